"""A row of the command palette: title with the typed letters lit, where it is from, and its key as a keycap."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QFontMetrics, QPainter, QPen
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from .. import theme
from .palette_choices import Offer

ROW = 30
#: Where a row keeps its offer.
OFFER = Qt.ItemDataRole.UserRole

_PAD = 12


class PaletteRows(QStyledItemDelegate):
    """Paints offers."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        """All rows are as high."""
        return QSize(200, ROW)

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """One row."""
        offer: Offer = index.data(OFFER)
        choice, rect = offer.choice, option.rect
        painter.save()
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        if chosen:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(theme.CHECKED)
            painter.drawRoundedRect(QRectF(rect).adjusted(1, 1, -1, -1), 5, 5)
        right = rect.right() - _PAD
        for key in reversed(choice.keys.split(", ") if choice.keys else []):
            right = self._keycap(painter, key, right, rect) - 6
        room = self._group(painter, choice.group, chosen, right, rect)
        self._title(painter, offer, chosen, QRect(rect.left() + _PAD, rect.top(), room - rect.left() - _PAD, ROW))
        painter.restore()

    @staticmethod
    def _keycap(painter: QPainter, text: str, right: int, rect: QRect) -> int:
        """The key at the right; its left edge."""
        font = theme.font(theme.POINT_SIZE - 1)
        metrics = QFontMetrics(font)
        width = metrics.horizontalAdvance(text) + 12
        cap = QRectF(right - width, rect.top() + (ROW - 20) / 2, width, 20)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(theme.BORDER, 1))
        painter.setBrush(theme.RAISED)
        painter.drawRoundedRect(cap.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
        painter.setPen(theme.TEXT)
        painter.setFont(font)
        painter.drawText(cap, Qt.AlignmentFlag.AlignCenter, text)
        return right - width

    @staticmethod
    def _group(painter: QPainter, text: str, chosen: bool, right: int, rect: QRect) -> int:
        """Where it is from, left of the key; the right edge of what remains."""
        font = theme.font(theme.POINT_SIZE - 1)
        metrics = QFontMetrics(font)
        text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, rect.width() // 3)
        width = metrics.horizontalAdvance(text)
        painter.setFont(font)
        painter.setPen(theme.TEXT if chosen else theme.MUTED)
        painter.drawText(QRect(right - width, rect.top(), width, ROW), Qt.AlignmentFlag.AlignVCenter, text)
        return right - width - _PAD

    @staticmethod
    def _title(painter: QPainter, offer: Offer, chosen: bool, rect: QRect) -> None:
        choice = offer.choice
        plain, lit = theme.font(), theme.font(bold=True)
        x = rect.left()
        shown = choice.title + ("  ✓" if choice.on else "")
        colour = theme.FAINT if not choice.enabled else theme.BRIGHT if chosen else theme.TEXT
        places = set(offer.places)
        # in runs of letters, or kerning would go
        runs: list[tuple[bool, str]] = []
        for i, letter in enumerate(shown):
            is_lit = i in places
            if runs and runs[-1][0] == is_lit:
                runs[-1] = (is_lit, runs[-1][1] + letter)
            else:
                runs.append((is_lit, letter))
        for is_lit, text in runs:
            painter.setFont(lit if is_lit else plain)
            painter.setPen(theme.HIGHLIGHT if is_lit and choice.enabled else colour)
            metrics = painter.fontMetrics()
            room = rect.right() - x
            cut = metrics.elidedText(text, Qt.TextElideMode.ElideRight, room)
            painter.drawText(QRect(x, rect.top(), room, ROW), Qt.AlignmentFlag.AlignVCenter, cut)
            x += metrics.horizontalAdvance(text)
            if cut != text:
                break

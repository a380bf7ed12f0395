"""Below the square of bigrams: what its colours mean, and how much of the language is drawn."""

from __future__ import annotations

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from .. import theme

#: Name, fill and edge of a swatch.
Entry = tuple[str, QColor | None, QColor | None]

_SWATCH, _GAP, _ROW = 9, 12, 17  # pixels


def _small_font() -> QFont:
    font = QFont()
    font.setPointSizeF(8)
    return font


class BigramLegend(QWidget):
    """Names of the fills and rings, wrapped to the width; while searching, what was found instead."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFont(_small_font())
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._message = ""
        status = theme.STATUS_COLOURS
        self._entries: tuple[Entry, ...] = ()
        self._state_of_work: tuple[Entry, ...] = (
            (self.tr("empty"), status["empty"], theme.BORDER),
            (self.tr("suggestion"), status["suggestion"], None),
            (self.tr("draft"), status["draft"], None),
            (self.tr("review"), status["review"], None),
            (self.tr("approved"), status["approved"], None),
            (self.tr("weak"), theme.WEAK, None),
            (self.tr("in sentence"), None, theme.BRIGHT),
            (self.tr("open"), None, theme.HIGHLIGHT),
        )
        self.setAccessibleName(self.tr("Legend"))
        self.set_other("")

    def set_other(self, name: str) -> None:
        """Name the tints of a comparison with a set of this name in place of the states of the work; "" for none."""
        if name:
            self._entries = (
                (self.tr("like {0}").format(name), theme.SUNKEN, theme.BORDER),
                (self.tr("differs a little"), theme.mix(theme.HIGHLIGHT, theme.SUNKEN, 0.4), None),
                (self.tr("differs much"), theme.HIGHLIGHT, None),
                *self._state_of_work[-2:],
            )
        else:
            self._entries = self._state_of_work
        self.set_message(self._message)
        self._lay_out()

    @property
    def names(self) -> tuple[str, ...]:
        """What the swatches stand for."""
        return tuple(name for name, _, _ in self._entries)

    def set_message(self, text: str) -> None:
        """Show a line in place of the legend; "" brings the legend back."""
        self._message = text
        self.setAccessibleDescription(text or ", ".join(self.names))
        self.update()

    @property
    def message(self) -> str:
        """The line shown in place of the legend."""
        return self._message

    def sizeHint(self) -> QSize:
        """As tall as the wrapped entries."""
        return QSize(200, self._height)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Wrap anew."""
        super().resizeEvent(event)
        self._lay_out()

    def _lay_out(self) -> None:
        metrics = self.fontMetrics()
        x = row = 0
        self._places: list[tuple[int, int]] = []
        for name, _, _ in self._entries:
            width = _SWATCH + 5 + metrics.horizontalAdvance(name)
            if x and x + width > self.width():
                x, row = 0, row + 1
            self._places.append((x, row * _ROW))
            x += width + _GAP
        self._height = (row + 1) * _ROW
        self.setFixedHeight(self._height)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Swatches and names, or the message."""
        painter = QPainter(self)
        middle = Qt.AlignmentFlag.AlignVCenter
        if self._message:
            painter.setPen(theme.TEXT)
            text = self.fontMetrics().elidedText(self._message, Qt.TextElideMode.ElideRight, self.width())
            painter.drawText(QRect(0, 0, self.width(), _ROW), middle, text)
            return
        for (name, fill, edge), (x, y) in zip(self._entries, self._places, strict=True):
            swatch = QRect(x, y + (_ROW - _SWATCH) // 2, _SWATCH, _SWATCH)
            if fill is not None:
                painter.fillRect(swatch, fill)
            if edge is not None:
                painter.setPen(edge)
                painter.drawRect(swatch.adjusted(0, 0, -1, -1))
            painter.setPen(theme.MUTED)
            painter.drawText(QRect(x + _SWATCH + 5, y, self.width(), _ROW), middle, name)


class CoverageBar(QWidget):
    """How much is drawn, as a bar with its text on it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFont(_small_font())
        self.setFixedHeight(18)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.tr("Coverage"))
        self._text, self._fraction = "", 0.0

    def set_coverage(self, text: str, fraction: float) -> None:
        """`text` over a bar filled to `fraction`, 0…1."""
        self._text, self._fraction = text, min(max(fraction, 0.0), 1.0)
        self.setAccessibleDescription(text)
        self.setToolTip(text)
        self.update()

    @property
    def text(self) -> str:
        """What the bar says."""
        return self._text

    def sizeHint(self) -> QSize:
        """One line."""
        return QSize(200, 18)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Track, bar, text."""
        painter = QPainter(self)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(theme.SUNKEN)
        painter.drawRoundedRect(self.rect(), 3, 3)
        filled = QRect(0, 0, round(self.width() * self._fraction), self.height())
        painter.setClipRect(filled)
        painter.setBrush(theme.CHECKED)
        painter.drawRoundedRect(self.rect(), 3, 3)
        painter.setClipping(False)
        painter.setPen(theme.TEXT)
        text = self.fontMetrics().elidedText(self._text, Qt.TextElideMode.ElideRight, self.width() - 8)
        painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, text)

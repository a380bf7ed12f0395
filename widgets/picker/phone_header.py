"""The names of the phones along the sides of the bigram square."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QFont, QFontMetrics, QPainter, QPaintEvent
from PySide6.QtWidgets import QHeaderView, QWidget

from .. import theme


def header_font(cell: int) -> QFont:
    """As large as a row of `cell` pixels allows."""
    font = QFont()
    font.setPixelSize(min(12, max(cell - 3, 8)))
    return font


def widest(phonemes: Sequence[str], cell: int) -> int:
    """Width of the longest name in pixels, in the font for `cell`."""
    metrics = QFontMetrics(header_font(cell))
    return max((metrics.horizontalAdvance(phone) for phone in phonemes), default=0)


def fits_level(phonemes: Sequence[str], cell: int, wide: int) -> bool:
    """Whether column names in the font for `cell` need not stand upright above columns `wide` pixels wide."""
    return widest(phonemes, cell) <= wide - 2


class PhoneHeader(QHeaderView):
    """The phones along one side, the current cell's marked. Column names turn upright where cells are small."""

    def __init__(self, orientation: Qt.Orientation, parent: QWidget) -> None:
        super().__init__(orientation, parent)
        self.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.setMinimumSectionSize(1)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._current = -1
        self._found: frozenset[int] = frozenset()
        self._cell = 12

    def set_cell(self, cell: int, size: int) -> None:
        """Sections of `size` pixels, names in the font for `cell`."""
        self._cell = cell
        self.setDefaultSectionSize(size)

    def set_current(self, section: int) -> None:
        """The section of the current cell, -1 for none."""
        if section != self._current:
            self._current = section
            self.viewport().update()

    def set_found(self, sections: Collection[int]) -> None:
        """The sections that a search names."""
        self._found = frozenset(sections)
        self.viewport().update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Every visible phone."""
        painter = QPainter(self.viewport())
        painter.fillRect(event.rect(), theme.WINDOW)
        cell = self.defaultSectionSize()
        painter.setFont(header_font(self._cell))
        across = self.orientation() == Qt.Orientation.Horizontal
        phones = [str(self.model().headerData(i, self.orientation())) for i in range(self.count())]
        upright = across and not fits_level(phones, self._cell, cell)
        for section, phone in enumerate(phones):
            at = self.sectionViewportPosition(section)
            rect = QRect(at, 0, cell, self.height()) if across else QRect(0, at, self.width(), cell)
            if not rect.intersects(event.rect()):
                continue
            if section == self._current:
                painter.fillRect(rect, theme.CHECKED)
                painter.setPen(theme.BRIGHT)
            else:
                painter.setPen(theme.HIGHLIGHT if section in self._found else theme.MUTED)
            if upright:
                painter.save()
                painter.translate(rect.x(), rect.bottom() + 1)
                painter.rotate(-90)
                painter.drawText(QRect(4, 0, self.height() - 4, cell), Qt.AlignmentFlag.AlignVCenter, phone)
                painter.restore()
            elif across:
                painter.drawText(rect, Qt.AlignmentFlag.AlignCenter, phone)
            else:
                flags = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight
                painter.drawText(rect.adjusted(0, 0, -5, 0), flags, phone)

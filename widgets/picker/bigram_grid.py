"""The square of all bigrams: one coloured cell per pair.

A table view, so that arrow keys, tooltips and screen readers find real cells, that paints all cells as one
small image blown up: a repaint costs nearly the same for 21 phones and for 60.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from PySide6.QtCore import QLine, QModelIndex, QPersistentModelIndex, QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QImage, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QFrame, QSizePolicy, QTableView, QWidget

from core_pipeline.phonemes import Pair

from .. import theme
from .bigram_model import BigramModel, Index
from .phone_header import PhoneHeader, fits_level, header_font, widest

MIN_CELL, MIN_TALL, MAX_CELL = 11, 9, 28  # pixels; a width of 11 only where the view must scroll as well
_WIDER = 2  # a cell is at most this many times as wide as tall
_FAINTEST = 0.45  # share of orange on the least weak cell
_DIMMED = 0.35  # share of the fill left on cells that a search did not find


class BigramGrid(QTableView):
    """The square. Arrow keys and clicks move the current cell and open it at once: `picked(pair)`; Enter
    asks to work on it: `entered()`.

    Cells fill the width, each from 12 pixels on; they are as tall as wide where there is the height, else lower,
    down to 9. In less the view scrolls.
    """

    picked = Signal(tuple)
    entered = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.pairs = BigramModel(self)
        self._image = QImage()
        self._pixels = np.zeros((0, 0), np.uint32)
        self._image_is_old = True
        self._found: frozenset[Pair] | None = None
        self._ringed = False
        self._hovered = QModelIndex()
        self._across = PhoneHeader(Qt.Orientation.Horizontal, self)
        self._down = PhoneHeader(Qt.Orientation.Vertical, self)
        self.setHorizontalHeader(self._across)
        self.setVerticalHeader(self._down)
        self.setModel(self.pairs)
        self.pairs.dataChanged.connect(self._outdate)
        self.pairs.modelReset.connect(self._lay_out)
        self.setCornerButtonEnabled(False)
        self.setStyleSheet(f"QTableCornerButton::section{{background:{theme.WINDOW.name()};border:0}}")
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setShowGrid(False)
        self.setTabKeyNavigation(False)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMouseTracking(True)
        self.setAccessibleName(self.tr("Bigrams"))
        self.setAccessibleDescription(self.tr("Rows: first phone. Columns: second phone. Arrow keys open bigrams."))

    @property
    def cell(self) -> QSize:
        """A cell in pixels."""
        return QSize(self._across.defaultSectionSize(), self._down.defaultSectionSize())

    def set_current(self, pair: Pair | None) -> None:
        """Show which bigram is open; emits nothing."""
        index = self.pairs.index_of(pair)
        self.setCurrentIndex(index)
        if index.isValid():
            self.scrollTo(index)

    def set_found(self, found: Collection[Pair] | None, phones: Collection[str] = (), *, ringed: bool = True) -> None:
        """Dim all cells but `found`; None ends the search. `phones` stand out in the headers."""
        self._found = None if found is None else frozenset(found)
        self._ringed = ringed
        sections = [i for i, phone in enumerate(self.pairs.phonemes) if phone in phones]
        self._across.set_found(sections)
        self._down.set_found(sections)
        self._outdate()

    def rect_of(self, pair: Pair) -> QRect:
        """Where a pair stands in the viewport; empty when it is not in the square."""
        cell = self.pairs.cell(pair)
        if cell is None:
            return QRect()
        size = self.cell
        x, y = -self.horizontalOffset(), -self.verticalOffset()
        return QRect(x + cell[1] * size.width(), y + cell[0] * size.height(), size.width() - 1, size.height() - 1)

    def sizeHint(self) -> QSize:
        """Room for cells of 17 pixels."""
        return self._whole(17, 17)

    def minimumSizeHint(self) -> QSize:
        """The whole width of the smallest cells, some rows."""
        small = self._whole(MIN_CELL, MIN_TALL)
        return QSize(small.width(), min(small.height(), self._head(MIN_CELL, MIN_TALL) + 10 * MIN_TALL))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Choose the largest cells that fit."""
        super().resizeEvent(event)
        self._lay_out()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows, Home, End and pages move and open; Enter opens again and goes to the curves."""
        before = QPersistentModelIndex(self.currentIndex())
        super().keyPressEvent(event)
        now = self.currentIndex()
        entered = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if now.isValid() and (entered or before != now):
            self.picked.emit(self.pairs.pair_at(now))
            if entered:
                self.entered.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """A left click opens."""
        super().mousePressEvent(event)
        index = self.indexAt(event.position().toPoint())
        if index.isValid() and event.button() == Qt.MouseButton.LeftButton:
            self.picked.emit(self.pairs.pair_at(index))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Ring the cell under the pointer; a drag does nothing else."""
        self._hover(self.indexAt(event.position().toPoint()))

    def leaveEvent(self, event: Any) -> None:
        """Nothing is under the pointer any more."""
        self._hover(QModelIndex())
        super().leaveEvent(event)

    def currentChanged(self, current: Index, previous: Index) -> None:
        """Row and column names follow."""
        super().currentChanged(current, previous)
        self._down.set_current(current.row())
        self._across.set_current(current.column())
        self.viewport().update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """One image for the fills, one pass of lines for the gaps, then rings and dots."""
        if self._image_is_old:
            self._make_image()
        count, size = len(self.pairs.phonemes), self.cell
        painter = QPainter(self.viewport())
        painter.fillRect(event.rect(), theme.WINDOW)
        if not count:
            return
        origin = QPoint(-self.horizontalOffset(), -self.verticalOffset())
        wide, tall = count * size.width(), count * size.height()
        painter.translate(origin)
        painter.drawImage(QRect(0, 0, wide, tall), self._image)
        painter.setPen(theme.SUNKEN)
        across = [(i + 1) * size.width() - 1 for i in range(count)]
        down = [(i + 1) * size.height() - 1 for i in range(count)]
        painter.drawLines([QLine(x, 0, x, tall - 1) for x in across] + [QLine(0, y, wide - 1, y) for y in down])
        painter.translate(-origin)
        current = self.pairs.pair_at(self.currentIndex()) if self.currentIndex().isValid() else None
        self._paint_rings(painter, current)
        if self.hasFocus():
            painter.setPen(theme.ACCENT)
            painter.drawRect(QRect(origin, QSize(wide - 1, tall - 1)))
        if current is not None:
            ring = self.rect_of(current)
            painter.setPen(theme.HIGHLIGHT)
            painter.drawRects([ring.adjusted(-1, -1, 0, 0), ring.adjusted(0, 0, -1, -1)])

    def _paint_rings(self, painter: QPainter, current: Pair | None) -> None:
        used = [p for p, times in self.pairs.used.items() if times and self.pairs.cell(p)]
        if used:
            painter.setPen(theme.BRIGHT if self._found is None else theme.FAINT)
            # inside the ring of the current cell, so that both can be seen
            inset = {current: 1}
            painter.drawRects([_inside(self.rect_of(p), inset.get(p, 0)) for p in used])
            pale = [p for p in used if self.pairs.statuses.get(p) == "approved"]
            if pale:  # white on nearly white: a dark line within
                painter.setPen(theme.SUNKEN)
                painter.drawRects([_inside(self.rect_of(p), inset.get(p, 0) + 1) for p in pale])
        if self._found is not None and self._ringed:
            painter.setPen(theme.LINK)
            painter.drawRects([_inside(self.rect_of(p), 0) for p in self._found if self.pairs.cell(p)])
        for pair in self.pairs.overridden:
            if self.pairs.cell(pair):
                corner = self.rect_of(pair).bottomRight()
                painter.fillRect(QRect(corner - QPoint(5, 5), QSize(5, 5)), theme.SUNKEN)
                painter.fillRect(QRect(corner - QPoint(4, 4), QSize(3, 3)), theme.BRIGHT)
        if self._hovered.isValid():
            painter.setPen(theme.TEXT)
            painter.drawRect(self.rect_of(self.pairs.pair_at(self._hovered)).adjusted(-1, -1, 0, 0))

    def _make_image(self) -> None:
        """Pixel (column, row) is the fill of that cell."""
        count = len(self.pairs.phonemes)
        colours = {status: colour.rgb() for status, colour in theme.STATUS_COLOURS.items()}
        self._pixels = np.full((count, count), colours["empty"], np.uint32)
        for pair, status in self.pairs.statuses.items():
            if cell := self.pairs.cell(pair):
                self._pixels[cell] = colours.get(status, colours["draft"])
        for pair in self.pairs.weak:
            if cell := self.pairs.cell(pair):
                share = self.pairs.weakness.get(pair, 1.0)
                own = theme.STATUS_COLOURS.get(self.pairs.statuses.get(pair, "empty"), theme.WEAK)
                self._pixels[cell] = theme.mix(theme.WEAK, own, _FAINTEST + (1 - _FAINTEST) * share).rgb()
        for pair, amount in (self.pairs.differences or {}).items():
            if cell := self.pairs.cell(pair):
                self._pixels[cell] = theme.mix(theme.HIGHLIGHT, theme.SUNKEN, min(max(amount, 0.0), 1.0)).rgb()
        if self._found is not None:
            found = np.zeros((count, count), bool)
            for pair in self._found:
                if cell := self.pairs.cell(pair):
                    found[cell] = True
            channels = self._pixels.view(np.uint8).reshape(count, count, 4)
            paper = np.array([theme.SUNKEN.rgb()], np.uint32).view(np.uint8)
            channels[~found] = channels[~found] * _DIMMED + paper * (1 - _DIMMED)
        self._image = QImage(self._pixels.data, count, count, 4 * count, QImage.Format.Format_RGB32)
        self._image_is_old = False

    def _outdate(self) -> None:
        self._image_is_old = True
        self.viewport().update()

    def _hover(self, index: QModelIndex) -> None:
        if index != self._hovered:
            self._hovered = index
            self.viewport().update()

    def _lay_out(self) -> None:
        self._hovered = QModelIndex()
        phonemes = self.pairs.phonemes
        cell = self._largest(self.width(), self.height())
        self._across.set_cell(min(cell.width(), cell.height()), cell.width())
        self._down.set_cell(cell.height(), cell.height())
        self._across.setFixedHeight(self._head(cell.width(), cell.height()))
        # What is left beside whole cells goes to the names, unless the cells are at their widest.
        count, names = max(len(phonemes), 1), self._names(cell.height())
        left = self.width() - names - count * cell.width()
        scrolled = self._head(cell.width(), cell.height()) + count * cell.height() > self.height()
        self._down.setFixedWidth(names + left if 0 <= left < count and not scrolled else names)
        self.updateGeometries()
        # No taller than the cells need, so that what stands below follows at once.
        most = self._largest(self.width(), 1 << 20)
        whole = self._whole(most.width(), most.height())
        self.setMaximumHeight(whole.height() if self.width() >= whole.width() else 1 << 14)
        self.updateGeometry()
        if self.currentIndex().isValid():
            self.scrollTo(self.currentIndex())
        self._outdate()

    def _names(self, tall: int) -> int:
        """Width of the row names beside cells this tall."""
        return widest(self.pairs.phonemes, tall) + 10

    def _head(self, wide: int, tall: int) -> int:
        """Height of the column names above such cells."""
        cell = min(wide, tall)
        if fits_level(self.pairs.phonemes, cell, wide):
            return QFontMetrics(header_font(cell)).height() + 6
        return widest(self.pairs.phonemes, cell) + 8

    def _whole(self, wide: int, tall: int) -> QSize:
        count = len(self.pairs.phonemes)
        return QSize(self._names(tall) + count * wide, self._head(wide, tall) + count * tall)

    def _largest(self, width: int, height: int) -> QSize:
        count = max(len(self.pairs.phonemes), 1)
        for tall in range(MAX_CELL, MIN_TALL - 1, -1):
            wide = min((width - self._names(tall)) // count, _WIDER * tall)
            if wide >= max(tall, MIN_CELL + 1) and self._head(wide, tall) + count * tall <= height:
                return QSize(wide, tall)
        room = width - self._names(MIN_TALL) - self.verticalScrollBar().sizeHint().width()
        wide = min(room // count, _WIDER * MIN_TALL)
        return QSize(max(wide, MIN_CELL), MIN_TALL)


def _inside(rect: QRect, inset: int) -> QRect:
    """The 1-pixel ring just within `rect`, `inset` pixels further in."""
    return rect.adjusted(inset, inset, -1 - inset, -1 - inset)

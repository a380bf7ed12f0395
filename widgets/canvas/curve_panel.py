"""The canvas with the bar of values under it and the table of keys beside it, bound to one another."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, QTimer
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QSplitter, QToolButton, QVBoxLayout, QWidget

from .. import theme
from .curve_canvas import CurveCanvas
from .key_table import KeyTable
from .value_bar import ValueBar

#: Pixels of the table, and of the canvas when it is first asked.
TABLE, WIDE = 150, 800

#: Pixels of the whole at least, and from which on the button has its word.
NARROWEST, WITH_WORD = 240, 300

#: Milliseconds the table may lag behind a drag.
LAG = 30


class CurvePanel(QWidget):
    """Shows a canvas and, in figures, what is selected on it; what is typed goes to the canvas as a wish.

    The canvas remains its owner's to connect: its `edited` tells every change, by hand or by figures.
    """

    def __init__(self, canvas: CurveCanvas, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.canvas = canvas
        self.values = ValueBar()
        self.table = KeyTable()
        self.table.hide()
        self.table_button = QToolButton()
        self.table_button.setIcon(theme.icon("table"))
        self.table_button.setText(self.tr("Keys"))
        self.table_button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.table_button.setCheckable(True)
        self.table_button.setAccessibleName(self.tr("Show the table of keys"))
        self.table_button.setToolTip(self.tr("Show the keys of the active curve as a table"))
        foot = QHBoxLayout()
        foot.setContentsMargins(0, 0, 8, 0)
        foot.addWidget(self.values, 1)
        foot.addWidget(self.table_button)
        self._body = QSplitter(Qt.Orientation.Horizontal)
        self._body.setHandleWidth(3)
        self._body.addWidget(canvas)
        self._body.addWidget(self.table)
        self._body.setStretchFactor(0, 1)
        self._body.setStretchFactor(1, 0)
        self._body.setSizes([WIDE, TABLE])
        self._body.setChildrenCollapsible(False)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._body, 1)
        column.addLayout(foot)
        self._late = QTimer(self)
        self._late.setSingleShot(True)
        self._late.setInterval(LAG)
        self._late.timeout.connect(self._show_table)
        canvas.shown_changed.connect(self._show)
        self.values.typed.connect(canvas.type_value)
        self.values.left.connect(canvas.setFocus)
        self.table.typed.connect(self._typed)
        self.table.keys_picked.connect(self._picked)
        self.table.add_wanted.connect(canvas.add_key)
        self.table.delete_wanted.connect(canvas.delete_selection)
        self.table.left.connect(canvas.setFocus)
        self.table_button.toggled.connect(self.show_table)
        for before, after in (
            (canvas, self.values.time),
            (self.values.time, self.values.weight),
            (self.values.weight, self.table_button),
            (self.table_button, self.table),
        ):
            QWidget.setTabOrder(before, after)
        self._show()

    def minimumSizeHint(self) -> QSize:
        """Narrower than its parts want to be: then the button loses its word."""
        return QSize(NARROWEST, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """The button's word where there is room."""
        super().resizeEvent(event)
        style = Qt.ToolButtonStyle
        wide = event.size().width() >= WITH_WORD
        self.table_button.setToolButtonStyle(style.ToolButtonTextBesideIcon if wide else style.ToolButtonIconOnly)

    def show_table(self, on: bool) -> None:
        """Whether the table stands beside the canvas."""
        self.table_button.setChecked(on)
        self.table.setVisible(on)
        self._show_table()

    def _show(self) -> None:
        canvas, curves = self.canvas, self.canvas.curves
        keys = sorted((pose, i) for pose, i in canvas.selection if pose in curves and i < len(curves[pose]))
        self.values.set_keys([(float(curves[pose].t[i]), float(curves[pose].v[i])) for pose, i in keys])
        if not canvas.busy:
            self._show_table()
        elif not self._late.isActive():
            self._late.start()

    def _show_table(self) -> None:
        if self.table.isVisibleTo(self):
            canvas = self.canvas
            self.table.set_curve(canvas.active, canvas.curves.get(canvas.active), editable=canvas.editable)
            self.table.select_keys([i for pose, i in canvas.selection if pose == canvas.active])

    def _typed(self, index: int, axis: str, text: str) -> None:
        # An expression typed into one of several selected rows means all of them, a plain number only that cell.
        together = index in self.table.picked and text.lstrip()[:1] in ("*", "/", "+", "-", "=", "−", "×")
        keys = sorted(self.table.picked) if together else [index]
        self.canvas.type_value(axis, text, {self.canvas.active: keys})

    def _picked(self, indices: frozenset[int]) -> None:
        self.canvas.select([(self.canvas.active, i) for i in indices])

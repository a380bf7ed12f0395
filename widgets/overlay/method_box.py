"""Which other method is shown beside the stages, and how far it lies from them, pose by pose."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPoint, QSignalBlocker, QSize, Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QFrame,
    QHBoxLayout,
    QTableWidget,
    QTableWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from core_pipeline.methods.compare import Difference

from .. import theme

NONE = ""


class MethodBox(QWidget):
    """A choice, a button that shows the differences, and one that puts the method's own face beside.

    chosen(key)          a method, or NONE
    beside_toggled(bool) whether it shall speak beside this one
    """

    chosen = Signal(str)
    beside_toggled = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.box = QComboBox(self)
        self.box.setAccessibleName(self.tr("Other method"))
        self.box.setToolTip(self.tr("Another method's curves, grey and dashed, on the same sentence"))
        self.box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.box.setMinimumContentsLength(17)
        self.details = QToolButton(self)
        self.details.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        self.details.setAutoRaise(True)
        self.details.setAccessibleName(self.tr("Differences of the other method"))
        self.beside = QToolButton(self)
        self.beside.setCheckable(True)
        self.beside.setAutoRaise(True)
        self.beside.setIcon(theme.icon("account-multiple-outline"))
        self.beside.setToolTip(self.tr("Two faces side by side: this set, and the other method"))
        self.beside.setAccessibleName(self.beside.toolTip())
        self.beside.setText(self.beside.toolTip())
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2)
        for widget in (self.details, self.beside, self.box):
            row.addWidget(widget)
        self.popup = QFrame(self)  # not the table itself: that one would keep Escape and clicks outside to itself
        self.popup.setWindowFlags(Qt.WindowType.Popup)
        self.popup.setFrameShape(QFrame.Shape.StyledPanel)
        self.table = self._table()
        inside = QVBoxLayout(self.popup)
        inside.setContentsMargins(1, 1, 1, 1)
        inside.addWidget(self.table)
        self.popup.setFocusProxy(self.table)
        self.box.activated.connect(lambda _: self.chosen.emit(self.box.currentData()))
        self.beside.toggled.connect(self.beside_toggled)
        self.details.clicked.connect(self._show_table)
        self.set_differences(None)

    def set_methods(self, methods: Sequence[tuple[str, str]]) -> None:
        """(key, title) of each; emits nothing."""
        with QSignalBlocker(self.box):
            self.box.clear()
            for key, title in methods:
                self.box.addItem(title, key)

    def set_chosen(self, key: str) -> None:
        """Show that one as chosen; emits nothing."""
        with QSignalBlocker(self.box):
            self.box.setCurrentIndex(max(self.box.findData(key), 0))

    def set_busy(self, text: str) -> None:
        """What is being learned; "" at the end."""
        self.box.setEnabled(not text)
        if text:
            self.set_differences(None)
            self.details.setText(text)
            self.details.setVisible(True)
            self.details.setEnabled(False)

    def set_differences(self, found: Sequence[Difference] | None) -> None:
        """Of the present sentence; None when nothing is compared."""
        there = found is not None
        self.details.setVisible(there)
        self.beside.setVisible(there)
        self.details.setEnabled(there)
        self.popup.setVisible(self.popup.isVisible() and there)
        rows = sorted(found or (), key=lambda d: -d.rmse)
        whole = (sum(d.rmse**2 for d in rows) / len(rows)) ** 0.5 if rows else 0.0
        self.details.setText(self.tr("RMSE {0}").format(f"{whole:.3f}"))
        self.details.setToolTip(self.tr("How far the other method lies from these curves: click for every pose"))
        self.table.setRowCount(len(rows))
        for i, difference in enumerate(rows):
            for column, text in enumerate((difference.pose, f"{difference.rmse:.3f}", f"{difference.peak:+.3f}")):
                item = QTableWidgetItem(text)
                if column:
                    item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                self.table.setItem(i, column, item)

    def _table(self) -> QTableWidget:
        table = QTableWidget(0, 3)
        table.setHorizontalHeaderLabels([self.tr("Pose"), self.tr("RMSE"), self.tr("Peak difference")])
        table.setAccessibleName(self.tr("Differences, pose by pose"))
        table.setAccessibleDescription(self.tr("How far the two methods are apart"))
        table.verticalHeader().hide()
        table.setColumnWidth(0, 80)
        table.setColumnWidth(1, 80)
        table.horizontalHeader().setStretchLastSection(True)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        return table

    def _show_table(self) -> None:
        rows = self.table.rowCount()
        tall = self.table.horizontalHeader().sizeHint().height() + 8
        tall += sum(self.table.rowHeight(i) for i in range(rows))
        self.popup.resize(QSize(300, tall))
        corner = self.details.mapToGlobal(QPoint(0, 0))
        self.popup.move(corner.x(), max(corner.y() - tall, 0))
        self.popup.show()
        self.table.setFocus()

"""What one pose is made of: a bar and a number per shape, and a search field that adds shapes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QVBoxLayout, QWidget

from core_pipeline.faces.retarget import normalised

from ..number_box import NumberBox
from ..settings.row_table import Row, RowTable
from .shape_box import ShapeBox
from .shape_slider import ShapeSlider

#: What the file of a mapping takes, either way of nothing.
FARTHEST = 4.0


def other_side(shape: str, shapes: Sequence[str]) -> str | None:
    """The shape that does on the right what this one does on the left, or the other way round."""
    plain = normalised(shape)
    turned = plain[:-1] + {"l": "r", "r": "l"}.get(plain[-1:], "")
    return next((name for name in shapes if name != shape and normalised(name) == turned), None)


class _ShapeRow(Row):
    """The bar goes from 0 to 1.5; the number also takes less than 0, for correctives, and more."""

    def __init__(self) -> None:
        super().__init__()
        self.shape = ""
        self.slider = ShapeSlider()
        self.amount = NumberBox(-FARTHEST, FARTHEST, 0.05)
        self.amount.setButtonSymbols(NumberBox.ButtonSymbols.NoButtons)  # the bar is beside it
        self.amount.setFixedWidth(self.amount.fontMetrics().horizontalAdvance("-0.00") + 18)
        self.line.addWidget(self.slider, 1)
        self.line.addWidget(self.amount)
        self.line.addWidget(self.remove)
        self.slider.valueChanged.connect(self._slid)
        self.amount.valueChanged.connect(self._typed)

    def show_shape(self, shape: str, amount: float, *, editable: bool) -> None:
        self.shape = shape
        self.slider.show_amount(shape, amount)
        self.amount.show_value(amount)
        self.amount.setAccessibleName(self.tr("Amount of {0}, as a number").format(shape))
        self.amount.setAccessibleDescription(self.tr("Less than 0 too, and more than the bar shows"))
        text = self.tr("Leave {0} out").format(shape)
        self.remove.setToolTip(text)
        self.remove.setAccessibleName(text)
        self.remove.setText(text)
        for field in (self.slider, self.amount, self.remove):
            field.setEnabled(editable)

    def _slid(self) -> None:
        self.amount.show_value(self.slider.amount)
        self.changed.emit(self.shape)

    def _typed(self, amount: float) -> None:
        self.slider.show_amount(self.shape, amount)
        self.changed.emit(self.shape)


class MixTable(QWidget):
    """The mix of one pose.

    edited(mix)  shape → amount, after every step of a slide, a typed number, a shape added or left out
    settled()    what comes next is another change: the slide has ended, or it was no slide
    """

    edited = Signal(object)
    settled = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shapes: tuple[str, ...] = ()
        self._editable = True
        self._sliding = ""  # the shape that was changed last
        self.table = RowTable(self._new_row, self.tr("Add a shape"))
        self.table.add.hide()  # the search field adds
        self.table.row_changed.connect(self._changed)
        self.table.remove_wanted.connect(self._remove)
        self.add = ShapeBox()
        self.add.shape_picked.connect(self._add)
        self.sides = QCheckBox(self.tr("Left and right together"))
        self.sides.setAccessibleName(self.sides.text())
        self.sides.setToolTip(self.tr("A shape of one side takes its twin of the other side along"))
        self.sides.setChecked(True)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(5)
        column.addWidget(self.table)
        column.addWidget(self.add)
        column.addWidget(self.sides)
        column.addStretch(1)

    def set_mix(self, mix: Mapping[str, float], shapes: Sequence[str], *, editable: bool = True) -> None:
        """One row per shape of the mix; the other `shapes` can be added. Emits nothing."""
        self._shapes, self._editable = tuple(shapes), editable
        self.table.set_count(len(mix))
        for row, (shape, amount) in zip(self.table.rows, mix.items(), strict=True):
            row.show_shape(shape, amount, editable=editable)
        self.add.set_shapes([shape for shape in shapes if shape not in mix])
        self.add.setVisible(editable)
        self.sides.setVisible(editable and any(other_side(shape, tuple(mix)) for shape in mix))

    def mix(self) -> dict[str, float]:
        """The table as it stands."""
        return {row.shape: row.amount.exact for row in self.table.rows}

    def _new_row(self) -> _ShapeRow:
        row = _ShapeRow()
        row.slider.sliderReleased.connect(self.settled)
        row.amount.editingFinished.connect(self.settled)
        return row

    def _changed(self, shape: str) -> None:
        if shape != self._sliding:
            self._sliding = shape
            self.settled.emit()
        mix = self.mix()
        twin = other_side(shape, tuple(mix)) if self.sides.isChecked() else None
        if twin is not None:
            mix[twin] = mix[shape]
            row = next(row for row in self.table.rows if row.shape == twin)
            row.show_shape(twin, mix[twin], editable=True)
        self.edited.emit(mix)

    def _add(self, shape: str) -> None:
        self.set_mix({**self.mix(), shape: 0.0}, self._shapes)
        self.table.rows[-1].slider.setFocus()
        self.settled.emit()
        self.edited.emit(self.mix())
        self.settled.emit()

    def _remove(self, at: int) -> None:
        mix = self.mix()
        del mix[self.table.rows[at].shape]
        self.set_mix(mix, self._shapes)
        if not mix:
            self.add.setFocus()
        self.settled.emit()
        self.edited.emit(mix)
        self.settled.emit()

"""Which two poses may not be strong together: C(a, b) of section 3.2.2, one row per pair: "open + FV ≤ 0.50"."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from core_pipeline.settings import UNCONSTRAINED, Constraint

from ..number_box import NumberBox
from .row_table import Row, RowTable, pose_box, show_choice

_NEW_LIMIT = 0.5


class _ConstraintRow(Row):
    def __init__(self) -> None:
        super().__init__()
        self.a, self.b = pose_box(), pose_box()
        self.limit = NumberBox(0.0, UNCONSTRAINED, 0.05)
        self.limit.make_narrow()
        self.line.addWidget(self.a, 1)
        self.add_sign("+")
        self.line.addWidget(self.b, 1)
        self.add_sign("≤")
        self.line.addWidget(self.limit)
        self.line.addWidget(self.remove)
        self.a.setAccessibleName(self.tr("First pose"))
        self.a.setAccessibleDescription(self.tr("One of the two poses that clash"))
        self.b.setAccessibleName(self.tr("Second pose"))
        self.b.setAccessibleDescription(self.tr("The other of the two poses that clash"))
        self.limit.setAccessibleName(self.tr("Largest sum of both weights"))
        self.limit.setToolTip(self.tr("Largest sum of both weights, 0 to 2; the pose of lower priority gives way"))
        for box in (self.a, self.b):
            box.activated.connect(lambda _: self._tell())
        self.limit.valueChanged.connect(lambda _: self._tell())

    def show_constraint(self, constraint: Constraint, names: Sequence[str]) -> None:
        show_choice(self.a, names, constraint.a)
        show_choice(self.b, names, constraint.b)
        self.limit.show_value(constraint.limit)
        text = self.tr("Remove the constraint of %1 and %2").replace("%1", constraint.a).replace("%2", constraint.b)
        self.remove.setToolTip(text)
        self.remove.setAccessibleName(text)
        self.remove.setText(text)

    def constraint(self) -> Constraint:
        return Constraint(self.a.currentText(), self.b.currentText(), self.limit.exact)

    def _tell(self) -> None:
        c = self.constraint()
        self.changed.emit(self.tr("Constraint of %1 and %2").replace("%1", c.a).replace("%2", c.b))


class ConstraintTable(QWidget):
    """edited(constraints, label): the whole table after one action of the user, and a name for it.

    It is passed on as it stands, even when a pose stands against itself: judging it is the receiver's part.
    """

    edited = Signal(tuple, str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._names: tuple[str, ...] = ()
        self.table = RowTable(_ConstraintRow, self.tr("Add constraint"))
        self.table.row_changed.connect(lambda label: self.edited.emit(self.constraints(), label))
        self.table.remove_wanted.connect(self._remove)
        self.table.add_wanted.connect(self._add)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.table)
        self.setAccessibleName(self.tr("Constraints"))

    def set_constraints(self, constraints: Sequence[Constraint], poses: Sequence[str]) -> None:
        """One row per constraint; `poses` can be chosen. Emits nothing."""
        named = (pose for c in constraints for pose in (c.a, c.b))
        self._names = tuple(dict.fromkeys([*poses, *named]))
        self.table.set_count(len(constraints))
        for row, constraint in zip(self.table.rows, constraints, strict=True):
            row.show_constraint(constraint, self._names)
        self.table.add.setEnabled(self._free_pair() is not None)

    def constraints(self) -> tuple[Constraint, ...]:
        """The table as it stands."""
        return tuple(row.constraint() for row in self.table.rows)

    def _free_pair(self) -> tuple[str, str] | None:
        taken = {frozenset((c.a, c.b)) for c in self.constraints()}
        return next((pair for pair in combinations(self._names, 2) if frozenset(pair) not in taken), None)

    def _add(self) -> None:
        pair = self._free_pair()
        if pair is not None:
            self.edited.emit((*self.constraints(), Constraint(*pair, _NEW_LIMIT)), self.tr("Add constraint"))

    def _remove(self, at: int) -> None:
        rest = self.constraints()
        self.edited.emit(rest[:at] + rest[at + 1 :], self.tr("Remove constraint"))

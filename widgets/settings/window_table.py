"""Smoothing windows of single poses (section 3.2.1): lips that must close get a narrower one than the rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from ..number_box import NumberBox
from .row_table import Row, RowTable, pose_box, show_choice


def window_box() -> NumberBox:
    """A width in seconds, 0…1."""
    return NumberBox(0.0, 1.0, 0.01, suffix=" s")


class _WindowRow(Row):
    def __init__(self) -> None:
        super().__init__()
        self.pose = pose_box()
        self.width_box = window_box()
        self.width_box.make_narrow()
        self.line.addWidget(self.pose, 1)
        self.line.addWidget(self.width_box)
        self.line.addWidget(self.remove)
        self.pose.setAccessibleName(self.tr("Pose with its own window"))
        self.pose.setAccessibleDescription(self.tr("The pose that is smoothed over another time"))
        self.width_box.setAccessibleName(self.tr("Smoothing window of this pose"))
        self.width_box.setAccessibleDescription(self.tr("Seconds between peaks that are joined"))
        self.pose.activated.connect(lambda _: self._tell())
        self.width_box.valueChanged.connect(lambda _: self._tell())

    def show_window(self, pose: str, width: float, names: Sequence[str]) -> None:
        show_choice(self.pose, names, pose)
        self.width_box.show_value(width)
        text = self.tr("%1 takes the window of all poses again").replace("%1", pose)
        self.remove.setToolTip(text)
        self.remove.setAccessibleName(text)
        self.remove.setText(text)

    def _tell(self) -> None:
        self.changed.emit(self.tr("Smoothing window of %1").replace("%1", self.pose.currentText()))


class WindowTable(QWidget):
    """edited(windows, label): pose → seconds after one action of the user, and a name for it."""

    edited = Signal(object, str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._names: tuple[str, ...] = ()
        self._default = 0.0
        self.table = RowTable(_WindowRow, self.tr("Add pose"))
        self.table.add.setToolTip(self.tr("Give one pose a window of its own"))
        self.table.row_changed.connect(lambda label: self.edited.emit(self.windows(), label))
        self.table.remove_wanted.connect(self._remove)
        self.table.add_wanted.connect(self._add)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.table)
        self.setAccessibleName(self.tr("Smoothing windows of single poses"))

    def set_windows(self, windows: Mapping[str, float], default: float, poses: Sequence[str]) -> None:
        """One row per pose with a window of its own, seconds. Emits nothing."""
        self._names = tuple(dict.fromkeys([*poses, *windows]))
        self._default = default
        self.table.set_count(len(windows))
        for row, (pose, width) in zip(self.table.rows, windows.items(), strict=True):
            # a pose that has a row cannot be chosen in another one
            row.show_window(pose, width, [name for name in self._names if name == pose or name not in windows])
        self.table.add.setEnabled(len(windows) < len(self._names))

    def windows(self) -> dict[str, float]:
        """The table as it stands."""
        return {row.pose.currentText(): row.width_box.exact for row in self.table.rows}

    def _add(self) -> None:
        windows = self.windows()
        pose = next((name for name in self._names if name not in windows), None)
        if pose is not None:
            label = self.tr("Smoothing window of %1").replace("%1", pose)
            self.edited.emit({**windows, pose: self._default}, label)

    def _remove(self, at: int) -> None:
        windows = self.windows()
        pose = list(windows)[at]
        del windows[pose]
        self.edited.emit(windows, self.tr("Smoothing window of %1").replace("%1", pose))

"""The settings of the pipeline: preset, spline, smoothing, constraints, priorities, speed limit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFormLayout, QFrame, QLabel, QScrollArea, QVBoxLayout, QWidget

from core_pipeline.errors import UserError
from core_pipeline.settings import PRESETS, SPLINES, Constraint, Settings

from .. import theme
from ..number_box import NumberBox
from .constraint_table import ConstraintTable
from .priority_list import PriorityList
from .row_table import pose_box
from .window_table import WindowTable, window_box


class SettingsPanel(QWidget):
    """settings_changed(settings, label): valid settings after one action of the user, and a name for the undo list.

    What would not be valid is kept on screen with a sentence that says why, and is not emitted.
    """

    settings_changed = Signal(object, str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._settings = Settings.paper()
        self._poses: tuple[str, ...] = ()
        self._make_fields()
        self._lay_out()
        self.set_settings(self._settings, ())

    def set_settings(self, settings: Settings, poses: Sequence[str]) -> None:
        """Show `settings` for a set of poses; emits nothing."""
        self._settings, self._poses = settings, tuple(poses)
        preset = settings.preset_name()
        self.preset.setCurrentIndex(self.preset.findData(preset))
        self._note.setText(self.tr("SmartBody's speed limit of 6 keeps lips from closing in fast speech."))
        self._note.setVisible(preset == "smartbody")
        self.spline.setCurrentIndex(self.spline.findData(settings.spline))
        self.window_width.show_value(settings.window)
        self.windows.set_windows(settings.windows, settings.window, self._poses)
        self.constraints.set_constraints(settings.constraints, self._poses)
        self.priorities.set_priorities(settings.priorities, self._poses)
        self.speed_limit.show_value(settings.speed_limit)
        self._say("")
        self._idle.setText(self._without_effect())
        self._idle.setVisible(bool(self._idle.text()))

    @property
    def problem(self) -> str:
        """Why what stands on screen is not valid; "" when it is."""
        return self._problem.text()

    def _make_fields(self) -> None:
        self.preset = pose_box()
        titles = {"paper": self.tr("Paper"), "smartbody": self.tr("SmartBody")}
        for name in PRESETS:
            self.preset.addItem(titles.get(name, name), name)
        self.preset.addItem(self.tr("Custom"), "")
        # shown where the values are no preset's; a flag of 0 keeps it from being chosen
        self.preset.setItemData(len(PRESETS), 0, Qt.ItemDataRole.UserRole - 1)
        self.preset.activated.connect(lambda _: self._choose_preset())

        self.spline = pose_box()
        splines = {
            "pchip": self.tr("Through keys (pchip)"),
            "bspline": self.tr("B-spline, as printed"),
            "cardinal": self.tr("Cardinal, clipped"),
            "linear": self.tr("Straight lines"),
        }
        for name in SPLINES:
            self.spline.addItem(splines.get(name, name), name)
        self.spline.setToolTip(
            self.tr("How a curve runs between its keys; a B-spline halves the peak of a three-key curve")
        )
        self.spline.activated.connect(lambda _: self._change(self.tr("Spline"), spline=self.spline.currentData()))

        self.window_width = window_box()
        self.window_width.setToolTip(self.tr("Full width of the smoothing window, 0 to 1 s"))
        self.window_width.valueChanged.connect(lambda width: self._change(self.tr("Smoothing window"), window=width))
        self.windows = WindowTable()
        self.windows.edited.connect(lambda windows, label: self._change(label, windows=windows))
        self.constraints = ConstraintTable()
        self.constraints.edited.connect(self._constrain)
        self.priorities = PriorityList()
        self.priorities.edited.connect(lambda order: self._change(self.tr("Priorities"), priorities=order))
        self.speed_limit = NumberBox(0.01, 1e4, 0.5, suffix=self.tr(" per s"))
        self.speed_limit.setToolTip(self.tr("How fast a weight may change: 15 lets a pose come or go in 1/15 s"))
        self.speed_limit.valueChanged.connect(lambda speed: self._change(self.tr("Speed limit"), speed_limit=speed))

    def _lay_out(self) -> None:
        inner = QWidget()
        self._column = QVBoxLayout(inner)
        self._column.setContentsMargins(7, 10, 7, 10)
        self._column.setSpacing(5)
        self._note = self._text(theme.WEAK.name())
        self._idle = self._text(theme.MUTED.name())
        self._form(
            (self.tr("Preset"), self.preset),
            (self.tr("Spline"), self.spline),
            (self.tr("Speed limit"), self.speed_limit),
        )
        self.preset.setAccessibleDescription(self.tr("Settings of the pipeline that belong together"))
        self._column.addWidget(self._note)
        self._heading(self.tr("Smoothing"))
        self._form((self.tr("All poses"), self.window_width))
        self._column.addWidget(self.windows)
        self._heading(self.tr("Constraints"))
        self._column.addWidget(self.constraints)
        self._column.addWidget(self._idle)
        self._heading(self.tr("Priorities, highest first"))
        self._column.addWidget(self.priorities)
        self._column.addStretch(1)

        scroll = QScrollArea()
        scroll.setWidget(inner)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._problem = self._text(theme.ERROR.name())
        self._problem.setContentsMargins(10, 4, 10, 6)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.setSpacing(0)
        outer.addWidget(scroll, 1)
        outer.addWidget(self._problem)
        self.setMinimumWidth(280)

    def _form(self, *rows: tuple[str, QWidget]) -> None:
        form = QFormLayout()
        form.setHorizontalSpacing(10)
        form.setVerticalSpacing(5)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for title, field in rows:
            label = QLabel(title)
            label.setMinimumWidth(76)
            form.addRow(label, field)
            field.setAccessibleName(title)
        self._column.addLayout(form)

    def _heading(self, title: str) -> None:
        label = QLabel(title)
        label.setFont(theme.font(bold=True))
        label.setContentsMargins(0, 8, 0, 0)
        self._column.addWidget(label)

    @staticmethod
    def _text(colour: str) -> QLabel:
        label = QLabel()
        label.setWordWrap(True)
        label.setStyleSheet(f"color:{colour}")
        label.hide()
        return label

    def _choose_preset(self) -> None:
        name = self.preset.currentData()
        if name in PRESETS:
            label = self.tr("Preset %1").replace("%1", self.preset.currentText())
            self._try(label, lambda: PRESETS[name].with_spline(self._settings.spline))

    def _constrain(self, constraints: tuple[Constraint, ...], label: str) -> None:
        pairs = [frozenset((c.a, c.b)) for c in constraints]
        for c, pair in zip(constraints, pairs, strict=True):
            if c.a != c.b and pairs.count(pair) > 1:
                text = self.tr("The poses %1 and %2 stand in two rows: choose another pose in one of them.")
                self._say(text.replace("%1", c.a).replace("%2", c.b))
                return
        self._change(label, constraints=constraints)

    def _change(self, label: str, **fields: Any) -> None:
        self._try(label, lambda: replace(self._settings, **fields))

    def _try(self, label: str, make: Callable[[], Settings]) -> None:
        try:
            settings = make()
        except UserError as error:
            self._say(str(error))
            return
        changed = settings != self._settings
        self.set_settings(settings, self._poses)
        if changed:
            self.settings_changed.emit(settings, label)

    def _say(self, problem: str) -> None:
        self._problem.setText(problem)
        self._problem.setVisible(bool(problem))

    def _without_effect(self) -> str:
        """A sentence about constraints whose pose has no priority."""
        for c in self._settings.constraints:
            for pose in (c.a, c.b):
                if pose not in self._settings.priorities:
                    text = self.tr("%1 + %2 has no effect: %3 has no priority.")
                    return text.replace("%1", c.a).replace("%2", c.b).replace("%3", pose)
        return ""

"""How the faces are seen: background, light, camera and turntable, chosen in the View menu or over the face."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QActionGroup

from core_pipeline.faces.looks import ANGLES, BACKGROUNDS, LIGHTS, Look

from .parts import Parts


class Looks(QObject):
    """Joins the look's actions, the preview and what is remembered."""

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._state = parts.state
        self._preview = parts.preview
        self._actions = parts.window.actions_
        view, a = parts.window.face_view, self._actions
        parts.window.preview_panel.set_looks(
            [
                (self.tr("Background"), a.backgrounds.actions()),
                (self.tr("Light"), a.lights.actions()),
                (self.tr("Camera"), a.angles.actions()),
            ]
        )
        parts.window.preview_panel.set_turntable(a.turntable)
        a.backgrounds.triggered.connect(lambda _: self._show())
        a.lights.triggered.connect(lambda _: self._show())
        a.angles.triggered.connect(self._see_from)
        a.next_background.triggered.connect(lambda _=False: _step(a.backgrounds))
        a.next_light.triggered.connect(lambda _=False: _step(a.lights))
        a.reset_view.triggered.connect(lambda _=False: self._front())
        a.turntable.toggled.connect(self._preview.turntable.set_on)
        a.lively.toggled.connect(self._preview.set_lively)
        view.reset_wanted.connect(self._front)
        view.held.connect(self._preview.turntable.hold)
        view.orbited.connect(self._off_the_mark)

    def restore(self) -> None:
        """Last time's look."""
        self._actions.lively.setChecked(self._state.flag("lively", True))
        for name, group, known in self._remembered():
            chosen = self._state.text(name)
            for action in group.actions():
                if action.data() == chosen and chosen in known:
                    action.trigger()

    def remember(self) -> None:
        """Keep this time's."""
        self._state.put("lively", self._actions.lively.isChecked())
        for name, group, _ in self._remembered():
            action = group.checkedAction()
            self._state.put(name, str(action.data()) if action is not None else "")

    def _remembered(self) -> Iterable[tuple[str, QActionGroup, Iterable[str]]]:
        a = self._actions
        return (("background", a.backgrounds, BACKGROUNDS), ("light", a.lights, LIGHTS), ("camera", a.angles, ANGLES))

    def _show(self) -> None:
        background, light = _chosen(self._actions.backgrounds), _chosen(self._actions.lights)
        self._preview.set_look(Look(BACKGROUNDS[background], LIGHTS[light]))

    def _see_from(self, action: QAction) -> None:
        action.setChecked(True)  # also when it was chosen again
        self._preview.set_angle(ANGLES[action.data()])

    def _front(self) -> None:
        self._actions.turntable.setChecked(False)
        self._actions.angles.actions()[0].trigger()

    def _off_the_mark(self) -> None:
        """The face was turned by hand: no named camera shows this any more."""
        action = self._actions.angles.checkedAction()
        if action is not None:
            action.setChecked(False)


def _chosen(group: QActionGroup) -> str:
    action = group.checkedAction()
    return str(action.data()) if action is not None else str(group.actions()[0].data())


def _step(group: QActionGroup) -> None:
    """Choose the next one."""
    actions = group.actions()
    at = next((i for i, action in enumerate(actions) if action.isChecked()), -1)
    actions[(at + 1) % len(actions)].trigger()

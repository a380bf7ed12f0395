"""Several faces at once: chosen from portraits, said to be unable, looked at in another light, remembered."""

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app import resources
from app.editor import Editor
from app.settings import ViewState
from app.wiring.character import Character
from core_pipeline.files import curve_set_json
from core_pipeline.phonemes import Pair
from core_pipeline.poses import FACEFX
from tests.helpers import rigs


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def names(editor: Editor) -> list[str]:
    return [actor.face.name for actor in editor.preview.actors]


def add(editor: Editor, qtbot: QtBot, *wanted: str) -> None:
    """From the picker, as a user would."""
    qtbot.waitUntil(lambda: bool(editor.preview.actors), timeout=20_000)
    for name in wanted:
        QTest.mouseClick(editor.window.preview_panel.add, Qt.MouseButton.LeftButton)
        pick(editor, name)
        qtbot.waitUntil(lambda name=name: name in names(editor), timeout=20_000)


def pick(editor: Editor, name: str) -> None:
    picker = editor.window.face_picker
    assert picker.isVisible()
    row = picker.keys.index(str(resources.face_folder(name)))
    at = picker.faces.visualItemRect(picker.faces.item(row)).center()
    QTest.mouseClick(picker.faces.viewport(), Qt.MouseButton.LeftButton, pos=at)


def test_faces_are_added_changed_and_sent_away(editor: Editor, qtbot: QtBot) -> None:
    add(editor, qtbot, "man", "crab")
    view = editor.window.face_view
    assert names(editor) == ["toon", "man", "crab"]
    assert not editor.window.preview_panel.add.isEnabled()
    assert "open, W" in view.name_tags[2].name.accessibleDescription()  # English is not for crabs
    assert view.name_tags[0].name.accessibleDescription() == ""
    with qtbot.waitSignal(editor.preview.frame_ready, timeout=20_000):
        editor.preview.refresh()

    QTest.mouseClick(view.name_tags[1].name, Qt.MouseButton.LeftButton)
    pick(editor, "woman")
    qtbot.waitUntil(lambda: names(editor) == ["toon", "woman", "crab"], timeout=20_000)

    QTest.mouseClick(view.name_tags[2].away, Qt.MouseButton.LeftButton)
    assert names(editor) == ["toon", "woman"]
    QTest.mouseClick(view.name_tags[0].away, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: names(editor) == ["woman"], timeout=20_000)
    assert view.name_tags[0].away.isHidden()


def test_the_crab_wakes_when_its_curves_are_opened(editor: Editor, qtbot: QtBot) -> None:
    add(editor, qtbot, "crab")
    editor.files.open(resources.assets() / "curves" / "crab.json")
    view = editor.window.face_view
    qtbot.waitUntil(
        lambda: len(view.name_tags) == 2 and view.name_tags[1].name.accessibleDescription() == "", timeout=20_000
    )


def test_they_are_there_again_the_next_time(editor: Editor, qtbot: QtBot) -> None:
    add(editor, qtbot, "man")
    editor.wiring.character.remember()
    editor.wiring.character.company.remove(0)
    Character.restore(editor.wiring.character)
    qtbot.waitUntil(lambda: names(editor) == ["toon", "man"], timeout=20_000)


def test_a_rig_of_the_users_is_offered_again(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    path = rigs.as_glb(rigs.head(("jawOpen", "mouthPucker", "mouthFunnel"), rings=12), tmp_path / "head.glb")
    with qtbot.waitSignal(editor.faces.opened, timeout=20_000):
        editor.wiring.character.open(path)
    editor.window.actions_.pick_face.trigger()
    picker = editor.window.face_picker
    assert picker.keys[-1] == str(path)
    assert picker.faces.currentItem().text() == "head"
    picker.hide()


class Mute:
    """Somebody who says nothing, in other words."""

    poses = FACEFX

    def weights_at(self, seconds: float) -> np.ndarray:
        return np.zeros(len(self.poses))

    def bigram_weights_at(self, pair: Pair, s: float) -> None:
        return None


def test_the_same_face_may_say_it_in_two_ways(editor: Editor, qtbot: QtBot) -> None:
    add(editor, qtbot, "man")
    editor.wiring.character.company.compare([("Silence", Mute())], "Bigrams")
    assert [actor.name for actor in editor.preview.actors] == ["Bigrams", "Silence", "Man"]
    asked: list[list[float]] = []
    request = editor.preview.worker.request

    def watched(figures: list, *rest: object) -> None:
        asked.append([float(figure.amounts.max()) for figure in figures])
        request(figures, *rest)

    editor.preview.worker.request = watched
    editor.preview.set_lively(False)
    editor.preview.show_pose({"open": 1.0})
    qtbot.waitUntil(lambda: bool(asked) and asked[-1] == [1.0, 1.0, 1.0])  # a pose that is shown, all show
    editor.preview.show_pose({})
    editor.wiring.bigram.open(("f", "ah"))
    editor.preview.show_bigram(0.3)
    qtbot.waitUntil(lambda: asked[-1][0] > 0 and asked[-1][1] == 0 and asked[-1][2] > 0)
    editor.wiring.character.company.compare(())
    assert [actor.name for actor in editor.preview.actors] == ["Toon", "Man"]


def test_light_camera_and_turntable(editor: Editor, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: bool(editor.preview.actors), timeout=20_000)
    actions, preview = editor.window.actions_, editor.preview
    actions.registry["camera.left"].action.trigger()
    assert preview.views[0].yaw == 38
    actions.next_background.trigger()
    assert actions.backgrounds.checkedAction().data() == "daylight"
    actions.next_light.trigger()
    editor.wiring.looks.remember()
    actions.reset_view.trigger()
    actions.backgrounds.actions()[0].trigger()
    assert preview.views[0].yaw == 0
    editor.wiring.looks.restore()
    assert preview.views[0].yaw == 38
    assert actions.backgrounds.checkedAction().data() == "daylight"
    assert actions.lights.checkedAction().data() == "right"

    QTest.mouseClick(editor.window.preview_panel.turntable, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: preview.views[0].yaw != 38, timeout=20_000)
    view = editor.window.face_view
    QTest.mousePress(view, Qt.MouseButton.LeftButton)
    assert not preview.turntable.turning
    QTest.mouseRelease(view, Qt.MouseButton.LeftButton)
    assert preview.turntable.turning
    actions.turntable.trigger()
    assert not preview.turntable.turning


def test_a_picked_pose_of_the_tongue_is_shown_with_the_mouth_open(editor: Editor, qtbot: QtBot) -> None:
    weights: list[np.ndarray] = []
    editor.preview.weights_changed.connect(weights.append)
    poses = editor.session.curve_set.poses
    editor.window.pose_list.pose_picked.emit("tRoof")
    qtbot.waitUntil(lambda: bool(weights) and weights[-1][poses.index("tRoof")] == 1.0)
    assert weights[-1][poses.index("open")] == pytest.approx(0.3)
    editor.window.pose_list.pose_picked.emit("W")
    qtbot.waitUntil(lambda: weights[-1][poses.index("tRoof")] < 1.0)


def broken(tmp_path: Path, name: str = "broken.glb") -> Path:
    path = tmp_path / name
    path.write_bytes(b"not a face")
    return path


def test_a_face_that_cannot_be_read_is_told_over_the_picture_until_another_is_wished_for(
    editor: Editor, qtbot: QtBot, tmp_path: Path
) -> None:
    add(editor, qtbot, "man")
    notice, character = editor.window.face_view.notice, editor.wiring.character
    character.put(1, broken(tmp_path))
    qtbot.waitUntil(lambda: "broken.glb" in notice.text, timeout=20_000)
    assert names(editor) == ["toon", "man"]
    assert [path.name for path in character.paths] == ["toon", "man"]
    character.put(0, broken(tmp_path, "other.glb"))
    qtbot.waitUntil(lambda: "other.glb" in notice.text, timeout=20_000)
    assert [path.name for path in character.paths] == ["toon", "man"]
    character.company.add(broken(tmp_path))
    qtbot.waitUntil(lambda: "broken.glb" in notice.text and len(character.paths) == 2, timeout=20_000)
    editor.window.actions_.pick_face.trigger()
    assert not [key for key in editor.window.face_picker.keys if "broken" in key]  # it never arrived
    editor.window.face_picker.hide()
    QTest.mouseClick(notice.cross, Qt.MouseButton.LeftButton)
    assert notice.text == ""


def test_where_the_first_face_cannot_be_read_one_of_ours_comes(qtbot: QtBot, tmp_path: Path) -> None:
    state = ViewState(tmp_path / "state")
    state.put("face", str(broken(tmp_path)))
    editor = Editor(curve_set_json.load(resources.english_curves()), state)
    try:
        editor.wiring.restore()  # before the first of ours has been read
        qtbot.waitUntil(lambda: names(editor) == ["toon"], timeout=20_000)
        assert "broken.glb" in editor.window.face_view.notice.text
    finally:
        editor.close()
        editor.window.deleteLater()
    assert state.text("face") == str(resources.face_folder())


def test_reading_is_cancelled_by_a_button_over_the_picture(
    editor: Editor, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    add(editor, qtbot)
    monkeypatch.setattr("app.preview.faces.QUIET", 0.0)
    large = rigs.as_objs(rigs.head(rigs.NAMES["arkit52"], rings=60), tmp_path / "large")
    notice, company = editor.window.face_view.notice, editor.wiring.character.company
    for begin in (lambda: editor.wiring.character.open(large), lambda: company.add(large)):
        begin()
        qtbot.waitUntil(lambda: "% read" in notice.text, timeout=20_000)
        QTest.mouseClick(notice.button, Qt.MouseButton.LeftButton)
        assert notice.text == ""
        assert not editor.faces.reads
        assert not company.reads
        editor.faces.reading.emit("large: 20 % read")  # was on its way
        assert notice.text == ""
    qtbot.wait(50)
    assert names(editor) == ["toon"]
    assert editor.wiring.character.paths == [resources.face_folder()]


def test_a_rig_of_unknown_names_leads_to_the_mapping(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    wolf = rigs.as_glb(rigs.head(("howl", "snarl")), tmp_path / "wolf.glb")
    editor.wiring.character.open(wolf)
    notice = editor.window.face_view.notice
    qtbot.waitUntil(lambda: "howl" in notice.text, timeout=20_000)
    assert not editor.window.mapping_panel.isVisible()
    QTest.mouseClick(notice.button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(editor.window.mapping_panel.isVisible)
    assert notice.text == ""
    editor.wiring.character.open(wolf)
    qtbot.waitUntil(lambda: "howl" in notice.text, timeout=20_000)
    editor.window.actions_.new_set_for_face.trigger()  # now it can make them all
    qtbot.waitUntil(lambda: notice.text == "", timeout=20_000)


def test_a_face_taken_off_the_list_is_not_offered_again(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    path = rigs.as_glb(rigs.head(("jawOpen",)), tmp_path / "head.glb")
    with qtbot.waitSignal(editor.faces.opened, timeout=20_000):
        editor.wiring.character.open(path)
    picker = editor.window.face_picker
    editor.window.actions_.pick_face.trigger()
    assert picker.keys[-1] == str(path)
    QTest.keyClick(picker.faces, Qt.Key.Key_Delete)
    picker.hide()
    editor.window.actions_.pick_face.trigger()
    assert str(path) not in picker.keys
    picker.hide()

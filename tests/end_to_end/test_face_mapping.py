"""A user's rig is taught the poses: opened, mixed live, saved beside the rig, and found again."""

import json
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox
from pytestqt.qtbot import QtBot

from app import resources
from app.editor import Editor
from core_pipeline.faces.mapping_json import mapping_path
from tests.helpers import mouse, rigs

ARKIT = ("jawOpen", "mouthPucker", "mouthFunnel", "mouthRollLower", "mouthRollUpper")


@pytest.fixture
def rig(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return rigs.as_glb(rigs.head(ARKIT, rings=16), tmp_path / "head.glb")


def open_rig(editor: Editor, qtbot: QtBot, path: Path) -> None:
    with qtbot.waitSignal(editor.faces.opened, timeout=20_000):
        editor.wiring.character.open(path)


def teach(editor: Editor, qtbot: QtBot, path: Path) -> None:
    """Open the rig and, from the menu, the panel."""
    open_rig(editor, qtbot, path)
    editor.window.mapping_dock.toggleViewAction().trigger()
    qtbot.waitUntil(editor.window.mapping_panel.isVisible)


def pick(editor: Editor, pose: str) -> None:
    panel = editor.window.mapping_panel
    item = panel.poses.findItems(pose, Qt.MatchFlag.MatchExactly)[0]
    panel.poses.scrollToItem(item)
    at = panel.poses.visualItemRect(item).center()
    QTest.mouseClick(panel.poses.viewport(), Qt.MouseButton.LeftButton, pos=at)


def pixels(image: QImage) -> np.ndarray:
    image = image.convertToFormat(QImage.Format.Format_RGB32)
    return np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1).copy()


def settled(editor: Editor, qtbot: QtBot) -> np.ndarray:
    """The face when it has come to rest."""
    frames: list[QImage] = []
    editor.preview.frame_ready.connect(frames.append)
    editor.preview.refresh()
    size = editor.window.face_view.frame_size
    # At once, and in full quality; what was still under way may have had another size.
    qtbot.waitUntil(lambda: sum(frame.size() == size() for frame in frames) >= 2, timeout=20_000)
    editor.preview.frame_ready.disconnect(frames.append)
    return pixels(frames[-1])


def slide(editor: Editor, shape: str, share: float) -> None:
    """Drag the shape's bar to a share of its width."""
    panel = editor.window.mapping_panel
    bar = next(row.slider for row in panel.mix.table.rows if row.shape == shape)
    start = QPointF(bar.value() / bar.maximum() * bar.width(), 10)
    mouse.drag(bar, start, QPointF(share * bar.width(), 10))


def jaw(editor: Editor) -> float:
    face = editor.preview.face
    assert face is not None
    return float(face.mix("open").get("jawOpen", 0.0))


def test_a_rig_is_taught_live_saved_and_found_again(editor: Editor, qtbot: QtBot, rig: Path) -> None:
    teach(editor, qtbot, rig)
    panel, preview = editor.window.mapping_panel, editor.preview
    assert panel.preset.currentData() == "arkit52"
    pick(editor, "open")
    assert panel.mix.mix() == {"jawOpen": 0.9}
    assert panel.hold.isChecked()
    item = panel.poses.findItems("tBack", Qt.MatchFlag.MatchExactly)[0]
    assert item.toolTip() == "tBack: not available on this face"
    preview.orbit(30, 0)
    view, wide_open = preview.views, settled(editor, qtbot)

    slide(editor, "jawOpen", 0.1)
    assert jaw(editor) == pytest.approx(0.15, abs=0.01)
    nearly_shut = settled(editor, qtbot)
    assert (np.abs(nearly_shut.astype(int) - wide_open) > 24).mean() > 0.005
    assert preview.views == view  # the camera stays where the user put it
    assert panel.preset.currentText() == "Own mix"

    assert panel.save.isEnabled()
    QTest.mouseClick(panel.save, Qt.MouseButton.LeftButton)
    saved = json.loads((rig.parent / "head.glb.lipstitch.json").read_text("utf-8"))
    assert saved["poses"]["open"]["jawOpen"] == jaw(editor)
    assert saved["preset"] == "arkit52"
    assert not panel.save.isEnabled()
    assert editor.window.hint_label.text().endswith("head.glb.lipstitch.json")

    open_rig(editor, qtbot, resources.face_folder())
    assert panel.mix.mix() == {"open": 1.0}
    assert not panel.preset.isEnabled()
    open_rig(editor, qtbot, rig)
    assert jaw(editor) == saved["poses"]["open"]["jawOpen"]
    assert panel.mix.mix() == saved["poses"]["open"]


def test_a_preset_remakes_all_poses_and_revert_takes_it_back(editor: Editor, qtbot: QtBot, rig: Path) -> None:
    rigs.as_glb(rigs.head((*ARKIT, "open", "W", "PBM"), rings=12), rig)
    teach(editor, qtbot, rig)
    panel = editor.window.mapping_panel
    pick(editor, "open")
    assert panel.mix.mix() == {"jawOpen": 0.9}
    panel.preset.setCurrentIndex(panel.preset.findData("facefx"))
    panel.preset.activated.emit(panel.preset.currentIndex())
    assert panel.mix.mix() == {"open": 1.0}
    assert editor.preview.face is not None
    assert dict(editor.preview.face.mix("PBM")) == {"PBM": 1.0}
    assert not editor.preview.face.mix("FV")  # that preset cannot make it here
    QTest.mouseClick(panel.revert, Qt.MouseButton.LeftButton)
    assert panel.mix.mix() == {"jawOpen": 0.9}
    assert panel.preset.currentData() == "arkit52"
    assert editor.preview.face.mix("FV")


def test_what_is_not_saved_survives_a_look_at_another_face_and_is_asked_about(
    editor: Editor, qtbot: QtBot, rig: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert editor.wiring.mapping.may_close()
    teach(editor, qtbot, rig)
    pick(editor, "open")
    slide(editor, "jawOpen", 0.2)
    mine = jaw(editor)
    open_rig(editor, qtbot, resources.face_folder())
    open_rig(editor, qtbot, rig)
    assert jaw(editor) == mine
    asked: list[str] = []
    answers = iter([QMessageBox.StandardButton.Cancel, QMessageBox.StandardButton.Save])

    def answer(_parent: object, _title: str, text: str, _buttons: object) -> QMessageBox.StandardButton:
        asked.append(text)
        return next(answers)

    monkeypatch.setattr(QMessageBox, "question", answer)
    assert not editor.wiring.mapping.may_close()
    assert "head.glb" in asked[0]
    assert editor.wiring.mapping.may_close()
    assert json.loads((rig.parent / "head.glb.lipstitch.json").read_text("utf-8"))["poses"]["open"]["jawOpen"] == mine


def test_a_place_that_takes_no_file_is_said(editor: Editor, qtbot: QtBot, rig: Path) -> None:
    teach(editor, qtbot, rig)
    pick(editor, "open")
    slide(editor, "jawOpen", 0.2)
    (rig.parent / "head.glb.lipstitch.json").mkdir()
    QTest.mouseClick(editor.window.mapping_panel.save, Qt.MouseButton.LeftButton)
    assert "head.glb.lipstitch.json" in editor.window.hint_label.text()
    assert editor.window.mapping_panel.save.isEnabled()


def test_our_own_face_is_shown_beside_a_users_in_the_same_pose(editor: Editor, qtbot: QtBot, rig: Path) -> None:
    teach(editor, qtbot, rig)
    pictures: dict[str, np.ndarray] = {}
    reference = editor.wiring.mapping._reference
    reference.picture.connect(lambda image, title: pictures.update({title: pixels(image)}))
    for pose in ("open", "PBM"):
        pick(editor, pose)
        qtbot.waitUntil(lambda pose=pose: f"{pose} on our face Toon" in pictures, timeout=20_000)
    opened, shut = (pictures[f"{pose} on our face Toon"].astype(int) for pose in ("open", "PBM"))
    assert (np.abs(opened - shut) > 24).mean() > 0.05
    assert editor.window.mapping_panel._reference.isVisible()


def test_in_a_low_window_the_panel_stays_and_does_not_cover_the_face(editor: Editor, qtbot: QtBot, rig: Path) -> None:
    teach(editor, qtbot, rig)
    editor.window.resize(1280, 720)
    panel, view = editor.window.mapping_panel, editor.window.face_view
    qtbot.waitUntil(lambda: not panel.visibleRegion().isEmpty() and not view.visibleRegion().isEmpty())
    assert panel.mapTo(editor.window, panel.rect().topRight()).x() < view.mapTo(editor.window, view.pos()).x()


def test_a_held_pose_gives_way_to_playing(editor: Editor, qtbot: QtBot, rig: Path) -> None:
    teach(editor, qtbot, rig)
    weights: list[np.ndarray] = []
    editor.preview.weights_changed.connect(weights.append)
    poses = editor.session.curve_set.poses
    pick(editor, "tTeeth")
    qtbot.waitUntil(lambda: bool(weights) and weights[-1][poses.index("tTeeth")] == 1.0)
    assert weights[-1][poses.index("open")] == pytest.approx(0.3)  # else the tongue would be hidden
    assert weights[-1].sum() == pytest.approx(1.3)
    editor.wiring.bigram.open(("f", "ah"))
    editor.preview.toggle_bigram()
    qtbot.waitUntil(lambda: not editor.window.mapping_panel.hold.isChecked(), timeout=20_000)
    qtbot.waitUntil(lambda: 0 < weights[-1][poses.index("FV")] < 1, timeout=20_000)
    editor.preview.toggle_bigram()


def test_a_rigs_own_names_become_a_pose_set(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    """From the menu: an empty set, settings that fit, and a face that makes its poses."""
    bird = rigs.as_glb(rigs.head(("beak open", "beak shut", "browUp"), rings=16), tmp_path / "bird.glb")
    open_rig(editor, qtbot, bird)
    with qtbot.waitSignal(editor.faces.opened, timeout=20_000):
        editor.window.actions_.new_set_for_face.trigger()
    curve_set = editor.document.curve_set
    assert curve_set.poses == ("beak open", "beak shut")
    assert curve_set.effective_settings.priorities == ("beak open", "beak shut")
    assert not curve_set.bigrams
    face = editor.preview.face
    assert face is not None
    assert face.mix("beak open") == {"beak open": 1.0}


def test_every_change_of_a_mapping_is_one_undo_step_and_no_change_of_the_curves(
    editor: Editor, qtbot: QtBot, rig: Path
) -> None:
    rigs.as_glb(rigs.head((*ARKIT, "open", "W", "PBM"), rings=12), rig)
    teach(editor, qtbot, rig)
    panel, stack, document = editor.window.mapping_panel, editor.document.undo_stack, editor.document
    pick(editor, "open")
    slide(editor, "jawOpen", 0.2)
    slide(editor, "jawOpen", 0.4)
    assert stack.count() == 2  # a slide is one step, however far
    assert not document.is_dirty
    assert not editor.window.isWindowModified()
    panel.preset.setCurrentIndex(panel.preset.findData("facefx"))
    panel.preset.activated.emit(panel.preset.currentIndex())
    assert stack.count() == 3
    assert panel.mix.mix() == {"open": 1.0}
    stack.undo()
    assert panel.mix.mix() == {"jawOpen": pytest.approx(0.6, abs=0.01)}
    assert jaw(editor) == pytest.approx(0.6, abs=0.01)
    stack.undo()
    assert panel.mix.mix() == {"jawOpen": pytest.approx(0.3, abs=0.01)}
    editor.wiring.bigram.open(("f", "ah"))
    editor.window.canvas.select_all()
    editor.window.canvas.nudge(0.0, 0.05)
    assert document.is_dirty
    stack.undo()
    assert not document.is_dirty

    open_rig(editor, qtbot, resources.face_folder())
    stack.undo()  # of a face that is not shown
    assert editor.wiring.mapping.may_close()  # nothing is left to save
    open_rig(editor, qtbot, rig)
    assert panel.mix.mix() == {"jawOpen": 0.9}
    stack.redo()
    assert panel.mix.mix() == {"jawOpen": pytest.approx(0.3, abs=0.01)}
    assert panel.save.isEnabled()


def test_behind_another_tab_the_panel_holds_no_pose(editor: Editor, qtbot: QtBot, rig: Path) -> None:
    teach(editor, qtbot, rig)
    held: list[bool] = []
    editor.preview.pose_held.connect(held.append)
    pick(editor, "W")
    assert held[-1]
    editor.window.weights_dock.raise_()
    qtbot.waitUntil(lambda: not held[-1])
    assert not editor.window.mapping_panel.hold.isChecked()


def test_a_mapping_that_cannot_be_kept_is_told_over_the_picture(editor: Editor, qtbot: QtBot, rig: Path) -> None:
    teach(editor, qtbot, rig)
    pick(editor, "W")
    slide(editor, "mouthPucker", 0.3)
    mapping_path(rig).mkdir()
    assert not editor.wiring.mapping.save()
    assert mapping_path(rig).name in editor.window.face_view.notice.text
    assert editor.window.mapping_panel.save.isEnabled()

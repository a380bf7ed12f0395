"""Portraits: drawn once for what is in the files, kept on disk, and missing rather than wrong."""

import shutil
import threading
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app import resources
from app.preview import thumbnails as module
from app.preview.thumbnails import SIDE, Thumbnails
from core_pipeline.errors import UserError
from tests.helpers import rigs


@pytest.fixture
def makers(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    made = []

    def maker():
        made.append(Thumbnails(tmp_path / "portraits"))
        return made[-1]

    yield maker
    for one in made:
        one.stop()


def portrait(qtbot, thumbnails, path) -> np.ndarray:
    with qtbot.waitSignal(thumbnails.ready, timeout=20_000) as caught:
        thumbnails.ask(path)
    name, image = caught.args
    assert name == str(path)
    image = image.convertToFormat(QImage.Format.Format_RGB32)
    return np.array(image.constBits()).reshape(image.height(), image.width(), 4)[..., :3].astype(int)


def kept(tmp_path: Path) -> list[Path]:
    return sorted((tmp_path / "portraits").glob("*.png"))


def test_a_portrait_shows_the_head_and_is_kept_for_the_next_time(qtbot, makers, tmp_path):
    path = resources.face_folder("man")
    first = portrait(qtbot, makers(), path)
    assert first.shape == (SIDE, SIDE, 3)
    assert first[SIDE // 2, SIDE // 2, 2] > first[SIDE // 2, SIDE // 2, 0] + 20, "skin in the middle"
    assert np.abs(first[2, 2] - first[2, -3]).max() < 12, "air beside the head"
    (file,) = kept(tmp_path)
    image = QImage(str(file))
    image.fill(0xFF123456)
    image.save(str(file))
    again = portrait(qtbot, makers(), path)
    assert (again == (0x56, 0x34, 0x12)).all(), "what is kept is shown, not drawn anew"


def test_the_same_file_elsewhere_is_the_same_and_a_changed_one_is_drawn_anew(qtbot, makers, tmp_path):
    path = rigs.as_glb(rigs.head(("jawOpen", "mouthPucker"), rings=10), tmp_path / "head.glb")
    thumbnails = makers()
    portrait(qtbot, thumbnails, path)
    portrait(qtbot, thumbnails, Path(shutil.copy(path, tmp_path / "copy.glb")))
    assert len(kept(tmp_path)) == 1
    rigs.as_glb(rigs.head(("jawOpen", "mouthFunnel"), rings=14), path)
    portrait(qtbot, thumbnails, path)
    assert len(kept(tmp_path)) == 2


def test_another_renderer_draws_anew(qtbot, makers, tmp_path, monkeypatch):
    path = resources.face_folder("toon")
    portrait(qtbot, makers(), path)
    monkeypatch.setattr(module, "_looks", lambda: b"another")
    portrait(qtbot, makers(), path)
    assert len(kept(tmp_path)) == 2


def test_a_damaged_file_gets_none_and_the_next_one_does(qtbot, makers, tmp_path):
    bad = tmp_path / "bad.glb"
    bad.write_bytes(b"glTF nonsense")
    thumbnails = makers()
    thumbnails.ask(bad)
    thumbnails.ask(tmp_path / "gone.glb")
    portrait(qtbot, thumbnails, resources.face_folder("toon"))
    (file,) = kept(tmp_path)
    file.write_bytes(b"no picture")
    assert portrait(qtbot, makers(), resources.face_folder("toon")).std() > 20


def test_a_cache_that_cannot_be_written_harms_nothing(qtbot, makers, tmp_path):
    (tmp_path / "portraits").write_text("in the way")
    assert portrait(qtbot, makers(), resources.face_folder("toon")).std() > 20


def test_stopping_waits_for_no_large_rig(makers, tmp_path, monkeypatch):
    reading, asked = threading.Event(), []

    def endless(_path, cancelled):
        reading.set()
        while not cancelled():
            asked.append(1)
        raise UserError("opening was cancelled")

    monkeypatch.setattr(module, "open_rig", endless)
    thumbnails = makers()
    thumbnails.ask(rigs.as_glb(rigs.head(), tmp_path / "head.glb"))
    assert reading.wait(20)
    thumbnails.stop()
    assert asked

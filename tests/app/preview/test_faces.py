"""Faces are read in a thread of their own: the latest wish counts, and long reading says how far it is."""

import os
import threading

import numpy as np
import pytest

from app.preview import faces as module
from app.preview.faces import Faces
from core_pipeline.poses import FACEFX
from tests.helpers.rigs import NAMES, as_glb, as_objs, head


@pytest.fixture
def faces(qtbot, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    faces = Faces()
    yield faces
    faces.close()


def test_a_rig_is_read_beside_the_thread_of_the_window(faces, qtbot, tmp_path, monkeypatch):
    path = as_glb(head(NAMES["arkit52"]), tmp_path / "head.glb")
    readers = []
    reads = module.open_face
    monkeypatch.setattr(
        module, "open_face", lambda *given: readers.append(threading.current_thread().name) or reads(*given)
    )
    with qtbot.waitSignal(faces.opened) as caught:
        faces.open(path, FACEFX)
    assert readers == ["face reader"]
    assert caught.args[0].retarget.preset == "arkit52"


def test_long_reading_says_how_far_it_is(faces, qtbot, tmp_path, monkeypatch):
    monkeypatch.setattr(module, "QUIET", 0.0)
    told = []
    faces.reading.connect(told.append)
    with qtbot.waitSignal(faces.opened):
        faces.open(as_objs(head(["jawOpen", "smile"]), tmp_path / "poses"), FACEFX)
    assert told[0] == "poses: 0 % read"
    assert "poses: 50 % read" in told
    assert told[-1] == "poses: 100 % read"


def test_a_newer_wish_ends_the_reading_of_an_older_one(faces, qtbot, tmp_path, monkeypatch):
    slow, quick = as_objs(head(), tmp_path / "slow"), as_glb(head(), tmp_path / "quick.glb")
    begun, go_on = threading.Event(), threading.Event()

    def told(number, path):
        def wait(_share):
            if path == slow:
                begun.set()
                assert go_on.wait(20)

        return wait

    monkeypatch.setattr(faces, "_told", told)
    opened, failed = [], []
    faces.opened.connect(lambda found: opened.append(found.face.title))
    faces.failed.connect(failed.append)
    faces.open(slow, FACEFX)
    assert begun.wait(20)
    with qtbot.waitSignal(faces.opened):
        faces.open(quick, FACEFX)
    go_on.set()
    faces.close()
    qtbot.waitUntil(lambda: not any(thread.is_alive() for thread in faces._threads))
    assert opened == ["quick"]
    assert failed == []


def test_a_bad_rig_is_a_sentence_and_the_next_one_opens(faces, qtbot, tmp_path):
    (tmp_path / "bad.glb").write_bytes(b"glTF" + bytes(40))
    with qtbot.waitSignal(faces.failed) as caught:
        faces.open(tmp_path / "bad.glb", FACEFX)
    assert "glTF version 0" in caught.args[0]
    with qtbot.waitSignal(faces.opened) as caught:
        faces.open(as_glb(head(), tmp_path / "good.glb"), FACEFX)
    assert np.isfinite(caught.args[0].face.positions).all()


def test_after_a_failure_the_face_that_is_there_is_the_one_to_come_back_to(faces, qtbot, tmp_path):
    good, bad = as_glb(head(), tmp_path / "good.glb"), tmp_path / "bad.glb"
    bad.write_bytes(b"glTF" + bytes(40))
    with qtbot.waitSignal(faces.opened):
        faces.open(good, FACEFX)
    with qtbot.waitSignal(faces.failed):
        faces.open(bad, FACEFX)
    assert faces.path == good
    assert not faces.reads


def test_a_failure_names_the_file_without_the_way_to_it(faces, qtbot, tmp_path):
    folder = as_objs(head(), tmp_path / "poses")
    (folder / "jawOpen.obj").write_text("v 0 0 0\nf 1 1 1\n")
    with qtbot.waitSignal(faces.failed) as caught:
        faces.open(folder, FACEFX)
    assert "poses/jawOpen.obj".replace("/", os.sep) in caught.args[0]
    assert str(tmp_path) not in caught.args[0]


def test_a_failure_with_another_pose_set_matches_the_face_that_is_there_to_it(faces, qtbot, tmp_path):
    good, bad = as_glb(head(["jawOpen", "howl"]), tmp_path / "good.glb"), tmp_path / "bad.glb"
    bad.write_bytes(b"glTF" + bytes(40))
    with qtbot.waitSignal(faces.opened):
        faces.open(good, FACEFX)
    failed: list[str] = []
    faces.failed.connect(failed.append)
    with qtbot.waitSignal(faces.opened) as caught:
        faces.open(bad, ("howl",))
    assert len(failed) == 1
    assert caught.args[0].retarget.poses["howl"] == {"howl": 1.0}
    assert faces.path == good


def test_cancelling_stays_with_the_face_before_and_tells_nothing(faces, qtbot, tmp_path, monkeypatch):
    good, slow = as_glb(head(), tmp_path / "good.glb"), as_objs(head(), tmp_path / "slow")
    with qtbot.waitSignal(faces.opened):
        faces.open(good, FACEFX)
    begun, go_on = threading.Event(), threading.Event()
    monkeypatch.setattr(faces, "_told", lambda *_: lambda _: (begun.set(), go_on.wait(20)))
    faces.open(slow, FACEFX)
    assert begun.wait(20)
    assert faces.reads
    with qtbot.assertNotEmitted(faces.opened), qtbot.assertNotEmitted(faces.failed):
        faces.cancel()
        go_on.set()
        qtbot.waitUntil(lambda: not any(thread.is_alive() for thread in faces._threads))
    assert faces.path == good
    assert not faces.reads

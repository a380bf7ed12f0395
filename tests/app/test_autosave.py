"""Unsaved work has a copy within two seconds, and a killed session's copy is offered to the next."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QTimer
from pytestqt.qtbot import QtBot

from app import autosave as module
from app.autosave import Autosave, left_behind
from app.document import Document
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json
from core_pipeline.settings import Settings

ROOT = Path(module.__file__).parents[1]
F_AH = ("f", "ah")
HILL = Curve.of([(0, 0), (0.5, 0.9), (1, 0.25)])
WITHIN = 2000  # milliseconds

#: A session that edits and waits to be killed; argv: recovery folder, path of its file.
SESSION = """
import sys
from pathlib import Path
from PySide6.QtCore import QCoreApplication
from app.autosave import Autosave
from app.document import Document
from core_pipeline.curve_set import CurveSet
from core_pipeline.curves import Curve

app = QCoreApplication([])
document = Document(CurveSet(name="Mine"))
document.save(Path(sys.argv[2]))
autosave = Autosave(document, Path(sys.argv[1]))
autosave.saved.connect(lambda: print("saved", flush=True))
document.edit_curves(("f", "ah"), {"open": Curve.of([(0, 0), (0.5, 0.9), (1, 0.25)])}, "Move key")
app.exec()
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "state" / "recovery"


@pytest.fixture
def document(qtbot: QtBot) -> Document:
    return Document(CurveSet(name="Mine"))


@pytest.fixture
def autosave(document: Document, folder: Path) -> Iterator[Autosave]:
    autosave = Autosave(document, folder)
    yield autosave
    autosave.finish()
    QCoreApplication.processEvents()


def edit(document: Document) -> None:
    document.edit_curves(F_AH, {"open": HILL}, "Move key")


def test_a_copy_is_there_two_seconds_after_the_first_edit(
    document: Document, autosave: Autosave, folder: Path, qtbot: QtBot
) -> None:
    assert not folder.exists()
    with qtbot.waitSignal(autosave.saved, timeout=WITHIN):
        edit(document)
    copy = curve_set_json.load(autosave.copy)
    assert copy.bigrams[F_AH].curves["open"].same_as(HILL)


def test_a_copy_comes_even_while_edits_go_on(document: Document, autosave: Autosave, qtbot: QtBot) -> None:
    heights = iter(range(1, 1000))

    def go_on() -> None:
        document.edit_curves(F_AH, {"open": Curve.of([(0, next(heights) / 1000)])}, "Move key")

    timer = QTimer(document)
    timer.timeout.connect(go_on)
    timer.start(50)
    with qtbot.waitSignal(autosave.saved, timeout=WITHIN):
        go_on()
    timer.stop()
    assert document.undo_stack.count() > 5


def test_settings_are_work_too(document: Document, autosave: Autosave, qtbot: QtBot) -> None:
    with qtbot.waitSignal(autosave.saved, timeout=WITHIN):
        document.change_settings(Settings.smartbody(), "Preset SmartBody")
    assert curve_set_json.load(autosave.copy).effective_settings == Settings.smartbody()


@pytest.mark.parametrize("way", ["save", "undo", "new"])
def test_no_copy_is_left_when_nothing_is_unsaved(
    document: Document, autosave: Autosave, folder: Path, tmp_path: Path, qtbot: QtBot, way: str
) -> None:
    with qtbot.waitSignal(autosave.saved, timeout=WITHIN):
        edit(document)
    assert len(list(folder.iterdir())) == 2
    {
        "save": lambda: document.save(tmp_path / "mine.json"),
        "undo": document.undo_stack.undo,
        "new": lambda: document.new(CurveSet()),
    }[way]()
    assert list(folder.iterdir()) == []


def test_a_copy_that_is_being_written_is_cleared_too(
    document: Document, autosave: Autosave, folder: Path, tmp_path: Path
) -> None:
    edit(document)
    autosave.write()
    document.save(tmp_path / "mine.json")
    assert list(folder.iterdir()) == []


def test_work_after_a_save_gets_a_new_copy(
    document: Document, autosave: Autosave, tmp_path: Path, qtbot: QtBot
) -> None:
    edit(document)
    document.save(tmp_path / "mine.json")
    with qtbot.waitSignal(autosave.saved, timeout=WITHIN):
        document.undo_stack.undo()
    assert F_AH not in curve_set_json.load(autosave.copy).bigrams


def test_where_no_copy_can_be_kept_it_is_said_once(tmp_path: Path, document: Document, qtbot: QtBot) -> None:
    (tmp_path / "file").write_text("")
    autosave = Autosave(document, tmp_path / "file" / "recovery")
    said: list[str] = []
    autosave.failed.connect(said.append)
    with qtbot.waitSignal(autosave.failed, timeout=WITHIN):
        edit(document)
    autosave.write()
    autosave.finish()
    QCoreApplication.processEvents()
    assert len(said) == 1
    assert said[0].startswith("No recovery copy can be kept (cannot make ")
    assert said[0].endswith("Save often.")


@pytest.mark.skipif(os.name != "posix", reason="SIGKILL is a signal of POSIX systems")
def test_a_killed_session_leaves_its_work_to_the_next(folder: Path, tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    with subprocess.Popen(
        [sys.executable, "-c", SESSION, folder, path],
        env={**os.environ, "PYTHONPATH": str(ROOT)}, stdout=subprocess.PIPE, text=True,
    ) as session:  # fmt: skip
        assert session.stdout is not None
        assert session.stdout.readline() == "saved\n"
        assert left_behind(folder) == []  # it is still at work
        session.send_signal(signal.SIGKILL)
    (recovery,) = left_behind(folder)
    assert recovery.path == path
    expected = CurveSet(name="Mine").with_bigram(F_AH, Bigram({"open": HILL}))
    assert curve_set_json.dumps(recovery.curve_set) == curve_set_json.dumps(expected)
    assert F_AH not in curve_set_json.load(path).bigrams
    recovery.discard()
    assert left_behind(folder) == []
    assert list(folder.iterdir()) == []


def test_damaged_copies_are_passed_over_and_the_newest_comes_first(folder: Path) -> None:
    folder.mkdir(parents=True)
    for i, name in enumerate(["first", "second"]):
        copy = folder / f"{name}.json"
        curve_set_json.save(CurveSet(name=name), copy)
        os.utime(copy, (1e9 + i, 1e9 + i))
    (folder / "first.origin").write_text(json.dumps({"path": "somewhere.json"}))
    (folder / "second.origin").write_bytes(b"\xff{")
    (folder / "broken.json").write_text("{")
    (folder / "broken.origin").write_text("[]")
    found = left_behind(folder)
    assert [recovery.curve_set.name for recovery in found] == ["second", "first"]
    assert [recovery.path for recovery in found] == [None, Path("somewhere.json")]


def test_without_a_folder_nothing_was_left(folder: Path) -> None:
    assert left_behind(folder) == []

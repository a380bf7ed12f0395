"""Unsaved work is in the journal within a second, and a killed session's work is offered to the next."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QTimer
from pytestqt.qtbot import QtBot

from app import document as module
from app.document import Document
from app.keeping import journal
from app.keeping.autosave import Autosave, left_behind
from app.keeping.journal import Kept
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json
from core_pipeline.settings import Settings

ROOT = Path(module.__file__).parents[1]
F_AH = ("f", "ah")
HILL = Curve.of([(0, 0), (0.5, 0.9), (1, 0.25)])
WITHIN = 1000  # milliseconds

#: A session that edits and waits to be killed; argv: recovery folder, path of its file.
SESSION = """
import sys
from pathlib import Path
from PySide6.QtCore import QCoreApplication
from app.keeping.autosave import Autosave
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


def test_the_first_edit_is_there_within_a_second(
    document: Document, autosave: Autosave, folder: Path, qtbot: QtBot
) -> None:
    assert not folder.exists()
    with qtbot.waitSignal(autosave.saved, timeout=WITHIN):
        edit(document)
    assert journal.read(autosave.journal).curve_set.bigrams[F_AH].curves["open"].same_as(HILL)


def test_lines_come_even_while_edits_go_on(document: Document, autosave: Autosave, qtbot: QtBot) -> None:
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
    assert journal.read(autosave.journal).curve_set.effective_settings == Settings.smartbody()


@pytest.mark.parametrize("way", ["save", "undo", "new"])
def test_no_journal_is_left_when_nothing_is_unsaved(
    document: Document, autosave: Autosave, folder: Path, tmp_path: Path, qtbot: QtBot, way: str
) -> None:
    with qtbot.waitSignal(autosave.saved, timeout=WITHIN):
        edit(document)
    assert len(list(folder.iterdir())) == 1
    {
        "save": lambda: document.save(tmp_path / "mine.json"),
        "undo": document.undo_stack.undo,
        "new": lambda: document.new(CurveSet()),
    }[way]()
    assert list(folder.iterdir()) == []


def test_a_line_that_is_being_written_is_cleared_too(
    document: Document, autosave: Autosave, folder: Path, tmp_path: Path
) -> None:
    edit(document)
    autosave.write()
    document.save(tmp_path / "mine.json")
    assert list(folder.iterdir()) == []


def test_work_after_a_save_gets_a_new_journal(
    document: Document, autosave: Autosave, tmp_path: Path, qtbot: QtBot
) -> None:
    edit(document)
    document.save(tmp_path / "mine.json")
    with qtbot.waitSignal(autosave.saved, timeout=WITHIN):
        document.undo_stack.undo()
    assert F_AH not in journal.read(autosave.journal).curve_set.bigrams


def test_where_no_journal_can_be_kept_it_is_said_once(tmp_path: Path, document: Document, qtbot: QtBot) -> None:
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
    assert recovery.kept.path == path
    expected = CurveSet(name="Mine").with_bigram(F_AH, Bigram({"open": HILL}))
    assert curve_set_json.dumps(recovery.kept.curve_set) == curve_set_json.dumps(expected)
    assert F_AH not in curve_set_json.load(path).bigrams
    recovery.discard()
    assert left_behind(folder) == []
    assert list(folder.iterdir()) == []


def test_damaged_journals_are_passed_over_and_the_newest_comes_first(folder: Path) -> None:
    folder.mkdir(parents=True)
    for i, name in enumerate(["first", "second"]):
        file = folder / f"{name}.journal"
        journal.begin(file, Kept(CurveSet(name=name), Path("somewhere.json") if i else None, ""))
        os.utime(file, (1e9 + i, 1e9 + i))
    (folder / "empty.journal").write_text("")
    (folder / "broken.journal").write_text("{\n")
    (folder / "other.journal").write_text("[]\n")
    (folder / "half.journal").write_bytes((folder / "first.journal").read_bytes()[:-20])
    found = left_behind(folder)
    assert [recovery.kept.curve_set.name for recovery in found] == ["second", "first"]
    assert [recovery.kept.path for recovery in found] == [Path("somewhere.json"), None]


def test_without_a_folder_nothing_was_left(folder: Path) -> None:
    assert left_behind(folder) == []

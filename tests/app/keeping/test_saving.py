"""Saving: beside the window, never over what others wrote unasked, whole or not at all whatever happens."""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QTimer
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox, QWidget
from pytestqt.qtbot import QtBot

from app import resources
from app.document import Document
from app.file_actions import FileActions
from app.keeping import journal
from app.keeping.background import in_background
from app.keeping.lock import Lock, Owner
from app.settings import ViewState
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.curve_set_merge import open_conflicts

ROOT = Path(resources.__file__).parents[1]
F_AH, AH_D = ("f", "ah"), ("ah", "d")
LOW, HIGH = (Curve.of([(0, 0), (0.5, v), (1, 0)]) for v in (0.1, 0.9))


@pytest.fixture
def mine(tmp_path: Path) -> Path:
    path = tmp_path / "mine.json"
    curve_set_json.save(CurveSet(name="Mine", bigrams={F_AH: Bigram({"W": LOW})}), path)
    return path


@pytest.fixture
def files(tmp_path: Path, mine: Path, qtbot: QtBot) -> Iterator[FileActions]:
    window = QWidget()
    qtbot.addWidget(window)
    files = FileActions(window, Document(CurveSet()), ViewState(tmp_path / "state"))
    files.open(mine)
    yield files
    files.close()
    QCoreApplication.processEvents()


def press(text: str, said: list[str]) -> None:
    """Press a button of the next message box, as a user does; what the box said is kept."""

    def look() -> None:
        box = QApplication.activeModalWidget()
        if not isinstance(box, QMessageBox):
            QTimer.singleShot(5, look)
            return
        said.append(box.text())
        next(button for button in box.buttons() if button.text().replace("&", "") == text).click()

    QTimer.singleShot(0, look)


def edit(files: FileActions, pose: str = "W", curve: Curve = HIGH) -> None:
    files.document.edit_curves(F_AH, {pose: curve}, "Move key")


def elsewhere(path: Path, change: Callable[[CurveSet], CurveSet]) -> CurveSet:
    """Another program changes the file."""
    changed = change(curve_set_json.load(path))
    curve_set_json.save(changed, path)
    return changed


# ── beside the window ────────────────────────────────────────────────────────────────────────────


def test_a_slow_disk_does_not_stop_the_window(qtbot: QtBot) -> None:
    """Timers go on while the work waits; what it raises is raised here."""
    gate = threading.Event()
    QTimer.singleShot(20, gate.set)
    seen: list[str] = []

    def work() -> None:
        assert gate.wait(5)
        seen.append(threading.current_thread().name)
        raise UserError("the disk is gone")

    with pytest.raises(UserError, match="the disk is gone"):
        in_background(work)
    assert seen == ["saving"]


# ── other programs ───────────────────────────────────────────────────────────────────────────────


def test_what_nobody_changed_is_saved_without_a_question(files: FileActions, mine: Path) -> None:
    for curve in (HIGH, LOW, HIGH):
        edit(files, curve=curve)
        assert files.save()
        assert curve_set_json.load(mine).bigrams[F_AH].curves["W"].same_as(curve)
    mine.unlink()
    edit(files, curve=LOW)
    assert files.save()
    assert mine.exists()


def test_merge_brings_both_sides_together(files: FileActions, mine: Path) -> None:
    edit(files)
    elsewhere(mine, lambda s: s.with_bigram(AH_D, Bigram({"open": HIGH})))
    said: list[str] = []
    press("Merge", said)
    assert files.save()
    assert "was changed by another program" in said[0]
    for both in (curve_set_json.load(mine), files.document.curve_set):
        assert set(both.bigrams) == {F_AH, AH_D}
        assert both.bigrams[F_AH].curves["W"].same_as(HIGH)
    assert not files.document.is_dirty
    files.document.undo_stack.undo()
    assert AH_D not in files.document.curve_set.bigrams
    assert {backup.kind for backup in files.keeper.backups().all()} == {"before merge with the file", "save", "day"}


def test_a_clash_is_told_and_marked(files: FileActions, mine: Path) -> None:
    edit(files)
    elsewhere(mine, lambda s: s.with_bigram(F_AH, Bigram({"W": Curve.of([(0, 0.3)])})))
    said: list[str] = []
    press("Merge", said)
    QTimer.singleShot(0, lambda: press("OK", said))
    assert files.save()
    assert open_conflicts(curve_set_json.load(mine)) == ["f-ah W"]
    assert files.document.curve_set.bigrams[F_AH].curves["W"].same_as(HIGH)
    edit(files, curve=LOW)  # deciding is editing
    assert open_conflicts(files.document.curve_set) == []


def test_reload_takes_theirs_and_keeps_a_backup_of_ours(files: FileActions, mine: Path) -> None:
    edit(files)
    theirs = elsewhere(mine, lambda s: s.with_bigram(F_AH, None))
    press("Reload", [])
    assert not files.save()
    assert curve_set_json.dumps(files.document.curve_set) == curve_set_json.dumps(theirs)
    (backup,) = files.keeper.backups().all()
    assert curve_set_json.load(backup.path).bigrams[F_AH].curves["W"].same_as(HIGH)


def test_a_copy_leaves_both(files: FileActions, mine: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    edit(files)
    theirs = elsewhere(mine, lambda s: s.with_bigram(F_AH, None))
    copy = tmp_path / "copy.json"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(copy), ""))
    press("Save a Copy…", [])
    assert files.save()
    assert mine.read_text("utf-8") == curve_set_json.dumps(theirs)
    assert curve_set_json.load(copy).bigrams[F_AH].curves["W"].same_as(HIGH)
    assert files.document.path == copy


def test_cancel_changes_nothing(files: FileActions, mine: Path) -> None:
    edit(files)
    elsewhere(mine, lambda s: s.with_bigram(F_AH, None))
    before = mine.read_bytes()
    press("Cancel", [])
    assert not files.save()
    assert mine.read_bytes() == before
    assert files.document.is_dirty


@pytest.mark.parametrize(("answer", "editable"), [("Open Read-Only", False), ("Edit Anyway", True), ("Cancel", None)])
def test_a_file_open_elsewhere_is_said(
    files: FileActions, mine: Path, tmp_path: Path, answer: str, editable: bool | None
) -> None:
    other = tmp_path / "other.json"
    curve_set_json.save(CurveSet(name="Other"), other)
    other.with_name(".other.json.lock").write_text('{"host": "studio-7", "pid": 4711}')
    said: list[str] = []
    press(answer, said)
    files.open(other)
    assert "“other.json” is open in another Lipstitch (process 4711 on studio-7)" in said[0]
    assert files.document.path == (mine if editable is None else other)
    assert bool(files.document.read_only_reason) == (editable is False)
    assert (Lock(other).owner() == Owner("studio-7", 4711)) == (editable is not True)


# ── whatever happens ─────────────────────────────────────────────────────────────────────────────


def test_a_vanished_folder_is_said_and_the_work_is_in_the_journal(
    tmp_path: Path, files: FileActions, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "shots"
    folder.mkdir()
    path = folder / "hero.json"
    files.document.save(path)
    path.unlink()
    folder.rmdir()
    said: list[str] = []
    edit(files)
    press("Cancel", said)
    assert not files.save()
    assert "there is no such file or folder" in said[0]
    assert files.document.is_dirty
    files.autosave.write()
    files.autosave.finish()
    kept = journal.read(files.autosave.journal)
    assert kept.path == path
    assert kept.curve_set.bigrams[F_AH].curves["W"].same_as(HIGH)


def test_what_cannot_be_saved_there_is_saved_elsewhere_when_the_user_likes(
    tmp_path: Path, files: FileActions, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, other = tmp_path / "shots", tmp_path / "other.json"
    folder.mkdir()
    files.document.save(folder / "hero.json")
    (folder / "hero.json").unlink()
    folder.rmdir()
    said: list[str] = []
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(other), ""))
    edit(files)
    press("Save As…", said)
    assert files.save()
    assert files.document.path == other
    assert curve_set_json.load(other).bigrams[F_AH].curves["W"].same_as(HIGH)


LIMITED = """
import resource, signal, sys
from pathlib import Path
from app.document import Document
from core_pipeline.curve_set import CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError

document = Document(CurveSet())
document.open(Path(sys.argv[1]))
document.edit_curves(("f", "ah"), {"W": Curve.of([(i / 1000, 0.5) for i in range(1000)])}, "Draw")
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))
try:
    document.save()
except UserError as error:
    print(error)
assert document.is_dirty
assert len(document.curve_set.bigrams["f", "ah"].curves["W"]) == 1000
"""


@pytest.mark.skipif(os.name != "posix", reason="file size limits are POSIX")
def test_a_disk_too_small_leaves_the_file_byte_by_byte(mine: Path) -> None:
    before, names = mine.read_bytes(), set(mine.parent.iterdir())
    done = subprocess.run(
        [sys.executable, "-c", LIMITED, mine],
        env={**os.environ, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "would be larger than is allowed there" in done.stdout
    assert "Nothing was changed" in done.stdout
    assert mine.read_bytes() == before
    assert set(mine.parent.iterdir()) == names


SAVING = """
import sys
from pathlib import Path
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json

curve = Curve.of([(i / 2000, 0.5) for i in range(2000)])
sets = [CurveSet(name=name, bigrams={("f", "ah"): Bigram({"W": curve})}) for name in "AB"]
print("go", flush=True)
while True:
    for curve_set in sets:
        curve_set_json.save(curve_set, sys.argv[1])
"""


@pytest.mark.skipif(os.name != "posix", reason="SIGKILL is a signal of POSIX systems")
def test_killed_while_saving_the_file_is_the_old_or_the_new_one(mine: Path, qtbot: QtBot) -> None:
    for wait in (3, 11, 29, 47, 80):
        with subprocess.Popen(
            [sys.executable, "-c", SAVING, mine],
            env={**os.environ, "PYTHONPATH": str(ROOT)}, stdout=subprocess.PIPE, text=True,
        ) as session:  # fmt: skip
            assert session.stdout is not None
            assert session.stdout.readline() == "go\n"
            qtbot.wait(wait)
            session.send_signal(signal.SIGKILL)
        read = curve_set_json.load(mine)
        assert (read.name, len(read.bigrams[F_AH].curves["W"])) in {("A", 2000), ("B", 2000), ("Mine", 3)}

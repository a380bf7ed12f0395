"""The File menu: what the user is asked, what they are told, and that no answer loses work unasked."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget
from pytestqt.qtbot import QtBot

from app.document import Document
from app.exchange import Exchange
from app.file_actions import FileActions
from app.keeping import journal
from app.keeping.journal import Kept
from app.session import Session
from app.settings import ViewState
from core_pipeline.curve_set import CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json
from core_pipeline.speech.utterance import Utterance
from tests.helpers import stages as small

F_AH = ("f", "ah")
HILL = Curve.of([(0, 0), (0.5, 0.9), (1, 0.25)])
Button = QMessageBox.StandardButton


class Answers:
    """Stands in for the user before a modal box: gives the prepared answers, remembers what was said."""

    def __init__(self) -> None:
        self.buttons: list[Button] = []
        self.file = ("", "")
        self.said: list[str] = []


@pytest.fixture
def user(monkeypatch: pytest.MonkeyPatch) -> Answers:
    answers = Answers()

    def question(_parent: QWidget, _title: str, text: str, *_: object) -> Button:
        answers.said.append(text)
        return answers.buttons.pop(0)

    def warning(_parent: QWidget, _title: str, text: str, *_: object) -> Button:
        answers.said.append(text)
        return Button.Ok

    monkeypatch.setattr(QMessageBox, "question", question)
    monkeypatch.setattr(QMessageBox, "warning", warning)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: answers.file)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: answers.file)
    return answers


@pytest.fixture
def document(qtbot: QtBot) -> Document:
    return Document(CurveSet(name="Mine"))


@pytest.fixture
def files(document: Document, user: Answers, tmp_path: Path, qtbot: QtBot) -> Iterator[FileActions]:
    window = QWidget()
    qtbot.addWidget(window)
    files = FileActions(window, document, ViewState(tmp_path / "state"))
    yield files
    files.close()
    QCoreApplication.processEvents()


@pytest.fixture
def exchange(files: FileActions, document: Document) -> Exchange:
    return Exchange(files, Session(document.curve_set, files))


def edit(document: Document) -> None:
    document.edit_curves(F_AH, {"open": HILL}, "Move key")


@pytest.mark.parametrize("act", ["new", "new_empty", "ask_open"])
def test_unsaved_work_is_never_replaced_unasked(
    files: FileActions, document: Document, user: Answers, act: str
) -> None:
    edit(document)
    user.buttons = [Button.Cancel]
    getattr(files, act)()
    assert user.said == ["“Mine (not saved yet)” has unsaved changes. Save them?"]
    assert document.curve_set.bigrams[F_AH].curves["open"] is HILL


def test_save_as_adds_the_ending_and_asks_before_it_replaces_a_file(
    files: FileActions, document: Document, user: Answers, tmp_path: Path
) -> None:
    mine = tmp_path / "mine.json"
    mine.write_text("something else")
    user.file = (str(tmp_path / "mine"), "Curve sets (*.json)")  # the dialog has asked for “mine” only
    user.buttons = [Button.No]
    assert not files.save()
    assert mine.read_text() == "something else"
    user.buttons = [Button.Yes]
    assert files.save()
    assert curve_set_json.load(mine).name == "Mine"
    assert document.path == mine


def test_a_save_that_fails_is_said_and_the_work_stays(
    files: FileActions, document: Document, user: Answers, tmp_path: Path
) -> None:
    edit(document)
    user.file = (str(tmp_path / "gone" / "mine.json"), "")
    user.buttons = [Button.Save]
    assert not files.may_discard()
    assert "there is no such file or folder" in user.said[-1]
    assert document.is_dirty


def test_a_file_that_cannot_be_opened_is_said(files: FileActions, user: Answers, tmp_path: Path) -> None:
    (tmp_path / "bad.json").write_text("{")
    files.open(tmp_path / "bad.json")
    assert "damaged at line 1" in user.said[0]


def test_names_from_a_file_are_never_read_as_markup(files: FileActions, user: Answers, tmp_path: Path) -> None:
    (tmp_path / "bad.json").write_text('{"schema": "lipstitch.CurveSet.1", "bigrams": {"<img src=x>-ah": {}}}')
    files.open(tmp_path / "bad.json")
    assert "&lt;img src=x&gt;" in user.said[0]


def test_export_writes_readable_or_small_and_keeps_the_document(
    exchange: Exchange, document: Document, tmp_path: Path
) -> None:
    edit(document)
    assert exchange.export(tmp_path / "set.json")
    assert exchange.export(tmp_path / "set.min.json")
    readable, small_ = (tmp_path / "set.json").read_text("utf-8"), (tmp_path / "set.min.json").read_text("utf-8")
    assert readable == curve_set_json.dumps(document.curve_set)
    assert small_.count("\n") == 1
    assert curve_set_json.dumps(curve_set_json.load(tmp_path / "set.min.json")) == readable
    assert document.path is None
    assert document.is_dirty


def test_weights_are_exported_in_either_format(exchange: Exchange, user: Answers, tmp_path: Path) -> None:
    exchange.ask_export_weights()
    assert user.said == ["There is no sentence yet: type one first."]
    session = exchange._session
    session.set_curve_set(small.curve_set())
    session.set_utterance(Utterance("f ah", small.schedule("f ah d")))
    session.recompute()
    for name in ("w.json", "w.csv"):
        user.file = (str(tmp_path / name), "")
        exchange.ask_export_weights()
        assert (tmp_path / name).stat().st_size > 100
    assert not exchange.export_weights(tmp_path / "w.txt")
    assert "name the file .json or .csv" in user.said[-1]


def left_over(files: FileActions, name: str, pid: int) -> Path:
    """What a session with this process number left when it was killed."""
    file = files.autosave.journal.with_name(f"{pid}.journal")
    file.parent.mkdir(parents=True, exist_ok=True)
    journal.begin(file, Kept(CurveSet(name=name), None, ""))
    return file


def gone(own: int) -> int:
    """A process number that nothing has."""
    return 2**22 + own


def test_recovered_work_keeps_a_journal_even_if_the_dead_session_had_our_number(
    files: FileActions, document: Document, user: Answers
) -> None:
    copy = left_over(files, "Rescued", int(files.autosave.journal.stem))
    user.buttons = [Button.Yes]
    files.offer_recovery()
    assert "Unsaved work on “Rescued”" in user.said[0]
    assert document.curve_set.name == "Rescued"
    assert document.is_dirty
    assert journal.read(copy).curve_set.name == "Rescued"


def test_recovered_work_moves_to_a_journal_of_this_session(
    files: FileActions, document: Document, user: Answers
) -> None:
    copy = left_over(files, "Rescued", gone(1))
    user.buttons = [Button.Yes]
    files.offer_recovery()
    assert not copy.exists()
    assert journal.read(files.autosave.journal).curve_set.name == "Rescued"


def test_what_is_not_wanted_is_forgotten_and_only_that(files: FileActions, document: Document, user: Answers) -> None:
    copies = [left_over(files, name, gone(i)) for i, name in enumerate("abc")]
    user.buttons = [Button.Discard, Button.Yes]
    files.offer_recovery()
    assert document.is_dirty
    assert sum(copy.exists() for copy in copies) == 1  # one refused, one taken, one for the next start

"""Imports and exports of the File menu, and a character's set on a base."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QTimer
from PySide6.QtWidgets import QApplication, QFileDialog, QInputDialog, QMessageBox, QWidget
from pytestqt.qtbot import QtBot

from app import resources
from app.document import Document
from app.exchange import Exchange
from app.file_actions import FileActions
from app.session import Session
from app.settings import ViewState
from core_pipeline.curve_set import CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json
from core_pipeline.files.smartbody_read import import_set
from core_pipeline.files.smartbody_script import read_script

F_AH = ("f", "ah")
HILL = Curve.of([(0, 0), (0.5, 0.9), (1, 0.25)])
SCRIPT = """d = m.createDiphone("f", "ah", "{name}")
d.addKey("open", 0.2, 0)
d.addKey("open", 1.01, 0.7)
"""


@pytest.fixture
def exchange(tmp_path: Path, qtbot: QtBot) -> Iterator[Exchange]:
    window = QWidget()
    qtbot.addWidget(window)
    document = Document(CurveSet(name="Mine"))
    files = FileActions(window, document, ViewState(tmp_path / "state"))
    yield Exchange(files, Session(document.curve_set, window))
    files.close()
    QCoreApplication.processEvents()


def accept(said: list[str], row: str | None = None) -> None:
    """Answer the next box: choose a row if it has any, and press its default button."""

    def look() -> None:
        box = QApplication.activeModalWidget()
        if isinstance(box, QInputDialog):
            said.append(box.labelText())
            if row is not None:
                box.setTextValue(row)
            box.accept()
        elif isinstance(box, QMessageBox):
            said.append(f"{box.text()} {box.detailedText()}")
            box.accept()
        else:
            QTimer.singleShot(5, look)

    QTimer.singleShot(0, look)


def test_a_script_is_imported_as_unsaved_work_and_repairs_are_told(
    exchange: Exchange, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "default.py"
    path.write_text(SCRIPT.format(name="default"))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    said: list[str] = []
    accept(said)
    exchange.ask_import()
    document = exchange._document
    assert document.curve_set.bigrams[F_AH].curves["open"].keys() == [(0.2, 0), (1, 0.7)]
    assert document.is_dirty
    assert document.path is None
    assert "1 bigram was imported" in said[0]
    assert "1 key outside 0…1 clipped" in said[0]


def test_of_several_sets_the_user_chooses_one(exchange: Exchange, tmp_path: Path) -> None:
    path = tmp_path / "both.py"
    path.write_text(SCRIPT.format(name="default") + SCRIPT.format(name="brad").replace("ah", "aa"))
    said: list[str] = []
    accept(said, "brad (1 diphone)")
    QTimer.singleShot(0, lambda: accept(said))
    exchange.import_script(path)
    assert said[0] == "The script has several sets. Which one?"
    assert exchange._document.curve_set.name == "brad"
    assert list(exchange._document.curve_set.bigrams) == [("f", "aa")]


def test_what_is_no_script_is_said_and_nothing_is_lost(
    exchange: Exchange, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said: list[str] = []
    monkeypatch.setattr(QMessageBox, "warning", lambda _parent, _title, text: said.append(text))
    (tmp_path / "other.py").write_text("import os\n")
    exchange.import_script(tmp_path / "other.py")
    assert "is no diphone script" in said[0]
    assert exchange._document.curve_set.name == "Mine"


def test_a_set_goes_out_as_a_script_and_comes_back(exchange: Exchange, tmp_path: Path) -> None:
    exchange._document.edit_curves(F_AH, {"open": HILL}, "Move key")
    assert exchange.export(tmp_path / "mine.py")
    assert import_set(read_script(tmp_path / "mine.py")).curve_set.bigrams[F_AH].curves["open"].same_as(HILL)


def test_a_characters_set_stores_what_differs_and_goes_out_whole(
    exchange: Exchange, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(QInputDialog, "getItem", lambda *asked: (asked[3][asked[4]], True))  # what it proposes
    monkeypatch.setattr(QInputDialog, "getText", lambda *_: ("Hero", True))
    exchange.ask_new_on_base()
    document = exchange._document
    assert document.curve_set.name == "Hero"
    assert document.curve_set.missing() == []
    assert not document.is_dirty
    document.edit_curves(F_AH, {"open": HILL}, "Move key")
    document.save(tmp_path / "hero.json")
    assert (tmp_path / "hero.json").stat().st_size < 3000
    assert exchange.export(tmp_path / "hero.min.json")
    english = curve_set_json.load(resources.english_curves())
    assert len(curve_set_json.load(tmp_path / "hero.min.json").bigrams) == len(english.bigrams)
    document.revert(F_AH, "Revert to base")
    assert document.curve_set.own == {}
    document.undo_stack.undo()
    assert document.curve_set.bigrams[F_AH].curves["open"] is HILL


def test_a_set_on_a_file_names_it_from_where_it_is_saved(exchange: Exchange, tmp_path: Path) -> None:
    curve_set_json.save(CurveSet(name="Low"), tmp_path / "low.json")
    exchange.new_on_base(str(tmp_path / "low.json"), "Hero")
    (tmp_path / "heroes").mkdir()
    exchange._document.save(tmp_path / "heroes" / "hero.json")
    assert curve_set_json.load(tmp_path / "heroes" / "hero.json").base == "../low.json"

"""The document: edits are steps, undo brings the very same objects back, a failed save loses nothing."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.document import NUDGE, Document
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.settings import Settings
from tests.helpers import stages as small

F_AH = ("f", "ah")
LOW, HIGH = Curve.of([(0, 0), (0.5, 0.2), (1, 0)]), Curve.of([(0, 0), (0.5, 0.9), (1, 0)])


@pytest.fixture
def document(qtbot: QtBot) -> Document:
    return Document(CurveSet(bigrams={F_AH: Bigram({"open": LOW}, status="suggestion", source="phone parts")}))


def opened(document: Document, text: str, path: Path) -> tuple[str, ...]:
    path.write_text(text, "utf-8")
    return document.open(path)


# ── edits ────────────────────────────────────────────────────────────────────────────────────────


def test_an_edit_is_one_step_and_says_which_bigram(document: Document, qtbot: QtBot) -> None:
    before = document.curve_set
    with qtbot.waitSignal(document.bigram_changed) as changed:
        document.edit_curves(F_AH, {"open": HIGH, "FV": LOW}, "Move key")
    assert changed.args == [F_AH]
    assert document.curve_set.bigrams[F_AH].curves == {"open": HIGH, "FV": LOW}
    assert (document.undo_stack.count(), document.undo_stack.undoText()) == (1, "Move key")
    assert before.bigrams[F_AH].curves == {"open": LOW}


def test_undo_and_redo_bring_the_very_same_bigrams_back(document: Document) -> None:
    before = document.curve_set.bigrams[F_AH]
    document.edit_curves(F_AH, {"open": HIGH}, "Move key")
    after = document.curve_set.bigrams[F_AH]
    for _ in range(3):
        document.undo_stack.undo()
        assert document.curve_set.bigrams[F_AH] is before
        assert not document.is_dirty
        document.undo_stack.redo()
        assert document.curve_set.bigrams[F_AH] is after
        assert document.is_dirty


def test_what_a_person_drew_is_a_draft_of_theirs(document: Document) -> None:
    document.edit_curves(F_AH, {"open": HIGH}, "Move key")
    bigram = document.curve_set.bigrams[F_AH]
    assert (bigram.status, bigram.source) == ("draft", "authored")


def test_the_first_curve_of_a_missing_bigram_makes_it_and_undo_removes_it(document: Document) -> None:
    document.edit_curves(("ah", "d"), {"open": LOW}, "Add key")
    assert document.curve_set.bigrams["ah", "d"].curves == {"open": LOW}
    document.undo_stack.undo()
    assert ("ah", "d") not in document.curve_set.bigrams


def test_a_curve_can_be_removed(document: Document) -> None:
    document.edit_curves(F_AH, {"open": None}, "Delete keys")
    assert document.curve_set.status_of(F_AH) == "empty"
    document.undo_stack.undo()
    assert document.curve_set.bigrams[F_AH].curves == {"open": LOW}


def test_several_nudges_are_one_step(document: Document) -> None:
    before = document.curve_set.bigrams[F_AH]
    for height in (0.3, 0.4, 0.5):
        document.edit_curves(F_AH, {"open": Curve.of([(0, height)])}, NUDGE)
    assert document.undo_stack.count() == 1
    assert document.curve_set.bigrams[F_AH].curves["open"].v[0] == 0.5
    document.undo_stack.undo()
    assert document.curve_set.bigrams[F_AH] is before
    document.undo_stack.redo()
    assert document.curve_set.bigrams[F_AH].curves["open"].v[0] == 0.5


def test_nudges_of_another_bigram_after_an_edit_or_a_save_are_steps_of_their_own(
    document: Document, tmp_path: Path
) -> None:
    document.edit_curves(F_AH, {"open": HIGH}, NUDGE)
    document.edit_curves(("ah", "d"), {"open": HIGH}, NUDGE)
    assert document.undo_stack.count() == 2
    document.edit_curves(("ah", "d"), {"open": LOW}, "Move key")
    document.edit_curves(("ah", "d"), {"open": HIGH}, NUDGE)
    assert document.undo_stack.count() == 4
    document.save(tmp_path / "set.json")
    document.edit_curves(("ah", "d"), {"open": LOW}, NUDGE)
    assert document.undo_stack.count() == 5
    assert document.is_dirty
    document.undo_stack.undo()
    assert not document.is_dirty


def test_nudges_after_an_undo_go_on_from_there(document: Document) -> None:
    document.edit_curves(F_AH, {"open": HIGH}, NUDGE)
    document.undo_stack.undo()
    document.edit_curves(F_AH, {"FV": HIGH}, NUDGE)
    assert document.curve_set.bigrams[F_AH].curves == {"open": LOW, "FV": HIGH}
    document.undo_stack.undo()
    assert document.curve_set.bigrams[F_AH].curves == {"open": LOW}


def test_settings_are_an_undoable_edit(document: Document, qtbot: QtBot) -> None:
    with qtbot.waitSignal(document.settings_changed):
        document.change_settings(Settings.smartbody(), "Preset SmartBody")
    assert document.curve_set.effective_settings == Settings.smartbody()
    assert document.is_dirty
    document.undo_stack.undo()
    assert document.curve_set.effective_settings == Settings.paper()
    assert not document.is_dirty


def test_the_same_settings_again_are_no_edit(document: Document) -> None:
    document.change_settings(Settings.paper(), "Preset Paper")
    assert document.undo_stack.count() == 0


@pytest.mark.parametrize(
    ("pair", "pose", "told"), [(("f", "q7"), "open", "f-q7 is not a bigram"), (F_AH, "Open", "has no pose Open")]
)
def test_an_edit_that_could_not_be_saved_is_refused(
    document: Document, pair: tuple[str, str], pose: str, told: str
) -> None:
    before = document.curve_set
    with pytest.raises(UserError, match=told):
        document.edit_curves(pair, {pose: HIGH}, "Move key")
    assert document.curve_set is before
    assert document.undo_stack.count() == 0


# ── the file ─────────────────────────────────────────────────────────────────────────────────────


def test_save_clears_the_mark_and_the_file_holds_the_edit(document: Document, tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    assert document.title == "Untitled (not saved yet)"
    assert document.file_name == "Untitled.json"
    document.edit_curves(F_AH, {"open": HIGH}, "Move key")
    document.save(path)
    assert not document.is_dirty
    assert (document.path, document.title, document.file_name) == (path, "mine.json", "mine.json")
    assert curve_set_json.load(path).bigrams[F_AH].curves["open"].same_as(HIGH)
    document.undo_stack.undo()
    assert document.is_dirty
    document.save()
    assert curve_set_json.load(path).bigrams[F_AH].curves["open"].same_as(LOW)


def test_a_set_without_a_file_asks_for_one(document: Document) -> None:
    with pytest.raises(UserError, match="Save As"):
        document.save()


def test_a_save_that_fails_loses_nothing(document: Document, tmp_path: Path) -> None:
    path = tmp_path / "folder" / "mine.json"
    path.parent.mkdir()
    document.save(path)
    document.edit_curves(F_AH, {"open": HIGH}, "Move key")
    path.unlink()
    path.parent.rmdir()
    with pytest.raises(UserError, match="there is no such file or folder"):
        document.save()
    with pytest.raises(UserError, match="it is a folder"):
        document.save(tmp_path)
    assert document.is_dirty
    assert document.path == path
    assert document.curve_set.bigrams[F_AH].curves["open"] is HIGH
    document.save(tmp_path / "elsewhere.json")
    assert not document.is_dirty


def test_opening_replaces_all_and_forgets_the_steps(document: Document, qtbot: QtBot, tmp_path: Path) -> None:
    document.edit_curves(F_AH, {"open": HIGH}, "Move key")
    with qtbot.waitSignals([document.replaced, document.file_changed]):
        assert opened(document, curve_set_json.dumps(CurveSet(name="Other")), tmp_path / "other.json") == ()
    assert document.curve_set.name == "Other"
    assert document.undo_stack.count() == 0
    assert not document.is_dirty


def test_a_file_that_cannot_be_opened_leaves_everything(document: Document, tmp_path: Path) -> None:
    document.edit_curves(F_AH, {"open": HIGH}, "Move key")
    before = document.curve_set
    for text in ("", "{}", '{"schema": "lipstitch.CurveSet.1", "bigrams": {"f-q7": {}}}'):
        with pytest.raises(UserError):
            opened(document, text, tmp_path / "bad.json")
    with pytest.raises(UserError):
        document.open(tmp_path / "missing.json")
    assert document.curve_set is before
    assert document.path is None
    assert document.is_dirty
    assert document.undo_stack.canUndo()


def test_a_repaired_file_counts_as_not_saved(document: Document, tmp_path: Path) -> None:
    path = tmp_path / "odd.json"
    keys = '{"f-ah": {"curves": {"open": [[0.5, 1], [0, 0]]}}}'
    assert opened(document, f'{{"schema": "lipstitch.CurveSet.1", "bigrams": {keys}}}', path)
    assert document.is_dirty
    document.save()
    assert not document.is_dirty
    assert document.open(path) == ()


def test_a_newer_file_is_shown_but_never_written(document: Document, tmp_path: Path) -> None:
    path = tmp_path / "newer.json"
    text = curve_set_json.dumps(CurveSet()).replace("CurveSet.1", "CurveSet.2")
    opened(document, text, path)
    assert "newer.json was written by a newer Lipstitch" in document.read_only_reason
    for act in (
        lambda: document.edit_curves(F_AH, {"open": HIGH}, "Move key"),
        lambda: document.change_settings(Settings.smartbody(), "Preset SmartBody"),
        document.save,
        lambda: document.save(tmp_path / "copy.json"),
    ):
        with pytest.raises(UserError, match="newer Lipstitch"):
            act()
    assert path.read_text("utf-8") == text
    assert not document.is_dirty
    document.new(CurveSet())
    document.edit_curves(F_AH, {"open": HIGH}, "Move key")


def test_unknown_fields_survive_open_edit_save(document: Document, tmp_path: Path) -> None:
    path = tmp_path / "set.json"
    opened(document, '{"schema": "lipstitch.CurveSet.1", "team": ["Ann"], "bigrams": {"f-ah": {"author": "Bo"}}}', path)
    document.edit_curves(F_AH, {"open": HIGH}, "Move key")
    document.change_settings(Settings.smartbody(), "Preset SmartBody")
    document.save()
    top = json.loads(path.read_text("utf-8"))
    assert top["team"] == ["Ann"]
    assert top["bigrams"]["f-ah"]["author"] == "Bo"


def test_recovered_work_knows_its_file_and_is_not_saved(document: Document, tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    document.recover(CurveSet(name="Rescued"), path)
    assert document.is_dirty
    assert not path.exists()
    document.save()
    assert curve_set_json.load(path).name == "Rescued"
    assert not document.is_dirty


def test_many_bigrams_are_one_step_and_the_same_objects_come_back(qtbot: QtBot) -> None:
    document = Document(small.curve_set())
    before = dict(document.curve_set.bigrams)
    new = {("f", "ah"): Bigram(status="review"), ("sil", "ah"): Bigram({"open": Curve.of([(0, 0), (1, 1)])})}
    with qtbot.waitSignal(document.bigrams_changed):
        document.put_bigrams(new, "Fill")
    assert document.undo_stack.count() == 1
    assert all(document.curve_set.bigrams[pair] is bigram for pair, bigram in new.items())
    document.undo_stack.undo()
    assert document.curve_set.bigrams.keys() == before.keys()
    assert all(document.curve_set.bigrams[pair] is bigram for pair, bigram in before.items())
    document.put_bigrams({}, "Nothing")
    assert document.undo_stack.count() == 1  # what was undone can still be done again
    document.read_only_reason = "Written by a newer Lipstitch."
    for act in (lambda: document.put_bigrams(new, "Fill"), lambda: document.put_bigram(("f", "ah"), Bigram(), "Put")):
        with pytest.raises(UserError, match="newer"):
            act()


def test_a_whole_bigram_is_put_with_its_status() -> None:
    document = Document(small.curve_set())
    approved = replace(document.curve_set.bigrams["f", "ah"], status="approved")
    document.put_bigram(("f", "ah"), approved, "Approve")
    assert document.curve_set.bigrams["f", "ah"] is approved
    with pytest.raises(UserError, match="is not a bigram of this set"):
        document.put_bigram(("f", "?"), approved, "Approve")


@pytest.mark.parametrize(("name", "file"), [("Bob/..\\a: b", "Boba b.json"), ("…", "curves.json"), ("魚", "魚.json")])
def test_a_new_file_is_to_be_called_by_the_sets_name(qtbot: QtBot, name: str, file: str) -> None:
    assert Document(CurveSet(name=name)).file_name == file

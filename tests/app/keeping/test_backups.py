"""Backups: the last ten saves, one a day for fourteen days, one before every great change; and the way back."""

from datetime import datetime, timedelta
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.document import Document
from app.keeping.backups import BEFORE, DAYS, SAVES, Backups
from app.keeping.keeper import Keeper
from core_pipeline.curve_set import CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.phone_sets import added

START = datetime.fromisoformat("2026-03-01T09:00:00+00:00")
F_AH = ("f", "ah")


@pytest.fixture
def mine(tmp_path: Path) -> Path:
    path = tmp_path / "mine.json"
    path.write_text("0")
    return path


@pytest.fixture
def backups(tmp_path: Path, mine: Path) -> Backups:
    return Backups(tmp_path / "backups", mine)


def kinds(backups: Backups, kind: str) -> list[str]:
    return [backup.path.read_text() for backup in backups.all() if backup.kind == kind]


def test_ten_saves_stay_and_the_first_of_the_day(backups: Backups, mine: Path) -> None:
    for i in range(25):
        mine.write_text(str(i))
        backups.keep_file(mine, START + timedelta(minutes=i))
    assert kinds(backups, "save") == [str(i) for i in range(24, 24 - SAVES, -1)]
    assert kinds(backups, "day") == ["0"]


def test_a_backup_a_day_stays_for_two_weeks(backups: Backups, mine: Path) -> None:
    for day in range(30):
        for hour in (0, 5):
            mine.write_text(f"{day} {hour}")
            backups.keep_file(mine, START + timedelta(days=day, hours=hour))
    assert kinds(backups, "day") == [f"{day} 0" for day in range(29, 29 - DAYS, -1)]


def test_great_changes_have_ten_of_their_own(backups: Backups, mine: Path) -> None:
    for i in range(15):
        backups.keep(str(i), "before merge", START + timedelta(hours=i))
        backups.keep_file(mine, START + timedelta(hours=i))
    assert kinds(backups, "before merge") == [str(i) for i in range(14, 14 - BEFORE, -1)]
    assert len(kinds(backups, "save")) == SAVES


def test_files_of_the_same_name_do_not_meet(tmp_path: Path, backups: Backups, mine: Path) -> None:
    backups.keep_file(mine, START)
    assert Backups(tmp_path / "backups", tmp_path / "other" / "mine.json").all() == []
    (tmp_path / "backups" / "notes.txt").write_text("")
    assert len(backups.all()) == 2


def test_where_none_can_be_kept_it_is_said(tmp_path: Path, mine: Path) -> None:
    with pytest.raises(UserError, match="No backup can be kept in"):
        Backups(mine, mine).keep_file(mine, START)


def test_saving_keeps_what_was_there_and_restoring_is_one_step(tmp_path: Path, mine: Path, qtbot: QtBot) -> None:
    document = Document(CurveSet(name="Old"))
    keeper = Keeper(document, tmp_path / "backups")
    document.save(mine, keeper.write)
    document.edit_curves(F_AH, {"open": Curve.of([(0, 1)])}, "Move key")
    document.save(None, keeper.write)
    saves = [backup for backup in keeper.backups().all() if backup.kind == "save"]
    assert [backup.path.read_text("utf-8")[:1] for backup in saves] == ["{", "0"]
    keeper.restore(saves[0])
    assert F_AH not in document.curve_set.bigrams
    assert document.is_dirty
    document.undo_stack.undo()
    assert F_AH in document.curve_set.bigrams
    assert not document.is_dirty
    with pytest.raises(UserError, match=r"not a curve set|does not begin"):
        keeper.restore(saves[1])


def test_before_many_bigrams_change_the_set_is_kept(tmp_path: Path, qtbot: QtBot) -> None:
    document = Document(CurveSet(name="Old"))
    keeper = Keeper(document, tmp_path / "backups")
    document.change_set(added(document.curve_set, "ü"), "Add ü to the phones")
    (backup,) = keeper.backups().all()
    assert backup.kind == "before add  to the phones"
    assert "ü" not in curve_set_json.load(backup.path).phonemes


def test_a_save_goes_on_where_no_backup_can_be_kept_and_says_so_once(tmp_path: Path, mine: Path, qtbot: QtBot) -> None:
    document = Document(CurveSet(name="Old"))
    keeper = Keeper(document, mine)  # a file where the folder should be
    said: list[str] = []
    keeper.failed.connect(said.append)
    other = tmp_path / "other.json"
    for _ in range(3):
        document.save(other, keeper.write)
    assert curve_set_json.load(other).name == "Old"
    assert len(said) == 1
    assert "No backup can be kept" in said[0]

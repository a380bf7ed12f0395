"""Locks: who has a file open, as long as they live."""

import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app import resources
from app.document import Document
from app.keeping.keeper import Keeper
from app.keeping.lock import Lock
from app.keeping.processes import birth, is_running
from core_pipeline.curve_set import CurveSet

ROOT = Path(resources.__file__).parents[1]
HOLDER = """
import sys
from pathlib import Path
from app.keeping.lock import Lock
Lock(Path(sys.argv[1])).take()
print("held", flush=True)
sys.stdin.read()
"""


@pytest.fixture
def mine(tmp_path: Path) -> Path:
    return tmp_path / "mine.json"


def written(mine: Path, **owner: object) -> Lock:
    mine.with_name(".mine.json.lock").write_text(json.dumps(owner))
    return Lock(mine)


def test_another_process_is_seen_until_it_is_killed(mine: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", HOLDER, mine], env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    ) as other:  # fmt: skip
        assert other.stdout is not None
        assert other.stdout.readline() == "held\n"
        owner = Lock(mine).owner()
        assert owner is not None
        assert (owner.pid, owner.host) == (other.pid, socket.gethostname())
        Lock(mine).release()
        assert Lock(mine).owner() == owner  # not ours to remove
        other.send_signal(signal.SIGKILL)
        other.wait()
        assert Lock(mine).owner() is None


def test_our_own_lock_is_nobody_elses_and_goes_when_released(mine: Path) -> None:
    lock = Lock(mine)
    assert lock.take()
    assert lock.owner() is None
    lock.release()
    assert list(mine.parent.iterdir()) == []


def test_another_machine_is_taken_to_live(mine: Path) -> None:
    owner = written(mine, host="far.example.com", pid=1, birth="").owner()
    assert owner is not None
    assert owner.host == "far.example.com"


def test_a_number_that_another_process_has_now_is_stale(mine: Path) -> None:
    parent = os.getppid()
    assert is_running(parent)
    assert written(mine, host=socket.gethostname(), pid=parent, birth=birth(parent)).owner() is not None
    if birth(parent):
        assert written(mine, host=socket.gethostname(), pid=parent, birth="1").owner() is None


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", "null", '{"host": 1, "pid": "x"}', '{"host": "a", "pid": 1e400}', "[" * 9000]
)
def test_a_damaged_lock_counts_as_none(mine: Path, text: str) -> None:
    mine.with_name(".mine.json.lock").write_text(text)
    assert Lock(mine).owner() is None
    Lock(mine).release()


def test_where_nothing_can_be_written_there_is_no_lock(mine: Path) -> None:
    assert not Lock(mine / "below.json").take()


def test_the_lock_follows_the_document(tmp_path: Path, mine: Path, qtbot: QtBot) -> None:
    document = Document(CurveSet())
    keeper = Keeper(document, tmp_path / "backups")
    document.save(mine)
    keeper.hold(mine)
    assert mine.with_name(".mine.json.lock").exists()
    document.new(CurveSet())
    assert not mine.with_name(".mine.json.lock").exists()

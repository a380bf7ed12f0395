"""View state: what was put comes back; a damaged file gives the defaults."""

from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray
from pytestqt.qtbot import QtBot

from app.settings import ViewState

TEXT = 'Fat, "cats"; often=find\\fish [100%] @home \U0001f408'


def reopened(state: ViewState) -> ViewState:
    state.write()
    return ViewState(state.folder)


def test_what_was_put_comes_back(tmp_path: Path, qtbot: QtBot) -> None:
    state = ViewState(tmp_path / "new" / "folder")
    layout = QByteArray(bytes(range(256)))
    for name, value in {"text": TEXT, "at": "@Variant(", "n": 0.75, "yes": True, "no": False, "dock": layout}.items():
        state.put(name, value)
    state.put("lines", ["a, b", "ü"])
    again = reopened(state)
    assert again.text("text") == TEXT
    assert again.text("at") == "@Variant("
    assert again.number("n", 1.0) == 0.75
    assert again.flag("yes", False)
    assert not again.flag("no", True)
    assert again.layout("dock") == layout
    assert again.texts("lines") == ["a, b", "ü"]


def test_defaults_where_nothing_was_put(tmp_path: Path, qtbot: QtBot) -> None:
    state = ViewState(tmp_path)
    assert state.text("x", "default") == "default"
    assert state.number("x", 0.5) == 0.5
    assert state.flag("x", True)
    assert not state.flag("x", False)
    assert state.layout("x").isEmpty()
    assert state.texts("x") == []


@pytest.mark.qt_log_ignore("QVariant::load: unable", "Trying to construct an instance of an invalid type")
@pytest.mark.parametrize(
    "data",
    [
        b"",
        bytes(range(256)) * 20,
        b"[General\nspeed",
        b"speed=fast\nlayout=7\nloop=maybe\nsentence=a, b",
        b"speed=nan\nlayout=@Invalid()\nsentence=@Invalid()",
        b"speed=1e999\nlayout=@ByteArray(\nsentence=@Variant(\\0\\0\\0\\x1f)",
        b"speed=@Variant(\\xff\\xff\\xff\\xff)\nlayout=@Rect(1 2 3 4)\nsentence=@Size(1 2)",
        b"speed=1,2\nlayout=,\nsentence=\\x\\xzz",
        b"[General]\nspeed=" + b"9" * 100_000,
    ],
)
def test_a_damaged_file_gives_usable_values(tmp_path: Path, qtbot: QtBot, data: bytes) -> None:
    (tmp_path / "lipstitch.ini").write_bytes(data)
    state = ViewState(tmp_path)
    assert state.number("speed", 0.5) == 0.5
    assert state.flag("loop", True) in (True, False)
    assert isinstance(state.text("sentence"), str)
    assert isinstance(state.layout("layout"), QByteArray)
    state.put("sentence", TEXT)
    state.put("speed", 0.25)
    again = reopened(state)
    assert again.text("sentence") == TEXT
    assert again.number("speed", 1.0) == 0.25


def test_a_folder_that_cannot_be_made_is_no_reason_to_complain(tmp_path: Path, qtbot: QtBot) -> None:
    (tmp_path / "file").write_text("mine")
    state = ViewState(tmp_path / "file" / "below")
    state.put("sentence", TEXT)
    state.write()
    assert state.text("sentence") == TEXT
    assert (tmp_path / "file").read_text() == "mine"

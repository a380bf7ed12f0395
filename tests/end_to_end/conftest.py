"""A real editor with its real parts, off screen: espeak-ng speaks, OpenGL draws, files are files."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app import resources
from app.editor import Editor
from app.settings import ViewState
from core_pipeline.files import curve_set_json


@pytest.fixture
def editor(qtbot: QtBot, qapp: QApplication, tmp_path: Path) -> Iterator[Editor]:
    editor = Editor(curve_set_json.load(resources.english_curves()), ViewState(tmp_path / "state"))
    editor.window.resize(1600, 1000)
    with qtbot.waitExposed(editor.window):
        editor.window.show()
    editor.preview.start()
    yield editor
    editor.close()
    editor.window.may_close = lambda: True
    editor.window.close()
    editor.window.deleteLater()
    qapp.processEvents()

"""A machine whose OpenGL cannot be reached: the editor edits, says why there is no face, and tries again when asked."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

STORY = """
import sys
from pathlib import Path
from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QApplication
from app import resources
from app.editor import Editor
from app.settings import ViewState
from core_pipeline.files import curve_set_json
from widgets import theme

app = QApplication([])
theme.apply(app)

def wait_for(signal):
    loop = QEventLoop()
    signal.connect(lambda *_: loop.quit())
    QTimer.singleShot(30_000, loop, lambda: sys.exit("nothing happened"))
    loop.exec()

editor = Editor(curve_set_json.load(resources.english_curves()), ViewState(Path(sys.argv[1])))
editor.window.show()
editor.preview.start()
wait_for(editor.preview.failed)
view = editor.window.face_view
print(view._message.text())
print(view._retry.isVisible())

editor.wiring.bigram.open(("f", "ah"))
before = editor.document.curve_set
canvas = editor.window.canvas
canvas.select_all()
canvas.nudge(0.0, 0.05)
print(editor.document.curve_set is not before)
editor.window.actions_.undo.trigger()
print(editor.document.curve_set.bigrams["f", "ah"] is before.bigrams["f", "ah"])

QTimer.singleShot(0, view._retry.click)
wait_for(editor.preview.failed)
print(view._retry.isVisible())
editor.close()
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="EGL is Linux's way")
def test_the_editor_goes_on_without_opengl_and_says_why(tmp_path):
    environment = {
        **os.environ,
        "__EGL_VENDOR_LIBRARY_FILENAMES": "/nowhere.json",
        "QT_QPA_PLATFORM": "offscreen",
        "PYTHONPATH": str(ROOT),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
    }
    command = [sys.executable, "-c", STORY, str(tmp_path / "state")]
    done = subprocess.run(
        command, env=environment, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr
    reason, offered, edited, undone, offered_again = done.stdout.splitlines()
    assert reason.startswith("The face cannot be drawn: no OpenGL on this machine (")
    assert reason.endswith("or the driver of your graphics card.")
    assert [offered, edited, undone, offered_again] == ["True"] * 4
    assert "Traceback" not in done.stderr

"""From the command to a window with its curves."""

import os
import subprocess
import sys
from pathlib import Path

from tests.helpers.budget import within

ROOT = Path(__file__).parents[2]

START = """
import sys
from pathlib import Path
from PySide6.QtWidgets import QApplication
from app.editor import Editor
from app.resources import english_curves
from app.settings import ViewState
from core_pipeline.files import curve_set_json
from widgets import theme

app = QApplication([])
theme.apply(app)
editor = Editor(curve_set_json.load(english_curves()), ViewState(Path(sys.argv[1])))
editor.wiring.restore()
editor.window.show()
app.processEvents()
print("shown", flush=True)
editor.close()
"""


def test_cold_start(benchmark, tmp_path):
    def start():
        environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
        command = [sys.executable, "-c", START, str(tmp_path)]
        with subprocess.Popen(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout.readline() == "shown\n"
            return process.communicate(timeout=30)

    benchmark.pedantic(start, rounds=5)
    within(benchmark, 3.0)

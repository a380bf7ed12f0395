"""The house keeps its rules: one-way imports, a core that needs only numpy and scipy, a PySide6 that counts right."""

import subprocess
import sys
from pathlib import Path

from PySide6.QtCore import QPointF

ROOT = Path(__file__).resolve().parent.parent

# Run in a fresh interpreter: whatever is neither ours, nor the standard library's, nor numpy or scipy cannot be found.
ONLY_NUMPY_AND_SCIPY = """
import importlib, pkgutil, sys

ALLOWED = {"core_pipeline", "numpy", "scipy", "msgspec"} | sys.stdlib_module_names

class Wall:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] not in ALLOWED:
            raise ModuleNotFoundError(f"{name} is not allowed in the core", name=name)

sys.meta_path.insert(0, Wall())
sys.path.insert(0, ROOT)
import core_pipeline

names = [m.name for m in pkgutil.walk_packages(core_pipeline.__path__, "core_pipeline.", onerror=lambda name: None)]
wanted = [n for n in names if not n.startswith("core_pipeline.faces")]
for name in wanted:
    importlib.import_module(name)
from core_pipeline.pipeline import run
from core_pipeline.schedule import Schedule
from core_pipeline.curve_set import CurveSet
run(Schedule(["hh", "ah", "l", "ow"], range(5)), CurveSet())
foreign = {n.partition(".")[0] for n in sys.modules} & {"PySide6", "shiboken6", "pyqtgraph", "OpenGL", "pyrender"}
print(len(wanted), sorted(foreign))
"""


def test_the_core_imports_with_numpy_and_scipy_alone():
    code = f"ROOT = {str(ROOT)!r}\n{ONLY_NUMPY_AND_SCIPY}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    count, foreign = done.stdout.split(" ", 1)
    assert int(count) >= 15
    assert foreign.strip() == "[]"


def test_imports_go_one_way():
    lint = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    done = subprocess.run(
        [sys.executable, "-c", lint, "--no-cache", "--config", "pyproject.toml"],
        capture_output=True,
        text=True,
        check=False,
        cwd=ROOT,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 broken" in done.stdout


def test_this_pyside_returns_every_reference_to_none():
    point = QPointF()
    before = sys.getrefcount(None)
    for x in range(2000):
        point.setX(x)
    assert abs(sys.getrefcount(None) - before) < 100, "this version of PySide6 loses None until Python aborts"

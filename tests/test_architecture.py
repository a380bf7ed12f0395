"""The house keeps its rules: one-way imports, a core without Qt, a PySide6 that counts right."""

import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QPointF

ROOT = Path(__file__).resolve().parent.parent

# Run in a fresh interpreter in which nothing but the standard library, our core and ALLOWED can be found.
BEHIND_A_WALL = """
import importlib, pkgutil, sys

class Wall:
    def find_spec(self, name, path=None, target=None):
        known = ALLOWED | {"core_pipeline"} | sys.stdlib_module_names
        if name.partition(".")[0] not in known and not name.startswith("_sysconfigdata"):  # sysconfig's own, for scipy
            raise ModuleNotFoundError(f"{name} is not allowed here", name=name)

sys.meta_path.insert(0, Wall())
sys.path.insert(0, ROOT)
import core_pipeline

wanted = ["core_pipeline.pipeline", "core_pipeline.weights"]
if "msgspec" in ALLOWED:
    modules = pkgutil.walk_packages(core_pipeline.__path__, "core_pipeline.", onerror=lambda name: None)
    wanted = [m.name for m in modules if not m.name.startswith("core_pipeline.faces")]
for name in wanted:
    importlib.import_module(name)
from core_pipeline.curve_set import CurveSet
from core_pipeline.pipeline import run
from core_pipeline.schedule import Schedule
from core_pipeline.settings import SPLINES
from core_pipeline.weights import bake
for spline in SPLINES:
    bake(run(Schedule(["hh", "ah", "l", "ow"], range(5)), CurveSet()).magenta, spline, 30)
foreign = {name.partition(".")[0] for name in sys.modules} & {"PySide6", "shiboken6", "pyqtgraph", "OpenGL", "pyrender"}
print(sorted(foreign))
"""


@pytest.mark.parametrize("allowed", [{"numpy", "scipy"}, {"numpy", "scipy", "msgspec"}], ids=["pipeline", "core"])
def test_the_core_imports_without_qt_and_opengl(allowed):
    """The pipeline needs numpy and scipy alone; files and speech also msgspec, which reads the JSON."""
    code = f"ROOT, ALLOWED = {str(ROOT)!r}, {allowed!r}\n{BEHIND_A_WALL}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "[]"


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

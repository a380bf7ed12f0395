"""`lipstitch build-faces` and `build-curves`: the shipped files from their sources, and how far they have come."""

import io
import sys
from pathlib import Path

import numpy as np
import pytest

from app import cli
from app.command_line.progress import bar
from app.resources import english_curves, face_folder
from core_pipeline.faces.face_folder import load

ROOT = Path(cli.__file__).parents[1]


def test_a_face_is_built_as_it_is_shipped(tmp_path, capsys):
    assert cli.main(["build-faces", "crab", "--out", str(tmp_path)]) == 0
    assert capsys.readouterr() == (f"{tmp_path / 'crab'}\n", "")
    assert [path.name for path in tmp_path.iterdir()] == ["crab"]
    made, shipped = load(tmp_path / "crab"), load(face_folder("crab"))
    assert made.shapes == shipped.shapes
    for name in ("positions", "deltas", "colours"):  # processors differ in the last digits
        np.testing.assert_allclose(getattr(made, name), getattr(shipped, name), atol=1e-4)


def test_curves_are_built_as_they_are_shipped(tmp_path, capsys):
    recipe = tmp_path / "mine.toml"
    recipe.write_bytes(english_curves().with_name("crab.toml").read_bytes())
    assert cli.main(["build-curves", str(recipe)]) == 0
    assert capsys.readouterr() == (f"{tmp_path / 'mine.json'}\n", "")
    assert (tmp_path / "mine.json").read_bytes() == english_curves().with_name("crab.json").read_bytes()


def test_without_names_all_are_built(tmp_path, capsys, monkeypatch):
    names = sorted(path.stem for path in (ROOT / "assets" / "curves").glob("*.toml"))
    for name in (f"{name}.toml" for name in names):
        (tmp_path / "curves").mkdir(exist_ok=True)
        (tmp_path / "curves" / name).write_bytes(english_curves().with_name(name).read_bytes())
    monkeypatch.setattr("app.resources.assets", lambda: tmp_path)
    assert cli.main(["build-curves"]) == 0
    assert capsys.readouterr().out.split() == [
        str(tmp_path / "curves" / f"{name}.json") for name in (*names, "curve_set.schema")
    ]
    for name in (*names, "curve_set.schema"):
        shipped = ROOT / "assets" / "curves" / f"{name}.json"
        assert (tmp_path / "curves" / shipped.name).read_bytes() == shipped.read_bytes()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["build-faces", "carb"], "“carb” is none of our characters; choose from toon, ada, woman, man, crab."),
        (["build-faces", "crab", "--out", "file/faces"], "cannot be written"),
        (["build-curves", "englisch"], "There is no recipe “englisch”: name crab, english, mandarin, or a file"),
        (["build-curves", "mine.json"], "There is no recipe “mine.json”"),
        (["build-curves", "none.toml"], "none.toml cannot be read"),
    ],
)
def test_what_cannot_be_built_is_said(arguments, told, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("mine")
    (tmp_path / "mine.json").write_text("{}")
    assert cli.main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert told in err
    assert err.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "mine.json"]
    assert (tmp_path / "mine.json").read_text() == "{}"


def test_the_bar_grows_and_its_numbers_stay_in_place():
    bars = [bar(done, 120, "frames") for done in range(121)]
    assert bars[0] == f"[{'.' * 30}]   0 of 120 frames"
    assert bars[60] == f"[{'#' * 15}{'.' * 15}]  60 of 120 frames"
    assert bars[120] == f"[{'#' * 30}] 120 of 120 frames"
    assert len(set(map(len, bars))) == 1
    assert [line.count("#") for line in bars] == sorted(line.count("#") for line in bars)
    assert bar(0, 0, "frames") == f"[{'.' * 30}] 0 of 0 frames"


class Terminal(io.StringIO):
    """A terminal that remembers; a machine in a cage may have no real one to give."""

    def isatty(self) -> bool:
        return True


def test_on_a_terminal_a_bar_is_drawn_on_one_line(monkeypatch, tmp_path):
    recipe = tmp_path / "mine.toml"
    recipe.write_bytes(english_curves().with_name("crab.toml").read_bytes())
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    assert cli.main(["build-curves", str(recipe)]) == 0
    assert terminal.getvalue().split("\r")[1:] == [
        f"[{'.' * 30}] 0 of 1 curve sets",
        f"[{'#' * 30}] 1 of 1 curve sets: mine\n",
    ]

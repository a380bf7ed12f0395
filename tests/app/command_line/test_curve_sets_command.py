"""convert, diff and merge from the command line, and merge as git calls it."""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from app import cli, resources
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json
from core_pipeline.files.curve_set_merge import open_conflicts

ROOT = Path(cli.__file__).resolve().parents[1]
F_AH, AH_D = ("f", "ah"), ("ah", "d")
SCRIPT = """diphone = diphoneManager.createDiphone("f", "ah", "default")
diphone.addKey("FV", -0.01, 0.2)
diphone.addKey("FV", 0.25, 0.97)
"""


def hill(height: float) -> Bigram:
    return Bigram({"open": Curve.of([(0, 0), (0.5, height), (1, 0)])})


@pytest.fixture(autouse=True)
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_script_becomes_a_set_and_a_script_again(capsys: pytest.CaptureFixture[str]) -> None:
    Path("default.py").write_text(SCRIPT)
    assert cli.main(["convert", "default.py", "set.json"]) == 0
    told = capsys.readouterr()
    assert told.out == "set.json: 1 bigrams.\n"
    assert told.err == "lipstitch: default.py: 1 key outside 0…1 clipped, in 1 curve (first: f-ah FV).\n"
    assert curve_set_json.load("set.json").bigrams[F_AH].curves["FV"].keys() == [(0, 0.2), (0.25, 0.97)]
    assert cli.main(["convert", "set.json", "again.py"]) == 0
    assert cli.main(["convert", "again.py", "again.json"]) == 0
    assert cli.main(["diff", "set.json", "again.json"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line for line in lines if line.startswith("f-ah")] == ["f-ah: source default.py → again.py"]


def test_layers_become_one_small_file() -> None:
    english = curve_set_json.load(resources.english_curves())
    hero = CurveSet(name="Hero", bigrams={F_AH: hill(0.9)}).on_base("english", english)
    curve_set_json.save(hero, "hero.json")
    assert cli.main(["convert", "hero.json", "hero.min.json"]) == 0
    assert Path("hero.min.json").read_text("utf-8").count("\n") == 1
    assert cli.main(["convert", "hero.json", "flat.json", "--flat"]) == 0
    for name in ("hero.min.json", "flat.json"):
        alone = curve_set_json.load(name)
        assert alone.base is None
        assert len(alone.bigrams) == len(english.bigrams)


def test_a_base_beside_the_file_is_found_from_another_folder(place: Path) -> None:
    curve_set_json.save(CurveSet(bigrams={AH_D: hill(0.5)}), "low.json")
    Path("hero.json").write_text(f'{{"schema": "{curve_set_json.SCHEMA}", "base": "low.json"}}')
    (place / "out").mkdir()
    assert cli.main(["convert", "hero.json", "out/hero.json"]) == 0
    assert curve_set_json.load("out/hero.json").base == "../low.json"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["convert", "default.py", "default.py"], "would be overwritten"),
        (["convert", "default.py", "set.txt"], "tells no format"),
        (["convert", "gone.py", "set.json"], "there is no such file"),
        (["convert", "default.py", "set.json", "--set", "bob"], "no set “bob”: choose among default"),
        (["convert", "set.json", "x.json", "--set", "bob"], "leave it out"),
        (["diff", "set.json", "gone.json"], "there is no such file"),
        (["merge", "new.json", "set.json", "set.json"], "written by a newer Lipstitch"),
    ],
)
def test_what_cannot_be_done_is_one_sentence(
    arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("default.py").write_text(SCRIPT)
    curve_set_json.save(CurveSet(), "set.json")
    Path("new.json").write_text('{"schema": "lipstitch.CurveSet.9"}')
    assert cli.main(arguments) == 2
    assert told in capsys.readouterr().err
    assert Path("default.py").read_text() == SCRIPT


def test_equal_sets_do_not_differ(capsys: pytest.CaptureFixture[str]) -> None:
    curve_set_json.save(CurveSet(), "a.json")
    assert cli.main(["diff", "a.json", "a.json"]) == 0
    assert capsys.readouterr().out == ""


def test_a_clash_is_told_marked_and_found_by_check(capsys: pytest.CaptureFixture[str]) -> None:
    for name, height in (("base", 0.1), ("ours", 0.5), ("theirs", 0.9)):
        curve_set_json.save(CurveSet(bigrams={F_AH: hill(height)}), f"{name}.json")
    before = Path("ours.json").read_bytes()
    assert cli.main(["merge", "base.json", "ours.json", "theirs.json", "--out", "m.json"]) == 1
    assert "conflict: f-ah open: both sides changed it; ours stays" in capsys.readouterr().err
    assert Path("ours.json").read_bytes() == before
    assert open_conflicts(curve_set_json.load("m.json")) == ["f-ah open"]
    assert cli.main(["check", "m.json"]) == 1
    assert "m.json: f-ah open is undecided since a merge." in capsys.readouterr().out


def git(*arguments: str) -> subprocess.CompletedProcess[str]:
    who = ["-c", "user.name=Ann", "-c", "user.email=ann@example.com", "-c", "commit.gpgsign=false"]
    environment = {
        **os.environ,
        "PYTHONPATH": str(ROOT),
        "GIT_CONFIG_GLOBAL": os.devnull,
        "GIT_CONFIG_SYSTEM": os.devnull,
    }
    return subprocess.run(["git", *who, *arguments], capture_output=True, text=True, check=False, env=environment)


def commit(path: Path, curve_set: CurveSet, branch: str) -> None:
    git("checkout", "-q", "-B", branch, "main")
    curve_set_json.save(curve_set, path)
    git("commit", "-qam", branch)


def test_git_merges_sets_with_it(place: Path) -> None:
    """Bigrams that stand side by side in the file would clash for git alone."""
    git("init", "-q", "-b", "main")
    command = f'"{sys.executable}" -m app merge %O %A %B --path %P'
    git("config", "merge.lipstitch.driver", command)
    Path(".gitattributes").write_text("curves/*.json merge=lipstitch\n")
    path = place / "curves" / "hero.json"
    path.parent.mkdir()
    curve_set_json.save(CurveSet(name="Low", bigrams={AH_D: hill(0.2)}), path.with_name("low.json"))
    low = curve_set_json.load(path.with_name("low.json"))
    base = CurveSet(name="Hero", bigrams={F_AH: hill(0.1)}).on_base("low.json", low)
    curve_set_json.save(base, path)
    git("add", ".")
    assert git("commit", "-qm", "start").returncode == 0
    commit(path, base.with_bigram(F_AH, hill(0.5)), "ann")
    commit(path, base.with_bigram(("f", "aa"), hill(0.6)), "bob")
    commit(path, replace(base.with_bigram(F_AH, hill(0.9)), name="Zed"), "zed")
    git("checkout", "-q", "ann")
    assert git("merge", "-q", "bob", "-m", "both").returncode == 0
    both = curve_set_json.load(path)
    assert set(both.own) == {F_AH, ("f", "aa")}
    assert both.base == "low.json"
    clash = git("merge", "zed")
    assert clash.returncode == 1
    assert "CONFLICT" in clash.stdout
    marked = curve_set_json.load(path)
    assert marked.name == "Zed"
    assert open_conflicts(marked) == ["f-ah open"]

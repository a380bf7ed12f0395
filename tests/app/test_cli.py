"""The command line: what it writes, what it says, and one sentence with exit code 2 for everything it cannot do."""

import csv
import json
import os
import subprocess
import sys
import wave
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app import cli, resources
from core_pipeline import pipeline, weights
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json, schedule_json
from core_pipeline.poses import FACEFX
from core_pipeline.schedule import Schedule
from core_pipeline.settings import PRESETS, SPLINES

ROOT = Path(cli.__file__).parents[1]
SCHEDULE = Schedule(["sil", "f", "ae", "t", "sil"], [0.0, 0.1, 0.2, 0.32, 0.4, 0.5])
QT_MODULES = ("PySide6", "shiboken6", "pyqtgraph", "qtawesome")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder to work in, with nothing but a schedule."""
    monkeypatch.chdir(tmp_path)
    schedule_json.save(SCHEDULE, "times.json")


def english() -> CurveSet:
    return curve_set_json.load(resources.english_curves())


def lipstitch(*arguments: str, **options: Any) -> subprocess.CompletedProcess[str]:
    """The program in a process of its own, as a user starts it."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "app", *arguments]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False, **options)


def baked(*options: str) -> dict[str, Any]:
    assert cli.main(["bake", "--schedule", "times.json", "--out", "w.json", *options]) == 0
    return json.loads(Path("w.json").read_text("utf-8"))


# ── what it writes ───────────────────────────────────────────────────────────────────────────────


def test_a_sentence_becomes_weights_stages_schedule_and_sound() -> None:
    done = lipstitch(
        "bake", "Fat cats often find fish", "--out", "w.json", "--stages", "s.json", "--schedule-out", "t.json",
        "--sound", "s.wav",
    )  # fmt: skip
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    schedule = schedule_json.load("t.json", english())
    assert [p for p in schedule.phones if p != "sil"][:3] == ["f", "ae", "t"]
    top = json.loads(Path("w.json").read_text("utf-8"))
    assert (top["schema"], top["fps"], top["poses"]) == ("lipstitch.Weights.1", 60, list(FACEFX))
    assert len(top["frames"]) == pytest.approx(60 * schedule.duration + 1, abs=1)
    stages = json.loads(Path("s.json").read_text("utf-8"))
    assert stages["schema"] == "lipstitch.Stages.1"
    assert max(stages["magenta"]["FV"]["v"]) > 0.5
    with wave.open("s.wav") as sound:
        assert sound.getnframes() / sound.getframerate() == pytest.approx(schedule.duration, abs=0.5)


@pytest.mark.parametrize("spline", SPLINES)
@pytest.mark.parametrize("preset", list(PRESETS))
def test_weights_are_those_of_the_pipeline(preset: str, spline: str) -> None:
    top = baked("--preset", preset, "--spline", spline, "--fps", "30")
    settings = PRESETS[preset].with_spline(spline)
    expected = weights.bake(pipeline.run(SCHEDULE, english(), settings).magenta, spline, 30)
    np.testing.assert_allclose(top["frames"], expected.frames, atol=6e-6)
    assert (top["fps"], top["start"]) == (30, 0.0)


def test_the_settings_of_the_curve_set_count_when_none_are_named() -> None:
    settings = PRESETS["smartbody"].with_spline("linear")
    curve_set_json.save(english().with_settings(settings), "mine.json")
    expected = weights.bake(pipeline.run(SCHEDULE, english(), settings).magenta, "linear", 60)
    np.testing.assert_allclose(baked("--curves", "mine.json")["frames"], expected.frames, atol=6e-6)


def test_csv_holds_the_same_as_json() -> None:
    top = baked("--fps", "25")
    assert cli.main(["bake", "--schedule", "times.json", "--out", "w.csv", "--fps", "25"]) == 0
    rows = list(csv.reader(Path("w.csv").read_text("utf-8").splitlines()))
    assert rows[0] == ["time", *FACEFX]
    np.testing.assert_allclose(np.array(rows[1:], float)[:, 1:], top["frames"])
    np.testing.assert_allclose(np.array(rows[1:], float)[:, 0], np.arange(len(rows) - 1) / 25)


def test_no_snap_samples_plainly() -> None:
    snapped, plain = np.array(baked("--fps", "24")["frames"]), np.array(baked("--fps", "24", "--no-snap")["frames"])
    expected = weights.bake(pipeline.run(SCHEDULE, english()).magenta, "pchip", 24, snap=False)
    np.testing.assert_allclose(plain, expected.frames, atol=6e-6)
    assert (snapped >= plain - 1e-5).all()
    assert (snapped > plain + 1e-3).any()


def test_another_curve_set_is_used_and_its_gaps_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    hill = Bigram({"open": Curve.of([(0, 0), (0.5, 0.8), (1, 0)])})
    curve_set_json.save(CurveSet(bigrams={("f", "ah"): hill}), "mine.json")
    frames = np.array(baked("--curves", "mine.json", "--spline", "linear", "--preset", "paper")["frames"])
    assert frames[:, 0].max() == pytest.approx(0.8)
    assert not frames[:, 1:].any()
    assert capsys.readouterr().err == "lipstitch: the curve set lacks 1 bigrams of this text: ah-d×1\n"


@pytest.mark.parametrize(
    ("phones", "times", "frames"),
    [([], [0.0], 1), ([], [], 1), (["f"], [1.0, 1.1], 7), (["sil", "sil"], [0, 1, 2], 121)],
)
def test_schedules_too_short_for_a_bigram_are_silent_not_wrong(
    phones: list[str], times: list[float], frames: int
) -> None:
    Path("times.json").write_text(json.dumps({"schema": schedule_json.SCHEMA, "phones": phones, "times": times}))
    top = baked("--stages", "s.json")
    assert np.array(top["frames"]).shape == (frames, 9)
    assert not np.array(top["frames"]).any()
    assert top["start"] == (times or [0.0])[0]
    assert json.loads(Path("s.json").read_text("utf-8"))["red"] == []


def test_repairs_are_told_and_the_work_goes_on(capsys: pytest.CaptureFixture[str]) -> None:
    Path("mine.json").write_text(curve_set('{"f-ah": {"curves": {"open": [[0.9, 0], [0.5, 1], [0.1, 0]]}}}'))
    assert np.array(baked("--curves", "mine.json")["frames"]).any()
    told = capsys.readouterr().err.splitlines()
    assert told[0] == "lipstitch: mine.json, bigram f-ah, pose open: keys out of order were sorted."


# ── check ────────────────────────────────────────────────────────────────────────────────────────


def curve_set(bigrams: str, version: int = 1) -> str:
    return f'{{"schema": "lipstitch.CurveSet.{version}", "bigrams": {bigrams}}}'


def test_check_counts_a_good_set(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["check", str(resources.english_curves())]) == 0
    out = capsys.readouterr().out
    assert "English (en): 441 of 441 bigrams" in out
    assert "Missing: 0." in out


def test_check_names_missing_bigrams_but_they_are_no_fault(capsys: pytest.CaptureFixture[str]) -> None:
    curve_set_json.save(english().with_bigram(("f", "ah"), None).with_bigram(("ah", "d"), None), "mine.json")
    assert cli.main(["check", "mine.json"]) == 0
    assert "Missing: 2: ah-d f-ah." in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (curve_set('{"f-xx": {}, "f-ah": {"curves": {"Open": []}}}'), ["bigram f-xx", "the pose “Open”"]),
        (curve_set('{"f-ah": {"curves": {"open": [[0.5, 1], [0, 0]]}}}'), ["keys out of order were sorted"]),
        (curve_set("{}", version=2), ["written by a newer Lipstitch"]),
        (curve_set('{"f\\n\\u001b[2Jah": {}}'), [r"bigram f\n\x1b[2Jah"]),
        ("{", ["damaged at line 1, column 2"]),
    ],
)
def test_check_prints_a_line_per_problem(text: str, told: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    Path("bad.json").write_text(text, "utf-8")
    assert cli.main(["check", "bad.json"]) == 1
    out, err = capsys.readouterr()
    problems = [line for line in out.splitlines() if line.startswith("bad.json")]
    assert err == ""
    assert len(problems) == len(told)
    for line, part in zip(problems, told, strict=True):
        assert part in line


# ── what it cannot do ────────────────────────────────────────────────────────────────────────────

BAD_SCHEDULES = {
    "falling.json": ('["f", "ah"], "times": [0, 0.2, 0.1]', "phone 1 ('ah') starts at 0.2 s and ends at 0.1"),
    "nan.json": ('["f"], "times": [0, NaN]', "holds NaN"),
    "unknown.json": ('["f", "q7"], "times": [0, 1, 2]', "phone 1 is “q7”"),
    "few.json": ('["f", "ah"], "times": [0, 1]', "2 phones needs 3 times, this one has 2"),
    "long.json": ('["f", "ah"], "times": [0, 1, 900000]', "are more than 1,000,000 frames"),
}
BAD_CURVES = {
    "damaged.json": ('{"schema": "lipstitch.CurveSet.1", "na', "damaged at line 1"),
    "hostile.json": (curve_set('{"f-ah\\n": {}}'), r"bigram f-ah\n: not two phonemes"),
    "deep.json": ("[" * 100_000, "nested too deeply"),
    "newer.json": (curve_set('{"f-ah": [1, 2]}', version=9), "(written by a newer Lipstitch)"),
    "other.json": ("{}", "is not a curve set"),
}


@pytest.fixture
def bad_files() -> None:
    for name, (inner, _) in BAD_SCHEDULES.items():
        Path(name).write_text(f'{{"schema": "lipstitch.Schedule.1", "phones": {inner}}}')
    for name, (text, _) in BAD_CURVES.items():
        Path(name).write_text(text)
    Path("folder").mkdir()
    Path("file").write_text("")
    with Path("huge.json").open("wb") as file:
        file.truncate(70 * 2**20)


def contents() -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path().iterdir() if path.is_file() and path.name != "huge.json"}


TO = ["--out", "w.json"]
BAKE = ["bake", "--schedule", "times.json"]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["bake", "", *TO], "nothing to say"),
        (["bake", " \t\n", *TO], "nothing to say"),
        (["bake", "x" * 10_000, *TO], "10,000 characters, the longest that can be spoken is 5,000"),
        (["bake", "😀👍🏽", *TO], "nothing to say"),
        (["bake", "\x00\x07\x1b", *TO], "nothing to say"),
        (["bake", "?!… —", *TO], "type at least one word"),
        (["render", "", "--out", "frames"], "nothing to say"),
        (["screenshot", "hi", "--out", "w.jpg"], "name the picture .png"),
        (["bake", "hi", "--schedule", "times.json", *TO], "a sentence in quotes, --audio, --labels or --schedule"),
        (["bake", *TO], "a sentence in quotes, --audio, --labels or --schedule"),
        (BAKE, "Nothing to write: name a file with --out"),
        ([*BAKE, *TO, "--fps", "0"], "0 frames per second is not possible: choose 1 to 1000"),
        ([*BAKE, *TO, "--fps", "NaN"], "nan frames per second is not possible"),
        ([*BAKE, *TO, "--fps", "inf"], "inf frames per second"),
        ([*BAKE, *TO, "--fps", "fast"], "invalid float value: 'fast' (see lipstitch bake --help)"),
        (["render", "hi", "--out", "frames", "--fps", "1e9"], "1e+09 frames per second is not possible"),
        (["render", "hi", "--out", "frames", "--size", "1x1"], "'1x1' is not a size such as 1600x1000"),
        (["render", "hi"], "required: --out (see lipstitch render --help)"),
        ([*BAKE, *TO, "--spline", "bezier"], "invalid choice: 'bezier'"),
        ([*BAKE, *TO, "--curve\n"], "unrecognized arguments"),
        ([*BAKE, "--out", "w.txt"], "name the file .json or .csv"),
        ([*BAKE, "--out", "nowhere/w.json"], "Cannot write nowhere/w.json: there is no such file or folder"),
        ([*BAKE, "--out", "file/w.json"], "part of the path is a file"),
        ([*BAKE, "--stages", "folder"], "Cannot write folder: it is a folder"),
        ([*BAKE, "--sound", "s.wav"], "no sound to write to s.wav"),
        ([*BAKE, "--out", "times.json"], "times.json is named twice, and would be overwritten"),
        ([*BAKE, *TO, "--stages", "w.json"], "w.json is named twice"),
        (["bake", "--schedule", "missing.json", *TO], "Cannot read missing.json: there is no such file"),
        (["bake", "--schedule", "folder", *TO], "folder is a folder: choose the schedule file in it"),
        ([*BAKE, *TO, "--curves", "missing.json"], "Cannot read missing.json: there is no such file"),
        ([*BAKE, *TO, "--curves", "folder"], "folder is a folder: choose the curve set file in it"),
        ([*BAKE, *TO, "--curves", "huge.json"], "huge.json is larger than 16 MB"),
        ([*BAKE, *TO, "--curves", "times.json"], "times.json is not a curve set"),
        (["check", "missing.json"], "Cannot read missing.json: there is no such file"),
        (["check", "folder"], "folder is a folder"),
        (["check", "huge.json"], "larger than 16 MB"),
        (["check"], "required: FILE (see lipstitch check --help)"),
        *((["bake", "--schedule", name, *TO], told) for name, (_, told) in BAD_SCHEDULES.items()),
        *(([*BAKE, *TO, "--curves", name], told) for name, (_, told) in BAD_CURVES.items()),
    ],
    ids=lambda value: " ".join(value)[:50].encode("unicode_escape").decode() if isinstance(value, list) else "",
)
@pytest.mark.usefixtures("bad_files")
def test_bad_input_gets_one_sentence_and_exit_code_2(
    arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = contents()
    assert cli.main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert told in err
    assert err.startswith("lipstitch: ")
    assert err.count("\n") == 1
    assert err.strip().isprintable()
    assert contents() == before  # nothing half done


@pytest.mark.usefixtures("bad_files")
def test_a_real_process_ends_with_2_and_no_traceback() -> None:
    done = lipstitch(*BAKE, *TO, "--curves", "hostile.json")
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith(r"lipstitch: hostile.json, bigram f-ah\n: not two phonemes of this set")
    assert done.stderr.count("\n") == 1


def test_a_name_this_terminal_cannot_show_is_no_reason_to_fail() -> None:
    curve_set_json.save(CurveSet(name="普通话"), "mine.json")
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "ascii"}
    command = [sys.executable, "-m", "app", "check", "mine.json"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert r"\u666e\u901a\u8bdd (en): 0 of 441 bigrams" in done.stdout


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a disk that is always full")
def test_output_that_cannot_be_written_ends_without_a_traceback() -> None:
    check = [sys.executable, "-m", "app", "check", str(resources.english_curves())]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(check, env=environment, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert "the disk is full" in done.stderr
    reading, writing = os.pipe()
    os.close(reading)  # as `| head` does when it has seen enough
    done = subprocess.run(check, env=environment, stdout=writing, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, "")


# ── what it loads ────────────────────────────────────────────────────────────────────────────────


def test_the_command_line_works_without_qt() -> None:
    code = f"""
import sys
class NoQt:
    def find_spec(self, name, path=None, target=None):
        assert name.partition(".")[0] not in {QT_MODULES!r}, name
sys.meta_path.insert(0, NoQt())
from app.cli import main
assert main(["bake", "Hi.", "--out", "w.json"]) == 0
assert main(["check", {str(resources.english_curves())!r}]) == 0
assert main(["render", "Hi.", "--out", "frames", "--size", "64x64", "--fps", "2"]) == 0
assert not [name for name in sys.modules if name.partition(".")[0] in {QT_MODULES!r}]
"""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_another_program_of_the_same_names_is_refused() -> None:
    Path("widgets").mkdir()
    Path("widgets/__init__.py").write_text("")
    path = os.pathsep.join([".", str(ROOT)])
    done = subprocess.run(
        [sys.executable, "-P", "-c", "import sys; from app.cli import main; sys.exit(main(['check', 'x']))"],
        env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "widgets comes from" in done.stderr


# ── help and the display ─────────────────────────────────────────────────────────────────────────


@pytest.mark.parametrize("command", [[], *([name] for name in cli.COMMANDS)], ids=lambda c: c[0] if c else "lipstitch")
def test_help_says_what_a_command_is_for(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        cli.main([*command, "--help"])
    assert ended.value.code == 0
    out = capsys.readouterr().out
    assert out.startswith(f"usage: lipstitch {' '.join(command)}".rstrip())
    assert "Example: lipstitch" in out
    assert "SUPPRESS" not in out
    assert max(map(len, out.splitlines())) <= 100


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems always have a display")
def test_a_display_must_be_there_and_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    assert not cli.has_display()
    monkeypatch.setenv("DISPLAY", ":98765")  # a server that has gone
    assert not cli.has_display()
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    assert cli.has_display()

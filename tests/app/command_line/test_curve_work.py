"""check --corpus, suggest, stats: what they print and write, and one sentence for what they cannot do."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app import cli, resources
from app.priors import prior_for
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.files import curve_set_json, frequencies_json, script_text
from core_pipeline.phonemes import COMMON, TABLE_1
from core_pipeline.speech.speaker import speak
from core_pipeline.statistics import TABLE_2, Frequencies

SCRIPT = "Fat cats often find fish.\n# a remark\nThe cat is fat. Bob\nputs a map down!\n"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder with a script."""
    monkeypatch.chdir(tmp_path)
    Path("script.txt").write_text(SCRIPT, "utf-8")


def english() -> CurveSet:
    return curve_set_json.load(resources.english_curves())


def said(arguments: list[str], capsys: pytest.CaptureFixture[str], code: int = 0) -> str:
    assert cli.main(arguments) == code
    return capsys.readouterr().out


def record(arguments: list[str], capsys: pytest.CaptureFixture[str], code: int = 0) -> dict[str, Any]:
    return json.loads(said([*arguments, "--json"], capsys, code))


# ── check ────────────────────────────────────────────────────────────────────────────────────────


def test_check_says_what_a_script_needs_and_lacks_worst_first(capsys: pytest.CaptureFixture[str]) -> None:
    gaps = english().with_bigram(("f", "ah"), None).with_bigram(("ah", "d"), Bigram()).with_bigram(("oy", "oy"), None)
    curve_set_json.save(gaps, "mine.json")
    lines = said(["check", "mine.json", "--corpus", "script.txt"], capsys, 1).splitlines()
    at = lines.index(next(line for line in lines if line.startswith("Weak, worst first")))
    assert [line.split()[:3] for line in lines[at + 1 : at + 3]] == [
        ["ah-d", "5×", "empty:"],
        ["f-ah", "3×", "missing"],
    ]
    assert lines[-1] == "2 bigrams that this corpus needs 8 times are missing or empty."
    assert not any("oy-oy" in line for line in lines[at:])


def test_check_as_json_names_kind_sentence_and_time(capsys: pytest.CaptureFixture[str]) -> None:
    curve_set_json.save(english().with_bigram(("f", "ah"), None), "mine.json")
    told = record(["check", "mine.json", "--corpus", "script.txt"], capsys, 1)
    assert (told["sentences"], told["errors"], told["problems"]) == (3, 1, [])
    worst = told["weak"][0]
    assert (worst["pair"], worst["uses"], worst["findings"][0]["kind"]) == ("f-ah", 3, "missing")
    assert worst["findings"][0]["sentence"] == "Fat cats often find fish."
    assert 0 < worst["findings"][0]["time"] < 1
    full = record(["check", str(resources.english_curves()), "--corpus", "script.txt"], capsys)
    assert full["errors"] == 0


def test_check_without_a_script_ranks_by_our_frequencies(capsys: pytest.CaptureFixture[str]) -> None:
    bad = english().with_bigram(("ah", "d"), Bigram()).with_bigram(("oy", "oy"), Bigram())
    curve_set_json.save(bad, "mine.json")
    weak = record(["check", "mine.json"], capsys)["weak"]
    pairs = [w["pair"] for w in weak]
    assert pairs[0] == "ah-d"
    assert "oy-oy" in pairs
    assert "Weak" not in said(["check", "mine.json", "--most", "0"], capsys)


# ── suggest ──────────────────────────────────────────────────────────────────────────────────────


def test_suggest_fills_what_is_empty_and_leaves_the_rest_byte_for_byte(capsys: pytest.CaptureFixture[str]) -> None:
    gaps = [pair for i, pair in enumerate(english().bigrams) if i % 3 == 0 and "sil" not in pair]
    part = replace(english(), bigrams={p: b for p, b in english().bigrams.items() if p not in set(gaps)})
    curve_set_json.save(part, "part.json")
    out = said(["suggest", "part.json", "--out", "full.json"], capsys)
    full = curve_set_json.load("full.json")
    assert f"{len(gaps)} suggestions, learned from {len(part.bigrams)} drawn bigrams." in out
    assert full.missing() == []
    assert {full.status_of(pair) for pair in gaps} == {"suggestion"}
    assert "in its row" in full.bigrams[gaps[0]].source
    curve_set_json.save(replace(full, bigrams={p: full.bigrams[p] for p in part.bigrams}), "same.json")
    assert Path("same.json").read_bytes() == Path("part.json").read_bytes()


def test_suggest_begins_with_phone_parts_where_nothing_is_drawn(capsys: pytest.CaptureFixture[str]) -> None:
    curve_set_json.save(CurveSet(), "empty.json")
    assert "441 suggestions, learned from 0 drawn bigrams and phone parts." in said(
        ["suggest", "empty.json", "--out", "full.json"], capsys
    )
    strange = CurveSet(phonemes=("x", "y"), poses=("left", "right"))
    curve_set_json.save(strange, "strange.json")
    assert cli.main(["suggest", "strange.json", "--out", "strange.json"]) == 0
    assert "4 bigrams stay empty" in capsys.readouterr().err


def test_a_prior_has_the_poses_of_the_set() -> None:
    crab = curve_set_json.load(resources.english_curves().with_name("crab.json"))
    for curve_set, name in ((CurveSet(), "English"), (crab, "Crab")):
        prior = prior_for(curve_set)
        assert prior is not None
        assert prior.name == name
    assert prior_for(CurveSet(poses=("open", "left", "right"))) is None


# ── stats ────────────────────────────────────────────────────────────────────────────────────────


def test_stats_sets_the_text_beside_the_papers_table(capsys: pytest.CaptureFixture[str]) -> None:
    out = said(["stats", "script.txt", "--curves", str(resources.english_curves())], capsys)
    assert "in 3 sentences" in out
    assert "ah-d        4.62 %" in out
    assert "283 cover 99.1 %; never said: 104." in out
    assert "English: 441 of 441 bigrams drawn, 100.0 % of this text" in out
    told = record(["stats", "script.txt"], capsys)
    schedules = [
        speak(text).schedule for text in ("Fat cats often find fish.", "The cat is fat.", "Bob puts a map down!")
    ]
    counted = Frequencies.of(schedules, COMMON, TABLE_1)
    assert {p["pair"]: p["count"] for p in told["pairs"]} == {f"{a}-{b}": n for (a, b), n in counted.counts.items()}
    assert told["cumulative"][-1] == 1
    assert len(told["table2"]) == 21


def test_our_table_comes_from_our_corpus_and_resembles_the_papers() -> None:
    """At least 200 utterances, spoken anew here; 12 of the 21 most frequent pairs are in the paper's table 2."""
    folder = resources.corpus()
    table = frequencies_json.load(folder / "frequencies.json")
    sentences = script_text.load(folder / "utterances.txt")
    spoken = Frequencies.of((speak(text).schedule for text in sentences), COMMON, TABLE_1)
    assert dict(spoken.counts) == dict(table.counts)
    assert table.utterances == len(sentences) >= 200
    assert table.shared_with_paper() >= 12
    assert set(table.top(5)) <= set(TABLE_2)


# ── what they cannot do ──────────────────────────────────────────────────────────────────────────


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["stats", "missing.txt"], "Cannot read missing.txt: there is no such file"),
        (["stats", "blob"], "blob is not text in UTF-8"),
        (["stats", "zeros"], "zeros is not a text"),
        (["stats", "silent.txt"], "silent.txt has no word in it"),
        (["stats", "script.txt", "--voice", "klingon"], "klingon"),
        (["stats", "script.txt", "--curves", "script.txt"], "script.txt is damaged at line 1"),
        (["check", "good.json", "--corpus", "missing.txt"], "Cannot read missing.txt"),
        (["check", "good.json", "--most", "-1"], "--most -1 is not possible"),
        (["suggest", "good.json"], "required: --out"),
        (["suggest", "script.txt", "--out", "full.json"], "script.txt is damaged"),
        (["suggest", "newer.json", "--out", "full.json"], "written by a newer Lipstitch"),
        (["suggest", "good.json", "--out", "nowhere/full.json"], "Cannot write nowhere/full.json"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_bad_input_gets_one_sentence(arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("blob").write_bytes(bytes(range(256)))
    Path("zeros").write_bytes(bytes(100))
    Path("silent.txt").write_text("# only a remark\n...\n\n—\n", "utf-8")
    Path("good.json").write_text('{"schema": "lipstitch.CurveSet.1", "bigrams": {}}', "utf-8")
    Path("newer.json").write_text('{"schema": "lipstitch.CurveSet.7", "bigrams": {}}', "utf-8")
    assert cli.main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert told in err
    assert err.count("\n") == 1
    assert not Path("full.json").exists()

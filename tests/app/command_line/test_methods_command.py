"""`lipstitch fit`, `bake --method` and `study`, as typed."""

import json
from pathlib import Path

import numpy as np
import pytest

from app.cli import main
from core_pipeline.files import curve_set_json, model_npz, schedule_json, study_json, weights_files, weights_read
from core_pipeline.study import RIGHT
from tests.helpers.corpora import baked


@pytest.fixture
def corpus(tmp_path) -> Path:
    folder = tmp_path / "takes"
    folder.mkdir()
    for i, clip in enumerate(baked()[:6]):
        weights_files.save(clip.weights, folder / f"{i}.csv")
        schedule_json.save(clip.schedule, folder / f"{i}.schedule.json")
    return folder


@pytest.mark.parametrize("method", ["dam", "cohen-massaro", "animpho", "visemes"])
def test_a_model_is_learned_and_baked_with(method, corpus, tmp_path, capsys):
    model, out = tmp_path / "m.npz", tmp_path / "w.json"
    assert main(["fit", method, str(corpus), "--out", str(model), "--hold-out", "3"]) == 0
    told = capsys.readouterr().out
    assert "from 4 clips" in told
    assert "on 2 kept aside" in told
    assert "Never heard:" in told
    about = model_npz.read(model).about
    assert about["clips"] == 4
    assert about["error"] < about["held_out_error"] < 0.25
    schedule = str(corpus / "2.schedule.json")
    assert main(["bake", "--schedule", schedule, "--method", str(model), "--out", str(out)]) == 0
    weights = weights_read.load(out)
    assert np.sqrt(np.mean((weights.frames - baked()[2].weights.frames) ** 2)) < 0.25


def test_bigrams_are_learned_into_a_set(corpus, tmp_path, capsys):
    out = tmp_path / "learned.json"
    assert main(["fit", "bigrams", str(corpus), "--out", str(out)]) == 0
    learned = curve_set_json.load(out)
    assert {b.source for b in learned.bigrams.values()} == {"learned"}
    assert learned.provenance.startswith("Learned from 6 clips")
    told = capsys.readouterr().out
    assert "of 441 bigrams were heard" in told
    assert "Largest residuals" in told
    saved = json.loads(out.read_text("utf-8"))["bigrams"]
    assert all(bigram["learned"]["occurrences"] > 0 for bigram in saved.values())


def test_a_text_is_spoken_and_baked_for_a_corpus(tmp_path, capsys):
    (tmp_path / "script.txt").write_text("Fat cats often find fish.\nMy mother makes marmalade.\n", "utf-8")
    assert main(["fit", "visemes", str(tmp_path / "script.txt"), "--out", str(tmp_path / "v.npz")]) == 0
    assert "from 2 clips" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["fit", "dam", "{}", "--out", "m.json"], "should end in .npz"),
        (["fit", "bigrams", "{}", "--out", "m.npz"], "should end in .json"),
        (["fit", "dam", "{}", "--out", "m.npz", "--hold-out", "1"], "would keep every clip"),
        (["fit", "dam", "{}/nowhere", "--out", "m.npz"], "is not a folder"),
        (["fit", "oracle", "{}", "--out", "m.npz"], "invalid choice"),
        (["bake", "Hello", "--method", "{}/0.csv", "--out", "w.json"], "no model of ours"),
        (["study", "results", "{}"], "study.json"),
        (["study"], "STEP"),
    ],
)
def test_what_cannot_be_done_is_said(arguments, sentence, corpus, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main([argument.format(corpus) for argument in arguments]) == 2
    told = capsys.readouterr().err
    assert sentence in told
    assert told.count("\n") == 1
    assert not (tmp_path / "m.npz").exists()


def test_ctrl_c_leaves_nothing_half_written(corpus, tmp_path, monkeypatch):
    """The old model stays as it was, and no other file appears."""
    model = tmp_path / "m.npz"
    model.write_bytes(b"the old one")

    def interrupted(self, done, what=""):
        if done > 30:
            raise KeyboardInterrupt

    monkeypatch.setattr("app.command_line.progress.Progress.step", interrupted)
    assert main(["fit", "dam", str(corpus), "--out", str(model)]) == 130
    assert model.read_bytes() == b"the old one"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["m.npz", "takes"]


def test_a_study_from_its_making_to_its_results(corpus, tmp_path, monkeypatch, capsys):
    """Two pairs drawn, judged on two days, and counted."""
    script, folder = tmp_path / "script.txt", tmp_path / "study"
    script.write_text("Hi.\nBye.\n", "utf-8")
    for method in ("visemes", "animpho"):
        assert main(["fit", method, str(corpus), "--out", str(tmp_path / f"{method}.npz")]) == 0
    make = ["study", "make", str(script), "--first", str(tmp_path / "visemes.npz"), "--second"]
    make += [str(tmp_path / "animpho.npz"), "--out", str(folder), "--size", "64", "--fps", "5"]
    assert main(make) == 0
    clips = sorted(path.name for path in folder.glob("*.mp4"))
    assert clips == ["001-left.mp4", "001-right.mp4", "002-left.mp4", "002-right.mp4"]
    drawn = (folder / "001-left.mp4").stat().st_mtime_ns
    (folder / "002-right.mp4").unlink()
    assert main(make) == 0  # goes on where it stopped
    assert (folder / "002-right.mp4").exists()
    assert (folder / "001-left.mp4").stat().st_mtime_ns == drawn
    said = iter(["right", "5"])

    def answer(*_):
        try:
            return next(said)
        except StopIteration:
            raise EOFError from None

    monkeypatch.setattr("builtins.input", answer)
    assert main(["study", "answer", str(folder)]) == 0
    saved = study_json.load(folder).answers
    assert [(a.trial, a.side, a.strength) for a in saved] == [(0, RIGHT, 5)]
    said = iter(["up", "l", "9", "2"])
    assert main(["study", "answer", str(folder)]) == 0
    assert main(["study", "answer", str(folder)]) == 0
    capsys.readouterr()
    assert main(["study", "results", str(folder), "--csv", str(tmp_path / "answers.csv")]) == 0
    assert "all: visemes.npz" in capsys.readouterr().out
    assert len((tmp_path / "answers.csv").read_text("utf-8").splitlines()) == 3
    script.write_text("Another.\n", "utf-8")
    assert main(make) == 2
    assert "holds another study" in capsys.readouterr().err

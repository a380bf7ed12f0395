"""`bake` with recordings, label files, voices and phoneme maps: everything on files, without a display."""

import json

import pytest
from praatio import textgrid as praat

from app.cli import main
from core_pipeline.speech.speaker import speak
from core_pipeline.speech.wav import write_wav


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    at = tmp_path_factory.mktemp("speech")
    write_wav(at / "a.wav", speak("Fat cats often find fish.").audio)
    return at


def bake(*arguments):
    return main(["bake", *map(str, arguments)])


def test_a_recording_with_its_words(folder, tmp_path):
    out, schedule, labels = tmp_path / "w.json", tmp_path / "s.json", tmp_path / "a.TextGrid"
    words = "Fat cats often find fish."
    asked = ["--audio", folder / "a.wav", "--transcript", words, "--out", out, "--schedule-out", schedule]
    assert bake(*asked, "--labels-out", labels) == 0
    assert len(json.loads(out.read_text())["frames"]) > 100
    phones = json.loads(schedule.read_text())["phones"]
    assert phones[1:4] == ["f", "ae", "t"]
    grid = praat.openTextgrid(str(labels), includeEmptyIntervals=False)
    assert [e.label for e in grid.getTier("words").entries] == ["Fat", "cats", "often", "find", "fish"]
    assert [e.label for e in grid.getTier("phones").entries] == [p for p in phones if p != "sil"]

    again = tmp_path / "again.json"  # and back from the labels
    assert bake("--labels", labels, "--schedule-out", again) == 0
    assert json.loads(again.read_text())["phones"] == phones


def test_a_recording_alone_tells_what_was_heard(folder, tmp_path, capsys):
    assert bake("--audio", folder / "a.wav", "--out", tmp_path / "w.json") == 0
    said = capsys.readouterr().err
    assert "Recognised:" in said
    assert "% sure" in said


def test_a_sentence_to_labels_and_an_utterance(tmp_path):
    labels, utterance = tmp_path / "a.TextGrid", tmp_path / "u.json"
    assert bake("Hello there.", "--labels-out", labels) == 0
    assert bake("Hello there.", "--labels-out", utterance, "--rate", 120, "--pitch", 70) == 0
    assert "IntervalTier" in labels.read_text()
    assert json.loads(utterance.read_text())["schema"] == "lipstitch.Utterance.1"


def test_unknown_phone_names_are_told_and_assigned(tmp_path, capsys):
    lab = tmp_path / "a.lab"
    lab.write_text("0 1000000 QX\n1000000 2000000 aa\n")
    out = tmp_path / "s.json"
    assert bake("--labels", lab, "--schedule-out", out) == 0
    assert "Unknown phone names became silence: QX" in capsys.readouterr().err
    assert bake("--labels", lab, "--schedule-out", out, "--assign", "QX=b") == 0
    assert json.loads(out.read_text())["phones"] == ["b", "aa"]


def test_mandarin_falls_back_on_the_english_set_and_lists_what_is_missing(tmp_path, capsys):
    assert bake("女人好", "--voice", "mandarin", "--out", tmp_path / "w.json") == 0
    assert "ü" in capsys.readouterr().err


def test_a_phoneme_map_changes_the_curves(tmp_path):
    plain, mapped = tmp_path / "a.json", tmp_path / "b.json"
    assert bake("A young king sang.", "--out", plain) == 0
    assert bake("A young king sang.", "--out", mapped, "--phoneme-map", "sapi") == 0
    assert plain.read_text() != mapped.read_text()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["hi", "--audio", "a.wav"], "spoken by the voice"),
        (["--audio", "none.wav"], "Cannot read"),
        (["--transcript", "hi"], "Say what to bake"),
        (["hi", "--transcript", "hi"], "needs its recording"),
        (["--labels", "none.TextGrid"], "Cannot read"),
        (["--labels", "x.lab", "--schedule", "s.json"], "Say what to bake"),
        (["hi", "--assign", "x"], "NAME=PHONE"),
        (["hi", "--assign", "x=qq"], "no phone"),
        (["hi", "--voice", "klingon"], "no voice"),
        (["--labels", "x.lab", "--label-rate", "0"], "--label-rate 0"),
        (["hi", "--rate", "9"], "words per minute"),
        (["hi", "--pitch", "200"], "pitch"),
        (["hi", "--phoneme-map", "none"], "no phoneme map"),
        (["hi", "--phoneme-map", "mandarin"], "does not have"),
    ],
)
def test_what_cannot_be_baked_is_one_sentence(tmp_path, capsys, arguments, says):
    assert bake(*arguments, "--out", tmp_path / "w.json") == 2
    said = capsys.readouterr().err
    assert says in said
    assert said.count("\n") == 1
    assert not (tmp_path / "w.json").exists()

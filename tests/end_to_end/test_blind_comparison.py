"""Two days of a study: judged, closed, gone on with, counted. Clips are real files with sound."""

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt

from app.command_line.mp4 import Mp4
from core_pipeline.files import study_json
from core_pipeline.speech.utterance import Audio
from core_pipeline.study import LEFT, RIGHT, Study

PATIENCE = 60_000


@pytest.fixture
def folder(tmp_path) -> Path:
    """Two pairs; the left clip is red, the right one blue, half a second each."""
    study = Study.of(("ours", "theirs"), ["One.", "Two."], ["toon"], 5)
    study_json.save(study, tmp_path)
    sound = Audio(np.sin(np.arange(8000) / 20).astype(np.float32), 16000)
    for trial in range(2):
        for side, channel in ((LEFT, 2), (RIGHT, 0)):  # BGRA
            frame = np.zeros((64, 64, 4), np.uint8)
            frame[..., channel] = 200
            with Mp4(study_json.clip_path(tmp_path, trial, side), (64, 64), 10.0, sound) as clip:
                for _ in range(5):
                    clip.add(frame)
    return tmp_path


def test_a_study_goes_on_where_it_stopped(editor, qtbot, folder):
    studying = editor.wiring.studying
    studying.open()
    studying.open_study(folder)
    view = studying.view
    qtbot.waitUntil(lambda: studying.pair is not None, timeout=PATIENCE)
    film = studying.pair.films[LEFT]
    assert (len(film.frames), film.fps) == (5, 10.0)
    assert film.audio is not None
    assert film.audio.duration == pytest.approx(0.5, abs=0.1)
    assert film.frames[2, 32, 32].argmax() == 0
    assert studying.pair.films[RIGHT].frames[2, 32, 32].argmax() == 2
    seen = []
    studying._player.ended.connect(lambda: seen.append("left"))
    qtbot.mouseClick(view.plays[LEFT], Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: bool(seen), timeout=PATIENCE)
    for button in (view.side_buttons[LEFT], view.strength_buttons[4], view.next):
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    saved = study_json.load(folder)
    assert [(a.trial, a.side, a.strength) for a in saved.answers] == [(0, LEFT, 4)]
    assert not view.results.isVisible()

    studying.open_study(folder)  # another day
    qtbot.waitUntil(lambda: studying.pair is not None, timeout=PATIENCE)
    assert view.place.text() == f"Pair 2 of 2: “{saved.trials[1].text}”"
    for button in (view.side_buttons[RIGHT], view.strength_buttons[1], view.next):
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    assert "χ²" in view.results.text()
    assert "of 2 answers" in view.results.text()
    assert len(study_json.load(folder).answers) == 2


def test_a_missing_clip_and_no_study_are_said(editor, qtbot, folder, tmp_path):
    studying = editor.wiring.studying
    studying.open()
    studying.open_study(tmp_path / "nowhere")
    assert "study.json" in studying.view.place.text()
    study_json.clip_path(folder, 0, RIGHT).write_bytes(b"no clip")
    studying.open_study(folder)
    qtbot.waitUntil(lambda: "no clip that can be shown" in studying.view.place.text(), timeout=PATIENCE)
    assert not studying.view.next.isEnabled()

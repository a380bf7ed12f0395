"""Files of what is said: where phones and words are kept, and what a dropped .json file is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from core_pipeline.errors import UserError
from core_pipeline.files import schedule_json, utterance_json
from core_pipeline.files.atomic import open_to_read
from core_pipeline.files.labels import textgrid
from core_pipeline.phonemes import SILENCE
from core_pipeline.schedule import Schedule
from core_pipeline.speech.utterance import Audio, Utterance
from core_pipeline.speech.wav import read_wav, write_wav


def save_spoken(path: Path, utterance: Utterance, recording: Path | None) -> None:
    """A TextGrid, an utterance or a schedule, by the name's ending; a sound without a file is written beside.

    recording  the file the sound is from, if any
    UserError when it cannot be written.
    """
    if path.suffix.lower() == ".textgrid":
        textgrid.save(path, utterance.schedule, utterance.words)
    elif path.name.lower().endswith(".utterance.json") or not path.suffix:
        utterance_json.save(path, utterance, _sound_beside(path, utterance, recording))
    else:
        schedule_json.save(utterance.schedule, path)


def _sound_beside(path: Path, utterance: Utterance, recording: Path | None) -> str:
    """The name of the sound's file; "" without sound."""
    if utterance.audio is None or recording is not None:
        return recording.name if recording is not None else ""
    stem = path.name.removesuffix(".utterance.json")
    for name in (f"{stem}.wav", *(f"{stem}-{i}.wav" for i in range(2, 100))):
        sound = path.with_name(name)
        if not sound.exists():
            write_wav(sound, utterance.audio)
            return name
        if _holds(sound, utterance.audio):
            return name
    raise UserError(f"There are a hundred sounds beside {path} already: save elsewhere.")


def _holds(sound: Path, audio: Audio) -> bool:
    """Whether a file has this very sound."""
    try:
        found = read_wav(sound)
    except UserError:
        return False
    same = found.rate == audio.rate and found.samples.size == audio.samples.size
    return same and bool(np.abs(found.samples - audio.samples).max(initial=0) < 1e-3)


def recording_of(path: Path) -> Path | None:
    """The recording beside an utterance's file; None when it names none or it is gone."""
    if path.suffix.lower() != ".json":
        return None
    try:
        name = utterance_json.load(path).recording
    except UserError:
        return None
    return path.with_name(name) if name and path.with_name(name).is_file() else None


def saved_beside(recording: Path) -> Path:
    """Where phones and words of a recording are kept: "a.wav" → "a.utterance.json"."""
    return recording.with_name(f"{recording.stem}.utterance.json")


def is_spoken(path: Path) -> bool:
    """Whether a .json file is an utterance, a schedule, or labels of MFA, by its first bytes."""
    try:
        with open_to_read(path) as file:
            head = file.read(4000)
    except OSError:
        return False
    return b"lipstitch.Utterance." in head or b"lipstitch.Schedule." in head or b'"tiers"' in head


def from_zero(utterance: Utterance) -> Utterance:
    """What begins later has silence before; what begins before 0 is moved there."""
    schedule = utterance.schedule
    if schedule.start > 0:
        phones, times = [SILENCE, *schedule.phones], np.concatenate([[0.0], schedule.times])
        return replace(utterance, schedule=Schedule(phones, times))
    shift = -schedule.start
    words = tuple(replace(w, start=w.start + shift, end=w.end + shift) for w in utterance.words)
    return replace(utterance, schedule=Schedule(schedule.phones, schedule.times + shift), words=words)

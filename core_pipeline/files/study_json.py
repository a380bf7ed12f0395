"""A study in its folder: study.json beside the clips; answers are saved one by one, so that it can go on any day."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import msgspec

from ..errors import UserError
from ..study import LEFT, RIGHT, STRENGTHS, Answer, Study, Trial
from .atomic import read_bytes, write_atomically
from .json_text import decode_json

SCHEMA = "lipstitch.Study.1"
NAME = "study.json"
MAX_BYTES = 16 * 2**20
MAX_TRIALS = 10_000


class TrialRecord(msgspec.Struct):
    """See `Trial`."""

    text: str
    face: str
    left: int


class AnswerRecord(msgspec.Struct):
    """See `Answer`."""

    trial: int
    observer: str
    side: str
    strength: int


class StudyRecord(msgspec.Struct):
    """See `Study`."""

    contenders: tuple[str, str]
    trials: list[TrialRecord]
    answers: list[AnswerRecord] = []


def clip_path(folder: Path, trial: int, side: str) -> Path:
    """Where a clip lies; its name tells nothing of what made it."""
    return folder / f"{trial + 1:03}-{side}.mp4"


def load(folder: Path) -> Study:
    """The study in a folder; UserError when there is none, or it is damaged."""
    place = folder / NAME
    return parse(read_bytes(place, MAX_BYTES, "study"), str(place))


def parse(data: bytes, place: str) -> Study:
    """As `load`, from bytes; `place` names the file in messages."""
    top = decode_json(data, place)
    if top.get("schema") != SCHEMA:
        raise UserError(f'{place} is not a study: it should say "schema": "{SCHEMA}". Choose another folder.')
    try:
        record = msgspec.convert(top, StudyRecord)
    except msgspec.ValidationError as error:
        raise UserError(f"{place}: {str(error)[:200].lower()}. Correct that value.") from error
    if not 1 <= len(record.trials) <= MAX_TRIALS or any(trial.left not in (0, 1) for trial in record.trials):
        raise UserError(f"{place}: its trials are not those of a study. Make the study again.")
    study = Study(record.contenders, tuple(Trial(t.text, t.face, t.left) for t in record.trials))
    for i, a in enumerate(record.answers):
        if not 0 <= a.trial < len(study.trials) or a.side not in (LEFT, RIGHT) or a.strength not in STRENGTHS:
            raise UserError(f"{place}: answer {i + 1} is none to a trial of this study. Remove it.")
    answers = {(a.trial, a.observer): Answer(a.trial, a.observer, a.side, a.strength) for a in record.answers}
    return Study(study.contenders, study.trials, tuple(answers.values()))


def dumps(study: Study) -> str:
    """The file's text, a line a trial and a line an answer."""

    def rows(values: list[dict[str, Any]]) -> str:
        return ",\n".join("    " + json.dumps(value, ensure_ascii=False) for value in values)

    trials = rows([{"text": t.text, "face": t.face, "left": t.left} for t in study.trials])
    answers = rows(
        [{"trial": a.trial, "observer": a.observer, "side": a.side, "strength": a.strength} for a in study.answers]
    )
    names = json.dumps(list(study.contenders), ensure_ascii=False)
    return (
        f'{{\n  "schema": "{SCHEMA}",\n  "contenders": {names},\n  "trials": [\n{trials}\n  ],\n'
        f'  "answers": [{chr(10) + answers + chr(10) + "  " if answers else ""}]\n}}\n'
    )


def save(study: Study, folder: Path) -> None:
    """Write the study atomically; UserError when that fails."""
    write_atomically(folder / NAME, dumps(study))

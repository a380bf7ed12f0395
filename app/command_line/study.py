"""`lipstitch study`: make a blind comparison, answer it, read the results."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json, study_json
from core_pipeline.files.atomic import write_atomically
from core_pipeline.study import LEFT, RIGHT, STRENGTHS, Answer, Study, to_csv, told

from ..rigs import face_path, open_rig
from .progress import Progress
from .steps import make_folder, say, tell

if TYPE_CHECKING:
    from core_pipeline.methods.method import Method


def study(options: argparse.Namespace) -> int:
    """The step that is asked for."""
    return {"make": _make, "answer": _answer, "results": _results}[options.step](options)


def load_method(path: Path) -> Method:
    """A curve set (.json) or a learned model (.npz) as a method; UserError when it is neither."""
    from core_pipeline.files import model_npz
    from core_pipeline.methods.bigram import BigramMethod

    if path.suffix.lower() == ".npz":
        return model_npz.load(path)
    return BigramMethod(curve_set_json.read(path).curve_set)


def _make(options: argparse.Namespace) -> int:
    from core_pipeline.files import script_text

    if not 1 <= options.fps <= 240 or not 64 <= options.size <= 2048:
        raise UserError("Choose 1 to 240 for --fps and 64 to 2048 for --size.")
    methods = load_method(options.first), load_method(options.second)
    names = _names(options.first, options.second)
    poses = [pose for pose in methods[0].poses if pose in methods[1].poses]
    if not poses:
        raise UserError(f"{options.first} and {options.second} have no pose in common: they cannot be compared.")
    for face in options.faces:  # one that cannot be read or played is refused before anything is drawn
        if not open_rig(face_path(face), poses).retarget.poses:
            raise UserError(f"{face} can make none of the poses {', '.join(poses)}: name another face.")
    fresh = Study.of(names, script_text.load(options.text), options.faces, options.seed)
    made = _begun(options.out, fresh)
    make_folder(options.out)
    study_json.save(made, options.out)
    with Progress(2 * len(made.trials), "clips") as progress:
        for i in range(len(made.trials)):
            for k, side in enumerate((LEFT, RIGHT)):
                _clip(made, i, side, methods, options)
                progress.step(2 * i + k + 1)
    print(f"{len(made.trials)} pairs in {options.out}: judge them in the editor, or with lipstitch study answer.")
    return 0


def _names(first: Path, second: Path) -> tuple[str, str]:
    same = first.name == second.name
    return (str(first), str(second)) if same else (first.name, second.name)


def _begun(folder: Path, fresh: Study) -> Study:
    """The study that is there already, when it is this one; UserError when it is another."""
    if not (folder / study_json.NAME).exists():
        return fresh
    old = study_json.load(folder)
    if (old.contenders, old.trials) != (fresh.contenders, fresh.trials):
        raise UserError(f"{folder} holds another study: name an empty folder, or delete it.")
    return old


def _clip(made: Study, number: int, side: str, methods: tuple[Method, Method], options: argparse.Namespace) -> None:
    """Draw one clip, unless it is there."""
    from .frames import FaceFrames
    from .mp4 import Mp4, even

    path = study_json.clip_path(options.out, number, side)
    if path.exists():
        return
    trial = made.trials[number]
    utterance = say(trial.text, options.voice)
    method = methods[trial.contender(side)]
    weights = method.synthesize(utterance.schedule, method.poses, options.fps)
    face = open_rig(face_path(trial.face), method.poses).face
    frames = FaceFrames(face, tuple(method.poses), even((options.size, options.size)))
    with Mp4(path, frames.size, weights.fps, utterance.audio) as clip:
        for i, row in enumerate(weights.frames):
            clip.add(frames.pixels(row, life=i / weights.fps))


def _answer(options: argparse.Namespace) -> int:
    made = study_json.load(options.folder)
    waiting = made.waiting(options.observer)
    if not waiting:
        print("Every pair has been judged.")
    for done, number in enumerate(waiting):
        left, right = (study_json.clip_path(options.folder, number, side) for side in (LEFT, RIGHT))
        print(f"Pair {done + 1} of {len(waiting)}: “{made.trials[number].text}”\n  left   {left}\n  right  {right}")
        side = _asked("Which lips move better, left or right?", {"left": LEFT, "l": LEFT, "right": RIGHT, "r": RIGHT})
        strength = _asked("How strongly, 1 (weak) to 5 (strong)?", {str(s): s for s in STRENGTHS})
        if side is None or strength is None:
            tell("no answer; the study goes on here next time.")
            return 0
        made = made.with_answer(Answer(number, options.observer, str(side), int(strength)))
        study_json.save(made, options.folder)
    return 0


def _asked(question: str, choices: Mapping[str, str | int]) -> str | int | None:
    """One of the choices; None when nobody answers any more."""
    while True:
        print(question, end=" ", flush=True)
        try:
            word = input().strip().lower()
        except EOFError:
            print()
            return None
        if word in choices:
            return choices[word]


def _results(options: argparse.Namespace) -> int:
    made = study_json.load(options.folder)
    for line in told(made):
        print(line)
    if options.csv:
        write_atomically(options.csv, to_csv(made))
        print(options.csv)
    return 0

"""The commands on other methods, their options: fit and study."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

#: Makes a command: name, purpose, example.
AddCommand = Callable[[str, str, str], argparse.ArgumentParser]

METHODS = ("bigrams", "dam", "cohen-massaro", "animpho", "visemes")


def add(command: AddCommand) -> None:
    """Tell the parser of these commands."""
    fit = command(
        "fit",
        "learn bigram curves or another paper's method from animation",
        "lipstitch fit dam takes/ --out dam.npz",
    )
    fit.add_argument("method", choices=METHODS, metavar="METHOD", help=", ".join(METHODS))
    fit.add_argument(
        "corpus",
        type=Path,
        metavar="CORPUS",
        help="a folder of clips (.csv, .json, .glb) with their labels (.TextGrid), or a text to be spoken and baked",
    )
    fit.add_argument("--out", type=Path, required=True, metavar="FILE", help="the model, .npz; of bigrams a set, .json")
    fit.add_argument("--curves", type=Path, metavar="FILE", help="a set with the poses and phonemes (default: English)")
    fit.add_argument("--hold-out", type=int, default=0, metavar="N", help="keep every Nth clip to measure the error on")
    fit.add_argument("--selection", choices=("naive", "priority", "viterbi"), default="priority", help="of AnimPhos")
    fit.add_argument("--clusters", choices=("kmeans", "affinity"), default="kmeans", help="of animemes")
    fit.add_argument("--voice", metavar="NAME", default="en-us", help="espeak-ng voice for a text (default en-us)")

    study = command(
        "study",
        "compare two sets or methods blindly, as the paper's section 4 does",
        "lipstitch study make script.txt --first mine.json --second dam.npz --faces toon ada --out study/",
    )
    steps = study.add_subparsers(title="steps", metavar="STEP", dest="step", required=True, parser_class=type(study))
    make = steps.add_parser("make", help="draw a pair of clips for every sentence and face; goes on where it stopped")
    make.add_argument("text", type=Path, metavar="TEXT", help="a text, one or more sentences a line")
    make.add_argument("--first", type=Path, required=True, metavar="FILE", help="a curve set .json, or a model .npz")
    make.add_argument("--second", type=Path, required=True, metavar="FILE", help="what it is compared with")
    make.add_argument("--faces", nargs="+", default=["toon"], metavar="FACE", help="who speaks (default toon)")
    make.add_argument("--out", type=Path, required=True, metavar="FOLDER", help="where study and clips go")
    make.add_argument("--size", type=int, default=400, metavar="N", help="pixels of a clip's side (default 400)")
    make.add_argument("--fps", type=float, default=30, metavar="N", help="frames per second (default 30)")
    make.add_argument("--seed", type=int, default=1, metavar="N", help="of order and sides (default 1)")
    make.add_argument("--voice", metavar="NAME", default="en-us", help="espeak-ng voice (default en-us)")
    answer = steps.add_parser("answer", help="judge the pairs that wait, on the terminal; Ctrl+C to go on another day")
    answer.add_argument("folder", type=Path, metavar="FOLDER")
    answer.add_argument("--observer", default="me", metavar="NAME", help="who judges (default me)")
    results = steps.add_parser("results", help="preference, χ² and mean strength")
    results.add_argument("folder", type=Path, metavar="FOLDER")
    results.add_argument("--csv", type=Path, metavar="FILE", help="every answer as a line, .csv")

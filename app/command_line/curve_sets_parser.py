"""The options of convert, diff and merge."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path


def add(command: Callable[[str, str, str], argparse.ArgumentParser]) -> None:
    """Their parsers; `command` makes one from name, purpose and example."""
    convert = command(
        "convert",
        "turn a SmartBody diphone script into a curve set, a curve set into a script, or layers into one small file",
        "lipstitch convert default.py my-curves.json",
    )
    convert.add_argument("source", type=Path, metavar="FROM", help="a diphone script (.py) or a curve set (.json)")
    convert.add_argument(
        "target", type=Path, metavar="TO", help=".json, .min.json (all layers, small) or .py (a script)"
    )
    convert.add_argument("--set", metavar="NAME", help="which set of the script (default: the largest)")
    convert.add_argument("--flat", action="store_true", help="write the base's bigrams into the .json too")

    diff = command(
        "diff",
        "list where two curve sets differ: exit code 0 when they say the same, 1 otherwise",
        "lipstitch diff mine.json theirs.json",
    )
    diff.add_argument("first", type=Path, metavar="A")
    diff.add_argument("second", type=Path, metavar="B")

    merge = command(
        "merge",
        "bring two people's changes together, per bigram and pose: exit code 1 when some clash",
        "lipstitch merge base.json ours.json theirs.json --out merged.json",
    )
    merge.add_argument("base", type=Path, metavar="BASE", help="what both started from")
    merge.add_argument("ours", type=Path, metavar="OURS", help="stays where both changed the same")
    merge.add_argument("theirs", type=Path, metavar="THEIRS", help="is kept beside it there, marked")
    merge.add_argument("--out", type=Path, metavar="FILE", help="where to (default: into OURS, as git expects)")
    merge.add_argument("--path", type=Path, metavar="FILE", help="the file's own place, to find its base beside it")

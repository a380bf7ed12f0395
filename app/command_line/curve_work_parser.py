"""The commands for work on curve sets, their options: check, suggest, stats, build-frequencies."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

#: Makes a command: name, purpose, example.
AddCommand = Callable[[str, str, str], argparse.ArgumentParser]


def add(command: AddCommand) -> None:
    """Tell the parser of these commands."""
    check = command(
        "check",
        "validate a curve set and tell its weak bigrams: exit code 0 when it is good, 1 when there are problems",
        "lipstitch check my-curves.json --corpus script.txt",
    )
    check.add_argument("file", type=Path, metavar="FILE", help="a curve set, .json")
    check.add_argument(
        "--corpus", type=Path, metavar="FILE", help="a text: what is weak where these sentences are said"
    )
    check.add_argument("--json", action="store_true", help="everything as JSON, for other programs")
    check.add_argument("--most", type=int, default=40, metavar="N", help="tell so many weak bigrams (default 40)")
    _voice(check)

    suggest = command(
        "suggest",
        "fill the empty bigrams of a curve set with suggestions learned from the others",
        "lipstitch suggest partial.json --out full.json",
    )
    suggest.add_argument("file", type=Path, metavar="FILE", help="a curve set, .json")
    suggest.add_argument("--out", type=Path, required=True, metavar="FILE", help="the filled set, .json")

    stats = command(
        "stats",
        "count how often each phone pair is said in a text, beside the paper's tables",
        "lipstitch stats script.txt --curves my-curves.json",
    )
    stats.add_argument("file", type=Path, metavar="TEXT", help="a text, one or more sentences a line")
    stats.add_argument("--curves", type=Path, metavar="FILE", help="say how much of the text this curve set covers")
    stats.add_argument("--json", action="store_true", help="everything as JSON, for other programs")
    _voice(stats)

    command(
        "build-frequencies",
        "count our own corpus anew, into assets/corpus/frequencies.json",
        "lipstitch build-frequencies",
    )


def _voice(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--voice", metavar="NAME", default="en-us", help="espeak-ng voice (default en-us)")

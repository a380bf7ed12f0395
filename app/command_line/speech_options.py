"""The options of everything spoken: recordings, transcripts, label files, voices, phoneme maps; and `batch`."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from core_pipeline.settings import PRESETS

Command = Callable[[str, str, str], argparse.ArgumentParser]


def add_to_bake(bake: argparse.ArgumentParser) -> None:
    """What `bake` takes beside a sentence, and the labels it writes."""
    bake.add_argument("--audio", type=Path, metavar="FILE", help="a recording: wav, flac, ogg, mp3 (mp4 with av)")
    bake.add_argument("--transcript", metavar="TEXT", help="what is said in it, or a .txt file; else it is recognised")
    bake.add_argument("--labels", type=Path, metavar="FILE", help="phones with times: TextGrid, HTK, ESPS, TIMIT, JSON")
    bake.add_argument("--label-rate", type=int, metavar="N", help="samples per second, for labels in samples")
    bake.add_argument(
        "--assign", action="append", default=[], metavar="NAME=PHONE", help="what a phone name of the label file means"
    )
    bake.add_argument("--labels-out", type=Path, metavar="FILE", help="phones and words, .TextGrid or .json")
    bake.add_argument("--rate", type=int, default=175, metavar="N", help="words per minute of the voice (default 175)")
    bake.add_argument("--pitch", type=int, default=50, metavar="N", help="pitch of the voice, 0 to 99 (default 50)")
    bake.add_argument("--phoneme-map", metavar="MAP", help="smartbody, sapi, cereproc, table-1, or a .json file")


def add(command: Command) -> None:
    """The command `batch`."""
    batch = command(
        "batch",
        "bake every line of a table, many at a time; an interrupted run goes on where it stopped",
        "lipstitch batch manifest.csv --out baked --workers 2",
    )
    batch.add_argument(
        "manifest", type=Path, metavar="FILE", help="CSV with the columns name, text, audio, transcript, labels, voice"
    )
    batch.add_argument("--out", type=Path, required=True, metavar="FOLDER", help="where weights and reports go")
    batch.add_argument("--workers", type=int, metavar="N", help="processes at a time (default: one per processor)")
    batch.add_argument("--dask", metavar="ADDRESS", help="a Dask scheduler, such as tcp://host:8786, in their place")
    batch.add_argument("--curves", type=Path, metavar="FILE", help="curve set (default: our English set)")
    batch.add_argument("--preset", metavar="NAME", choices=tuple(PRESETS), help="pipeline settings")
    batch.add_argument("--fps", type=float, default=60, metavar="N", help="frames per second, 1 to 1000 (default 60)")
    batch.add_argument("--format", choices=("json", "csv"), default="json", help="of the weights (default json)")
    batch.add_argument("--textgrids", action="store_true", help="write a TextGrid beside each file of weights")
    batch.add_argument("--again", action="store_true", help="bake everything anew, finished lines too")

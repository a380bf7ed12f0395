"""What may be said on the command line: the commands, their options, and a sentence for what does not fit."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import NoReturn

from core_pipeline.errors import UserError
from core_pipeline.settings import PRESETS, SPLINES

from . import curve_sets_parser, curve_work_parser, look_options, methods_parser, speech_options

_FACE = "toon, ada, man, woman, crab; or a .glb, .gltf or .vrm; or a folder of .obj poses"


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one sentence, without the whole usage."""

    def error(self, message: str) -> NoReturn:
        """UserError in place of argparse's own ending."""
        raise UserError(f"{message} (see {self.prog} --help)")


def make_parser() -> Parser:
    """All commands and their options; the one chosen is in `command`."""
    parser = Parser(
        prog="lipstitch",
        usage="lipstitch [FILE] [--sentence TEXT]\n       lipstitch COMMAND …     (lipstitch COMMAND --help says more)",
        description="An editor for phone-bigram lip sync. Without a command the editor opens.",
        epilog='Example: lipstitch bake "Fat cats often find fish" --out weights.json',
    )
    parser.add_argument("--version", action="version", version=f"lipstitch {_version()}")
    commands = parser.add_subparsers(
        title="commands", metavar="COMMAND", dest="command", required=True, prog="lipstitch"
    )

    def command(name: str, purpose: str, example: str) -> argparse.ArgumentParser:
        return commands.add_parser(
            name, help=purpose, description=f"{purpose[0].upper()}{purpose[1:]}.", epilog=f"Example: {example}"
        )

    edit = command("edit", "open the editor, as without a command", "lipstitch edit my-curves.json")
    edit.add_argument("file", nargs="?", type=Path, metavar="FILE", help="a curve set to open")
    edit.add_argument("--sentence", metavar="TEXT", help="what to type first")
    edit.add_argument("--face", metavar="FACE", help=_FACE)

    bake = command(
        "bake",
        "turn a sentence, a recording, a label file or a schedule into weights per frame",
        'lipstitch bake "Fat cats often find fish" --out weights.json',
    )
    _speech_options(bake, text_optional=True)
    bake.add_argument("--schedule", type=Path, metavar="FILE", help="phones and times as JSON, instead of a text")
    bake.add_argument("--out", type=Path, metavar="FILE", help="weights, .json or .csv")
    bake.add_argument("--stages", type=Path, metavar="FILE", help="all five stages, .json")
    bake.add_argument("--schedule-out", type=Path, metavar="FILE", help="the schedule that was used, .json")
    bake.add_argument("--sound", type=Path, metavar="FILE", help="the sound of the sentence, .wav")
    bake.add_argument("--spline", choices=SPLINES, help="final spline (default: the curve set's own)")
    bake.add_argument("--fps", type=float, default=60, metavar="N", help="frames per second, 1 to 1000 (default 60)")
    bake.add_argument("--method", type=Path, metavar="FILE", help="a learned model, .npz, in place of the curves")
    bake.add_argument("--no-snap", action="store_true", help="do not put each peak on its nearest frame")
    speech_options.add_to_bake(bake)
    speech_options.add(command)

    curve_work_parser.add(command)

    curve_sets_parser.add(command)

    methods_parser.add(command)

    render = command(
        "render",
        "draw the face saying a sentence: a clip with sound, or frame by frame",
        'lipstitch render "Hello there" --face ada --out clip.mp4',
    )
    _speech_options(render, usual="the face's own, or our English set")
    render.add_argument(
        "--out", type=Path, required=True, metavar="PATH", help="a clip, .mp4, or a folder for PNG frames and sound"
    )
    render.add_argument("--fps", type=float, default=30, metavar="N", help="frames per second, 1 to 240 (default 30)")
    render.add_argument(
        "--size", type=_size, metavar="WxH", help="pixels (default 512x512; of several faces 384x512 each)"
    )
    render.add_argument(
        "--face", metavar="FACE", action="append", help=f"{_FACE}; up to three times, for faces side by side"
    )
    look_options.add_look(render)
    look_options.add_camera(render)
    render.add_argument("--method", type=Path, metavar="FILE", help="a learned model, .npz, in place of the curves")
    render.add_argument("--still", action="store_true", help="keep eyes and brows still: no blinking")

    strip = command(
        "film-strip",
        "draw a sentence as a row of pictures, one for each phone",
        'lipstitch film-strip "Five big moths" --face ada --out strip.png',
    )
    _speech_options(strip, usual="the face's own, or our English set")
    strip.add_argument("--out", type=Path, required=True, metavar="FILE", help="the picture, .png")
    strip.add_argument("--face", metavar="FACE", help=_FACE)
    strip.add_argument(
        "--size", type=_size, default=(128, 128), metavar="WxH", help="pixels of each picture (default 128x128)"
    )

    face = command("face", "say what a face is made of and which poses it can make", "lipstitch face head.glb")
    face.add_argument("face", metavar="FACE", help=_FACE)
    face.add_argument("--curves", type=Path, metavar="FILE", help="the curve set whose poses it shall make")
    face.add_argument(
        "--new-set", type=Path, metavar="FILE", help="write an empty curve set over the face's own shapes (.json)"
    )

    sheet = command(
        "contact-sheet",
        "draw every pose of a face, in front and three-quarter view, with its name",
        "lipstitch contact-sheet ada --out sheet.png",
    )
    sheet.add_argument("face", metavar="FACE", help=f"{_FACE}; or all: our characters together")
    sheet.add_argument("--out", type=Path, required=True, metavar="FILE", help="the picture, .png")
    sheet.add_argument("--curves", type=Path, metavar="FILE", help="the curve set whose poses are shown")
    sheet.add_argument(
        "--size", type=_size, default=(240, 240), metavar="WxH", help="pixels of each face (default 240x240)"
    )
    sheet.add_argument("--portraits", action="store_true", help="with all: one picture of each, speaking")
    look_options.add_look(sheet)

    shot = command(
        "screenshot",
        "draw the editor's window off screen, in mid-sentence",
        'lipstitch screenshot "Hello there" --out window.png',
    )
    _speech_options(shot)
    shot.add_argument("--out", type=Path, required=True, metavar="FILE", help="the picture, .png")
    shot.add_argument("--face", metavar="FACE", help=_FACE)
    shot.add_argument("--size", type=_size, default=(1600, 1000), metavar="WxH", help="pixels (default 1600x1000)")

    faces = command(
        "build-faces", "sculpt our characters anew from their parameters", "lipstitch build-faces toon crab"
    )
    faces.add_argument("names", nargs="*", metavar="NAME", help="only these characters (default: all)")
    faces.add_argument("--out", type=Path, metavar="FOLDER", help="where to (default: where the shipped ones are)")

    curves = command(
        "build-curves",
        "make curve sets from their recipes, each .json beside its .toml",
        "lipstitch build-curves english",
    )
    curves.add_argument("names", nargs="*", metavar="NAME", help="english, crab, or a .toml of yours (default: ours)")
    return parser


def _speech_options(
    parser: argparse.ArgumentParser, *, text_optional: bool = False, usual: str = "our English set"
) -> None:
    parser.add_argument("text", metavar="TEXT", nargs="?" if text_optional else None, help="what to say")
    parser.add_argument("--curves", type=Path, metavar="FILE", help=f"curve set (default: {usual})")
    parser.add_argument("--preset", choices=tuple(PRESETS), help="pipeline settings (default: the curve set's own)")
    parser.add_argument("--voice", metavar="NAME", default="en-us", help="espeak-ng voice (default en-us)")


def _size(text: str) -> tuple[int, int]:
    """ "1600x1000" → (1600, 1000)."""
    width, _, height = text.lower().partition("x")
    if not (width.isdigit() and height.isdigit() and 64 <= int(width) <= 8192 and 64 <= int(height) <= 8192):
        raise argparse.ArgumentTypeError(f"{text!r} is not a size such as 1600x1000 (64 to 8192 each)")
    return int(width), int(height)


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("lipstitch")
    except PackageNotFoundError:
        return "(not installed)"

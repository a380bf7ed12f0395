"""The command line. Nothing here imports Qt; only the editor and `screenshot` do, when they run."""

from __future__ import annotations

import argparse
import ctypes
import os
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import NoReturn

from core_pipeline.errors import UserError
from core_pipeline.files.atomic import reason
from core_pipeline.files.json_text import shown
from core_pipeline.settings import PRESETS, SPLINES

COMMANDS = ("edit", "bake", "check", "render", "face", "screenshot")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run `lipstitch`; the exit code: 0, 1 for problems `check` found, 2 for anything a user must mend."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    for stream in (sys.stdout, sys.stderr):  # a name this terminal cannot show is no reason to fail
        if stream is not None and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    try:
        refuse_name_clash()
        options = _parser().parse_args(
            arguments if arguments[:1] and _is_command(arguments[0]) else ["edit", *arguments]
        )
        code: int = options.run(options)
        if sys.stdout is not None:
            sys.stdout.flush()
    except UserError as error:
        return _refuse(str(error))
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # `lipstitch check … | head`
        _drop_output()
        return 0
    except OSError as error:
        _drop_output()
        return _refuse(f"{error.filename or 'The output'} failed: {reason(error)}.")
    except MemoryError:
        return _refuse("There is not enough memory for that: use a smaller file, a shorter text or fewer frames.")
    except ImportError as error:
        return _refuse(f"A part of Lipstitch cannot be loaded ({error}): python3 run.py installs what is missing.")
    return code


def _refuse(sentence: str) -> int:
    """One line on stderr, whatever a file's names hold."""
    print(f"lipstitch: {shown(sentence, 2000)}", file=sys.stderr)
    return 2


def _drop_output() -> None:
    """What is still buffered cannot be written; Python would try once more when it ends, and complain."""
    if sys.stdout is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one sentence, without the whole usage."""

    def error(self, message: str) -> NoReturn:
        raise UserError(f"{message} (see {self.prog} --help)")


def refuse_name_clash() -> None:
    """UserError when `widgets` or `core_pipeline` of another program stand before ours on the path."""
    ours = Path(__file__).resolve().parent.parent
    for name in ("widgets", "core_pipeline"):
        spec = find_spec(name)
        found = Path((spec.origin if spec is not None else None) or "").resolve().parent.parent
        if found != ours:
            raise UserError(
                f"Two programs get in each other's way: {name} comes from {found}, app from {ours}. "
                "Install Lipstitch in an environment of its own."
            )


def has_display() -> bool:
    """Whether a window could be shown."""
    if not sys.platform.startswith("linux") or os.environ.get("QT_QPA_PLATFORM") or os.environ.get("WAYLAND_DISPLAY"):
        return True
    return bool(os.environ.get("DISPLAY")) and _x_answers()


def _x_answers() -> bool:
    """Whether the X server that DISPLAY names is there; Qt would end the whole process where it is not."""
    try:
        xcb = ctypes.CDLL("libxcb.so.1")
    except OSError:
        return True  # Qt will say so itself
    xcb.xcb_connect.restype = ctypes.c_void_p
    connection = ctypes.c_void_p(xcb.xcb_connect(None, None))
    failed = xcb.xcb_connection_has_error(connection)
    xcb.xcb_disconnect(connection)
    return not failed


def _is_command(word: str) -> bool:
    return word in COMMANDS or word in ("-h", "--help", "--version")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="lipstitch",
        usage="lipstitch [FILE] [--sentence TEXT]\n       lipstitch COMMAND …     (lipstitch COMMAND --help says more)",
        description="An editor for phone-bigram lip sync. Without a command the editor opens.",
        epilog='Example: lipstitch bake "Fat cats often find fish" --out weights.json',
    )
    parser.add_argument("--version", action="version", version=f"lipstitch {_version()}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True, prog="lipstitch")

    def command(name: str, purpose: str, example: str) -> argparse.ArgumentParser:
        return commands.add_parser(
            name, help=purpose, description=f"{purpose[0].upper()}{purpose[1:]}.", epilog=f"Example: {example}"
        )

    edit = command("edit", "open the editor, as without a command", "lipstitch edit my-curves.json")
    edit.add_argument("file", nargs="?", type=Path, metavar="FILE", help="a curve set to open")
    edit.add_argument("--sentence", metavar="TEXT", help="what to type first")
    edit.set_defaults(run=_edit)

    bake = command(
        "bake",
        "turn a sentence or a schedule into weights per frame",
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
    bake.add_argument("--no-snap", action="store_true", help="do not put each peak on its nearest frame")
    bake.set_defaults(run=_bake)

    check = command(
        "check",
        "validate a curve set: exit code 0 when it is good, 1 with a line per problem",
        "lipstitch check my-curves.json",
    )
    check.add_argument("file", type=Path, metavar="FILE", help="a curve set, .json")
    check.set_defaults(run=_check)

    render = command(
        "render", "draw the face saying a sentence, frame by frame", 'lipstitch render "Hello there" --out frames'
    )
    _speech_options(render)
    render.add_argument(
        "--out", type=Path, required=True, metavar="FOLDER", help="folder for the PNG frames and the sound"
    )
    render.add_argument("--fps", type=float, default=30, metavar="N", help="frames per second, 1 to 240 (default 30)")
    render.add_argument("--size", type=_size, default=(512, 512), metavar="WxH", help="pixels (default 512x512)")
    render.add_argument("--face", type=Path, metavar="PATH", help="a .glb, .gltf or .vrm, or a folder of .obj poses")
    render.set_defaults(run=_render)

    face = command("face", "say what a face is made of and which poses it can make", "lipstitch face head.glb")
    face.add_argument("path", type=Path, metavar="PATH", help="a .glb, .gltf or .vrm, or a folder of .obj poses")
    face.add_argument("--curves", type=Path, metavar="FILE", help="the curve set whose poses it shall make")
    face.set_defaults(run=_face)

    shot = command(
        "screenshot",
        "draw the editor's window off screen, in mid-sentence",
        'lipstitch screenshot "Hello there" --out window.png',
    )
    _speech_options(shot)
    shot.add_argument("--out", type=Path, required=True, metavar="FILE", help="the picture, .png")
    shot.add_argument("--size", type=_size, default=(1600, 1000), metavar="WxH", help="pixels (default 1600x1000)")
    shot.set_defaults(run=_screenshot)
    return parser


def _speech_options(parser: argparse.ArgumentParser, *, text_optional: bool = False) -> None:
    parser.add_argument("text", metavar="TEXT", nargs="?" if text_optional else None, help="what to say")
    parser.add_argument("--curves", type=Path, metavar="FILE", help="curve set (default: our English set)")
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


def _edit(options: argparse.Namespace) -> int:
    if not has_display():
        from . import resources
        from .batch import demo

        return demo(options.sentence or resources.DEMO_SENTENCE, options.file)
    from .editor import run_editor

    return run_editor(options.file, options.sentence)


def _bake(options: argparse.Namespace) -> int:
    from .batch import bake

    return bake(options)


def _check(options: argparse.Namespace) -> int:
    from .batch import check

    return check(options.file)


def _render(options: argparse.Namespace) -> int:
    from .batch import render

    return render(options)


def _face(options: argparse.Namespace) -> int:
    from .batch import tell_face

    return tell_face(options.path, options.curves)


def _screenshot(options: argparse.Namespace) -> int:
    from .batch import load_curves
    from .screenshot import screenshot

    return screenshot(options.text, load_curves(options), options.out, options.size, options.voice)

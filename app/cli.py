"""The command line. Nothing here imports Qt; only the editor and `screenshot` do, when they run."""

from __future__ import annotations

import argparse
import ctypes
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from core_pipeline.errors import UserError
from core_pipeline.files.atomic import reason
from core_pipeline.files.json_text import shown

from .command_line.parser import make_parser

Command = Callable[[argparse.Namespace], int]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run `lipstitch`; the exit code: 0, 1 for problems `check` found, 2 for anything a user must mend."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    for stream in (sys.stdout, sys.stderr):  # a name this terminal cannot show is no reason to fail
        if stream is not None and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    try:
        refuse_name_clash()
        options = make_parser().parse_args(
            arguments if arguments[:1] and _is_command(arguments[0]) else ["edit", *arguments]
        )
        code = COMMANDS[options.command](options)
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


def _edit(options: argparse.Namespace) -> int:
    if not has_display():
        from . import resources
        from .command_line.demo import demo

        return demo(options.sentence or resources.DEMO_SENTENCE, options.file)
    from .editor import run_editor

    return run_editor(options.file, options.sentence, options.face)


def _screenshot(options: argparse.Namespace) -> int:
    from .command_line.screenshot import screenshot
    from .command_line.steps import load_curves
    from .rigs import curves_of, face_path

    face = face_path(options.face)
    curve_set = load_curves(options, curves_of(face))
    return screenshot(options.text, curve_set, options.out, options.size, options.voice, face)


def _in(module: str, function: str) -> Command:
    """The command at `function` of a module of ours, which is loaded only when it is asked for."""

    def run(options: argparse.Namespace) -> int:
        code: int = getattr(import_module(f".{module}", __package__), function)(options)
        return code

    return run


COMMANDS: Mapping[str, Command] = {
    "edit": _edit,
    "bake": _in("command_line.bake", "bake"),
    "batch": _in("command_line.batch", "batch"),
    "check": _in("command_line.check", "check"),
    "convert": _in("command_line.curve_sets", "convert"),
    "diff": _in("command_line.curve_sets", "diff"),
    "merge": _in("command_line.curve_sets", "merge"),
    "suggest": _in("command_line.suggest", "suggest"),
    "stats": _in("command_line.stats", "stats"),
    "render": _in("command_line.clips", "render"),
    "face": _in("rigs", "tell_face"),
    "contact-sheet": _in("command_line.contact_sheet", "contact_sheet"),
    "film-strip": _in("command_line.film_strip", "film_strip"),
    "screenshot": _screenshot,
    "fit": _in("command_line.fit", "fit"),
    "study": _in("command_line.study", "study"),
    "build-faces": _in("command_line.build", "build_faces"),
    "build-curves": _in("command_line.build", "build_curves"),
    "build-frequencies": _in("command_line.stats", "build_frequencies"),
}

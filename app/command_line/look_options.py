"""Options of every command that draws faces: light, background, camera, turntable."""

from __future__ import annotations

import argparse

from core_pipeline.faces.looks import ANGLES, BACKGROUNDS, LIGHTS, Angle, Look


def add_look(parser: argparse.ArgumentParser) -> None:
    """--background and --light."""
    parser.add_argument(
        "--background", choices=tuple(BACKGROUNDS), default="studio", help="what is behind (default studio)"
    )
    parser.add_argument(
        "--light", choices=tuple(LIGHTS), default="left", help="where the main light stands (default left)"
    )


def add_camera(parser: argparse.ArgumentParser) -> None:
    """--camera and --turntable."""
    parser.add_argument("--camera", choices=tuple(ANGLES), default="front", help="from where (default front)")
    parser.add_argument("--turntable", action="store_true", help="turn the faces evenly, once in 12 seconds")


def look_of(options: argparse.Namespace) -> Look:
    """The look the options name."""
    return Look(BACKGROUNDS[options.background], LIGHTS[options.light])


def angle_of(options: argparse.Namespace) -> Angle:
    """The camera the options name."""
    return ANGLES[options.camera]

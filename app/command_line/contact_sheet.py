"""`lipstitch contact-sheet`: every pose of a face on one page, from the front and in three-quarter view, named."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Face
from core_pipeline.faces.looks import ANGLES, Look
from core_pipeline.faces.view import View
from core_pipeline.files import curve_set_json
from core_pipeline.files.json_text import shown

from ..rigs import curves_of, face_path, is_ours, open_rig
from .frames import FaceFrames, save_png
from .line_up import line_up
from .look_options import look_of
from .posed import Pose, poses_of
from .progress import Progress

COLUMNS = 3
#: More than any screen or printer shows; beyond it memory runs out.
MAX_PIXELS = 100_000_000

_MARGIN, _GAP, _SEAM = 20, 18, 2
_TITLE, _LABEL = 26, 15
_PAPER, _INK, _FAINT = (27, 29, 33), (226, 229, 234), (138, 145, 156)


def contact_sheet(options: argparse.Namespace) -> int:
    """Draw the sheet of the face the options name."""
    out: Path = options.out
    if out.suffix.lower() != ".png":
        raise UserError(f"Cannot tell the format of {out}: name the picture .png.")
    if options.face == "all":
        return line_up(options)
    if options.portraits:
        raise UserError("--portraits shows our characters together: write contact-sheet all --portraits.")
    path = face_path(options.face)
    poses = curve_set_json.read(options.curves or curves_of(path)).curve_set.poses
    face = open_rig(path, poses).face
    shown_poses = poses_of(face, poses, idle=is_ours(path))
    if 2 * len(shown_poses) * options.size[0] * options.size[1] > MAX_PIXELS:
        raise UserError(f"{len(shown_poses)} poses that large are no picture any more: choose a smaller --size.")
    save_png(sheet(face, shown_poses, options.size, look_of(options)), out)
    print(f"{len(shown_poses)} poses of {shown(face.title, 200)} in {out}")
    return 0


def sheet(face: Face, poses: Sequence[Pose], size: tuple[int, int], look: Look | None = None) -> Image.Image:
    """The page: pairs of pictures of `size` (width, height) pixels, three pairs in a row."""
    width, height = size
    pair, label = 2 * width + _SEAM, 2 * _LABEL
    columns = min(COLUMNS, len(poses))
    rows = -(-len(poses) // columns)
    head = _MARGIN + 2 * _TITLE
    page = Image.new(
        "RGB",
        (2 * _MARGIN + columns * pair + (columns - 1) * _GAP, head + rows * (height + label + _GAP) + _MARGIN - _GAP),
        _PAPER,
    )
    draw = ImageDraw.Draw(page)
    draw.text((_MARGIN, _MARGIN), shown(face.title, 80), _INK, ImageFont.load_default(_TITLE))
    with Progress(len(poses), "poses") as progress:
        for number, (pose, pictures) in enumerate(zip(poses, _pictures(face, poses, size, look), strict=True)):
            x = _MARGIN + number % columns * (pair + _GAP)
            y = head + number // columns * (height + label + _GAP)
            for side, picture in enumerate(pictures):
                page.paste(picture, (x + side * (width + _SEAM), y))
            _write(draw, pose, (x, y + height + _LABEL // 2), pair)
            progress.step(number + 1)
    return page


def _pictures(
    face: Face, poses: Sequence[Pose], size: tuple[int, int], look: Look | None
) -> Iterator[tuple[Image.Image, Image.Image]]:
    frames = FaceFrames(face, face.shapes, size, look)
    side = View.on(face, ANGLES["left"])
    for _, _, mix in poses:
        amounts = np.array([mix.get(shape, 0.0) for shape in face.shapes])
        yield frames.picture(amounts), frames.picture(amounts, side)


def _write(draw: ImageDraw.ImageDraw, pose: Pose, place: tuple[int, int], width: int) -> None:
    """The name, and in fainter letters what is said beside it, cut where the pair of pictures ends."""
    font = ImageFont.load_default(_LABEL)
    name = _cut(shown(pose[0], 80), font, width)
    draw.text(place, name, _INK, font)
    x = place[0] + round(font.getlength(name)) + _LABEL
    draw.text((x, place[1]), _cut(pose[1], font, place[0] + width - x), _FAINT, font)


def _cut(text: str, font: ImageFont.FreeTypeFont | ImageFont.ImageFont, width: float) -> str:
    if font.getlength(text) <= width:
        return text
    while text and font.getlength(f"{text}…") > width:
        text = text[:-1]
    return f"{text}…" if text else ""

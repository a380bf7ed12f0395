"""`lipstitch contact-sheet all`: our characters together, every pose of each in a row; or one portrait of each."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from core_pipeline.faces.face import Face
from core_pipeline.files import curve_set_json

from .. import resources
from ..rigs import curves_of, open_rig
from .frames import FaceFrames, save_png
from .posed import poses_of
from .progress import Progress

#: Degrees beside the face's own camera: enough to see lips from the side, little enough to see both corners.
TURNED = 22.0
#: What each says on its portrait, shape → amount.
SAYING: Mapping[str, Mapping[str, float]] = {
    "toon": {"wide": 0.75, "open": 0.35},
    "ada": {"wide": 0.55, "open": 0.22},
    "woman": {"wide": 0.3, "open": 0.45},
    "man": {"wide": 0.5, "open": 0.25},
    "crab": {"mouth open": 0.45, "smile": 0.6},
}
_PAPER, _INK = (27, 29, 33), (170, 176, 186)
_LABEL, _GAP = 13, 4


def line_up(options: argparse.Namespace) -> int:
    """Draw the page the options ask for."""
    folders = sorted(resources.characters(), key=lambda folder: curves_of(folder) != resources.english_curves())
    out: Path = options.out
    with Progress(len(folders), "faces") as progress:
        rows = []
        for number, folder in enumerate(folders, 1):
            poses = curve_set_json.read(curves_of(folder)).curve_set.poses
            face = open_rig(folder, poses).face
            rows.append(_portrait(face, options.size) if options.portraits else _row(face, poses, options.size))
            progress.step(number)
    page = _joined(rows, beside=options.portraits)
    save_png(page, out)
    print(f"{len(folders)} faces in {out}")
    return 0


def _portrait(face: Face, size: tuple[int, int]) -> Image.Image:
    saying = SAYING.get(face.name, {})
    return _drawn(FaceFrames(face, face.shapes, size), face, saying)


def _row(face: Face, poses: tuple[str, ...], size: tuple[int, int]) -> Image.Image:
    frames, (width, height) = FaceFrames(face, face.shapes, size), size
    _, *posed = poses_of(face, poses, idle=False)
    shown = [(face.title, {}), *((pose, mix) for pose, _, mix in posed)]
    row = Image.new("RGB", (len(shown) * (width + _GAP) - _GAP, height + 2 * _LABEL), _PAPER)
    draw, font = ImageDraw.Draw(row), ImageFont.load_default(_LABEL)
    for number, (name, mix) in enumerate(shown):
        x = number * (width + _GAP)
        row.paste(_drawn(frames, face, mix), (x, 0))
        draw.text((x + 2, height + _LABEL // 4), name, _INK, font)
    return row


def _drawn(frames: FaceFrames, face: Face, mix: Mapping[str, float]) -> Image.Image:
    amounts = np.array([mix.get(shape, 0.0) for shape in face.shapes])
    return frames.picture(amounts, replace(frames.view, yaw=frames.view.yaw + TURNED))


def _joined(pictures: list[Image.Image], *, beside: bool) -> Image.Image:
    wide, high = (max(picture.size[axis] for picture in pictures) for axis in (0, 1))
    page = Image.new("RGB", (wide * len(pictures), high) if beside else (wide, high * len(pictures)), _PAPER)
    for number, picture in enumerate(pictures):
        page.paste(picture, (number * wide, 0) if beside else (0, number * high))
    return page

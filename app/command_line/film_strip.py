"""`lipstitch film-strip`: a sentence as a row of pictures, one for each phone, as an animator would look through it."""

from __future__ import annotations

import argparse
import unicodedata
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from core_pipeline import pipeline
from core_pipeline.errors import UserError
from core_pipeline.files.json_text import shown
from core_pipeline.phonemes import SILENCE
from core_pipeline.schedule import Schedule
from core_pipeline.weights import sample

from ..rigs import curves_of, face_path, open_rig
from .contact_sheet import MAX_PIXELS
from .frames import FaceFrames, save_png
from .progress import Progress
from .steps import load_curves, say, tell_missing

COLUMNS = 12
_LABEL, _PAPER, _INK = 15, (27, 29, 33), (226, 229, 234)


def film_strip(options: argparse.Namespace) -> int:
    """Draw the strip of the sentence the options name."""
    out: Path = options.out
    if out.suffix.lower() != ".png":
        raise UserError(f"Cannot tell the format of {out}: name the picture .png.")
    face = face_path(options.face)
    curve_set = load_curves(options, curves_of(face))
    schedule = say(options.text, options.voice).schedule
    stages = pipeline.run(schedule, curve_set)
    tell_missing(stages)
    moments = moments_of(schedule)
    width, height = options.size
    if len(moments) * width * (height + 2 * _LABEL) > MAX_PIXELS:
        raise UserError(f"{len(moments)} pictures that large are no picture any more: choose a smaller --size.")
    rows = sample(stages.magenta, curve_set.effective_settings.spline, np.array([time for _, time in moments]))
    frames = FaceFrames(open_rig(face, stages.poses).face, stages.poses, options.size)
    columns = min(COLUMNS, len(moments))
    strip = Image.new("RGB", (columns * width, -(-len(moments) // columns) * (height + 2 * _LABEL)), _PAPER)
    draw = ImageDraw.Draw(strip)
    with Progress(len(moments), "pictures") as progress:
        for i, (phone, _) in enumerate(moments):
            x, y = i % columns * width, i // columns * (height + 2 * _LABEL)
            strip.paste(frames.picture(rows[i]), (x, y))
            place = (x + width // 2, y + height + _LABEL)
            draw.text(place, _plain(phone), _INK, ImageFont.load_default(_LABEL), anchor="mm")
            progress.step(i + 1)
    save_png(strip, out)
    print(f"{len(moments)} pictures in {out}")
    return 0


def moments_of(schedule: Schedule) -> list[tuple[str, float]]:
    """(phone, the middle of its time) of every phone that is heard."""
    spans = zip(schedule.phones, schedule.times[:-1], schedule.times[1:], strict=True)
    return [(phone, float(start + end) / 2) for phone, start, end in spans if phone != SILENCE]


def _plain(phone: str) -> str:
    """As the font can write it: ü is u:, as in pinyin on old machines."""
    parts = unicodedata.normalize("NFKD", phone).replace("\u0308", ":")
    return shown(parts.encode("ascii", "ignore").decode() or "?", 12)

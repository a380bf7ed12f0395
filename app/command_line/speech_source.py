"""What `bake` was asked to say, from its options; apart from them, because this loads what speaks."""

from __future__ import annotations

import argparse

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files.json_text import shown
from core_pipeline.phonemes import SILENCE, TABLE_1
from core_pipeline.speech.audio_file import FASTEST_RATE, SLOWEST_RATE
from core_pipeline.speech.espeak import voice_named
from core_pipeline.speech.intake import Source

from .. import resources
from ..phoneme_maps import applied


def source_of(options: argparse.Namespace) -> Source:
    """What `bake` was asked to say. UserError for an assignment that is none."""
    if options.label_rate is not None and not SLOWEST_RATE <= options.label_rate <= FASTEST_RATE:
        raise UserError(
            f"--label-rate {options.label_rate} is no rate of recordings: choose {SLOWEST_RATE} to {FASTEST_RATE}."
        )
    return Source(
        text=options.text or "",
        audio=options.audio,
        transcript=options.transcript or "",
        labels=options.labels,
        voice=voice_named(options.voice),
        rate=options.rate,
        pitch=options.pitch,
        label_rate=options.label_rate,
        assigned=dict(map(_assignment, options.assign)),
    )


def with_map(curve_set: CurveSet, name: str | None) -> CurveSet:
    """The set with another phoneme map: one of ours by name, or a file. UserError when they do not fit."""
    if name is None:
        return curve_set
    return applied(curve_set, resources.phoneme_map(name))


def _assignment(text: str) -> tuple[str, str]:
    name, sign, phones = text.rpartition("=")
    if not sign or not name:
        raise UserError(f"--assign “{shown(text)}” should be NAME=PHONE, such as QX=b.")
    for phone in phones.split():
        if phone not in TABLE_1 and phone != SILENCE:
            raise UserError(f"--assign “{shown(text)}”: {shown(phone)} is no phone; choose one of {' '.join(TABLE_1)}.")
    return name, phones

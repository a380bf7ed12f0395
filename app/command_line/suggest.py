"""`lipstitch suggest`: a set with gaps → the same with suggestions in them."""

from __future__ import annotations

import argparse
from dataclasses import replace

from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.suggest import FEW, fill, is_drawn

from ..priors import prior_for
from .steps import tell


def suggest(options: argparse.Namespace) -> int:
    """Fill what is empty, and write the whole set."""
    reading = curve_set_json.read(options.file)
    if reading.newer:
        raise UserError(f"{options.file} was written by a newer Lipstitch: update to fill it without losing anything.")
    for line in reading.repairs:
        tell(line)
    curve_set = reading.curve_set
    prior = prior_for(curve_set)
    filled = fill(curve_set, prior)
    moving = sum(not bigram.is_empty for bigram in filled.values())
    curve_set_json.save(replace(curve_set, bigrams={**curve_set.bigrams, **filled}), options.out)
    drawn = sum(is_drawn(bigram) for bigram in curve_set.bigrams.values())
    parts = " and phone parts" if prior is not None and drawn < FEW else ""
    print(f"{options.out}: {moving} suggestions, learned from {drawn} drawn bigrams{parts}.")
    if moving < len(filled):
        tell(f"{len(filled) - moving} bigrams stay empty: nothing drawn says what their phones do.")
    return 0

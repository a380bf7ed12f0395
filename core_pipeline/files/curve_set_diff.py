"""Where two curve sets differ, as sentences for people and for `lipstitch diff`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..curve_set import Bigram, CurveSet
from ..curves import Curve
from ..phonemes import SILENCE, Pair, pair_name
from ..settings import Settings


def distance(a: Curve | None, b: Curve | None) -> float:
    """The greatest difference in height between two curves, 0…1; no curve is 0 throughout."""
    times = np.concatenate([curve.t for curve in (a, b) if curve is not None] or [np.zeros(1)])
    heights = [curve.at(times) if curve is not None else np.zeros(times.size) for curve in (a, b)]
    return float(np.abs(heights[0] - heights[1]).max())


def differences(a: CurveSet, b: CurveSet) -> list[str]:
    """One line per difference from `a` to `b`, in canonical order; empty when they say the same."""
    lines = []
    for what in ("name", "language", "base", "authors", "provenance"):
        old, new = getattr(a, what), getattr(b, what)
        if old != new:
            lines.append(f"{what}: {_said(old)} → {_said(new)}")
    lines += _lists("phonemes", a.phonemes, b.phonemes)
    lines += _lists("poses", a.poses, b.poses)
    lines += _mappings("phoneme_map", a.phoneme_map, b.phoneme_map)
    lines += _settings(a.effective_settings, b.effective_settings)
    lines += _mappings("field", a.extra, b.extra)
    rank = {phone: i for i, phone in enumerate(dict.fromkeys((*b.phonemes, *a.phonemes, SILENCE)))}
    pairs = sorted({*a.bigrams, *b.bigrams}, key=lambda pair: (rank[pair[0]], rank[pair[1]]))
    for pair in pairs:
        lines += _bigram(pair_name(pair), a.bigrams.get(pair), b.bigrams.get(pair))
    for pair in sorted({*a.aside, *b.aside}):
        lines += _bigram(f"aside {pair_name(pair)}", a.aside.get(pair), b.aside.get(pair))
    return lines


def _bigram(name: str, a: Bigram | None, b: Bigram | None) -> list[str]:
    if a is b:
        return []
    if a is None or b is None:
        curves = (a or b or Bigram()).curves
        return [f"{name}: {'only in the second' if a is None else 'only in the first'} ({' '.join(curves) or 'empty'})"]
    lines = [
        f"{name}: {what} {_said(getattr(a, what))} → {_said(getattr(b, what))}"
        for what in ("status", "source", "note", "author")
        if getattr(a, what) != getattr(b, what)
    ]
    lines += _mappings(f"{name}: field", a.extra, b.extra)
    for pose in dict.fromkeys((*a.curves, *b.curves)):
        old, new = a.curves.get(pose), b.curves.get(pose)
        if old is None or new is None:
            lines.append(f"{name} {pose}: {'only in the second' if old is None else 'only in the first'}")
        elif not old.same_as(new):
            keys = f"{len(old)} → {len(new)} keys" if len(old) != len(new) else f"{len(old)} keys"
            lines.append(f"{name} {pose}: differs by up to {distance(old, new):.3g} ({keys})")
    return lines


def pair_differs(a: CurveSet, b: CurveSet, pair: Pair) -> float:
    """The greatest difference in height between the curves of one bigram in two sets, over all poses, 0…1."""
    old, new = (s.bigrams.get(pair) or Bigram() for s in (a, b))
    if old is new:
        return 0.0
    return max((distance(old.curves.get(p), new.curves.get(p)) for p in {*old.curves, *new.curves}), default=0.0)


def _lists(what: str, a: tuple[str, ...], b: tuple[str, ...]) -> list[str]:
    lines = [f"{what}: {name} only in the first" for name in a if name not in b]
    lines += [f"{what}: {name} only in the second" for name in b if name not in a]
    return lines or ([f"{what}: in another order"] if a != b else [])


def _mappings(what: str, a: Mapping[str, Any], b: Mapping[str, Any]) -> list[str]:
    return [
        f"{what} {name}: {_said(a.get(name))} → {_said(b.get(name))}"
        for name in dict.fromkeys((*a, *b))
        if a.get(name) != b.get(name)
    ]


def _settings(a: Settings, b: Settings) -> list[str]:
    lines = [
        f"settings {what}: {_said(getattr(a, what))} → {_said(getattr(b, what))}"
        for what in ("window", "speed_limit", "spline", "priorities")
        if getattr(a, what) != getattr(b, what)
    ]
    lines += _mappings("settings window of", a.windows, b.windows)
    old, new = ({f"{c.a} + {c.b}": c.limit for c in s.constraints} for s in (a, b))
    return lines + _mappings("settings constraint", old, new)


def _said(value: Any) -> str:
    if value is None or value == "":
        return "none"
    text = " ".join(map(str, value)) if isinstance(value, tuple | list) else str(value)
    return text if len(text) <= 60 else text[:59] + "…"

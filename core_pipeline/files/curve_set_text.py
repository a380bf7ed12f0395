"""A curve set → the text of its file: canonical order, one curve a line, at most 4 decimals, LF."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from ..curve_set import Bigram, CurveSet
from ..curves import Curve
from ..phonemes import SILENCE, Pair, pair_name
from .curve_set_records import SCHEMA
from .settings_json import encode_settings, number


def dumps(curve_set: CurveSet, *, minified: bool = False) -> str:
    """The file's text. Bigrams in the order of the phoneme set, poses in the set's order.

    A set with a base writes what is its own: the rest stays in the base.
    """
    below = curve_set.below
    head = f'"name": {_text(curve_set.name)}, "language": {_text(curve_set.language)}, "base": {_text(curve_set.base)}'
    lines = [f'"schema": "{SCHEMA}"', head]
    if curve_set.authors:
        lines.append(f'"authors": {_text(list(curve_set.authors))}')
    if curve_set.provenance:
        lines.append(f'"provenance": {_text(curve_set.provenance)}')
    lines += [f'"phonemes": {_text(list(curve_set.phonemes))}', f'"poses": {_text(list(curve_set.poses))}']
    if below is None or curve_set.phoneme_map != below.phoneme_map:
        lines.append(f'"phoneme_map": {_text(dict(curve_set.phoneme_map))}')
    unknown = curve_set.extra.get("settings", {})
    if below is None or curve_set.settings is not None:
        lines.append(f'"settings": {encode_settings(curve_set.effective_settings, unknown)}')
    lines += [f"{_text(name)}: {_text(value)}" for name, value in curve_set.extra.items() if name != "settings"]
    lines.append(f'"bigrams": {_bigrams_text(curve_set, curve_set.own, curve_set.poses)}')
    if curve_set.aside:
        poses = dict.fromkeys(curve_set.poses)
        poses |= dict.fromkeys(sorted(pose for bigram in curve_set.aside.values() for pose in bigram.curves))
        lines.append(f'"aside": {_bigrams_text(curve_set, curve_set.aside, tuple(poses))}')
    text = "{\n" + ",\n".join(f"  {line}" for line in lines) + "\n}\n"
    return json.dumps(json.loads(text), ensure_ascii=False, separators=(",", ":")) + "\n" if minified else text


def in_order(pairs: Iterable[Pair], phonemes: Iterable[str]) -> list[Pair]:
    """Pairs as the files have them: in the order of the phoneme set, `sil` after it, unknown phones last."""
    rank = {phone: i for i, phone in enumerate([*phonemes, SILENCE])}
    last = len(rank)
    return sorted(pairs, key=lambda pair: (rank.get(pair[0], last), rank.get(pair[1], last), pair))


def _bigrams_text(curve_set: CurveSet, bigrams: Mapping[Pair, Bigram], poses: tuple[str, ...]) -> str:
    pairs = in_order(bigrams, curve_set.phonemes)
    rows = ",\n".join(_bigram_text(pair, bigrams[pair], poses) for pair in pairs)
    return f"{{\n{rows}\n  }}" if rows else "{}"


def _bigram_text(pair: Pair, bigram: Bigram, poses: tuple[str, ...]) -> str:
    author = {"author": bigram.author} if bigram.author else {}
    fields = {"status": bigram.status, "source": bigram.source, "note": bigram.note, **author, **bigram.extra}
    start = f"    {_text(pair_name(pair))}: {_text(fields)[:-1]}, " + '"curves": {'
    curves = [f"      {_text(pose)}: {keys_text(bigram.curves[pose])}" for pose in poses if pose in bigram.curves]
    return start + ("\n" + ",\n".join(curves) + "\n    }}" if curves else "}}")


def keys_text(curve: Curve) -> str:
    """The keys as JSON, times as short as keeps them apart."""
    times = [number(t) for t in curve.t]
    if len(set(times)) < len(times):  # keys nearer than four decimals can tell
        times = [repr(float(t)) for t in curve.t]
    return "[" + ", ".join(f"[{t}, {number(v)}]" for t, v in zip(times, curve.v, strict=True)) + "]"


def _text(value: Any) -> str:
    return json.dumps(dict(value) if isinstance(value, Mapping) else value, ensure_ascii=False)

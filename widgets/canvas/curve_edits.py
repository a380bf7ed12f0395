"""Edits of curves that need no hand: move, scale, reverse, mirror, retype, paste and blend as pure functions. No Qt."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from core_pipeline.curves import MIN_GAP, Curve

from .curve_geometry import Array, feasible, feasible_scale, scaled, shifted

#: What a pose does that has no curve.
FLAT = Curve.of([(0.0, 0.0), (1.0, 0.0)])

#: Decimals of times and weights that come out of an edit.
DECIMALS = 6

Chosen = Mapping[str, Sequence[int]]


def moved(curves: Mapping[str, Curve], chosen: Chosen, dt: float, dv: float) -> dict[str, Curve]:
    """The curves that become others when the chosen keys go that way as one body, as far as there is room."""
    dt_lo, dt_hi, dv_lo, dv_hi = feasible(curves, chosen)
    dt, dv = min(max(dt, dt_lo), dt_hi), min(max(dv, dv_lo), dv_hi)
    if dt == 0 and dv == 0:
        return {}
    return different(curves, {pose: shifted(curves[pose], at, dt, dv) for pose, at in chosen.items()})


def stretched(
    curves: Mapping[str, Curve], chosen: Chosen, pivot: tuple[float, float], factors: tuple[float, float]
) -> dict[str, Curve]:
    """The curves that become others when the chosen keys are scaled about `pivot` as far as there is room.

    factors  in time and in weight
    """
    t_lo, t_hi, v_lo, v_hi = feasible_scale(curves, chosen, pivot)
    in_t, in_v = min(max(factors[0], t_lo), t_hi), min(max(factors[1], v_lo), v_hi)
    if in_t == 1 and in_v == 1:
        return {}
    return different(curves, {pose: scaled(curves[pose], at, pivot, in_t, in_v) for pose, at in chosen.items()})


def different(curves: Mapping[str, Curve], changed: Mapping[str, Curve]) -> dict[str, Curve]:
    """Those of `changed` that are not what `curves` has."""
    return {pose: curve for pose, curve in changed.items() if not curve.same_as(curves.get(pose))}


def rekeyed(curve: Curve, indices: Sequence[int], t: Array, v: Array) -> tuple[Curve, list[int]] | None:
    """With the keys at `indices` at new times and weights, which may pass others; and their new indices.

    t, v  (n,), brought into [0, 1] and to six decimals
    None when two keys would come nearer than MIN_GAP that did not stand so before.
    """
    at = np.asarray(indices, dtype=np.intp)
    times, values = curve.t.copy(), curve.v.copy()
    times[at] = np.round(np.clip(t, 0.0, 1.0), DECIMALS)
    values[at] = np.round(np.clip(v, 0.0, 1.0), DECIMALS)
    order = np.argsort(times, kind="stable")
    times = times[order]
    gaps = np.diff(times)
    allowed = MIN_GAP if len(curve) < 2 else min(MIN_GAP, float(np.diff(curve.t).min()))
    if gaps.size and (gaps.min() < allowed - 1.1e-6 or gaps.min() <= 0):
        return None
    chosen = np.isin(order, at)
    return Curve(times, values[order]), np.flatnonzero(chosen).tolist()


def reversed_keys(curves: Mapping[str, Curve], chosen: Chosen) -> dict[str, tuple[Curve, list[int]]] | None:
    """Chosen keys mirrored in time, pose → (curve, their new indices); None when there is no room.

    Whole curves t → 1 − t; otherwise within the time from the first chosen key to the last.
    """
    whole = all(len(at) == len(curves[pose]) for pose, at in chosen.items())
    times = np.concatenate([curves[pose].t[list(at)] for pose, at in chosen.items()])
    about = 1.0 if whole else float(times.min() + times.max())
    result = {}
    for pose, at in chosen.items():
        curve = curves[pose]
        turned = rekeyed(curve, at, about - curve.t[list(at)], curve.v[list(at)])
        if turned is None:
            return None
        result[pose] = turned
    return result


def mirrored_values(curves: Mapping[str, Curve], chosen: Chosen) -> dict[str, tuple[Curve, list[int]]]:
    """Chosen keys turned upside down between the least and the largest weight of them, pose → (curve, indices)."""
    weights = np.concatenate([curves[pose].v[list(at)] for pose, at in chosen.items()])
    about = float(weights.min() + weights.max())
    result = {}
    for pose, at in chosen.items():
        curve = curves[pose]
        v = curve.v.copy()
        v[list(at)] = np.round(np.clip(about - v[list(at)], 0.0, 1.0), DECIMALS)
        result[pose] = Curve(curve.t, v), list(at)
    return result


def with_keys(curve: Curve | None, keys: Curve) -> tuple[Curve, list[int]]:
    """`curve` with other keys from the first time of `keys` to the last; and the indices of these.

    Without a curve it starts and ends at weight 0.
    """
    rest = FLAT if curve is None else curve
    keep = (rest.t <= keys.t[0] - MIN_GAP) | (rest.t >= keys.t[-1] + MIN_GAP)
    t = np.concatenate((rest.t[keep], keys.t))
    v = np.concatenate((rest.v[keep], keys.v))
    order = np.argsort(t, kind="stable")
    return Curve(t[order], v[order]), np.flatnonzero(order >= int(keep.sum())).tolist()


def turned_round(curves: Mapping[str, Curve], whole: Iterable[str]) -> dict[str, Curve]:
    """Mirrored in time: whole curves t → 1 − t, pieces within their common span."""
    complete = frozenset(whole)
    pieces = [curve.t for pose, curve in curves.items() if pose not in complete]
    span = float(min(t[0] for t in pieces) + max(t[-1] for t in pieces)) if pieces else 1.0
    about = {pose: 1.0 if pose in complete else span for pose in curves}
    return {pose: Curve(_mirrored(curve.t, about[pose]), curve.v[::-1]) for pose, curve in curves.items()}


def _mirrored(t: Array, about: float) -> Array:
    exact = np.clip(about - t[::-1], 0.0, 1.0)
    return _tidy(exact)


def _tidy(t: Array) -> Array:
    """To six decimals, unless keys of an imported curve stand too near for them."""
    tidy = np.round(t, DECIMALS)
    return tidy if (np.diff(tidy) > 0).all() else t


def blended(now: Curve, other: Curve, share: float) -> Curve:
    """Between two curves: `now` at share 0, `other` at 1.

    Curves of as many keys slide key by key; others meet at the times of both.
    """
    if share <= 0 or now.same_as(other):
        return now
    if share >= 1:
        return other
    if len(now) == len(other):
        t = now.t + share * (other.t - now.t)
        v = now.v + share * (other.v - now.v)
    else:
        t = _thinned(np.union1d(now.t, other.t))
        v = now.at(t) + share * (other.at(t) - now.at(t))
    return Curve(_tidy(t), np.round(v, DECIMALS))


def _thinned(t: Array) -> Array:
    """Without times nearer than MIN_GAP to the one before."""
    kept = [float(t[0])]
    for time in t[1:].tolist():
        if time - kept[-1] >= MIN_GAP:
            kept.append(time)
    return np.array(kept)

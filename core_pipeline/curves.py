"""A curve: what one pose does over a bigram's normalised time (section 3.1.2)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

#: Keys of one curve keep at least this distance in normalised time.
MIN_GAP = 1e-3


@dataclass(frozen=True, eq=False)
class Curve:
    """Keys of one pose over a bigram's normalised time: t (m,) strictly rising in [0, 1], v (m,) in [0, 1].

    Straight between keys, held flat outside the first and last. Read-only; every edit returns a new
    curve. ValueError when the keys break these rules.
    """

    t: Array
    v: Array

    def __post_init__(self) -> None:
        t = np.array(self.t, dtype=np.float64)
        v = np.array(self.v, dtype=np.float64)
        if t.ndim != 1 or t.shape != v.shape or t.size == 0:
            raise ValueError("a curve needs as many values as times, and at least one key")
        if not (np.isfinite(t).all() and np.isfinite(v).all()):
            raise ValueError("key times and values must be finite")
        if t[0] < 0 or t[-1] > 1 or (np.diff(t) <= 0).any():
            raise ValueError("key times must rise strictly within 0 and 1")
        if v.min() < 0 or v.max() > 1:
            raise ValueError("key values must lie within 0 and 1")
        t.flags.writeable = v.flags.writeable = False
        object.__setattr__(self, "t", t)
        object.__setattr__(self, "v", v)

    @classmethod
    def of(cls, keys: Iterable[Sequence[float]]) -> Curve:
        """From (t, v) pairs, as the files write them."""
        pairs = list(keys)
        return cls(np.array([k[0] for k in pairs]), np.array([k[1] for k in pairs]))

    def __len__(self) -> int:
        return self.t.size

    def keys(self) -> list[tuple[float, float]]:
        """The keys as (t, v) pairs."""
        return list(zip(self.t.tolist(), self.v.tolist(), strict=True))

    def same_as(self, other: Curve | None) -> bool:
        """Whether both have equal keys."""
        return other is not None and np.array_equal(self.t, other.t) and np.array_equal(self.v, other.v)

    def at(self, t: ArrayLike) -> Array:
        """The control polygon's height at normalised times t, any shape."""
        return np.asarray(np.interp(np.asarray(t, dtype=np.float64), self.t, self.v))

    def with_key(self, t: float, v: float) -> Curve:
        """With one more key; ValueError when it comes nearer than MIN_GAP to another."""
        if np.abs(self.t - t).min() < MIN_GAP:
            raise ValueError("there is already a key at this time")
        i = int(self.t.searchsorted(t))
        return Curve(np.insert(self.t, i, t), np.insert(self.v, i, v))

    def without(self, indices: Iterable[int]) -> Curve | None:
        """Without the keys at `indices`; None when no key is left."""
        gone = list(indices)
        return None if len(set(gone)) >= len(self) else Curve(np.delete(self.t, gone), np.delete(self.v, gone))

"""Our own method behind the common interface: curves of phone bigrams, stitched (Xu et al., section 3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .. import pipeline
from ..curve_set import CurveSet
from ..schedule import Schedule
from ..settings import Settings
from ..weights import Weights, bake
from .method import weights_of


@dataclass(frozen=True, eq=False)
class BigramMethod:
    """A curve set, and settings other than its own if any. Peaks are snapped to frames, as in a baked file."""

    curve_set: CurveSet
    settings: Settings | None = None

    @property
    def title(self) -> str:
        """For people."""
        return f"Bigrams ({self.curve_set.name})"

    @property
    def poses(self) -> tuple[str, ...]:
        """The set's poses."""
        return self.curve_set.poses

    def synthesize(self, schedule: Schedule, poses: Sequence[str], fps: float) -> Weights:
        """See `Method.synthesize`."""
        settings = self.settings if self.settings is not None else self.curve_set.effective_settings
        baked = bake(pipeline.run(schedule, self.curve_set, settings).magenta, settings.spline, fps)
        return weights_of(baked.frames, self.poses, poses, schedule, fps)

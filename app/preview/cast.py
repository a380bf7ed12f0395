"""Who is in the picture: up to three faces, what each of them speaks, and from where it is seen."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces import idle
from core_pipeline.faces.face import Face
from core_pipeline.faces.looks import Angle
from core_pipeline.faces.render.renderer import Figure
from core_pipeline.faces.view import View, places
from core_pipeline.phonemes import Pair

#: Faces side by side, as many as the paper's first figure has in a row.
MOST = 3
#: From the side, in degrees: there the open half shows the tongue.
CUTAWAY_YAW = 65.0

Weights = NDArray[np.float64]
#: Poses, and their weights (poses,).
Spoken = tuple[tuple[str, ...], Weights]


class Source(Protocol):
    """Where a face's weights come from: the session, or another curve set or method saying the same sentence."""

    @property
    def poses(self) -> tuple[str, ...]:
        """The poses, in the order of the weights."""

    def weights_at(self, seconds: float) -> Weights:
        """(poses,) weights of the sentence at a moment."""

    def bigram_weights_at(self, pair: Pair, s: float) -> Weights | None:
        """(poses,) weights of one bigram alone at normalised time s; None where there are no bigrams."""


@dataclass(frozen=True, eq=False)
class Actor:
    """A face and what it speaks.

    source  None: what the session says
    title   what stands beside it; "" for the face's own title
    """

    face: Face
    source: Source | None = None
    title: str = ""

    @property
    def name(self) -> str:
        """What to call it."""
        return self.title or self.face.title


@dataclass(eq=False)
class _Part:
    """An actor on the stage. `mesh` is its face as the renderer knows it: poses may be made anew, the mesh stays."""

    actor: Actor
    mesh: Face
    view: View
    matrix: NDArray[np.float32] | None = None
    matrix_poses: tuple[str, ...] = ()

    def amounts(self, poses: tuple[str, ...], weights: Weights) -> NDArray[np.float32]:
        """(shapes,) of the face. Another set may have as many poses, of other names."""
        if self.matrix is None or self.matrix_poses != poses:
            self.matrix, self.matrix_poses = self.actor.face.retarget(poses), poses
        amounts: NDArray[np.float32] = weights.astype(np.float32) @ self.matrix
        return amounts


class Cast:
    """The actors and their cameras, which turn together: one moved face is compared with the others as it is."""

    def __init__(self) -> None:
        self._parts: list[_Part] = []
        self._angle = Angle()

    @property
    def actors(self) -> tuple[Actor, ...]:
        """From left to right."""
        return tuple(part.actor for part in self._parts)

    @property
    def views(self) -> tuple[View, ...]:
        """Where each is seen from."""
        return tuple(part.view for part in self._parts)

    def set_actors(self, actors: Sequence[Actor]) -> None:
        """Other actors; one whose mesh is there already is seen as before. ValueError for more than MOST."""
        if len(actors) > MOST:
            raise ValueError(f"{len(actors)} faces; {MOST} at most")
        before, self._parts = self._parts, []
        left = list(before)  # a face that stands there twice is seen in two ways
        for actor in actors:
            known = next((p for p in (*left, *self._parts, *before) if p.mesh.positions is actor.face.positions), None)
            if known in left:
                left.remove(known)
            if known is None:
                view = View.on(actor.face, self._angle)
                if before and before[0].view.outline is not None:
                    view = replace(view.like(before[0].view), cutaway=False)
                known = _Part(actor, actor.face, view)
            self._parts.append(_Part(actor, known.mesh, known.view))

    # ── cameras ──────────────────────────────────────────────────────────────────────────────────

    def set_angle(self, angle: Angle) -> None:
        """See all from there."""
        self._angle = angle
        for part in self._parts:
            part.view = replace(View.on(part.mesh, angle), cutaway=part.view.cutaway)

    def orbit(self, dx: float, dy: float) -> None:
        """Turn by a drag in pixels."""
        self._each(lambda view: view.orbited(dx, dy))

    def turn(self, degrees: float) -> None:
        """Turn about the upright axis."""
        self._each(lambda view: view.turned(degrees))

    def zoom(self, steps: float) -> None:
        """Come nearer by notches of the wheel."""
        self._each(lambda view: view.zoomed(steps))

    def pan(self, dx: float, dy: float, size: tuple[int, int]) -> None:
        """Shift by a drag in pixels of a picture of this size."""
        *_, width, height = places(size, len(self._parts))[0]
        self._each(lambda view: view.panned(dx, dy, (width, height)))

    def cut_away(self, index: int, on: bool) -> None:
        """Hide the near half of one head and look in from the side, so that its tongue can be seen."""
        part = self._parts[index]
        yaw = CUTAWAY_YAW if on else View.on(part.mesh, self._angle).yaw
        part.view = replace(part.view, cutaway=on, yaw=yaw)

    def _each(self, move: Callable[[View], View]) -> None:
        for part in self._parts:
            part.view = move(part.view)

    # ── what is drawn ────────────────────────────────────────────────────────────────────────────

    def figures(
        self, spoken: Sequence[tuple[tuple[str, ...], Weights]], life: float | None, talks: bool
    ) -> list[Figure]:
        """What to draw.

        spoken what each actor shows
        life   seconds on the clock of idle life, None for none; each face lives at a time of its own
        talks  whether brows may move, too
        """
        figures = []
        for number, (part, (poses, weights)) in enumerate(zip(self._parts, spoken, strict=True)):
            amounts = part.amounts(poses, weights)
            if life is not None:
                idle.enliven(amounts, part.mesh, life + number * idle.APART, talks)
            figures.append(Figure(part.mesh, amounts, part.view))
        return figures

    def next_life(self, now: float, step: float) -> float:
        """Seconds until some face has more of its idle life to show: `step` while one blinks."""
        times = [now + number * idle.APART for number in range(len(self._parts))]
        return min((step if idle.blink(t + step) else idle.next_blink(t) - t for t in times), default=step)

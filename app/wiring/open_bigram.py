"""Which bigram is open, where the sentence has it, and how canvas, header and pose list show it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Signal

from core_pipeline.curve_set import Bigram
from core_pipeline.curves import Curve
from core_pipeline.phone_classes import similar_bigrams
from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from core_pipeline.speech.spelling import Span, in_words
from core_pipeline.speech.utterance import Utterance
from widgets.picker.bigram_model import spoken_pair

from .canvas_hand import CanvasHand
from .parts import Parts

#: Pose → normalised times and weights.
Played = Mapping[str, tuple[NDArray[np.float64], NDArray[np.float64]]]


class OpenBigram(QObject):
    """The bigram in the canvas: opens, shows and edits it.

    pair   the open bigram, None in a set without phonemes
    index  which of the sentence's bigrams it is, None when the sentence does not have it
    visible, locked  poses
    opened(pair)          another one than before
    pose_activated(pose)  the pose that is edited
    eyes_changed()        other poses are visible or locked
    """

    opened = Signal(object)
    pose_activated = Signal(str)
    eyes_changed = Signal()

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._document = parts.document
        self._session = parts.session
        self._preview = parts.preview
        self._window = parts.window
        self.pair: Pair | None = None
        self.index: int | None = None
        self.visible: set[str] = set()
        self.locked: set[str] = set()
        self._spelt: tuple[Utterance | None, list[tuple[str, Span]]] = (None, [])
        w = self._window
        CanvasHand(parts, w.canvas, lambda: self.pair, self.show_curves, self)
        w.canvas.preview_changed.connect(self._look_at)
        w.canvas.active_changed.connect(self.activate_pose)
        w.pose_list.pose_picked.connect(self.activate_pose)
        w.pose_list.visibility_changed.connect(self._visibility_changed)
        w.pose_list.lock_changed.connect(self._lock_changed)
        for view in (w.pose_list, w.canvas):
            view.solo_wanted.connect(w.pose_list.set_solo)
            view.solo_wanted.connect(w.canvas.set_solo)
        w.stage_panel.pose_activated.connect(self.activate_pose)
        w.stage_panel.bigram_picked.connect(self._open_from_overlay)
        w.picker.picked.connect(self.open)
        w.weak_list.picked.connect(self.open_in_sentence)

    # ── open ─────────────────────────────────────────────────────────────────────────────────────

    def open(self, pair: Pair | None, index: int | None = None) -> None:
        """Show a bigram in the canvas; `index` is its place in the sentence, else its first there."""
        changed = pair != self.pair
        self.pair = pair
        self.index = index if index is not None else self._first_index()
        w = self._window
        if changed:
            first, second = pair or ("", "")
            self._preview.set_pair(pair)
            w.canvas.set_bigram(first, second)
            w.header.set_bigram(first, second)
            w.canvas.set_ghost(self._bigram.curves)
            w.canvas.set_neighbours(self._neighbours())
            self._activate_drawn_pose()
            self.opened.emit(pair)
        w.picker.set_current(pair)
        self.show_curves()

    def open_at(self, seconds: float) -> None:
        """Open the bigram that sounds at a moment of the sentence."""
        stages = self._session.stages
        if stages is not None and len(stages.schedule) > 1:
            i = int(np.searchsorted(stages.schedule.times, seconds, side="right")) - 1
            i = min(max(i, 0), len(stages.schedule) - 2)
            self.open(stages.schedule.pairs()[i], i)

    def open_swapped(self) -> None:
        """From a-b to b-a."""
        if self.pair is not None:
            self.open(self.pair[::-1])

    def open_next(self, step: int = 1) -> None:
        """The sentence's next bigram, or the previous one with step −1; from the end to the start."""
        stages = self._session.stages
        if stages is not None and stages.schedule.pairs():
            pairs = stages.schedule.pairs()
            at = self.index if self.index is not None else -1 if step > 0 else 0
            i = (at + step) % len(pairs)
            self.open(pairs[i], i)
            self._go_to(float(stages.schedule.times[i]))

    def set_replaced(self) -> None:
        """Another set was opened: all its poses, and the same bigram if it has it, else F-Ah, the paper's example."""
        curve_set = self._document.curve_set
        self.visible, self.locked = set(curve_set.poses), set()
        phones = curve_set.phonemes
        wanted = [self.pair, ("f", "ah"), (phones[0], phones[0]) if phones else None]
        pair = next((p for p in wanted if p is not None and curve_set.has_pair(p)), None)
        self.pair = None
        self.open(pair)

    def _open_from_overlay(self, index: int, seconds: float, pose: str) -> None:
        stages = self._session.stages
        if stages is None:
            return
        self.open(stages.schedule.pairs()[index], index)
        self.activate_pose(pose)
        self._go_to(seconds)

    def open_in_sentence(self, pair: Pair, seconds: float | None) -> None:
        """Open a bigram where the sentence has it nearest to a moment, and go there."""
        stages, index = self._session.stages, None
        if stages is not None and seconds is not None:
            places = [i for i, other in enumerate(stages.schedule.pairs()) if other == pair]
            index = min(places, key=lambda i: abs(stages.schedule.times[i + 1] - seconds), default=None)
        self.open(pair, index)
        if seconds is not None:
            self._go_to(seconds)

    def _go_to(self, seconds: float) -> None:
        if not self._preview.player.playing:
            self._preview.scrub(seconds)

    # ── show ─────────────────────────────────────────────────────────────────────────────────────

    def show_curves(self) -> None:
        """The open bigram's curves as the document has them."""
        w, bigram = self._window, self._bigram
        w.canvas.set_curves(bigram.curves)
        w.pose_list.set_drawn(bigram.curves)
        w.header.set_status(self._document.curve_set.status_of(self.pair) if self.pair is not None else "")
        self.show_place()

    def show_place(self) -> None:
        """Where the sentence has the open bigram, and what the pipeline makes of it there."""
        w, stages = self._window, self._session.stages
        pairs = stages.schedule.pairs() if stages is not None else []
        if self.index is None or self.index >= len(pairs) or pairs[self.index] != self.pair:
            self.index = self._first_index()
        w.stage_panel.set_current(self.index, self.pair)
        w.header.set_usage(pairs.count(self.pair) if stages is not None and self.pair is not None else None)
        w.header.set_example(*self._example())
        boundary, played = place_in(stages, self.index)
        w.canvas.set_boundary(boundary)
        w.canvas.set_played(played)

    def show_playhead(self, seconds: float) -> None:
        """The sentence's time in the canvas, while it is within the open bigram."""
        span = self.span()
        if span is None or not span[0] <= seconds <= span[2]:
            self._window.canvas.set_playhead(None)
        else:
            self._window.canvas.set_playhead((seconds - span[0]) / (span[2] - span[0]))

    def span(self) -> tuple[float, float, float] | None:
        """Start, boundary and end of the open bigram in the sentence, seconds; None when it is not there."""
        return span_in(self._session.stages, self.index)

    @property
    def _bigram(self) -> Bigram:
        nothing = Bigram()
        return self._document.curve_set.bigrams.get(self.pair, nothing) if self.pair is not None else nothing

    def _first_index(self) -> int | None:
        stages = self._session.stages
        pairs = stages.schedule.pairs() if stages is not None else []
        return pairs.index(self.pair) if self.pair in pairs else None

    def _example(self) -> tuple[str, Span]:
        """Where the sentence has the open bigram: its word or words, and the span of its letters."""
        examples = self.examples
        return examples[self.index] if self.index is not None and self.index < len(examples) else ("", (0, 0))

    @property
    def examples(self) -> list[tuple[str, Span]]:
        """For each bigram of the sentence its word or words, and the span of its letters."""
        utterance = self._session.utterance
        if utterance is not self._spelt[0]:
            self._spelt = utterance, in_words(utterance) if utterance is not None else []
        return self._spelt[1]

    def _neighbours(self) -> dict[str, Mapping[str, Curve]]:
        """Similar bigrams by the names that people read, the most similar first."""
        curve_set = self._document.curve_set
        pairs = similar_bigrams(curve_set, self.pair) if self.pair is not None else []
        return {spoken_pair(pair): curve_set.bigrams[pair].curves for pair in pairs}

    def _look_at(self, curves: Mapping[str, Curve]) -> None:
        """While a key is dragged, the face shows its moment."""
        if self.pair is None or self._preview.player.playing or self._preview.bigram_player.playing:
            return
        keys = [(pose, i) for pose, i in self._window.canvas.selection if pose in curves and i < len(curves[pose])]
        if not keys:
            return
        pose, i = min(keys)
        s, span = float(curves[pose].t[i]), self.span()
        if span is not None:
            self._preview.scrub(span[0] + s * (span[2] - span[0]))
        else:
            self._preview.show_bigram(s)

    # ── poses ────────────────────────────────────────────────────────────────────────────────────

    def activate_pose(self, pose: str) -> None:
        """The pose that is edited, in canvas, list and overlay."""
        self._window.canvas.set_active(pose)
        self._window.pose_list.set_active(pose)
        self._window.stage_panel.set_active_pose(pose)
        self.pose_activated.emit(pose)

    def _activate_drawn_pose(self) -> None:
        """A bigram opens with a pose that it moves: the present one if it can be, else the strongest."""
        curves, poses = self._bigram.curves, self._document.curve_set.poses
        drawn = [pose for pose in poses if pose in curves]
        active = self._window.canvas.active
        if drawn and active not in drawn:
            self.activate_pose(max(drawn, key=lambda pose: curves[pose].v.max()))
        elif active in poses:
            self.activate_pose(active)
        elif poses:
            self.activate_pose(poses[0])

    def _visibility_changed(self, pose: str, visible: bool) -> None:
        (self.visible.add if visible else self.visible.discard)(pose)
        self._window.pose_list.set_visible_poses(self.visible)
        self._window.canvas.set_visible_poses(self.visible)
        self.eyes_changed.emit()

    def _lock_changed(self, pose: str, locked: bool) -> None:
        (self.locked.add if locked else self.locked.discard)(pose)
        self._window.pose_list.set_locked(self.locked)
        self._window.canvas.set_locked(self.locked)
        self.eyes_changed.emit()


def span_in(stages: Stages | None, index: int | None) -> tuple[float, float, float] | None:
    """Start, boundary and end of one of the sentence's bigrams, seconds; None when it is not there."""
    if stages is None or index is None or index + 2 >= stages.schedule.times.size:
        return None
    start, middle, end = stages.schedule.times[index : index + 3].tolist()
    return start, middle, end


def place_in(stages: Stages | None, index: int | None) -> tuple[float, Played | None]:
    """Where the boundary of one of the sentence's bigrams is, 0…1, and what the pipeline makes of its poses there."""
    span = span_in(stages, index)
    if stages is None or span is None:
        return 0.5, None
    start, middle, end = span
    played = {}
    for pose in stages.poses:
        track = stages.magenta[pose]
        inside = (track.t > start) & (track.t < end)
        t = np.concatenate(([start], track.t[inside], [end]))
        v = track.at(t)
        if v.any():
            played[pose] = ((t - start) / (end - start), v)
    return (middle - start) / (end - start), played

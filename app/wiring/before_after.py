"""The sentence before the last edit, grey in the overlay, so that the effect of one drag can be seen."""

from __future__ import annotations

from PySide6.QtCore import QObject

from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from core_pipeline.speech.utterance import Utterance

from .parts import Parts


class BeforeAfter(QObject):
    """Keeps the result from before the gesture that is under way, or before the newest undo step.

    It goes with another sentence, and when another bigram is opened.
    """

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._session = parts.session
        self._stack = parts.document.undo_stack
        self._panel = parts.window.stage_panel
        self._settled: Stages | None = None  # the newest result without a gesture
        self._step = -1  # where the undo stack stood then
        self._ghost: Stages | None = None  # what is shown without a gesture
        self._shown: Stages | None = None
        self._utterance: Utterance | None = None
        parts.document.replaced.connect(self._begin)
        parts.session.stages_changed.connect(self._stages_changed)

    def forget(self, _pair: Pair | None = None) -> None:
        """There is no version from before any more."""
        self._ghost = None
        self._show(None)

    def _begin(self) -> None:
        self._utterance, self._settled = None, None
        self.forget()

    def _stages_changed(self, stages: Stages | None) -> None:
        utterance = self._session.utterance
        if utterance is None or utterance is not self._utterance:
            self._utterance, self._settled, self._step = utterance, stages, self._stack.index()
            self.forget()
        elif self._session.in_gesture:
            self._show(self._settled)
        else:
            if self._stack.index() != self._step:  # nudges that are one step have one before
                self._ghost = self._settled
            self._settled, self._step = stages, self._stack.index()
            self._show(self._ghost)

    def _show(self, ghost: Stages | None) -> None:
        if ghost is not self._shown:
            self._shown = ghost
            self._panel.set_ghost(ghost)

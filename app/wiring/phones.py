"""What is said, edited by hand in the overlay's rows: each gesture is one undo step."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from core_pipeline.errors import UserError
from core_pipeline.phonemes import SILENCE
from core_pipeline.pipeline import Stages
from core_pipeline.speech import edit
from core_pipeline.speech.utterance import Utterance

from ..commands import Change
from .parts import Parts
from .sentence import Sentence


class Phones(QObject):
    """Turns the overlay's wishes into edits of the utterance.

    edited()  the utterance differs from what was spoken, aligned or read
    """

    edited = Signal()

    def __init__(self, parts: Parts, sentence: Sentence, parent: QObject) -> None:
        super().__init__(parent)
        self._document = parts.document
        self._session = parts.session
        self._sentence = sentence
        self._window = parts.window
        self._before: Utterance | None = None  # while a boundary is dragged
        overlay = self._window.stage_panel.overlay
        overlay.edge_dragged.connect(self._drag)
        overlay.edge_dropped.connect(self._drop)
        overlay.edge_let_be.connect(self._let_be)
        overlay.phone_renamed.connect(
            lambda i, name: self._edit(lambda u: edit.renamed(u, i, name), self.tr("Rename a phone"))
        )
        overlay.phone_inserted.connect(
            lambda i, name, after: self._edit(
                lambda u: edit.inserted(u, i, name, after=after), self.tr("Insert a phone")
            )
        )
        overlay.phone_removed.connect(lambda i: self._edit(lambda u: edit.removed(u, i), self.tr("Remove a phone")))
        self._document.replaced.connect(self._show_choices)
        self._session.stages_changed.connect(self._show_words)
        self._show_choices()

    def _show_choices(self) -> None:
        curve_set = self._document.curve_set
        names = sorted({*curve_set.phoneme_map, *curve_set.phonemes})
        self._window.stage_panel.overlay.set_phone_choices([*names, SILENCE])

    def _show_words(self, stages: Stages | None) -> None:
        utterance = self._session.utterance if stages is not None else None
        words = utterance.words if utterance is not None else ()
        self._window.stage_panel.set_words([(word.text, word.start, word.end) for word in words])

    # ── boundaries ───────────────────────────────────────────────────────────────────────────────

    def _drag(self, boundary: int, seconds: float) -> None:
        """Show it; the document hears of it when the mouse lets go."""
        if self._before is None:
            self._before = self._session.utterance
        if self._before is not None and boundary < len(self._before.schedule):
            self._session.set_utterance(edit.boundary_moved(self._before, boundary, seconds))

    def _drop(self, boundary: int, seconds: float) -> None:
        before, self._before = self._before or self._session.utterance, None
        if before is None:
            return
        after = edit.boundary_moved(before, boundary, seconds)
        if after is before:
            self._put(before)
        else:
            self._push(before, after, self.tr("Move a boundary"))

    def _let_be(self) -> None:
        before, self._before = self._before, None
        if before is not None:
            self._put(before)

    # ── phones ───────────────────────────────────────────────────────────────────────────────────

    def _edit(self, act: Callable[[Utterance], Utterance], label: str) -> None:
        before = self._session.utterance
        if before is None:
            return
        try:
            after = act(before)
        except UserError as error:
            self._window.hint_label.setText(str(error))
            return
        self._push(before, after, label)

    def _push(self, before: Utterance, after: Utterance, label: str) -> None:
        self._document.push_aside(Change(self._put, before, after, label))

    def _put(self, utterance: Utterance) -> None:
        """Say this; playing goes on when it is the same sound."""
        shown = self._session.utterance
        if shown is not None and shown.audio is utterance.audio and shown.schedule.end == utterance.schedule.end:
            self._session.set_utterance(utterance)
        else:
            self._sentence.take(utterance, play=False)
        self.edited.emit()

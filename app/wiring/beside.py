"""The second canvas brought to life: the swapped pair of the open bigram, or one that stays."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QObject

from core_pipeline.curve_set import Bigram
from core_pipeline.curves import Curve
from core_pipeline.phonemes import Pair

from .canvas_hand import CanvasHand
from .open_bigram import OpenBigram, place_in
from .parts import Parts


class Beside(QObject):
    """Shows and edits one more bigram, through the same document and undo stack.

    pair  the bigram beside; None while there is one canvas only
    """

    def __init__(self, parts: Parts, bigram: OpenBigram, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._document = parts.document
        self._session = parts.session
        self._bigram = bigram
        self._view = parts.window.beside
        self._canvas = self._view.canvas
        self.pair: Pair | None = None
        self._pinned = False
        action, canvas, w = self._window.actions_.beside, self._canvas, self._window
        action.toggled.connect(self._show_or_hide)
        self._view.closed.connect(lambda: action.setChecked(False))
        self._view.pin_toggled.connect(self._pin)
        bigram.opened.connect(lambda _: self._follow())
        bigram.pose_activated.connect(canvas.set_active)
        bigram.eyes_changed.connect(self._show_eyes)
        for view in (w.pose_list, w.canvas, canvas):
            view.solo_wanted.connect(canvas.set_solo)
        canvas.solo_wanted.connect(w.canvas.set_solo)
        canvas.solo_wanted.connect(w.pose_list.set_solo)
        canvas.active_changed.connect(bigram.activate_pose)
        canvas.selection_changed.connect(w.selection_label.setText)
        canvas.hint_changed.connect(w.hint_label.setText)
        CanvasHand(parts, canvas, lambda: self.pair, self._show, self)
        canvas.play_wanted.connect(parts.preview.toggle_sentence)
        w.header.snap_toggled.connect(canvas.set_snap)
        parts.document.replaced.connect(self._replaced)
        parts.document.bigram_changed.connect(self._changed)
        parts.document.settings_changed.connect(self._show_spline)
        parts.session.stages_changed.connect(lambda _: self._show_place())
        self._replaced()

    def _show_or_hide(self, on: bool) -> None:
        self._window.show_beside(on)
        self._pinned = False
        self._open(self._bigram.pair[::-1] if on and self._bigram.pair is not None else None)

    def _pin(self, on: bool) -> None:
        self._pinned = on
        self._follow()
        self._show_title()

    def _follow(self) -> None:
        """The swapped pair of what is open now."""
        if not self._view.isHidden() and not self._pinned and self._bigram.pair is not None:
            self._open(self._bigram.pair[::-1])

    def _open(self, pair: Pair | None) -> None:
        if pair == self.pair:
            return
        self.pair = pair
        self._canvas.set_bigram(*(pair or ("", "")))
        self._canvas.set_ghost(self._curves)
        self._show()

    def _replaced(self) -> None:
        curve_set = self._document.curve_set
        self._canvas.set_poses(curve_set.poses)
        self._canvas.set_active(self._window.canvas.active)
        self._show_spline()
        self.pair, self._pinned = None, False
        self._follow()

    def _changed(self, pair: Pair) -> None:
        if pair == self.pair:
            self._show()

    def _show(self) -> None:
        self._canvas.set_curves(self._curves)
        self._show_title()
        self._show_place()

    def _show_title(self) -> None:
        status = self._document.curve_set.status_of(self.pair) if self.pair is not None else ""
        self._view.set_pair(self.pair, status, pinned=self._pinned)

    def _show_spline(self) -> None:
        self._canvas.set_spline(self._document.curve_set.effective_settings.spline)

    def _show_eyes(self) -> None:
        self._canvas.set_visible_poses(self._bigram.visible)
        self._canvas.set_locked(self._bigram.locked)

    def _show_place(self) -> None:
        stages = self._session.stages
        pairs = stages.schedule.pairs() if stages is not None and self.pair is not None else []
        index = pairs.index(self.pair) if self.pair in pairs else None
        boundary, played = place_in(stages, index)
        self._canvas.set_boundary(boundary)
        self._canvas.set_played(played)

    @property
    def _curves(self) -> Mapping[str, Curve]:
        nothing = Bigram()
        return self._document.curve_set.bigrams.get(self.pair, nothing).curves if self.pair is not None else {}

"""The only place where wishes become commands, and values reach the views."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, QTimer
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QMessageBox

from core_pipeline.curve_set import Bigram
from core_pipeline.curves import Curve
from core_pipeline.diagnose import Weakness, weak_bigrams
from core_pipeline.errors import UserError
from core_pipeline.phonemes import SILENCE, Pair, pair_name
from core_pipeline.pipeline import Stages
from core_pipeline.poses import MEANING
from core_pipeline.settings import Settings
from core_pipeline.speech.utterance import Utterance
from widgets.weak_list import WeakRow

from .preview import BIGRAM_SECONDS
from .speech_worker import SpeechWorker

if TYPE_CHECKING:
    from .editor import Editor

VOICE, RATE = "en-us", 175


class Wiring(QObject):
    """Connects an editor's parts and keeps what belongs to none of them: which bigram is open, and where."""

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        self._document = editor.document
        self._session = editor.session
        self._preview = editor.preview
        self._window = editor.window
        self._files = editor.files
        self._state = editor.state
        self._speech = editor.speech
        self._search = SpeechWorker(editor.speaker, self)  # the phones of a word typed into the picker's search
        self.pair: Pair | None = None
        self.index: int | None = None  # which of the sentence's bigrams is open
        self._play_next = False
        self._shown_ms = ""
        self._late = QTimer(self)  # what may lag a moment behind a drag
        self._late.setSingleShot(True)
        self._late.setInterval(120)
        self._late.timeout.connect(self._show_weak)
        self._caption = QTimer(self)
        self._caption.setInterval(500)
        self._caption.timeout.connect(self._show_caption)
        self._caption.start()
        self._preview.output.ready.connect(self._show_sound)
        self._preview.output.lost.connect(self._show_sound)
        self._connect_document()
        self._connect_canvas()
        self._connect_sentence()
        self._connect_views()
        self._connect_menu()
        self._set_replaced()
        self._show_file()
        self._window.bigram_transport.set_length(BIGRAM_SECONDS)
        self._window.canvas.setFocus()
        self._window.may_close = self._may_close

    # ── connections ──────────────────────────────────────────────────────────────────────────────

    def _connect_document(self) -> None:
        self._document.bigram_changed.connect(self._bigram_changed)
        self._document.settings_changed.connect(self._settings_changed)
        self._document.replaced.connect(self._set_replaced)
        self._document.file_changed.connect(self._show_file)
        self._session.stages_changed.connect(self._stages_changed)
        self._files.autosave.failed.connect(self._say)
        self._files.autosave.saved.connect(self._show_saved)

    def _connect_canvas(self) -> None:
        w = self._window
        w.canvas.preview_changed.connect(self._gesture)
        w.canvas.edited.connect(self._edited)
        w.canvas.cancelled.connect(self._gesture_cancelled)
        w.canvas.active_changed.connect(self._pose_activated)
        w.canvas.selection_changed.connect(self._say)
        w.canvas.hint_changed.connect(w.hint_label.setText)
        w.canvas.play_wanted.connect(self._preview.toggle_bigram)
        w.pose_list.pose_picked.connect(self._pose_activated)
        w.pose_list.visibility_changed.connect(self._visibility_changed)
        w.pose_list.lock_changed.connect(self._lock_changed)
        w.header.snap_toggled.connect(w.canvas.set_snap)
        w.header.frame_all_wanted.connect(w.canvas.frame_all)
        w.bigram_transport.play_toggled.connect(self._preview.toggle_bigram)
        w.bigram_transport.length_changed.connect(self._preview.set_bigram_length)
        self._preview.bigram_player.playing_changed.connect(w.bigram_transport.set_playing)
        w.settings_panel.settings_changed.connect(self._settings_wanted)

    def _connect_sentence(self) -> None:
        w, player = self._window, self._preview.player
        w.sentence_bar.sentence_entered.connect(self.type_sentence)
        self._speech.spoken.connect(self._spoken)
        self._speech.failed.connect(self._not_spoken)
        w.transport.play_toggled.connect(self._preview.toggle_sentence)
        w.transport.stopped.connect(player.pause)
        w.transport.to_start.connect(self._to_start)
        w.transport.loop_toggled.connect(self._set_loop)
        w.transport.speed_changed.connect(player.set_speed)
        player.playing_changed.connect(w.transport.set_playing)
        player.playing_changed.connect(w.stage_panel.set_following)
        self._preview.sentence_moment.connect(self._sentence_moment)

    def _connect_views(self) -> None:
        w = self._window
        w.picker.picked.connect(self.open_bigram)
        w.picker.search_wanted.connect(self._search_word)
        self._search.spoken.connect(self._word_found)
        self._search.failed.connect(self._word_not_found)
        w.weak_list.picked.connect(self._open_weak)
        w.stage_panel.bigram_picked.connect(self._open_from_overlay)
        w.stage_panel.scrubbed.connect(self._preview.scrub)
        w.stage_panel.pose_activated.connect(self._pose_activated)
        w.stage_panel.loop_range_changed.connect(self._set_loop_range)
        self._preview.weights_changed.connect(w.weights.set_weights)
        self._preview.bigram_moment.connect(w.canvas.set_playhead)
        self._preview.frame_ready.connect(self._frame_ready)
        self._preview.failed.connect(self._no_face)
        w.face_view.orbited.connect(self._preview.orbit)
        w.face_view.panned.connect(self._preview.pan)
        w.face_view.zoomed.connect(self._preview.zoom)
        w.face_view.reset_wanted.connect(self._preview.reset_view)
        w.face_view.cutaway_wanted.connect(self._preview.cut_away)
        w.face_view.cutaway_wanted.connect(w.face_view.set_cutaway)
        w.face_view.retry_wanted.connect(self._preview.worker.retry)
        w.face_view.resized.connect(self._preview.resize)

    def _connect_menu(self) -> None:
        a, w = self._window.actions_, self._window
        for action, act in (
            (a.new, self._files.new),
            (a.new_empty, self._files.new_empty),
            (a.open, self._files.ask_open),
            (a.save, self._files.save),
            (a.save_as, self._files.ask_save_as),
            (a.export, self._files.ask_export),
            (a.export_weights, self._files.ask_export_weights),
            (a.quit, w.close),
            (a.find, w.picker.search.setFocus),
            (a.sentence, w.sentence_bar.field.setFocus),
            (a.play, self._preview.toggle_sentence),
            (a.play_bigram, self._preview.toggle_bigram),
            (a.to_start, self._to_start),
            (a.reset_view, self._preview.reset_view),
            (a.about, self._about),
        ):
            action.triggered.connect(lambda _=False, act=act: act())
        a.loop.toggled.connect(self._set_loop)
        a.safe_colours.toggled.connect(w.stage_panel.set_palette_safe)
        a.default_layout.triggered.connect(w.default_layout)
        w.play_wanted.connect(self._preview.toggle_sentence)

    # ── document → views ─────────────────────────────────────────────────────────────────────────

    def _set_replaced(self) -> None:
        curve_set, w = self._document.curve_set, self._window
        w.picker.set_phonemes(curve_set.phonemes)
        w.pose_list.set_poses(curve_set.poses, {p: MEANING[p] for p in curve_set.poses if p in MEANING})
        w.canvas.set_poses(curve_set.poses)
        w.weights.set_poses(curve_set.poses)
        self._locked: set[str] = set()
        self._visible = set(curve_set.poses)
        self._session.set_curve_set(curve_set)
        self._show_settings()
        self._show_statuses()
        pair = self.pair if self.pair is not None and curve_set.has_pair(self.pair) else None
        self.open_bigram(pair or self._first_pair())

    def _first_pair(self) -> Pair | None:
        """F-Ah, the paper's example, or the set's first bigram."""
        if self._document.curve_set.has_pair(("f", "ah")):
            return ("f", "ah")
        phones = self._document.curve_set.phonemes
        return (phones[0], phones[0]) if phones else None

    def _bigram_changed(self, pair: Pair) -> None:
        self._session.set_curve_set(self._document.curve_set)
        self._statuses[pair] = self._document.curve_set.status_of(pair)
        self._show_coverage()
        if pair == self.pair:
            self._show_open()
        else:
            self.open_bigram(pair)  # undo reached another bigram: show what it did

    def _settings_changed(self) -> None:
        self._session.set_curve_set(self._document.curve_set)
        self._show_settings()

    def _show_settings(self) -> None:
        curve_set = self._document.curve_set
        settings = curve_set.effective_settings
        self._window.settings_panel.set_settings(settings, curve_set.poses)
        self._window.canvas.set_spline(settings.spline)

    def _show_statuses(self) -> None:
        curve_set = self._document.curve_set
        self._statuses = {(a, b): curve_set.status_of((a, b)) for a in curve_set.phonemes for b in curve_set.phonemes}
        self._show_coverage()

    def _show_coverage(self) -> None:
        total = len(self._document.curve_set.phonemes) ** 2
        drawn = sum(status != "empty" for pair, status in self._statuses.items() if SILENCE not in pair)
        self._window.picker.set_statuses(self._statuses)
        self._window.picker.set_coverage(self.tr("{0} of {1} bigrams").format(drawn, total), drawn / max(total, 1))

    def _show_file(self) -> None:
        document, w = self._document, self._window
        w.setWindowTitle(f"{document.title}[*] — Lipstitch")
        w.setWindowModified(document.is_dirty)
        if document.read_only_reason:
            text = self.tr("read-only")
        elif document.is_dirty:
            text = self.tr("unsaved changes")
        else:
            text = self.tr("saved") if document.path is not None else self.tr("no changes")
        w.saved_label.setText(text)

    def _show_saved(self) -> None:
        if self._document.is_dirty:
            self._window.saved_label.setText(self.tr("unsaved changes · recovery copy kept"))

    # ── the open bigram ──────────────────────────────────────────────────────────────────────────

    def open_bigram(self, pair: Pair | None, index: int | None = None) -> None:
        """Show a bigram in the canvas; `index` is its place in the sentence, else its first there."""
        changed = pair != self.pair
        self.pair = pair
        self.index = index if index is not None else self._first_index(pair)
        w = self._window
        if changed:
            self._preview.set_pair(pair)
            w.canvas.set_bigram(*(pair or ("", "")))
            w.header.set_bigram(*(pair or ("", "")))
            bigram = self._document.curve_set.bigrams.get(pair) if pair is not None else None
            w.canvas.set_ghost(bigram.curves if bigram is not None else None)
            drawn = [p for p in self._document.curve_set.poses if bigram is not None and p in bigram.curves]
            if drawn and w.canvas.active not in drawn:
                self._pose_activated(max(drawn, key=lambda p: bigram.curves[p].v.max() if bigram else 0.0))
            elif self._document.curve_set.poses and w.canvas.active not in self._document.curve_set.poses:
                self._pose_activated(self._document.curve_set.poses[0])
        w.picker.set_current(pair)
        self._show_open()

    def open_at(self, seconds: float) -> None:
        """Open the bigram that sounds at a moment of the sentence."""
        stages = self._session.stages
        if stages is not None and len(stages.schedule) > 1:
            i = int(np.searchsorted(stages.schedule.times, seconds, side="right")) - 1
            i = min(max(i, 0), len(stages.schedule) - 2)
            self.open_bigram(stages.schedule.pairs()[i], i)

    def _first_index(self, pair: Pair | None) -> int | None:
        stages = self._session.stages
        pairs = stages.schedule.pairs() if stages is not None else []
        return pairs.index(pair) if pair in pairs else None

    def _show_open(self) -> None:
        w, curve_set = self._window, self._document.curve_set
        bigram = curve_set.bigrams.get(self.pair, Bigram()) if self.pair is not None else Bigram()
        w.canvas.set_curves(bigram.curves)
        w.pose_list.set_drawn(bigram.curves)
        w.header.set_status(curve_set.status_of(self.pair) if self.pair is not None else "")
        self._show_place()

    def _show_place(self) -> None:
        """Where the sentence has the open bigram, and what the pipeline makes of it there."""
        w, stages = self._window, self._session.stages
        if stages is not None and self.index is not None and self.index >= len(stages.schedule.pairs()):
            self.index = None
        if stages is not None and self.index is not None and stages.schedule.pairs()[self.index] != self.pair:
            self.index = self._first_index(self.pair)
        w.stage_panel.set_current(self.index, self.pair)
        w.header.set_usage(self._session.used().get(self.pair, 0) if stages is not None and self.pair else None)
        w.header.set_example(self._word())
        if stages is None or self.index is None:
            w.canvas.set_played(None)
            w.canvas.set_boundary(0.5)
            return
        start, middle, end = self._span()
        w.canvas.set_boundary((middle - start) / (end - start))
        played = {}
        for pose in stages.poses:
            track = stages.magenta[pose]
            inside = (track.t > start) & (track.t < end)
            t = np.concatenate(([start], track.t[inside], [end]))
            v = track.at(t)
            if v.any():
                played[pose] = ((t - start) / (end - start), v)
        w.canvas.set_played(played)

    def _span(self) -> tuple[float, float, float]:
        """Start, boundary and end of the open bigram in the sentence, seconds."""
        assert self._session.stages is not None
        assert self.index is not None
        start, middle, end = self._session.stages.schedule.times[self.index : self.index + 3].tolist()
        return start, middle, end

    def _word(self) -> str:
        """The word of the sentence in which the open bigram sounds."""
        utterance = self._session.utterance
        if utterance is None or self.index is None or self._session.stages is None:
            return ""
        _, middle, _ = self._span()
        return next((word.text for word in utterance.words if word.start <= middle <= word.end), "")

    def _open_from_overlay(self, index: int, seconds: float, pose: str) -> None:
        stages = self._session.stages
        if stages is None:
            return
        self.open_bigram(stages.schedule.pairs()[index], index)
        self._pose_activated(pose)
        if not self._preview.player.playing:
            self._preview.scrub(seconds)

    def _open_weak(self, pair: Pair, seconds: float | None) -> None:
        self.open_bigram(pair)
        if seconds is not None and not self._preview.player.playing:
            self._preview.scrub(seconds)

    # ── wishes of the canvas ─────────────────────────────────────────────────────────────────────

    def _gesture(self, curves: Mapping[str, Curve]) -> None:
        """While a key is dragged, overlay and face follow; the document does not change yet."""
        if self.pair is None:
            return
        self._session.set_preview(self.pair, curves)
        if self._preview.player.playing or self._preview.bigram_player.playing:
            return
        keys = [(pose, i) for pose, i in self._window.canvas.selection if pose in curves and i < len(curves[pose])]
        if not keys:
            return
        pose, i = keys[0]
        s = float(curves[pose].t[i])
        if self.index is not None and self._session.stages is not None:
            start, _, end = self._span()
            self._preview.scrub(start + s * (end - start))
        else:
            self._preview.show_bigram(s)

    def _gesture_cancelled(self) -> None:
        if self.pair is not None:
            self._session.set_preview(self.pair, None)

    def _edited(self, curves: Mapping[str, Curve | None], label: str) -> None:
        if self.pair is None:
            return
        try:
            self._document.edit_curves(self.pair, curves, label)
        except UserError as error:
            self._session.set_preview(self.pair, None)
            self._show_open()
            self._say(str(error))

    def _settings_wanted(self, settings: Settings, label: str) -> None:
        try:
            self._document.change_settings(settings, label)
        except UserError as error:
            self._show_settings()
            self._say(str(error))

    def _pose_activated(self, pose: str) -> None:
        self._window.canvas.set_active(pose)
        self._window.pose_list.set_active(pose)
        self._window.stage_panel.set_active_pose(pose)

    def _visibility_changed(self, pose: str, visible: bool) -> None:
        (self._visible.add if visible else self._visible.discard)(pose)
        self._window.pose_list.set_visible_poses(self._visible)
        self._window.canvas.set_visible_poses(self._visible)

    def _lock_changed(self, pose: str, locked: bool) -> None:
        (self._locked.add if locked else self._locked.discard)(pose)
        self._window.pose_list.set_locked(self._locked)
        self._window.canvas.set_locked(self._locked)

    # ── the sentence ─────────────────────────────────────────────────────────────────────────────

    def type_sentence(self, text: str, play: bool = True) -> None:
        """Say something; it is played at once unless `play` is False."""
        self._play_next = play
        if self._window.sentence_bar.sentence != text:
            self._window.sentence_bar.set_sentence(text)
        if text.strip():
            self._speech.request(text, VOICE, RATE)
        else:
            self._preview.player.pause()
            self._session.set_utterance(None)
            self._preview.player.set_utterance(0.0, None)
            self._window.sentence_bar.set_message("")

    def _spoken(self, utterance: Utterance) -> None:
        self.take_utterance(utterance, play=self._play_next)

    def take_utterance(self, utterance: Utterance, *, play: bool) -> None:
        """Make an utterance the sentence."""
        w = self._window
        w.sentence_bar.set_message(" ".join(utterance.notes), "hint")
        if w.sentence_bar.sentence != utterance.text and not w.sentence_bar.field.hasFocus():
            w.sentence_bar.set_sentence(utterance.text)
        self._session.set_utterance(utterance)
        self._preview.player.set_utterance(utterance.schedule.end, utterance.audio)
        self._show_sound()
        w.transport.set_time(self._preview.player.time, self._preview.player.duration)
        w.stage_panel.set_loop_range(None)
        if play:
            self._preview.show_sentence()
            self._preview.player.seek(0.0)
            self._preview.player.play()

    def _not_spoken(self, reason: str) -> None:
        self._window.sentence_bar.set_message(reason, "error")

    def _show_sound(self) -> None:
        """Say so when nothing can be heard, and why."""
        output, utterance = self._preview.output, self._session.utterance
        if utterance is not None and utterance.audio is None:
            state = self.tr("this voice is silent")
        elif output.available:
            state = ""
        else:
            state = self.tr("{0}: playing silently").format(output.reason)
        self._window.transport.set_sound(state)

    def _set_loop(self, on: bool) -> None:
        self._preview.player.set_looping(on)
        self._window.transport.set_loop(on)
        self._window.actions_.loop.setChecked(on)

    def _set_loop_range(self, span: tuple[float, float] | None) -> None:
        player = self._preview.player
        player.set_loop_range(span)
        if span is not None:
            self._set_loop(True)
        self._window.stage_panel.set_loop_range(player.loop_range)

    def _to_start(self) -> None:
        self._preview.scrub(0.0)

    def _sentence_moment(self, seconds: float) -> None:
        w = self._window
        w.transport.set_time(seconds, self._preview.player.duration)
        w.stage_panel.set_playhead(seconds)
        if self._preview.shows_bigram:
            return
        if self.index is None or self._session.stages is None:
            w.canvas.set_playhead(None)
            return
        start, _, end = self._span()
        w.canvas.set_playhead((seconds - start) / (end - start) if start <= seconds <= end else None)

    def _stages_changed(self, stages: Stages | None) -> None:
        w = self._window
        w.stage_panel.set_stages(stages)
        utterance = self._session.utterance
        w.stage_panel.set_source_phones(utterance.schedule.phones if utterance is not None else None)
        if self.index is None:
            self.index = self._first_index(self.pair)
        self._show_place()
        if not self._late.isActive():
            self._late.start()
        if stages is None:
            w.timing_label.setText("")
            w.missing_label.setText("")
            return
        ms = f"{self._session.pipeline_ms:.1f}"
        if ms != self._shown_ms:
            self._shown_ms = ms
            w.timing_label.setText(self.tr("pipeline {0} ms").format(ms))
        names = ", ".join(pair_name(pair) for pair in stages.missing)
        w.missing_label.setText(self.tr("{0} missing").format(len(stages.missing)) if names else "")
        w.missing_label.setToolTip(names)

    def _show_weak(self) -> None:
        w, stages = self._window, self._session.stages
        weak = weak_bigrams(stages, self._session.curve_set) if stages is not None else []
        w.weak_list.set_rows([WeakRow(x.pair, self._why(x), x.time, x.uses, x.severity > 0.2) for x in weak])
        w.picker.set_weak({x.pair: self._why(x) for x in weak if x.severity > 0.2})
        w.picker.set_used(self._session.used())

    def _why(self, weakness: Weakness) -> str:
        if weakness.kind == "slowed":
            return self.tr("{0}: {1} % lost to the speed limit").format(weakness.pose, round(100 * weakness.amount))
        return {
            "missing": self.tr("missing"),
            "flat": self.tr("no curve rises"),
            "unreviewed": self.tr("not reviewed yet"),
        }[weakness.kind]

    # ── search ───────────────────────────────────────────────────────────────────────────────────

    def _search_word(self, text: str) -> None:
        self._search.request(text, VOICE, RATE)

    def _word_found(self, utterance: Utterance) -> None:
        curve_set = self._document.curve_set
        schedule = utterance.schedule.mapped(curve_set.phonemes, curve_set.phoneme_map)
        self._window.picker.set_matches([p for p in schedule.pairs() if SILENCE not in p and curve_set.has_pair(p)])

    def _word_not_found(self, reason: str) -> None:
        self._window.picker.set_matches([])
        self._say(reason)

    # ── the face ─────────────────────────────────────────────────────────────────────────────────

    def _frame_ready(self, image: QImage) -> None:
        self._window.face_view.set_frame(image)

    def _no_face(self, reason: str) -> None:
        self._window.face_view.set_message(reason, retry=True)

    def _show_caption(self) -> None:
        face, ms = self._preview.face, self._preview.milliseconds
        if face is None or not ms:
            return
        width, height = self._preview.frame_size
        self._window.face_view.set_caption(f"{face.title} · {width} × {height} · {ms:.0f} ms")

    # ── the window ───────────────────────────────────────────────────────────────────────────────

    def _say(self, text: str) -> None:
        self._window.selection_label.setText(text)

    def _about(self) -> None:
        QMessageBox.about(
            self._window,
            self.tr("About Lipstitch"),
            self.tr(
                "Lipstitch edits the curves of phone bigrams for lip sync.\n\n"
                "The method is that of Xu, Feng, Marsella and Shapiro, "
                "“A Practical and Configurable Lip Sync Method for Games”, Motion in Games 2013."
            ),
        )

    def _may_close(self) -> bool:
        if not self._files.may_discard():
            return False
        self._files.autosave.clear()
        return True

    def restore(self) -> None:
        """Bring back last time's layout."""
        state, w = self._state, self._window
        w.restore_layout(state.layout("geometry"), state.layout("docks"))
        self._set_loop(state.flag("loop", True))
        w.actions_.safe_colours.setChecked(state.flag("safe colours", False))
        w.transport.set_speed(state.number("speed", 1.0))

    def remember(self) -> None:
        """Keep this time's layout, and stop what this object runs."""
        state, w = self._state, self._window
        state.put("geometry", w.saveGeometry())
        state.put("docks", w.saveState())
        state.put("sentence", w.sentence_bar.sentence)
        state.put("safe colours", w.actions_.safe_colours.isChecked())
        state.put("loop", self._preview.player.looping)
        state.put("speed", self._preview.player.speed)
        self._caption.stop()
        self._late.stop()
        self._search.stop()

"""The only place, with its neighbours, where wishes become commands and values reach the views.

open_bigram.py has the canvas and what belongs to it, sentence.py the sentence and its transport, character.py the
face, company.py those beside it, face_news.py what is said of their reading, face_picker.py their choice, looks.py
light and camera, mapping.py what makes a face's poses, palette.py the command palette, keys.py keymaps and
shortcuts; here is the rest: the document's news, the pipeline's results, settings, search, menus.
"""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMessageBox

from core_pipeline.errors import UserError
from core_pipeline.phone_classes import by_class, by_frequency
from core_pipeline.phonemes import SILENCE, Pair, pair_name
from core_pipeline.pipeline import Stages
from core_pipeline.poses import MEANING
from core_pipeline.settings import Settings
from core_pipeline.speech.utterance import Utterance

from ..exchange import Exchange
from ..preview.preview import BIGRAM_SECONDS
from .before_after import BeforeAfter
from .beside import Beside
from .carrier import Carrier
from .character import Character
from .compare import Compare
from .face_news import FaceNews
from .face_picker import FacePicking
from .keys import KeysOfWindow
from .layers import Layers
from .layouts import Layouts
from .learning import Learning
from .looks import Looks
from .mapping import Mapping
from .notes import Notes
from .open_bigram import OpenBigram
from .other_method import OtherMethod
from .palette import Palette
from .parts import Parts
from .phone_sets import PhoneSets
from .queue import Queue
from .sentence import RATE, Sentence
from .sentences import Sentences
from .speech_in import SpeechIn
from .statistics import Statistics
from .studying import Studying
from .suggesting import Suggesting
from .tabs import Tabs
from .time_spent import TimeSpent
from .tongue import Tongue
from .weak import Weak


class Wiring(QObject):
    """Joins the parts of an editor."""

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._document = parts.document
        self._session = parts.session
        self._preview = parts.preview
        self._window = parts.window
        self._files = parts.files
        self._state = parts.state
        self._search = parts.search
        self._statuses: dict[Pair, str] = {}
        self.exchange = Exchange(parts.files, parts.session)
        self.bigram = OpenBigram(parts, self)
        self.tabs = Tabs(parts, self.bigram, self)
        self.sentence = Sentence(parts, self)
        self.speech_in = SpeechIn(parts, self.sentence, self)
        self.sentences = Sentences(parts, self.sentence, self)
        self.character = Character(parts, self)
        self.face_news = FaceNews(parts, self.character, self)
        self.picking = FacePicking(parts, self.character, self)
        self.looks = Looks(parts, self)
        self.tongue = Tongue(parts, self)
        self.mapping = Mapping(parts, self)
        self.weak = Weak(parts, self.bigram, self.sentence, self)
        self.suggesting = Suggesting(parts, self.bigram, self.weak, self)
        self.carrier = Carrier(parts, self.sentence, self)
        self.queue = Queue(parts, self.bigram, self.weak, self.carrier, self)
        self.time_spent = TimeSpent(parts, self.bigram, self)
        self.compare = Compare(parts, self.bigram, self)
        self.other_method = OtherMethod(parts, self.character.company, self)
        self.learning = Learning(parts, self)
        self.studying = Studying(parts, self)
        self.statistics = Statistics(parts, self.queue, self)
        self.notes = Notes(parts, self.bigram, self)
        self.layers = Layers(parts, self.bigram, self)
        self.phone_sets = PhoneSets(parts, self)
        self.palette = Palette(parts, self.bigram, self.sentence, self)
        self.keys = KeysOfWindow(parts, self)
        self.layouts = Layouts(parts, self.keys.shortcuts, self)
        self.before_after = BeforeAfter(parts, self)
        self.bigram.opened.connect(self.before_after.forget)
        self.queue.frequencies_changed.connect(self._show_orders)
        self._connect_document()
        self.beside = Beside(parts, self.bigram, self)  # after: it follows what the document has told the canvas
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
        self._document.bigrams_changed.connect(self._bigrams_changed)
        self._document.settings_changed.connect(self._settings_changed)
        self._document.replaced.connect(self._set_replaced)
        self._document.file_changed.connect(self._show_file)
        self._session.stages_changed.connect(self._stages_changed)
        self._files.autosave.failed.connect(self._window.hint_label.setText)
        self._files.keeper.failed.connect(self._window.hint_label.setText)
        self._files.autosave.saved.connect(self._show_saved)

    def _connect_views(self) -> None:
        w, preview = self._window, self._preview
        w.canvas.selection_changed.connect(w.selection_label.setText)
        w.canvas.hint_changed.connect(w.hint_label.setText)
        w.canvas.play_wanted.connect(preview.toggle_bigram)
        w.header.snap_toggled.connect(w.canvas.set_snap)
        w.header.polygon_toggled.connect(w.canvas.set_polygon)
        w.header.action_wanted.connect(w.canvas.act)
        w.canvas.keys_changed.connect(w.header.set_keys)
        w.header.set_keys(w.canvas.keys)
        w.bigram_transport.play_toggled.connect(preview.toggle_bigram)
        w.bigram_transport.length_changed.connect(preview.set_bigram_length)
        w.settings_panel.settings_changed.connect(self._settings_wanted)
        w.picker.entered.connect(w.canvas.setFocus)
        w.picker.search_wanted.connect(lambda text: self._search.request(text, self.sentence.voice, RATE))
        self._search.spoken.connect(self._word_found)
        self._search.failed.connect(self._word_not_found)
        preview.bigram_player.playing_changed.connect(w.bigram_transport.set_playing)
        preview.sentence_moment.connect(self._sentence_moment)
        preview.weights_changed.connect(w.weights.set_weights)
        preview.bigram_moment.connect(w.canvas.set_playhead)

    def _connect_menu(self) -> None:
        a, w = self._window.actions_, self._window
        for action, act in (
            (a.new, self._files.new),
            (a.new_empty, self._files.new_empty),
            (a.open, self._files.ask_open),
            (a.save, self._files.save),
            (a.save_as, self._files.ask_save_as),
            (a.new_on_base, self.exchange.ask_new_on_base),
            (a.import_script, self.exchange.ask_import),
            (a.restore, self._files.ask_restore),
            (a.author, self._files.ask_author),
            (a.export, self.exchange.ask_export),
            (a.export_weights, self.exchange.ask_export_weights),
            (a.quit, w.close),
            (a.find, w.picker.search.setFocus),
            (a.sentence, w.sentence_bar.field.setFocus),
            (a.swapped, self.bigram.open_swapped),
            (a.next_bigram, self.bigram.open_next),
            (a.previous_bigram, lambda: self.bigram.open_next(-1)),
            (a.play, self._preview.toggle_sentence),
            (a.play_bigram, self._preview.toggle_bigram),
            (a.to_start, self.sentence.to_start),
            (a.next_part, w.focus_ring.go),
            (a.previous_part, lambda: w.focus_ring.go(-1)),
            (a.about, self._about),
        ):
            action.triggered.connect(lambda _=False, act=act: act())
        a.loop.toggled.connect(self.sentence.set_loop)
        a.safe_colours.toggled.connect(w.stage_panel.set_palette_safe)
        w.play_wanted.connect(self._preview.toggle_sentence)
        w.dropped.connect(self._open_dropped)
        self.character.set_wanted.connect(self._files.new_empty)

    # ── document → views ─────────────────────────────────────────────────────────────────────────

    def _set_replaced(self) -> None:
        curve_set, w = self._document.curve_set, self._window
        self._show_orders()
        w.pose_list.set_poses(curve_set.poses, {p: MEANING[p] for p in curve_set.poses if p in MEANING})
        w.fit_poses()
        w.canvas.set_poses(curve_set.poses)
        w.weights.set_poses(curve_set.poses)
        self._session.set_curve_set(curve_set)
        self._show_settings()
        self._statuses = {(a, b): curve_set.status_of((a, b)) for a in curve_set.phonemes for b in curve_set.phonemes}
        self._show_statuses()
        self.bigram.set_replaced()
        self.character.set_poses(curve_set.poses)

    def _show_orders(self) -> None:
        """In which orders the picker can show the phones."""
        phones = self._document.curve_set.phonemes
        self._window.picker.set_orders(
            {
                self.tr("As in the set"): phones,
                self.tr("By class"): by_class(phones),
                self.tr("By frequency"): by_frequency(phones, self.queue.shares),
            }
        )

    def _bigram_changed(self, pair: Pair) -> None:
        curve_set = self._document.curve_set
        self._session.set_curve_set(curve_set)
        self._statuses[pair] = curve_set.status_of(pair)
        self._show_statuses()
        if pair == self.bigram.pair:
            self.bigram.show_curves()
        elif pair != self.beside.pair:
            self.bigram.open(pair)  # undo reached another bigram: show what it did

    def _bigrams_changed(self) -> None:
        curve_set = self._document.curve_set
        self._session.set_curve_set(curve_set)
        self._statuses = {pair: curve_set.status_of(pair) for pair in self._statuses}
        self._show_statuses()
        self.bigram.show_curves()

    def _settings_changed(self) -> None:
        self._session.set_curve_set(self._document.curve_set)
        self._show_settings()

    def _settings_wanted(self, settings: Settings, label: str) -> None:
        try:
            self._document.change_settings(settings, label)
        except UserError as error:
            self._show_settings()
            self._window.hint_label.setText(str(error))

    def _show_settings(self) -> None:
        curve_set = self._document.curve_set
        settings = curve_set.effective_settings
        self._window.settings_panel.set_settings(settings, curve_set.poses)
        self._window.canvas.set_spline(settings.spline)

    def _show_statuses(self) -> None:
        self._window.picker.set_statuses(self._statuses)

    def _show_file(self) -> None:
        document, w = self._document, self._window
        w.setWindowTitle(f"{document.title}[*] — Lipstitch")
        w.setWindowModified(document.is_dirty)
        if document.read_only_reason:
            text = self.tr("read-only")
            w.hint_label.setText(document.read_only_reason)
        elif document.is_dirty:
            text = self.tr("unsaved changes")
        else:
            text = self.tr("saved") if document.path is not None else self.tr("no changes")
        w.saved_label.setText(text)
        w.saved_label.setToolTip(document.read_only_reason)

    def _show_saved(self) -> None:
        if self._document.is_dirty:
            self._window.saved_label.setText(self.tr("unsaved changes · recovery copy kept"))

    # ── pipeline → views ─────────────────────────────────────────────────────────────────────────

    def _stages_changed(self, stages: Stages | None) -> None:
        w, utterance = self._window, self._session.utterance
        w.stage_panel.set_stages(stages)
        w.stage_panel.set_source_phones(utterance.schedule.phones if utterance is not None else None)
        self.bigram.show_place()
        if stages is None:
            w.timing_label.setText("")
            w.missing_label.setText("")
            return
        w.timing_label.setText(self.tr("pipeline {0:.1f} ms").format(self._session.pipeline_ms))
        names = ", ".join(pair_name(pair) for pair in stages.missing)
        w.missing_label.setText(self.tr("{0} missing").format(len(stages.missing)) if names else "")
        w.missing_label.setToolTip(names)

    def _sentence_moment(self, seconds: float) -> None:
        w = self._window
        w.transport.set_time(seconds, self._preview.player.duration)
        w.stage_panel.set_playhead(seconds)
        if not self._preview.shows_bigram:
            self.bigram.show_playhead(seconds)

    # ── search ───────────────────────────────────────────────────────────────────────────────────

    def _word_found(self, utterance: Utterance) -> None:
        curve_set = self._document.curve_set
        schedule = utterance.schedule.mapped(curve_set.phonemes, curve_set.phoneme_map)
        self._window.picker.set_matches([p for p in schedule.pairs() if SILENCE not in p and curve_set.has_pair(p)])

    def _word_not_found(self, reason: str) -> None:
        self._window.picker.set_matches([])
        self._window.hint_label.setText(reason)

    # ── the window ───────────────────────────────────────────────────────────────────────────────

    def _open_dropped(self, path: Path) -> None:
        """Something spoken, a curve set, a diphone script, or else a face."""
        if self.speech_in.take(path):
            return
        if path.suffix.lower() == ".py":
            self.exchange.import_script(path)
        elif path.suffix.lower() != ".json":
            self.character.open(path)
        elif self._files.may_discard():
            self._files.open(path)

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
        if not self._files.may_discard() or not self.mapping.may_close() or not self.speech_in.may_close():
            return False
        self._files.autosave.clear()
        return True

    def restore(self) -> None:
        """Bring back last time's layout."""
        state, w = self._state, self._window
        w.restore_layout(state.layout("geometry"), state.layout("docks"))
        w.picker.set_order(state.text("order of phones"))
        w.actions_.safe_colours.setChecked(state.flag("safe colours", False))
        self.keys.restore()
        self.looks.restore()
        self.character.restore()
        self.sentence.set_loop(state.flag("loop", True))
        w.voice_bar.set_speed(state.number("speed", 1.0))
        self._preview.player.set_speed(state.number("speed", 1.0))
        self.sentence.set_voice(state.text("voice"))
        self.speech_in.restore()

    def remember(self) -> None:
        """Keep this time's layout."""
        state, w, player = self._state, self._window, self._preview.player
        self.character.remember()
        self.looks.remember()
        self.picking.close()
        self.mapping.close()
        self.sentences.remember()
        state.put("geometry", w.saveGeometry())
        state.put("docks", w.docks_state())
        state.put("order of phones", w.picker.order_name)
        state.put("sentence", w.sentence_bar.sentence)
        state.put("safe colours", w.actions_.safe_colours.isChecked())
        state.put("loop", player.looping)
        state.put("speed", player.speed)
        state.put("voice", self.sentence.voice)
        self.speech_in.close()
        self.weak.close()
        self.carrier.close()
        self.time_spent.close()
        self.other_method.close()
        self.learning.close()
        self.studying.close()

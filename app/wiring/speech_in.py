"""Every way in but typing: recordings, label files, the microphone; how the voice speaks; the phoneme map."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog

from core_pipeline.files import phoneme_map_json
from core_pipeline.files.atomic import open_to_read
from core_pipeline.files.phoneme_map_json import PhonemeMap
from core_pipeline.phonemes import SILENCE
from core_pipeline.speech.utterance import Utterance
from widgets.speech.assign_dialog import AssignDialog

from .. import resources
from ..phoneme_maps import check_fits
from ..workers.live_worker import Heard, LiveWorker, microphones
from .parts import Parts
from .phones import Phones
from .recording import Recording
from .sentence import Sentence

_MAPS = "Phoneme maps (*.json)"


class SpeechIn(QObject):
    """Joins the panels of speech with the rest."""

    def __init__(self, parts: Parts, sentence: Sentence, parent: QObject) -> None:
        super().__init__(parent)
        self._parts = parts
        self._window = parts.window
        self._sentence = sentence
        self.phones = Phones(parts, sentence, self)
        self.recording = Recording(parts, sentence, self.phones, self)
        self.live = LiveWorker(self)
        self._connect_voice()
        self._connect_live()
        actions = self._window.actions_
        actions.open_recording.triggered.connect(self.recording.ask_open)
        actions.open_labels.triggered.connect(self.recording.ask_labels)
        actions.save_utterance.triggered.connect(self.recording.ask_save)
        actions.live.triggered.connect(self._show_live)

    def take(self, path: Path) -> bool:
        """Open what was dropped, if it is of ours; whether it was."""
        if path.suffix.lower() == ".json" and _is_map(path):
            self._parts.files.attempt(lambda: self._use_map(phoneme_map_json.load(path)))
            return True
        return self.recording.take(path)

    def may_close(self) -> bool:
        """Whether the window may close."""
        return self.recording.may_discard()

    def restore(self) -> None:
        """Last time's rate and pitch."""
        state = self._parts.state
        self._sentence.rate = round(min(max(state.number("rate", self._sentence.rate), 80), 450))
        self._sentence.pitch = round(min(max(state.number("pitch", self._sentence.pitch), 0), 99))
        self._window.voice_panel.set_voice(self._sentence.rate, self._sentence.pitch)

    def close(self) -> None:
        """Remember, and stop what this object runs."""
        self._parts.state.put("rate", self._sentence.rate)
        self._parts.state.put("pitch", self._sentence.pitch)
        self.recording.close()
        self.live.close()

    # ── voice and phoneme map ────────────────────────────────────────────────────────────────────

    def _connect_voice(self) -> None:
        panel = self._window.voice_panel
        panel.set_voice(self._sentence.rate, self._sentence.pitch)
        panel.rate_changed.connect(lambda value: self._speak_anew("rate", value))
        panel.pitch_changed.connect(lambda value: self._speak_anew("pitch", value))
        panel.map_chosen.connect(self._choose_map)
        panel.map_edit_wanted.connect(self._edit_map)
        panel.map_open_wanted.connect(self._open_map)
        self._maps = [(path, phoneme_map_json.load(path)) for path in resources.phoneme_maps()]
        self._parts.document.replaced.connect(self._show_maps)
        self._show_maps()

    def _speak_anew(self, what: str, value: int) -> None:
        setattr(self._sentence, what, value)
        self._sentence.type(self._window.sentence_bar.sentence)

    def _show_maps(self) -> None:
        curve_set = self._parts.document.curve_set
        fitting = [(path, m) for path, m in self._maps if set(m.phonemes) <= set(curve_set.phonemes)]
        current = next((path.stem for path, m in fitting if dict(m.table) == dict(curve_set.phoneme_map)), "")
        self._window.voice_panel.set_maps([(path.stem, m.name, m.note) for path, m in fitting], current)

    def _choose_map(self, name: str) -> None:
        found = next((m for path, m in self._maps if path.stem == name), None)
        if found is not None:
            self._parts.files.attempt(lambda: self._use_map(found))
        self._show_maps()

    def _open_map(self) -> None:
        name, _ = QFileDialog.getOpenFileName(self._window, self.tr("Open a phoneme map"), "", _MAPS)
        if name:
            self._parts.files.attempt(lambda: self._use_map(phoneme_map_json.load(name)))

    def _edit_map(self) -> None:
        curve_set = self._parts.document.curve_set
        choices = [*((phone, phone) for phone in curve_set.phonemes), (SILENCE, self.tr("silence"))]
        dialog = AssignDialog(
            self.tr("Phoneme map"),
            self.tr("Which phone of the voice counts as which phoneme of the curves. One undo step takes it back."),
            (self.tr("Phone"), self.tr("Phoneme")),
            dict(sorted(curve_set.phoneme_map.items())),
            choices,
            self._window,
        )
        if dialog.exec():
            table = PhonemeMap(self.tr("edited"), curve_set.phonemes, dialog.answers)
            self._parts.files.attempt(lambda: self._use_map(table))

    def _use_map(self, found: PhonemeMap) -> None:
        """One undo step; UserError when it does not fit the set."""
        document = self._parts.document
        check_fits(document.curve_set, found)
        if dict(found.table) != dict(document.curve_set.phoneme_map):
            label = self.tr("Use the phoneme map “{0}”").format(found.name)
            document.change_set(replace(document.curve_set, phoneme_map=found.table), label)

    # ── live ─────────────────────────────────────────────────────────────────────────────────────

    def _connect_live(self) -> None:
        panel, live = self._window.live_panel, self.live
        panel.start_wanted.connect(self._listen)
        panel.replay_wanted.connect(self._replay)
        panel.stop_wanted.connect(live.stop)
        panel.record_wanted.connect(self._record)
        live.heard.connect(self._heard)
        self._window.live_dock.visibilityChanged.connect(self._look_for_microphones)
        live.ended.connect(self._ended)
        self._parts.session.stages_changed.connect(lambda _: live.set_curve_set(self._parts.session.curve_set))

    def _show_live(self) -> None:
        """The dock, with the microphones that are there now."""
        dock = self._window.live_dock
        dock.show()
        dock.raise_()
        self._look_for_microphones(True)

    def _look_for_microphones(self, visible: bool) -> None:
        if visible and not self.live.running:
            self._window.live_panel.set_devices(*microphones())

    def _listen(self, device: int | None) -> None:
        self._begin()
        self.live.listen(device, self._parts.session.curve_set)

    def _replay(self) -> None:
        audio = self.recording.audio
        if audio is None:
            return
        self._begin()
        self._parts.preview.output.play(audio, 0.0, audio.duration, 1.0, None)
        self.live.replay(audio, self._parts.session.curve_set)

    def _begin(self) -> None:
        self._parts.preview.player.pause()
        self._parts.preview.show_sentence()
        self._window.live_panel.set_message("")
        self._window.live_panel.set_running(True)

    def _heard(self, heard: Heard) -> None:
        """40 ms more: the face says them."""
        if not self.live.running:
            return
        preview, moment = self._parts.preview, heard.moment
        preview.show_pose(dict(zip(self._parts.session.curve_set.poses, moment.weights.tolist(), strict=False)))
        latency = heard.latency + preview.milliseconds / 1000
        self._window.live_panel.set_moment(moment.phone, latency, moment.cost / 0.04, heard.loudness)

    def _ended(self, reason: str) -> None:
        self._parts.preview.output.stop()
        self._parts.preview.show_pose({})
        self._window.live_panel.set_running(False)
        self._window.live_panel.set_message(reason)

    def _record(self) -> None:
        """What was said becomes the sentence."""
        said: Utterance | None = self.live.recorded()
        if said is None:
            self._window.live_panel.set_message(self.tr("No speech was heard yet."))
        elif self.recording.may_discard():
            self.live.stop()
            self._sentence.take(said, play=False)


def _is_map(path: Path) -> bool:
    try:
        with open_to_read(path) as file:
            return phoneme_map_json.SCHEMA.encode() in file.read(2000)
    except OSError:
        return False

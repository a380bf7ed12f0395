"""The sentence: typed, spoken, played, looped and scrubbed."""

from __future__ import annotations

from PySide6.QtCore import QObject

from core_pipeline.speech.espeak import ALL_VOICES, PITCH
from core_pipeline.speech.utterance import Utterance

from .. import resources
from ..pinned import Pinned
from .parts import Parts

#: Words per minute.
RATE = 175


class Sentence(QObject):
    """Turns what is typed into an utterance, and the transport's wishes into playing.

    pinned  the sentences that are kept
    voice   who speaks, one of ALL_VOICES; rate, pitch: how
    """

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._session = parts.session
        self._preview = parts.preview
        self._player = parts.preview.player
        self._speech = parts.speech
        self._window = parts.window
        self._play_next = False
        self.voice = next(iter(ALL_VOICES))
        self.rate, self.pitch = RATE, PITCH
        self.pinned = Pinned(parts.state, resources.TEST_SENTENCES, self)
        w, player = self._window, self._player
        w.sentence_bar.sentence_entered.connect(self.type)
        self._speech.spoken.connect(self._spoken)
        self._speech.failed.connect(lambda reason: w.sentence_bar.set_message(reason, "error"))
        w.voice_bar.set_voices(ALL_VOICES)
        w.voice_bar.voice_chosen.connect(self._choose_voice)
        w.transport.play_toggled.connect(self._preview.toggle_sentence)
        w.transport.stopped.connect(self._stop)
        w.transport.to_start.connect(self.to_start)
        w.transport.loop_toggled.connect(self.set_loop)
        w.voice_bar.speed_changed.connect(player.set_speed)
        w.stage_panel.scrubbed.connect(lambda seconds: self._preview.scrub(seconds, aloud=True))
        w.stage_panel.loop_range_changed.connect(self._set_loop_range)
        player.playing_changed.connect(w.transport.set_playing)
        player.playing_changed.connect(w.stage_panel.set_following)
        self._preview.output.ready.connect(self._show_sound)
        self._preview.output.lost.connect(self._show_sound)

    def type(self, text: str, play: bool = True) -> None:
        """Say something; it is played at once unless `play` is False."""
        bar = self._window.sentence_bar
        self._play_next = play
        if bar.sentence != text:
            bar.set_sentence(text)
        if text.strip():
            self._speech.request(text, self.voice, self.rate, self.pitch)
            return
        self._player.set_utterance(0.0, None)
        self._session.set_utterance(None)
        self._window.transport.set_time(0.0, 0.0)
        bar.set_message("")

    def _spoken(self, utterance: Utterance) -> None:
        self.take(utterance, play=self._play_next)

    def take(self, utterance: Utterance, *, play: bool) -> None:
        """Make an utterance the sentence."""
        w = self._window
        w.sentence_bar.set_message(" ".join(utterance.notes), "hint")
        if w.sentence_bar.sentence != utterance.text and not w.sentence_bar.field.hasFocus():
            w.sentence_bar.set_sentence(utterance.text)
        self._session.set_utterance(utterance)
        self._player.set_utterance(utterance.schedule.end, utterance.audio)
        w.transport.set_time(self._player.time, self._player.duration)
        w.stage_panel.set_loop_range(None)
        self._show_sound()
        if play:
            self._preview.show_sentence()
            self._player.play()

    def set_voice(self, name: str) -> None:
        """Who speaks the next sentence; a voice that is not there changes nothing."""
        if name in ALL_VOICES:
            self.voice = name
            self._window.voice_bar.set_voice(name)

    def _choose_voice(self, name: str) -> None:
        """Another voice says the same again."""
        self.set_voice(name)
        self.type(self._window.sentence_bar.sentence)

    def to_start(self) -> None:
        """Go to the start, playing or not."""
        self._preview.scrub(0.0)

    def _stop(self) -> None:
        self._player.pause()
        self.to_start()

    def set_loop(self, on: bool) -> None:
        """Begin again at the end, or not."""
        self._player.set_looping(on)
        self._window.transport.set_loop(on)
        self._window.actions_.loop.setChecked(on)

    def _set_loop_range(self, span: tuple[float, float] | None) -> None:
        self._player.set_loop_range(span)
        if span is not None:
            self.set_loop(True)
        self._window.stage_panel.set_loop_range(self._player.loop_range)

    def _show_sound(self) -> None:
        """Say so when nothing can be heard, and why."""
        output, utterance = self._preview.output, self._session.utterance
        if utterance is not None and utterance.audio is None:
            state = self.tr("this voice is silent")
        elif output.available:
            state = ""
        else:
            state = self.tr("{0}: playing silently").format(output.reason)
        self._window.voice_bar.set_sound(state)

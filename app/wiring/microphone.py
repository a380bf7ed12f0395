"""The microphone, or the open recording as if it came from there: the face says it while it is heard."""

from __future__ import annotations

from PySide6.QtCore import QObject

from core_pipeline.speech.utterance import Utterance

from ..workers.live_worker import Heard, LiveWorker, microphones
from .parts import Parts
from .recording import Recording
from .sentence import Sentence


class Microphone(QObject):
    """Joins the microphone's panel, the worker that listens, and the face."""

    def __init__(self, parts: Parts, sentence: Sentence, recording: Recording, parent: QObject) -> None:
        super().__init__(parent)
        self._dock = parts.window.live_dock
        self._panel = parts.window.live_panel
        self._session = parts.session
        self._preview = parts.preview
        self._sentence = sentence
        self._recording = recording
        self.worker = LiveWorker(self)
        parts.window.actions_.live.triggered.connect(self._show_live)
        panel, live = self._panel, self.worker
        panel.start_wanted.connect(self._listen)
        panel.replay_wanted.connect(self._replay)
        panel.stop_wanted.connect(live.stop)
        panel.record_wanted.connect(self._record)
        live.heard.connect(self._heard)
        self._dock.visibilityChanged.connect(self._look_for_microphones)
        live.ended.connect(self._ended)
        self._session.stages_changed.connect(lambda _: live.set_curve_set(self._session.curve_set))

    def close(self) -> None:
        """Stop listening."""
        self.worker.close()

    def _show_live(self) -> None:
        """The dock, with the microphones that are there now."""
        self._dock.show()
        self._dock.raise_()
        self._look_for_microphones(True)

    def _look_for_microphones(self, visible: bool) -> None:
        if visible and not self.worker.running:
            self._panel.set_devices(*microphones())

    def _listen(self, device: int | None) -> None:
        self._begin()
        self.worker.listen(device, self._session.curve_set)

    def _replay(self) -> None:
        audio = self._recording.audio
        if audio is None:
            return
        self._begin()
        self._preview.output.play(audio, 0.0, audio.duration, 1.0, None)
        self.worker.replay(audio, self._session.curve_set)

    def _begin(self) -> None:
        self._preview.player.pause()
        self._preview.show_sentence()
        self._panel.set_message("")
        self._panel.set_running(True)

    def _heard(self, heard: Heard) -> None:
        """40 ms more: the face says them."""
        if not self.worker.running:
            return
        preview, moment = self._preview, heard.moment
        preview.show_pose(dict(zip(self._session.curve_set.poses, moment.weights.tolist(), strict=False)))
        latency = heard.latency + preview.milliseconds / 1000
        self._panel.set_moment(moment.phone, latency, moment.cost / 0.04, heard.loudness)

    def _ended(self, reason: str) -> None:
        self._preview.output.stop()
        self._preview.show_pose({})
        self._panel.set_running(False)
        self._panel.set_message(reason)

    def _record(self) -> None:
        """What was said becomes the sentence."""
        said: Utterance | None = self.worker.recorded()
        if said is None:
            self._panel.set_message(self.tr("No speech was heard yet."))
        elif self._recording.may_discard():
            self.worker.stop()
            self._sentence.take(said, play=False)

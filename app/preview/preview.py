"""What the faces show: the sentence at a moment, or one bigram alone, seen from where the user turned them."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QImage

from core_pipeline.faces.face import Face
from core_pipeline.faces.looks import Angle, Look
from core_pipeline.faces.view import View
from core_pipeline.phonemes import Pair

from ..audio_output import AudioOutput
from ..player import Player
from ..session import Session
from .cast import Actor, Cast, Source, Weights
from .render_worker import RenderWorker
from .turntable import Turntable

#: A bigram plays over this long by default, in seconds (two phones of average length).
BIGRAM_SECONDS = 0.4
#: Seconds between the pictures of a blink when nothing else moves.
BLINK_FRAME = 0.033
#: While a key is dragged the face is drawn this often: software OpenGL takes every core, and the hand comes first.
GESTURE_SECONDS = 0.04


class Preview(QObject):
    """Joins the two players, the session's weights and the renderer.

    weights_changed(array)     (poses,) what the face shows now
    bigram_moment(float|None)  normalised time of the open bigram, while it is shown
    sentence_moment(float)     seconds
    frame_ready(QImage)        a drawn face
    failed(str)                why no face can be drawn
    pose_held(bool)            whether the face holds a pose, whatever the sentence says
    """

    weights_changed = Signal(object)
    bigram_moment = Signal(object)
    sentence_moment = Signal(float)
    frame_ready = Signal(QImage)
    failed = Signal(str)
    pose_held = Signal(bool)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.output = AudioOutput(self)
        self.player = Player(self.output, parent=self)
        self.bigram_player = Player(parent=self)
        self.bigram_player.set_utterance(BIGRAM_SECONDS, None)
        self.bigram_player.set_looping(True)
        self.pair: Pair | None = None
        self._bigram_time: float | None = None  # normalised; None: the sentence is shown
        self._held: dict[str, float] = {}  # pose → weight, shown while nothing plays and nothing is edited
        self._size = (512, 512)
        self._cast = Cast()
        self._look = Look()
        self._ms: list[float] = []
        self.worker = RenderWorker(self)
        self.worker.frame.connect(self._frame)
        self.worker.failed.connect(self.failed)
        self._turn = QTimer(self)  # many causes in one turn of the event loop, one picture
        self._turn.setSingleShot(True)
        self._turn.timeout.connect(self._show)
        self._lively = True
        self._clock = time.monotonic
        self._life = QTimer(self)  # wakes a face at rest for its next blink
        self._life.setSingleShot(True)
        self._life.timeout.connect(self.refresh)
        self.turntable = Turntable(parent=self)
        self.turntable.turned.connect(self._turned)
        self._asked = 0.0  # when the face was last asked for, on the monotonic clock
        session.stages_changed.connect(self._stages_changed)
        self.player.time_changed.connect(self._sentence_time)
        self.bigram_player.time_changed.connect(self._bigram_time_changed)

    def start(self) -> None:
        """Start drawing, and look for a loudspeaker."""
        self.output.open()
        self.worker.start()
        self.refresh()

    def stop(self) -> None:
        """Stop playing and drawing; waits for the thread."""
        self._life.stop()
        self.turntable.set_on(False)
        self.player.pause()
        self.bigram_player.pause()
        self.output.close()
        self.worker.stop()

    # ── what is shown ────────────────────────────────────────────────────────────────────────────

    def set_actors(self, actors: Sequence[Actor]) -> None:
        """Show these faces side by side, from left to right; one that was shown before is seen as before."""
        self._cast.set_actors(actors)
        self.refresh()

    def set_face(self, face: Face) -> None:
        """Show another character in the first place."""
        self.set_actors((Actor(face), *self.actors[1:]))

    def set_pose_map(self, poses: Mapping[str, Mapping[str, float]]) -> None:
        """Let the first character make its poses from other shapes, seen as before: pose → {shape: amount}."""
        if self.actors:
            first, *others = self.actors
            self.set_actors((replace(first, face=replace(first.face, pose_map=poses)), *others))

    def show_pose(self, weights: Mapping[str, float]) -> None:
        """Hold some poses, pose → weight, until something plays, is scrubbed or edited; {} lets go at once."""
        if weights == self._held:
            return
        if weights:
            self.player.pause()
            self.bigram_player.pause()
        self._held = dict(weights)
        self.pose_held.emit(bool(weights))
        self.refresh()

    @property
    def actors(self) -> tuple[Actor, ...]:
        """Who is in the picture, from left to right."""
        return self._cast.actors

    @property
    def views(self) -> tuple[View, ...]:
        """Where each actor is seen from."""
        return self._cast.views

    @property
    def face(self) -> Face | None:
        """The first character."""
        return self.actors[0].face if self.actors else None

    @property
    def shows_bigram(self) -> bool:
        """Whether the open bigram is shown alone, not the sentence."""
        return self._bigram_time is not None

    def show_sentence(self) -> None:
        """Show the sentence at the player's time."""
        self.show_pose({})
        if self._bigram_time is not None:
            self._bigram_time = None
            self.bigram_player.pause()
            self.bigram_moment.emit(None)
        self.refresh()

    def show_bigram(self, s: float) -> None:
        """Show the open bigram alone at normalised time s."""
        self.show_pose({})
        self.player.pause()
        self._bigram_time = s
        self.bigram_moment.emit(s)
        self.refresh()

    def set_pair(self, pair: Pair | None) -> None:
        """The bigram that is open."""
        self.pair = pair
        if pair is None:
            self.show_sentence()
        self.refresh()

    def toggle_sentence(self) -> None:
        """Play or pause the sentence; from the start when it is at its end."""
        if self.player.playing:
            self.player.pause()
            return
        self.show_sentence()
        if self.player.time >= self.player.duration - 1e-3:
            self.player.seek(0.0)
        self.player.play()

    def toggle_bigram(self) -> None:
        """Play or stop the open bigram alone."""
        if self.bigram_player.playing:
            self.bigram_player.pause()
            self.show_sentence()
        elif self.pair is not None:
            self.player.pause()
            self.bigram_player.seek(0.0)
            self.bigram_player.play()

    def set_bigram_length(self, seconds: float) -> None:
        """How long the open bigram takes when it is played alone."""
        playing = self.bigram_player.playing
        self.bigram_player.set_utterance(seconds, None)
        if playing:
            self.bigram_player.play()

    def scrub(self, seconds: float, *, aloud: bool = False) -> None:
        """Show the sentence at another moment; `aloud`: what sounds there is heard, too."""
        self.show_sentence()
        self.player.scrub(seconds) if aloud else self.player.seek(seconds)

    def set_lively(self, on: bool) -> None:
        """Blink and move the brows a little, or keep still."""
        self._lively = on
        self.refresh()

    # ── camera and light ─────────────────────────────────────────────────────────────────────────

    def set_look(self, look: Look) -> None:
        """Another background and light."""
        self._look = look
        self.refresh()

    def set_angle(self, angle: Angle) -> None:
        """See all faces from there."""
        self._cast.set_angle(angle)
        self.refresh()

    def orbit(self, dx: float, dy: float) -> None:
        """Turn the faces by a drag in pixels."""
        self._cast.orbit(dx, dy)
        self.refresh()

    def zoom(self, steps: float) -> None:
        """Come nearer by notches of the wheel."""
        self._cast.zoom(steps)
        self.refresh()

    def pan(self, dx: float, dy: float) -> None:
        """Shift the faces by a drag in pixels."""
        self._cast.pan(dx, dy, self._size)
        self.refresh()

    def cut_away(self, index: int, on: bool) -> None:
        """Hide the near half of one head and look in from the side, so that the tongue can be seen."""
        self._cast.cut_away(index, on)
        self.refresh()

    def _turned(self, degrees: float) -> None:
        self._cast.turn(degrees)
        self.refresh()

    def resize(self, width: int, height: int) -> None:
        """Draw for a view of this many pixels."""
        self._size = (max(width, 16), max(height, 16))
        self.refresh()

    def refresh(self) -> None:
        """Draw again at the next turn of the event loop; during a gesture the hand comes first."""
        if not self._turn.isActive():
            wait = GESTURE_SECONDS - (time.monotonic() - self._asked) if self._session.in_gesture else 0.0
            self._turn.start(max(0, round(wait * 1000)))

    @property
    def milliseconds(self) -> float:
        """Median drawing time of the last frames; 0 before the first."""
        return float(np.median(self._ms)) if self._ms else 0.0

    @property
    def frame_size(self) -> tuple[int, int]:
        """Pixels of a frame, (width, height)."""
        return self._size

    def _stages_changed(self) -> None:
        self.show_pose({})
        self.refresh()

    def _sentence_time(self, seconds: float) -> None:
        self.sentence_moment.emit(seconds)
        if self._bigram_time is None:
            self.refresh() if self._session.in_gesture else self._show()

    def _bigram_time_changed(self, seconds: float) -> None:
        if not self.bigram_player.playing:
            return
        self._bigram_time = min(seconds / max(self.bigram_player.duration, 1e-6), 1.0)
        self.bigram_moment.emit(self._bigram_time)
        self._show()

    def _show(self) -> None:
        self._turn.stop()
        playing = self.player.playing or self.bigram_player.playing
        if playing:
            self.show_pose({})
        shown = self._weights(self._session)
        self.weights_changed.emit(shown)
        if not self.actors:
            return
        self._asked = time.monotonic()
        alone = self.shows_bigram and not self._held
        seconds = self._bigram_time if alone and self._bigram_time is not None else self.player.time
        spoken = []
        for actor in self.actors:
            source = actor.source if actor.source is not None and not self._held else self._session
            spoken.append((source.poses, shown if source is self._session else self._weights(source)))
        now = self._clock()
        figures = self._cast.figures(spoken, now if self._lively else None, playing)
        if self._lively:
            self._life.start(max(1, round(self._cast.next_life(now, BLINK_FRAME) * 1000)))
        self.worker.request(figures, self._size, seconds, self._look)

    def _weights(self, source: Source) -> Weights:
        """(poses,) of a source now. One without bigrams shows the sentence where a bigram is shown alone."""
        if self._held:
            return np.array([self._held.get(pose, 0.0) for pose in source.poses])
        if self._bigram_time is not None and self.pair is not None:
            weights = source.bigram_weights_at(self.pair, self._bigram_time)
            if weights is not None:
                return weights
        return source.weights_at(self.player.time)

    def _frame(self, image: QImage, _seconds: float, milliseconds: float) -> None:
        self._ms = [*self._ms[-29:], milliseconds]
        self.frame_ready.emit(image)

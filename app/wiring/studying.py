"""The blind comparison in the editor: a study is opened, judged pair by pair, and saved after every answer."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QFileDialog

from core_pipeline.errors import UserError
from core_pipeline.files import study_json
from core_pipeline.files.atomic import write_atomically
from core_pipeline.study import LEFT, RIGHT, Answer, Study, to_csv, told
from widgets.window.study_view import StudyView

from ..player import Player
from ..workers.pair_reader import Film, Pair, PairReader
from .parts import Parts


class Studying(QObject):
    """Opens the dialog and keeps the study. Results are shown only when the observer has judged everything."""

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._state, self._preview = parts.window, parts.state, parts.preview
        self.view: StudyView | None = None
        self.study: Study | None = None
        self.pair: Pair | None = None
        self._folder = Path()
        self._side = LEFT
        self._reader: PairReader | None = None
        self._player = Player(parts.preview.output, parent=self)
        self._player.time_changed.connect(self._show_frame)
        action = self._window.actions_.tools_menu.add(
            "tools.study",
            self.tr("&Blind Comparison…"),
            (),
            self.tr("Judge pairs of clips without knowing what made them"),
        )
        action.triggered.connect(lambda _=False: self.open())

    @property
    def observer(self) -> str:
        """Who judges."""
        return self._state.text("observer") or "me"

    def open(self) -> None:
        """Show the dialog."""
        if self.view is None:
            view = self.view = StudyView(self._window)
            view.set_observer(self.observer)
            view.folder_wanted.connect(self._ask_folder)
            view.play_wanted.connect(self.play)
            view.answered.connect(self._answer)
            view.observer_changed.connect(self._observer_changed)
            view.csv_wanted.connect(self._ask_csv)
            view.closed.connect(self._player.pause)
        self.view.show()
        self.view.raise_()

    def open_study(self, folder: Path) -> None:
        """Go on with the study in a folder."""
        if self.view is None:
            return
        try:
            self.study = study_json.load(folder)
        except UserError as error:
            self.view.set_message(str(error))
            return
        self._folder = folder
        self._next()

    def play(self, side: str) -> None:
        """One clip from its start."""
        if self.pair is None:
            return
        self._preview.player.pause()
        self._side = side
        film = self.pair.films[side]
        self._player.set_utterance(film.duration, film.audio)
        self._show_frame(0.0)
        self._player.play()

    def close(self) -> None:
        """Stop what plays, end the thread."""
        self._player.pause()
        if self._reader is not None:
            self._reader.stop()

    def _ask_folder(self) -> None:
        name = QFileDialog.getExistingDirectory(self.view, self.tr("Open a study"), self._state.text("study folder"))
        if name:
            self._state.put("study folder", name)
            self.open_study(Path(name))

    def _observer_changed(self, name: str) -> None:
        self._state.put("observer", name or "me")
        if self.study is not None:
            self._next()

    def _answer(self, side: str, strength: int) -> None:
        if self.study is None or self.pair is None:
            return
        before = self.study
        self.study = before.with_answer(Answer(self.pair.trial, self.observer, side, strength))
        try:
            study_json.save(self.study, self._folder)
        except UserError as error:
            self.study = before
            if self.view is not None:
                self.view.set_message(str(error))
            return
        self._next()

    def _next(self) -> None:
        """Read the pair that waits; when none does, tell the results."""
        if self.view is None or self.study is None:
            return
        self._player.pause()
        self.pair = None
        self.view.set_trial(None)
        waiting = self.study.waiting(self.observer)
        if waiting:
            self.view.set_results(())
            self.view.set_message(self.tr("The next pair is being read…"))
            if self._reader is None:
                self._reader = PairReader(self)
                self._reader.answered.connect(self._read)
                self._reader.failed.connect(self.view.set_message)
            self._reader.request((self._folder, waiting[0]))
        else:
            self.view.set_message(self.tr("{0} has judged every pair. Thank you.").format(self.observer))
            self.view.set_results(told(self.study))

    def _read(self, pair: Pair) -> None:
        if self.view is None or self.study is None:
            return
        self.pair = pair
        total = len(self.study.trials)
        number = total - len(self.study.waiting(self.observer)) + 1
        self.view.set_trial(self.study.trials[pair.trial].text, number, total)
        for side in (LEFT, RIGHT):
            self.view.set_image(side, picture(pair.films[side], 0.0))

    def _show_frame(self, seconds: float) -> None:
        if self.view is not None and self.pair is not None:
            self.view.set_image(self._side, picture(self.pair.films[self._side], seconds))

    def _ask_csv(self) -> None:
        name, _ = QFileDialog.getSaveFileName(
            self.view, self.tr("Save answers"), str(self._folder / "answers.csv"), self.tr("Tables (*.csv)")
        )
        if name and self.study is not None and self.view is not None:
            try:
                write_atomically(name, to_csv(self.study))
            except UserError as error:
                self.view.set_message(str(error))


def picture(film: Film, seconds: float) -> QImage:
    """The frame at a time; the picture has its own copy of the pixels."""
    frame = film.frames[min(max(int(seconds * film.fps), 0), len(film.frames) - 1)]
    height, width, _ = frame.shape
    return QImage(frame.tobytes(), width, height, 3 * width, QImage.Format.Format_RGB888).copy()

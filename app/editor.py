"""The running editor: all parts made, joined, and taken apart again in order."""

from __future__ import annotations

import logging
import sys
import traceback
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QApplication, QMessageBox

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.atomic import reason
from core_pipeline.speech.speaker import Speaker
from widgets import theme

from . import resources
from .collector import Collector
from .document import Document
from .file_actions import FileActions
from .main_window import MainWindow
from .preview.faces import Faces
from .preview.preview import Preview
from .rigs import curves_of, face_path
from .session import Session
from .settings import ViewState
from .wiring.parts import Parts
from .wiring.wiring import Wiring
from .workers.speech_worker import SpeechWorker

_log = logging.getLogger("lipstitch")


class Editor(QObject):
    """One window with everything behind it. `close` stops the threads; call it once."""

    def __init__(self, curve_set: CurveSet, state: ViewState) -> None:
        super().__init__()
        self.state = state
        self._collector = Collector(self)
        self.document = Document(curve_set, self)
        self.session = Session(curve_set, self)
        self.window = MainWindow(self.document)
        self.preview = Preview(self.session, self)
        self.faces = Faces(self)
        self.speaker = Speaker()
        self.speech = SpeechWorker(self.speaker, self)
        self._search = SpeechWorker(self.speaker, self)
        self.files = FileActions(self.window, self.document, state)
        self.wiring = Wiring(
            Parts(
                document=self.document,
                session=self.session,
                window=self.window,
                preview=self.preview,
                faces=self.faces,
                files=self.files,
                state=state,
                speech=self.speech,
                search=self._search,
                speaker=self.speaker,
            ),
            self,
        )

    def start(self, sentence: str) -> None:
        """Begin drawing and speaking; the sentence is shown, and played when the user asks."""
        self.preview.start()
        self.wiring.sentence.type(sentence, play=False)

    def close(self) -> None:
        """Stop threads and timers, remember the layout."""
        self.wiring.remember()
        self.files.close()
        self.faces.close()
        self.speech.stop()
        self._search.stop()
        self.preview.stop()
        self._collector.stop()
        self.state.write()


def run_editor(file: Path | None, sentence: str | None, face: str | None) -> int:
    """`lipstitch [FILE]`: open the window and stay until it is closed."""
    face_at = face_path(face)
    app = QApplication(sys.argv[:1])
    app.setApplicationName("lipstitch")
    theme.apply(app)
    state = ViewState()
    _catch_everything(state.folder)
    editor = Editor(curve_set_json.load(curves_of(face_at)), state)
    editor.window.fit_screen()
    editor.wiring.restore()
    if face is not None:
        editor.wiring.character.open(face_at)
    editor.window.show()
    editor.start(sentence or state.text("sentence") or resources.DEMO_SENTENCE)

    def first_things() -> None:
        editor.files.offer_recovery()
        if file is not None and editor.files.may_discard():
            editor.files.open(file)

    QTimer.singleShot(0, editor, first_things)
    code = app.exec()
    editor.close()
    return code


def _catch_everything(folder: Path) -> None:
    """A fault of ours: one sentence for the user, the details in a log file, and the editor goes on."""
    path = folder / "lipstitch.log"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        _log.addHandler(RotatingFileHandler(path, maxBytes=500_000, backupCount=1, delay=True, encoding="utf-8"))
    except OSError as error:
        print(f"lipstitch: no log can be kept in {folder}: {reason(error)}.", file=sys.stderr)
    _log.propagate = False
    telling = False

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        nonlocal telling
        if issubclass(kind, KeyboardInterrupt):
            QApplication.quit()
            return
        _log.error("%s", "".join(traceback.format_exception(kind, error, trace)))
        if not telling:  # a fault in painting would come again with every picture
            telling = True
            what = (
                str(error) if isinstance(error, UserError) else f"This is a fault of Lipstitch's own ({kind.__name__})."
            )
            QMessageBox.warning(None, "Lipstitch", f"{what}\nYour work is still here: save it. Details are in {path}.")
            telling = False

    sys.excepthook = hook

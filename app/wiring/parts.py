"""The parts of a running editor, handed as one to whoever joins them."""

from __future__ import annotations

from dataclasses import dataclass

from core_pipeline.speech.speaker import Speaker

from ..document import Document
from ..file_actions import FileActions
from ..main_window import MainWindow
from ..preview.faces import Faces
from ..preview.preview import Preview
from ..session import Session
from ..settings import ViewState
from ..workers.speech_worker import SpeechWorker


@dataclass(frozen=True, eq=False)
class Parts:
    """Everything that wiring connects.

    speech   speaks the sentence; search speaks a word typed into the picker's search
    speaker  what both of them speak with
    """

    document: Document
    session: Session
    window: MainWindow
    preview: Preview
    faces: Faces
    files: FileActions
    state: ViewState
    speech: SpeechWorker
    search: SpeechWorker
    speaker: Speaker

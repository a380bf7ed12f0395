"""`lipstitch screenshot`: the real window, drawn off screen, in the middle of a sentence."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QApplication

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files.atomic import write_atomically
from core_pipeline.speech.speaker import speak
from widgets import theme

from ..editor import Editor
from ..preview.png import png
from ..settings import ViewState

#: Drawing the face once takes a fraction of this, even in software.
PATIENCE_MS = 20_000


def screenshot(text: str, curve_set: CurveSet, out: Path, size: tuple[int, int], voice: str, face: Path) -> int:
    """Draw the window of `size` after the sentence has been spoken to its middle by a face."""
    if out.suffix.lower() != ".png":
        raise UserError(f"Cannot tell the format of {out}: name the picture .png.")
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    app = QApplication(["lipstitch"])
    theme.apply(app)
    utterance = speak(text, voice)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        editor = Editor(curve_set, ViewState(Path(folder)))
        editor.window.resize(*size)
        editor.window.show()
        editor.preview.set_lively(False)
        editor.wiring.character.open(face)
        editor.preview.start()
        editor.wiring.sentence.take(utterance, play=False)
        editor.session.recompute()
        editor.session.recompute()  # the first time is also the first use of numpy: no figure to show
        middle = utterance.schedule.start + utterance.schedule.duration / 2
        editor.wiring.bigram.open_at(middle)
        editor.preview.scrub(middle)
        _wait_for_face(editor)
        picture = editor.window.grab().toImage()
        editor.close()
        editor.window.deleteLater()
    write_atomically(out, png(picture))
    return 0


def _wait_for_face(editor: Editor) -> None:
    """Until the renderer has come to rest in full quality, or says that it cannot draw."""
    loop = QEventLoop()
    rest = QTimer()
    rest.setSingleShot(True)
    rest.setInterval(400)  # longer than the renderer waits before its last, best frame
    rest.timeout.connect(loop.quit)
    editor.preview.frame_ready.connect(rest.start)
    editor.preview.failed.connect(rest.start)
    editor.faces.failed.connect(rest.start)
    QTimer.singleShot(PATIENCE_MS, loop, loop.quit)
    loop.exec()

"""What a hand does on a canvas becomes what the pipeline shows meanwhile, and one step of the undo stack at its end."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QObject

from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.phonemes import Pair
from widgets.canvas.curve_canvas import CurveCanvas

from .parts import Parts


class CanvasHand(QObject):
    """Joins a canvas, the session and the document.

    pair         the bigram of the canvas now; None for none
    show_curves  shows the document's curves again, where an edit was refused
    """

    def __init__(
        self,
        parts: Parts,
        canvas: CurveCanvas,
        pair: Callable[[], Pair | None],
        show_curves: Callable[[], None],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._document = parts.document
        self._session = parts.session
        self._hint = parts.window.hint_label
        self._pair, self._show_curves = pair, show_curves
        canvas.preview_changed.connect(self._moving)
        canvas.cancelled.connect(self._cancelled)
        canvas.edited.connect(self._edited)

    def _moving(self, curves: Mapping[str, Curve]) -> None:
        """While it lasts overlay and face follow; the document does not change yet."""
        if (pair := self._pair()) is not None:
            self._session.set_preview(pair, curves)

    def _cancelled(self) -> None:
        if (pair := self._pair()) is not None:
            self._session.set_preview(pair, None)

    def _edited(self, curves: Mapping[str, Curve | None], label: str) -> None:
        if (pair := self._pair()) is None:
            return
        try:
            self._document.edit_curves(pair, curves, label)
        except UserError as error:
            self._cancelled()
            self._show_curves()
            self._hint.setText(str(error))

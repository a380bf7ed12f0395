"""One line of text that shortens itself with "…" where space is short, and says all of it in its tooltip."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from . import theme


class ElidedLabel(QWidget):
    """Like QLabel with plain text, but it may shrink."""

    def __init__(self, parent: QWidget | None = None, *, points: float = theme.POINT_SIZE) -> None:
        super().__init__(parent)
        font = self.font()
        font.setPointSizeF(points)
        self.setFont(font)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self._text = ""
        self._colour = theme.MUTED

    @property
    def text(self) -> str:
        """The whole text."""
        return self._text

    def set_text(self, text: str, colour: QColor = theme.MUTED) -> None:
        """Show `text` in `colour`."""
        self._text, self._colour = text, colour
        self.setToolTip(text)
        self.setAccessibleName(text)
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:
        """Room for the whole text."""
        metrics = self.fontMetrics()
        return QSize(metrics.horizontalAdvance(self._text) + 1, metrics.height())

    def minimumSizeHint(self) -> QSize:
        """Room for the ellipsis."""
        return QSize(self.fontMetrics().horizontalAdvance("…") + 1, self.fontMetrics().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        """The text, or as much as fits."""
        painter = QPainter(self)
        painter.setPen(self._colour)
        text = self.fontMetrics().elidedText(self._text, Qt.TextElideMode.ElideRight, self.width())
        painter.drawText(self.rect(), Qt.AlignmentFlag.AlignVCenter, text)

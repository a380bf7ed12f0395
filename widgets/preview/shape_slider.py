"""A slider that is a bar with its name inside: as many shapes fit into a narrow dock as it has lines."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSignalBlocker, QSize, Qt
from PySide6.QtGui import QMouseEvent, QPainter, QPainterPath, QPaintEvent, QPen, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QSlider, QWidget

from .. import theme

#: The right end of the bar.
MOST = 1.5
STEPS = 100  # per 1.0
_HEIGHT = 22
_PAD = 7


class ShapeSlider(QSlider):
    """0 to 1.5 in hundredths, by mouse, arrows, Page and Home/End. valueChanged comes from the user alone."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.setRange(0, round(MOST * STEPS))
        self.setPageStep(STEPS // 10)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setCursor(Qt.CursorShape.SizeHorCursor)
        self._name = ""

    @property
    def amount(self) -> float:
        """What the bar shows."""
        return self.value() / STEPS

    def show_amount(self, name: str, amount: float) -> None:
        """Show a shape's amount; what lies beyond an end stands at it. Emits nothing."""
        self._name = name
        with QSignalBlocker(self):
            self.setValue(round(amount * STEPS))
        self.setAccessibleName(self.tr("Amount of {0}").format(name))
        self.setToolTip(name)
        self.update()

    def sizeHint(self) -> QSize:
        """Room for a usual name."""
        return QSize(150, _HEIGHT)

    def minimumSizeHint(self) -> QSize:
        """Room to drag in."""
        return QSize(70, _HEIGHT)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take the value under the pointer."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.setSliderDown(True)
            self._to(event)
        else:
            event.ignore()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Follow the pointer."""
        if self.isSliderDown():
            self._to(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.setSliderDown(False)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Left to the panel, which scrolls."""
        event.ignore()

    def paintEvent(self, event: QPaintEvent) -> None:
        """The bar, a mark at 1, and the name."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        box = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        shape = QPainterPath()
        shape.addRoundedRect(box, 4, 4)
        painter.fillPath(shape, theme.BACKGROUND)
        painter.save()
        painter.setClipPath(shape)
        on = self.isEnabled()
        filled = QRectF(box.left(), box.top(), box.width() * self.value() / self.maximum(), box.height())
        painter.fillRect(filled, theme.CHECKED if on else theme.RAISED)
        one = box.left() + box.width() / MOST
        painter.setPen(QPen(theme.BORDER, 1))
        painter.drawLine(round(one), round(box.top()), round(one), round(box.bottom()))
        painter.restore()
        painter.setPen(QPen(theme.ACCENT if self.hasFocus() else theme.BORDER, 1))
        painter.drawPath(shape)
        painter.setPen(theme.TEXT if on else theme.MUTED)
        inside = self.rect().adjusted(_PAD, 0, -_PAD, 0)
        # where names of shapes differ is mostly at their ends: mouthLowerDownLeft, mouthFrownLeft
        text = self.fontMetrics().elidedText(self._name, Qt.TextElideMode.ElideLeft, inside.width())
        painter.drawText(inside, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)

    def _to(self, event: QMouseEvent) -> None:
        share = event.position().x() / max(self.width(), 1)
        self.setValue(round(min(max(share, 0.0), 1.0) * self.maximum()))

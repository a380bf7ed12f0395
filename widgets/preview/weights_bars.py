"""The weight of every pose at the playhead: the numbers that the face is made of."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QAccessible, QHelpEvent, QPainter, QPaintEvent, QPixmap, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from core_pipeline.poses import MEANING

from .. import theme

_MIN_ROW, _ROW, _MAX_ROW = 14, 21, 26  # pixels
_PAD = 8
_BAR = 7


class WeightsBars(QWidget):
    """Per pose a dot, its name, a bar and a number. What does not move is painted once, into a pixmap."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._poses: tuple[str, ...] = ()
        self._shown = np.zeros(0, np.int64)  # hundredths: no repaint for less than the eye can see
        self._still = QPixmap()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAccessibleName(self.tr("Pose weights"))

    @property
    def poses(self) -> tuple[str, ...]:
        """The poses shown."""
        return self._poses

    @property
    def weights(self) -> np.ndarray:
        """The weights as shown (k,), rounded to hundredths."""
        return self._shown / 100

    def set_poses(self, poses: Sequence[str]) -> None:
        """The poses, top to bottom; their weights start at 0."""
        self._poses = tuple(poses)
        self._shown = np.zeros(len(self._poses), np.int64)
        self._still = QPixmap()
        self.updateGeometry()
        self._describe()
        self.update()

    def set_weights(self, weights: ArrayLike) -> None:
        """Weights (k,) of the poses, 0…1. ValueError when their number is not that of the poses."""
        hundredths = np.rint(np.asarray(weights, float) * 100).astype(np.int64)
        if hundredths.shape != self._shown.shape:
            raise ValueError(f"{hundredths.shape} weights for {len(self._poses)} poses")
        if not np.array_equal(hundredths, self._shown):
            self._shown = hundredths
            self._describe()
            self.update()

    def sizeHint(self) -> QSize:
        """A comfortable row per pose."""
        return QSize(260, len(self._poses) * _ROW + 2 * _PAD)

    def minimumSizeHint(self) -> QSize:
        """Rows as tight as they can be read."""
        return QSize(150, len(self._poses) * _MIN_ROW + 2 * _PAD)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """The still part no longer fits."""
        super().resizeEvent(event)
        self._still = QPixmap()

    def event(self, event: QEvent) -> bool:
        """A pose's tooltip says what it means."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            row = int((event.pos().y() - _PAD) // self._row_height()) if self._poses else -1
            text = self.tooltip(row) if 0 <= row < len(self._poses) else ""
            QToolTip.showText(event.globalPos(), text, self)
            return True
        return super().event(event)

    def tooltip(self, row: int) -> str:
        """Name, meaning and weight of one row."""
        pose = self._poses[row]
        meaning = f": {MEANING[pose]}" if pose in MEANING else ""
        return f"{pose}{meaning} · {self._shown[row] / 100:.2f}"

    def paintEvent(self, event: QPaintEvent) -> None:
        """The still part, then bars and numbers."""
        if self._still.isNull():
            self._still = self._paint_still()
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._still)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        left, width = self._track()
        height = self._row_height()
        number_at = self.width() - _PAD - self._number_width()
        bars = []
        for i, hundredths in enumerate(self._shown.tolist()):
            middle = _PAD + (i + 0.5) * height
            if hundredths > 0:
                length = max(width * min(hundredths, 100) / 100, _BAR)
                bars.append((i, QRectF(left, middle - _BAR / 2, length, _BAR)))
            painter.setPen(theme.TEXT if hundredths else theme.FAINT)
            box = QRectF(number_at, middle - height / 2, self._number_width(), height)
            right = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight
            painter.drawText(box, right, f"{hundredths / 100:.2f}")
        painter.setPen(Qt.PenStyle.NoPen)
        for i, bar in bars:
            painter.setBrush(theme.pose_colour(self._poses[i], i))
            painter.drawRoundedRect(bar, _BAR / 2, _BAR / 2)

    def _paint_still(self) -> QPixmap:
        still = QPixmap(self.size() * self.devicePixelRatio())
        still.setDevicePixelRatio(self.devicePixelRatio())
        still.fill(self.palette().window().color())
        painter = QPainter(still)
        painter.setFont(self.font())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        left, width = self._track()
        height = self._row_height()
        for i, pose in enumerate(self._poses):
            middle = _PAD + (i + 0.5) * height
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(theme.pose_colour(pose, i))
            painter.drawEllipse(QRectF(_PAD, middle - 4, 8, 8))
            painter.setBrush(theme.SUNKEN)
            painter.drawRoundedRect(QRectF(left, middle - _BAR / 2, width, _BAR), _BAR / 2, _BAR / 2)
            painter.setPen(theme.TEXT)
            name = self.fontMetrics().elidedText(pose, Qt.TextElideMode.ElideRight, self._name_width())
            painter.drawText(
                QRectF(_PAD + 14, middle - height / 2, self._name_width() + 1, height),
                Qt.AlignmentFlag.AlignVCenter,
                name,
            )
        painter.end()
        return still

    def _row_height(self) -> float:
        return min(max((self.height() - 2 * _PAD) / max(len(self._poses), 1), _MIN_ROW), _MAX_ROW)

    def _name_width(self) -> int:
        widest = max((self.fontMetrics().horizontalAdvance(pose) for pose in self._poses), default=0)
        return min(widest + 2, self.width() // 3)

    def _number_width(self) -> int:
        return self.fontMetrics().horizontalAdvance("0.00") + 1

    def _track(self) -> tuple[float, float]:
        left = _PAD + 14 + self._name_width() + 10
        return left, max(self.width() - left - self._number_width() - 10 - _PAD, 10)

    def _describe(self) -> None:
        # Text for screen readers, made only where one listens: this comes 60 times a second.
        if QAccessible.isActive() or not self._shown.any():
            pairs = zip(self._poses, self.weights.tolist(), strict=True)
            self.setAccessibleDescription(", ".join(f"{pose} {weight:.2f}" for pose, weight in pairs))

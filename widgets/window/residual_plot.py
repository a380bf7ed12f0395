"""How a learned curve fits: every occurrence in grey, the learned curve over them, what the set has dashed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from core_pipeline.curves import Curve

from .. import theme

Array = NDArray[np.float64]
#: (normalised times, weights) of one occurrence.
Spoken = tuple[Array, Array]

_LEFT, _RIGHT, _TOP, _FOOT = 36, 12, 10, 24
#: More occurrences than this would only be a grey surface.
MOST = 150


class _Picture(QWidget):
    """The curves of one pose; values come down."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(320, 220)
        self.spoken: Sequence[Spoken] = ()
        self.learned: Curve | None = None
        self.now: Curve | None = None
        self.colour = QColor(theme.TEXT)

    def sizeHint(self) -> QSize:
        """As wide as the table."""
        return QSize(560, 420)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Grid, occurrences, the set's curve, the learned one."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), theme.BACKGROUND)
        painter.setFont(theme.font(8.5))
        for height in (0.0, 0.25, 0.5, 0.75, 1.0):
            y = round(self._point(0, height).y())
            painter.fillRect(_LEFT, y, self.width() - _LEFT - _RIGHT, 1, theme.GRID)
            painter.setPen(theme.MUTED)
            box = QRectF(0, y - 8, _LEFT - 6, 16)
            painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, f"{height:g}")
        for t in (0.0, 0.5, 1.0):
            x = self._point(t, 0).x()
            box = QRectF(x - 24, self.height() - _FOOT + 4, 48, 16)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, f"{t:g}")
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(theme.GHOST, 1))
        for t, v in self.spoken[:MOST]:
            painter.drawPolyline(QPolygonF([self._point(x, y) for x, y in zip(t.tolist(), v.tolist(), strict=True)]))
        if self.now is not None:
            pen = QPen(theme.MUTED, 1.5)
            pen.setDashPattern([4, 3])
            self._curve(painter, self.now, pen)
        if self.learned is not None:
            self._curve(painter, self.learned, QPen(self.colour, 2.2))

    def _curve(self, painter: QPainter, curve: Curve, pen: QPen) -> None:
        painter.setPen(pen)
        keys = [(0.0, float(curve.v[0])), *curve.keys(), (1.0, float(curve.v[-1]))]
        painter.drawPolyline(QPolygonF([self._point(t, v) for t, v in keys]))

    def _point(self, t: float, v: float) -> QPointF:
        wide, tall = self.width() - _LEFT - _RIGHT, self.height() - _TOP - _FOOT
        return QPointF(_LEFT + wide * t, _TOP + tall * (1 - v))


class ResidualPlot(QWidget):
    """A pose to look at, and its picture.

    pose_picked(pose)  show another pose
    """

    pose_picked = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.title = QLabel()
        self.poses = QComboBox()
        self.poses.setAccessibleName(self.tr("Pose"))
        self.poses.currentTextChanged.connect(self.pose_picked)
        self.picture = _Picture()
        self.legend = QLabel(
            self.tr("grey: every occurrence   bold: learned   dashed: in this set now   (normalised time, weight)")
        )
        self.legend.setStyleSheet(f"color:{theme.MUTED.name()}")
        self.legend.setWordWrap(True)
        top = QHBoxLayout()
        top.addWidget(self.title, 1)
        top.addWidget(self.poses)
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 0, 0, 0)
        column.addLayout(top)
        column.addWidget(self.picture, 1)
        column.addWidget(self.legend)

    @property
    def pose(self) -> str:
        """The pose that is shown."""
        return self.poses.currentText()

    def set_poses(self, poses: Sequence[str]) -> None:
        """The set's poses; the chosen one stays if it can. Emits nothing."""
        if [self.poses.itemText(i) for i in range(self.poses.count())] == list(poses):
            return
        before = self.pose
        with QSignalBlocker(self.poses):
            self.poses.clear()
            self.poses.addItems(list(poses))
            self.poses.setCurrentIndex(max(self.poses.findText(before), 0))

    def set_bigram(
        self,
        title: str,
        spoken: Sequence[Spoken],
        learned: Mapping[str, Curve],
        now: Mapping[str, Curve],
    ) -> None:
        """What to draw, for the pose that is chosen."""
        self.title.setText(title)
        picture = self.picture
        picture.spoken = spoken
        picture.learned, picture.now = learned.get(self.pose), now.get(self.pose)
        picture.colour = theme.pose_colour(self.pose, self.poses.currentIndex())
        picture.update()

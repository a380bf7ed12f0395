"""The preview: shows frames of the faces and turns the mouse into wishes for another view."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QKeyEvent,
    QLinearGradient,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from core_pipeline.faces.view import places

from .. import theme
from .name_tag import HEIGHT, NameTag, Tag
from .notice import Notice

_KEY_STEP = 20.0  # pixels of drag that one press of an arrow key stands for
_MARGIN = 6


class FaceView(QWidget):
    """Shows frames; emits what the mouse wants. Knows nothing of faces."""

    orbited = Signal(float, float)
    """Left drag or arrow keys: (dx, dy) in pixels of the widget, +y down."""

    panned = Signal(float, float)
    """Middle drag, Shift+left drag or Shift+arrow keys: (dx, dy) in pixels of the widget."""

    zoomed = Signal(float)
    """Wheel, + and -: steps, positive to come nearer."""

    reset_wanted = Signal()
    """Double click or Home: the faces' own view again."""

    held = Signal(bool)
    """A drag began, or ended."""

    cutaway_wanted = Signal(int, bool)
    """The scissors of a face, or C for all: the near half of its head hidden, to see the tongue."""

    face_wanted = Signal(int)
    """Its name: another face in its place."""

    away_wanted = Signal(int)
    """Its cross: this face no longer."""

    retry_wanted = Signal()
    """The button under a message."""

    resized = Signal(int, int)
    """The size a frame should have now, in device pixels."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Face preview"))
        self.setAccessibleDescription(self.tr("Drag to turn the face, turn the wheel to zoom, press Home to reset."))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 160)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._image = QImage()
        self._tags: tuple[Tag, ...] = ()
        self._name_tags: list[NameTag] = []
        self._from: QPointF | None = None
        self._told = QSize()

        self._message = QLabel(self)
        self._message.setWordWrap(True)
        self._message.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._message.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._message.setAccessibleName(self.tr("Why there is no face"))
        self._retry = QPushButton(self.tr("Try again"), self)
        self._retry.setAccessibleName(self.tr("Try to draw the face again"))
        self._retry.setAccessibleDescription(self.tr("Start the renderer once more"))
        self._retry.clicked.connect(self.retry_wanted)
        column = QVBoxLayout(self)
        column.setContentsMargins(24, 24, 24, 24)
        column.setSpacing(12)
        column.addStretch()
        column.addWidget(self._message)
        column.addWidget(self._retry, 0, Qt.AlignmentFlag.AlignHCenter)
        column.addStretch()
        self._message.hide()
        self._retry.hide()
        self.notice = Notice(self)

    def sizeHint(self) -> QSize:
        """A square that a face fits well."""
        return QSize(340, 340)

    def set_frame(self, image: QImage) -> None:
        """Show this picture, and no message any more. One of another shape than the widget is cropped to it."""
        self._image = image
        if not self._message.isHidden():
            self.set_message("")
        self.update()

    def set_tags(self, tags: Sequence[Tag]) -> None:
        """What is said of each face, from left to right."""
        self._tags = tuple(tags)
        while len(self._name_tags) > len(tags):
            gone = self._name_tags.pop()
            gone.hide()
            gone.deleteLater()
        while len(self._name_tags) < len(tags):
            self._name_tags.append(self._name_tag(len(self._name_tags)))
        self._lay_out_tags()
        self.update()

    @property
    def name_tags(self) -> tuple[NameTag, ...]:
        """The tags on the picture, from left to right."""
        return tuple(self._name_tags)

    def set_message(self, message: str, retry: bool = False) -> None:
        """Say why there is no face, over the last frame; "" to say nothing. With `retry` a button offers it."""
        self._message.setText(message)
        self._message.setVisible(bool(message))
        self._retry.setVisible(bool(message) and retry)
        for tag in self._name_tags:
            tag.setVisible(not message)
        self.update()

    def frame_size(self) -> QSize:
        """The size a frame should have, in device pixels."""
        ratio = self.devicePixelRatioF()
        return QSize(max(round(self.width() * ratio), 1), max(round(self.height() * ratio), 1))

    # ── Qt's events ──

    def paintEvent(self, event: QPaintEvent) -> None:
        """The frame, pixel for pixel when it has the widget's size."""
        painter = QPainter(self)
        if self._image.isNull():
            self._paint_backdrop(painter)
        else:
            source = self._cropped()
            same = source.size().toSize() == self.frame_size()
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, not same)
            painter.drawImage(QRectF(self.rect()), self._image, source)
        if not self._message.isHidden():
            veil = theme.SUNKEN
            painter.fillRect(self.rect(), veil if self._image.isNull() else _faded(veil, 200))
        else:
            self._paint_mute(painter)
        if self.hasFocus():
            painter.setPen(theme.ACCENT)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Tell the new size, and keep the tags under their faces."""
        self._lay_out_tags()
        self._tell_size()

    def event(self, event: QEvent) -> bool:
        """A screen of another density wants another frame."""
        if event.type() == QEvent.Type.DevicePixelRatioChange:
            self._tell_size()
        return super().event(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a drag."""
        if event.button() in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton):
            self._from = event.position()
            self.held.emit(True)
            self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Every move of a drag is one wish."""
        if self._from is None:
            return
        moved = event.position() - self._from
        self._from = event.position()
        shifted = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        pan = shifted or not event.buttons() & Qt.MouseButton.LeftButton
        (self.panned if pan else self.orbited).emit(moved.x(), moved.y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End the drag with the last button."""
        if not event.buttons() & (Qt.MouseButton.LeftButton | Qt.MouseButton.MiddleButton):
            self._from = None
            self.held.emit(False)
            self.unsetCursor()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Back to the face's own view."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.reset_wanted.emit()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """A notch is 120; touchpads send less at a time."""
        if event.angleDelta().y():
            self.zoomed.emit(event.angleDelta().y() / 120.0)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """What the mouse can, the keys can too."""
        key = event.key()
        turns = {
            Qt.Key.Key_Left: (-_KEY_STEP, 0.0),
            Qt.Key.Key_Right: (_KEY_STEP, 0.0),
            Qt.Key.Key_Up: (0.0, -_KEY_STEP),
            Qt.Key.Key_Down: (0.0, _KEY_STEP),
        }
        if key in turns:
            pan = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            (self.panned if pan else self.orbited).emit(*turns[Qt.Key(key)])
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal):
            self.zoomed.emit(1.0)
        elif key == Qt.Key.Key_Minus:
            self.zoomed.emit(-1.0)
        elif key == Qt.Key.Key_Home:
            self.reset_wanted.emit()
        elif key == Qt.Key.Key_Escape and self.notice.text:
            (self.notice.cross if self.notice.warns else self.notice.button).click()
        elif key == Qt.Key.Key_C and not event.modifiers():
            cut = not all(tag.cut for tag in self._tags)
            for index in range(len(self._tags)):
                self.cutaway_wanted.emit(index, cut)
        else:
            super().keyPressEvent(event)

    # ── building and painting ──

    def _name_tag(self, index: int) -> NameTag:
        tag = NameTag(self)
        tag.face_wanted.connect(lambda: self.face_wanted.emit(index))
        tag.cut_wanted.connect(lambda cut: self.cutaway_wanted.emit(index, cut))
        tag.away_wanted.connect(lambda: self.away_wanted.emit(index))
        tag.setVisible(self._message.isHidden())
        return tag

    def _lay_out_tags(self) -> None:
        for place, name_tag, tag in zip(self._places(), self._name_tags, self._tags, strict=True):
            room = round(place.width()) - 2 * _MARGIN
            name_tag.show_tag(tag, room, alone=len(self._tags) == 1)
            width = min(name_tag.sizeHint().width(), room)
            x, y = place.center().x() - width / 2, place.bottom() - _MARGIN - HEIGHT
            name_tag.setGeometry(round(x), round(y), width, HEIGHT)

    def _places(self) -> list[QRectF]:
        """Where each face is, in the widget."""
        return [QRectF(*place) for place in places((self.width(), self.height()), len(self._tags))][: len(self._tags)]

    def _cropped(self) -> QRectF:
        """The middle part of the frame that has the widget's shape."""
        size = QSize(self.frame_size()).scaled(self._image.size(), Qt.AspectRatioMode.KeepAspectRatio)
        x, y = (self._image.width() - size.width()) / 2, (self._image.height() - size.height()) / 2
        return QRectF(x, y, size.width(), size.height())

    def _paint_backdrop(self, painter: QPainter) -> None:
        fall = QLinearGradient(0, 0, 0, self.height())
        fall.setColorAt(0.0, theme.RAISED)
        fall.setColorAt(1.0, theme.BACKGROUND)
        painter.fillRect(self.rect(), fall)

    def _paint_mute(self, painter: QPainter) -> None:
        """Over a face that can say nothing of this: a word, or it would only seem broken."""
        painter.setFont(theme.font(9.0))
        for place, tag in zip(self._places(), self._tags, strict=True):
            if tag.mute:
                bottom = place.bottom() - HEIGHT - 2 * _MARGIN
                room = QRectF(place.left() + _MARGIN, place.top(), place.width() - 2 * _MARGIN, bottom - place.top())
                flags = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignBottom | Qt.TextFlag.TextWordWrap
                word = self.tr("None of this set's poses can be made on this face")
                box = painter.boundingRect(room.adjusted(6, 0, -6, -4), flags, word)
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(_faded(theme.SUNKEN, 200))
                painter.drawRoundedRect(box.adjusted(-6, -4, 6, 4), 6, 6)
                painter.setPen(theme.WEAK)
                painter.drawText(box, flags, word)

    def _tell_size(self) -> None:
        if (size := self.frame_size()) != self._told:
            self._told = size
            self.resized.emit(size.width(), size.height())


def _faded(colour: QColor, alpha: int) -> QColor:
    faded = QColor(colour)
    faded.setAlpha(alpha)
    return faded

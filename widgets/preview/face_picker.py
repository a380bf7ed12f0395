"""The face picker: a sheet of portraits that pops up, by mouse or arrow keys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QImage, QKeyEvent, QPainter, QPixmap, QShowEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QListView,
    QListWidget,
    QListWidgetItem,
    QMenu,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from .. import theme

#: Side of a portrait, in pixels of the interface.
PORTRAIT = 96
_CELL = QSize(PORTRAIT + 16, PORTRAIT + 38)
_COLUMNS, _ROWS = 4, 2
_LISTED = Qt.ItemDataRole.UserRole + 1


@dataclass(frozen=True)
class Choice:
    """A face to be picked.

    key    what `picked` tells
    title  under its portrait
    about  its tooltip: where it is, what it is made of
    listed it is here because it was opened before, and may be taken off the list
    """

    key: str
    title: str
    about: str = ""
    listed: bool = False


class FacePicker(QFrame):
    """picked(key) with a click or Enter; file_wanted and folder_wanted for a face that is not here.

    forgotten(key)  a face was taken off the list, by Del or its own menu
    """

    picked = Signal(str)
    forgotten = Signal(str)
    file_wanted = Signal()
    folder_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setAccessibleName(self.tr("Face picker"))
        self.title = QLabel()
        self.title.setFont(theme.font(bold=True))
        self.faces = QListWidget()
        self.faces.setAccessibleName(self.tr("Faces"))
        self.faces.setAccessibleDescription(self.tr("Enter shows a face, Del takes one of yours off this list"))
        self.faces.setViewMode(QListView.ViewMode.IconMode)
        self.faces.setMovement(QListView.Movement.Static)
        self.faces.setResizeMode(QListView.ResizeMode.Adjust)
        self.faces.setUniformItemSizes(True)
        self.faces.setIconSize(QSize(PORTRAIT, PORTRAIT))
        self.faces.setGridSize(_CELL)
        self.faces.setFrameShape(QFrame.Shape.NoFrame)
        self.faces.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.faces.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.faces.setSpacing(2)
        self.faces.setStyleSheet(
            f"QListWidget{{outline:0}}QListWidget::item{{border-radius:8px;padding:4px 0;color:{theme.TEXT.name()}}}"
            f"QListWidget::item:hover{{background:{theme.RAISED.name()}}}"
            f"QListWidget::item:selected{{background:{theme.CHECKED.name()};color:{theme.BRIGHT.name()}}}"
        )
        self.faces.itemClicked.connect(self._pick)
        self.faces.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.faces.customContextMenuRequested.connect(self._offer)
        bar = self.faces.verticalScrollBar().sizeHint().width()
        self.faces.setFixedSize(_COLUMNS * _CELL.width() + bar + 4, _ROWS * _CELL.height() + 4)
        self.file = QPushButton(theme.icon("file-outline"), self.tr("Open a file…"))
        self.file.setToolTip(self.tr("A .glb, .gltf or .vrm with blendshapes"))
        self.folder = QPushButton(theme.icon("folder-outline"), self.tr("Open a folder…"))
        self.folder.setToolTip(self.tr("A folder with one .obj per pose and a neutral one"))
        for button, wanted in ((self.file, self.file_wanted), (self.folder, self.folder_wanted)):
            button.setAutoDefault(False)
            button.clicked.connect(self.hide)
            button.clicked.connect(wanted)
        row = QHBoxLayout()
        row.addWidget(self.file)
        row.addWidget(self.folder)
        row.addStretch()
        column = QVBoxLayout(self)
        column.setContentsMargins(10, 8, 10, 10)
        column.setSpacing(8)
        column.addWidget(self.title)
        column.addWidget(self.faces)
        column.addLayout(row)

    @property
    def keys(self) -> list[str]:
        """What can be picked, in order."""
        return [str(item.data(Qt.ItemDataRole.UserRole)) for item in self._items()]

    def open(self, title: str, choices: Sequence[Choice], current: str, beside: QRect) -> None:
        """Pop up near a rectangle of the screen, with the current face chosen."""
        self.title.setText(title)
        pictures = {str(item.data(Qt.ItemDataRole.UserRole)): item.icon() for item in self._items()}
        self.faces.clear()
        for choice in choices:
            item = QListWidgetItem(pictures.get(choice.key) or _blank(choice.title), choice.title)
            item.setData(Qt.ItemDataRole.UserRole, choice.key)
            item.setData(_LISTED, choice.listed)
            hint = self.tr("Del takes it off this list") if choice.listed else ""
            item.setToolTip("\n".join(filter(None, (choice.about or choice.title, hint))))
            item.setData(Qt.ItemDataRole.AccessibleTextRole, f"{choice.title}. {choice.about}")
            self.faces.addItem(item)
            if choice.key == current:
                self.faces.setCurrentItem(item)
        if self.faces.currentItem() is None and self.faces.count():
            self.faces.setCurrentRow(0)
        self.adjustSize()
        self.move(self._place(beside))
        self.show()

    def set_picture(self, key: str, picture: QImage) -> None:
        """The portrait of a face, when it has been drawn."""
        for item in self._items():
            if item.data(Qt.ItemDataRole.UserRole) == key:
                item.setIcon(_framed(picture, self.devicePixelRatioF()))

    def showEvent(self, event: QShowEvent) -> None:
        """The arrow keys are for the faces."""
        super().showEvent(event)
        self.faces.setFocus(Qt.FocusReason.PopupFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter and Space pick, Esc closes."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space) and self.faces.hasFocus():
            if (item := self.faces.currentItem()) is not None:
                self._pick(item)
        elif event.key() == Qt.Key.Key_Delete and (item := self.faces.currentItem()) is not None:
            self._forget(item)
        elif event.key() == Qt.Key.Key_Escape:
            self.hide()
        else:
            super().keyPressEvent(event)

    def _pick(self, item: QListWidgetItem) -> None:
        self.hide()
        self.picked.emit(str(item.data(Qt.ItemDataRole.UserRole)))

    def _offer(self, at: QPoint) -> None:
        """The menu of a face that may go."""
        item = self.faces.itemAt(at)
        if item is not None and item.data(_LISTED):
            menu = QMenu(self)
            menu.addAction(self.tr("Take off this list")).triggered.connect(lambda: self._forget(item))
            menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
            menu.popup(self.faces.viewport().mapToGlobal(at))

    def _forget(self, item: QListWidgetItem) -> None:
        if item.data(_LISTED):
            self.faces.takeItem(self.faces.row(item))
            self.forgotten.emit(str(item.data(Qt.ItemDataRole.UserRole)))

    def _items(self) -> list[QListWidgetItem]:
        return [self.faces.item(row) for row in range(self.faces.count())]

    def _place(self, beside: QRect) -> QPoint:
        """Above or below the rectangle, on its screen."""
        size, room = self.sizeHint(), self.screen().availableGeometry()
        above, below = beside.top() - size.height() - 4, beside.bottom() + 4
        y = below if below + size.height() <= room.bottom() else above
        x = beside.center().x() - size.width() // 2
        x = max(room.left(), min(x, room.right() - size.width()))
        return QPoint(x, max(room.top(), min(y, room.bottom() - size.height())))


def _blank(title: str) -> QIcon:
    """Until the portrait is there: a letter on a quiet ground."""
    picture = QImage(2 * PORTRAIT, 2 * PORTRAIT, QImage.Format.Format_RGB32)
    picture.fill(theme.RAISED)
    painter = QPainter(picture)
    painter.setFont(theme.font(48, bold=True))
    painter.setPen(theme.FAINT)
    painter.drawText(picture.rect(), Qt.AlignmentFlag.AlignCenter, title[:1].upper())
    painter.end()
    return _framed(picture, 1.0)


def _framed(picture: QImage, ratio: float) -> QIcon:
    """With round corners, as sharp as the screen."""
    side = round(PORTRAIT * ratio)
    result = QPixmap(side, side)
    result.fill(QColor(0, 0, 0, 0))
    painter = QPainter(result)
    painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
    smooth = Qt.TransformationMode.SmoothTransformation
    painter.setBrush(picture.scaled(side, side, Qt.AspectRatioMode.IgnoreAspectRatio, smooth))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.drawRoundedRect(result.rect(), 8 * ratio, 8 * ratio)
    painter.end()
    result.setDevicePixelRatio(ratio)
    icon = QIcon(result)
    icon.addPixmap(result, QIcon.Mode.Selected)  # Qt would tint the chosen face blue
    return icon

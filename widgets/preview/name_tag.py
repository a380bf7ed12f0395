"""The tag under a face: its name, which opens the picker, scissors to cut it open, and a cross to send it away."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QToolButton, QWidget

from .. import theme

HEIGHT = 26
_BUTTON = 22
#: Narrower than this the name needs all the room; key and menu still cut open.
_NARROW = 104


@dataclass(frozen=True)
class Tag:
    """What is said of one face.

    name    its title
    note    what is odd about it, such as poses it cannot make; "" for nothing
    mute    it can make none of the poses that are spoken
    cut     its head is cut open
    """

    name: str
    note: str = ""
    mute: bool = False
    cut: bool = False


class NameTag(QWidget):
    """Lies over a picture. Its signals come from the user alone."""

    face_wanted = Signal()
    cut_wanted = Signal(bool)
    away_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFixedHeight(HEIGHT)
        self.setFont(theme.font(8.5))
        row = QHBoxLayout(self)
        row.setContentsMargins(3, 2, 3, 2)
        row.setSpacing(0)
        self.name = self._button("")
        self.name.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.name.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.name.setStyleSheet("QToolButton{padding:2px 4px}")  # with more the "_" of a file's name is cut off
        self.name.clicked.connect(self.face_wanted)
        self.cut = self._button("content-cut")
        self.cut.setCheckable(True)
        self.cut.setToolTip(self.tr("Cut the head open to see the tongue (C)"))
        self.cut.clicked.connect(self.cut_wanted)
        self.away = self._button("close")
        self.away.clicked.connect(self.away_wanted)
        for button in (self.name, self.cut, self.away):
            row.addWidget(button)

    def show_tag(self, tag: Tag, room: int, *, alone: bool) -> None:
        """Show a tag in `room` pixels; a face that is alone cannot be sent away."""
        self.name.setIcon(theme.icon("alert-outline", theme.WEAK) if tag.note else theme.icon("chevron-down"))
        self.cut.setChecked(tag.cut)
        self.cut.setVisible(room >= _NARROW)
        self.away.setHidden(alone)
        others = sum(_BUTTON for button in (self.cut, self.away) if not button.isHidden())
        text = self.fontMetrics().elidedText(tag.name, Qt.TextElideMode.ElideRight, max(room - others - 38, 20))
        self.name.setText(text.replace("&", "&&"))  # a name has no mnemonics
        self.name.setAccessibleName(self.tr("Face: {0}").format(tag.name))
        self.name.setAccessibleDescription(tag.note)
        self.name.setToolTip("\n".join(filter(None, (tag.name, tag.note, self.tr("Click to choose another face")))))
        self.cut.setAccessibleName(self.tr("Cut {0} open").format(tag.name))
        self.away.setAccessibleName(self.tr("Remove {0}").format(tag.name))
        for button in (self.cut, self.away):
            button.setText(button.accessibleName())
        self.away.setToolTip(self.tr("Remove {0} from the picture").format(tag.name))
        self.adjustSize()

    def paintEvent(self, event: QPaintEvent) -> None:
        """A dark plate that any picture can lie under."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        plate = theme.SUNKEN.toRgb()
        plate.setAlpha(175)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(plate)
        painter.drawRoundedRect(self.rect(), 6, 6)

    def _button(self, icon: str) -> QToolButton:
        button = QToolButton(self)
        button.setAutoRaise(True)
        button.setFont(self.font())
        button.setFixedHeight(_BUTTON)
        if icon:
            button.setIcon(theme.icon(icon, theme.MUTED))
            button.setFixedWidth(_BUTTON)
        return button

"""A plate over the picture: how far a face has been read, or why it was not, with a button for what can be done."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QRect, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QLabel, QPushButton, QToolButton, QWidget

from .. import theme

_MARGIN = 6
#: Wider than this a sentence is hard to read.
_WIDEST = 460
#: Narrower than this the button goes below the sentence.
_NARROW = 300
_SIGN = 18


class Notice(QWidget):
    """Hidden until something is said. Its signals come from the user alone.

    wanted()     the button: cancel what is read, or do what was offered
    dismissed()  the cross of a warning
    """

    wanted = Signal()
    dismissed = Signal()

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setFont(theme.font(8.5))
        self._sign = QLabel()
        self._sign.setPixmap(theme.icon("alert-outline", theme.WEAK).pixmap(_SIGN, _SIGN))
        self._words = QLabel()
        self._words.setTextFormat(Qt.TextFormat.PlainText)  # names from files are no markup
        self._words.setWordWrap(True)
        self.button = QPushButton(self.tr("Cancel"))
        self.button.setToolTip(self.tr("What can be done about it"))
        self.button.setAutoDefault(False)
        self.button.clicked.connect(self.wanted)
        self.cross = QToolButton()
        self.cross.setAutoRaise(True)
        self.cross.setIcon(theme.icon("close", theme.MUTED))
        self.cross.setText(self.tr("Put this message away"))
        self.cross.setAccessibleName(self.cross.text())
        self.cross.setToolTip(self.tr("Put this message away (Esc)"))
        self.cross.clicked.connect(self.hide)
        self.cross.clicked.connect(self.dismissed)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 5, 5, 5)
        row.setSpacing(6)
        row.addWidget(self._sign)
        self._middle = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._middle.addWidget(self._words, 1)
        self._middle.addWidget(self.button)
        row.addLayout(self._middle, 1)
        row.addWidget(self.cross)
        parent.installEventFilter(self)
        self.hide()

    @property
    def text(self) -> str:
        """What is said; "" for nothing."""
        return "" if self.isHidden() else self._words.text()

    @property
    def warns(self) -> bool:
        """Whether it is a warning that is said, which may be put away."""
        return not self.isHidden() and not self.cross.isHidden()

    def tell(self, sentence: str, button: str) -> None:
        """Something goes on, and the button ends it."""
        self._say(sentence, button, warns=False)

    def warn(self, sentence: str, button: str = "") -> None:
        """Something is not as it should be; with a button for what mends it."""
        self._say(sentence, button, warns=True)

    def eventFilter(self, watched: object, event: QEvent) -> bool:
        """The picture has another size."""
        if event.type() == QEvent.Type.Resize and not self.isHidden():
            self._place()
        return False

    def paintEvent(self, event: QPaintEvent) -> None:
        """A dark plate that any picture can lie under."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        plate = theme.SUNKEN.toRgb()
        plate.setAlpha(225)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(plate)
        painter.drawRoundedRect(self.rect(), 6, 6)

    def _say(self, sentence: str, button: str, *, warns: bool) -> None:
        self._words.setText(sentence)
        self._words.setAccessibleName(sentence)
        self.button.setText(button or self.button.text())
        self.button.setAccessibleDescription(sentence)
        self.button.setVisible(bool(button))
        self._sign.setVisible(warns)
        self.cross.setVisible(warns)
        self._place()
        self.show()
        self.raise_()

    def _place(self) -> None:
        """Along the upper edge."""
        room = self.parentWidget().rect().adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN)
        width = min(room.width(), _WIDEST)
        across = QBoxLayout.Direction.LeftToRight
        self._middle.setDirection(across if width >= _NARROW else QBoxLayout.Direction.TopToBottom)
        self._middle.invalidate()  # what was reckoned for another sentence
        self.layout().invalidate()
        height = self.layout().totalHeightForWidth(width)
        left = room.left() + (room.width() - width) // 2
        self.setGeometry(QRect(left, room.top(), width, min(height, room.height())))

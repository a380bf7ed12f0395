"""The weak bigrams with what they are weak in: the sentence, or a text that was loaded."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QProgressBar, QToolButton, QVBoxLayout, QWidget

from .. import theme
from .weak_list import WeakList

SENTENCE, CORPUS = 0, 1


class WeakPanel(QWidget):
    """A list, the choice of its source, and how far the reading of a text has come.

    source_picked(source)  SENTENCE or CORPUS
    load_wanted()          the user wants to choose a text
    cancel_wanted()        the user has waited long enough
    """

    source_picked = Signal(int)
    load_wanted = Signal()
    cancel_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.list = WeakList()
        self.list.hide_title()
        self.source = QComboBox()
        self.source.setAccessibleName(self.tr("Where weak bigrams are looked for"))
        self.source.setAccessibleDescription(self.tr("In this sentence, in a text, or in the whole set"))
        self.source.addItem(self.tr("In this sentence"))
        self.source.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.source.currentIndexChanged.connect(self.source_picked)
        self.load = self._button("file-document-outline", self.tr("Look in a whole text: choose a script…"))
        self.load.clicked.connect(self.load_wanted)
        self.progress = QProgressBar()
        self.progress.setMaximumHeight(14)
        self.progress.setAccessibleName(self.tr("Sentences read"))
        self.cancel = self._button("close", self.tr("Stop reading"))
        self.cancel.clicked.connect(self.cancel_wanted)
        top = QHBoxLayout()
        top.setContentsMargins(6, 4, 6, 0)
        top.setSpacing(4)
        top.addWidget(self.source, 1)
        top.addWidget(self.progress, 1)
        top.addWidget(self.cancel)
        top.addWidget(self.load)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(top)
        column.addWidget(self.list, 1)
        self.setFocusProxy(self.list)
        self.set_progress(None)

    def set_corpus(self, name: str) -> None:
        """A text can be chosen by this name; "" for none. Emits nothing."""
        with QSignalBlocker(self.source):
            while self.source.count() > CORPUS:
                self.source.removeItem(CORPUS)
            if name:
                self.source.addItem(self.tr("In %1").replace("%1", name))

    def set_source(self, source: int) -> None:
        """SENTENCE or CORPUS; emits nothing."""
        with QSignalBlocker(self.source):
            self.source.setCurrentIndex(source)

    def set_progress(self, step: tuple[int, int] | None) -> None:
        """(sentences read, of how many); None when nothing is being read."""
        reading = step is not None
        self.progress.setVisible(reading)
        self.cancel.setVisible(reading)
        self.source.setVisible(not reading)
        self.load.setVisible(not reading)
        if step is not None:
            self.progress.setMaximum(step[1])
            self.progress.setValue(step[0])
            self.progress.setFormat(self.tr("%v of %m sentences"))

    @staticmethod
    def _button(icon: str, tip: str) -> QToolButton:
        button = QToolButton()
        button.setIcon(theme.icon(icon, theme.MUTED))
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.setText(tip)
        button.setAutoRaise(True)
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        return button

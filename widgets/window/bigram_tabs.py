"""Tabs of the open bigrams, above the canvas."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QTabBar, QToolButton, QWidget

from core_pipeline.phonemes import Pair

from .. import theme
from ..picker.bigram_model import spoken_pair


class BigramTabs(QTabBar):
    """Seen while there are two tabs or more.

    tab_picked(i)      the user wants that one in the canvas
    close_wanted(i)    its cross, or the middle button
    order_wanted(a, b) dragged from place a to place b
    """

    tab_picked = Signal(int)
    close_wanted = Signal(int)
    order_wanted = Signal(int, int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Open bigrams"))
        self.setToolTip(self.tr("Open bigrams: drag to reorder, middle button closes"))
        self.setDocumentMode(True)
        self.setDrawBase(False)
        self.setExpanding(False)
        self.setMovable(True)
        self.setUsesScrollButtons(True)
        self.setElideMode(Qt.TextElideMode.ElideNone)
        self.currentChanged.connect(self.tab_picked)
        self.tabMoved.connect(self.order_wanted)
        self.hide()

    def set_tabs(self, pairs: Sequence[Pair | None], current: int) -> None:
        """The open bigrams, and which of them is in the canvas; emits nothing."""
        with QSignalBlocker(self):
            while self.count() > len(pairs):
                self.removeTab(self.count() - 1)
            for i, pair in enumerate(pairs):
                text = spoken_pair(pair) if pair is not None else "–"
                if i == self.count():
                    self.addTab(text)
                    self.setTabButton(i, QTabBar.ButtonPosition.RightSide, self._cross())
                elif text != self.tabText(i):
                    self.setTabText(i, text)
                self.setTabToolTip(i, text)
            self.setCurrentIndex(current)
        self.setVisible(len(pairs) > 1)

    @property
    def titles(self) -> list[str]:
        """What stands on the tabs."""
        return [self.tabText(i) for i in range(self.count())]

    def _cross(self) -> QToolButton:
        button = QToolButton()
        button.setIcon(theme.icon("close", theme.MUTED))
        button.setIconSize(QSize(12, 12))
        button.setText(self.tr("Close"))
        button.setToolTip(self.tr("Close this tab"))
        button.setAccessibleName(self.tr("Close this tab"))
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the keyboard closes the present tab by its own key
        button.setStyleSheet("padding:1px")
        button.clicked.connect(lambda: self.close_wanted.emit(self.tabAt(button.geometry().center())))
        return button

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """The middle button closes."""
        index = self.tabAt(event.position().toPoint())
        if event.button() == Qt.MouseButton.MiddleButton and index >= 0:
            self.close_wanted.emit(index)
        else:
            super().mouseReleaseEvent(event)

"""The preview with a narrow bar above it: what is shown, and buttons for faces, light, camera and turntable."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QHBoxLayout, QMenu, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from .. import theme
from ..elided_label import ElidedLabel
from .face_view import FaceView

_BUTTON = 26


class PreviewPanel(QWidget):
    """A bar over a `FaceView`.

    add_wanted  another face beside those shown
    """

    add_wanted = Signal()

    def __init__(self, view: FaceView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.view = view
        self.caption = ElidedLabel(points=8.0)
        self.caption.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.add = self._button("account-plus-outline", self.tr("Add a face"))
        self.add.clicked.connect(self.add_wanted)
        self.look = self._button("palette-outline", self.tr("Background, light and camera"))
        self.look.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.turntable = self._button("rotate-360", self.tr("Turntable"))
        self.turntable.setCheckable(True)
        self.reset = self._button("camera-retake-outline", self.tr("Reset the view"))
        self.reset.setToolTip(self.tr("Reset the view (Home)"))
        self.reset.clicked.connect(view.reset_wanted)
        bar = QWidget()
        bar.setFixedHeight(_BUTTON + 4)
        row = QHBoxLayout(bar)
        row.setContentsMargins(8, 2, 4, 2)
        row.setSpacing(2)
        row.addWidget(self.caption, 1)
        for button in (self.add, self.look, self.turntable, self.reset):
            row.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(bar)
        column.addWidget(view, 1)

    def sizeHint(self) -> QSize:
        """The view's, and the bar."""
        return self.view.sizeHint() + QSize(0, _BUTTON + 4)

    def set_caption(self, caption: str) -> None:
        """A small line, such as "512 × 512 · 14 ms"."""
        if caption != self.caption.text:
            self.caption.set_text(caption)

    def set_looks(self, groups: Sequence[tuple[str, Sequence[QAction]]]) -> None:
        """The actions of the look's menu, under a title each."""
        menu = QMenu(self.look)
        for title, actions in groups:
            heading = QAction(title, menu)  # Fusion draws no text in a section's line
            heading.setEnabled(False)
            menu.addSeparator()
            menu.addAction(heading)
            menu.addActions(list(actions))
        self.look.setMenu(menu)

    def set_turntable(self, action: QAction) -> None:
        """The switch that the button shows and turns."""
        self.turntable.setToolTip(action.toolTip())
        self.turntable.toggled.connect(action.setChecked)
        action.toggled.connect(self.turntable.setChecked)

    def set_full(self, full: bool) -> None:
        """Whether there is no room for another face."""
        self.add.setEnabled(not full)
        self.add.setToolTip(
            self.tr("Three faces are as many as fit")
            if full
            else self.tr("Add a face beside, to say the same sentence")
        )

    def _button(self, icon: str, name: str) -> QToolButton:
        button = QToolButton()
        button.setIcon(theme.icon(icon, theme.MUTED))
        button.setAutoRaise(True)
        button.setFixedSize(_BUTTON, _BUTTON)
        button.setAccessibleName(name)
        button.setText(name)
        button.setToolTip(name)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        return button

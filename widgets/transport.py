"""Playing the sentence: buttons and the time."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QToolButton, QWidget

from . import theme


class Transport(QWidget):
    """Emits what the user wants; what really plays comes back by the set_… methods."""

    play_toggled = Signal()
    stopped = Signal()
    to_start = Signal()
    loop_toggled = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.start_button = self._button("skip-backward", self.tr("To the start"))
        self.play_button = self._button("play", self.tr("Play"))
        self.stop_button = self._button("stop", self.tr("Stop"))
        self.loop_button = self._button("repeat", self.tr("Loop"))
        self.loop_button.setCheckable(True)
        self.start_button.clicked.connect(self.to_start)
        self.play_button.clicked.connect(self.play_toggled)
        self.stop_button.clicked.connect(self.stopped)
        self.loop_button.clicked.connect(self.loop_toggled)

        self.time = QLabel()
        self.time.setFont(theme.mono_font())
        self.time.setStyleSheet(f"color:{theme.MUTED.name()}")
        self.time.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.time.setAccessibleName(self.tr("Time"))
        self.time.setToolTip(self.tr("Where the sentence is, and how long it is, in seconds"))
        self.time.setMinimumWidth(QFontMetrics(theme.mono_font()).horizontalAdvance("00.00 / 00.00 s") + 12)

        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2)
        for button in (self.start_button, self.play_button, self.stop_button, self.loop_button):
            row.addWidget(button)
        row.addSpacing(4)
        row.addWidget(self.time)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self._playing = False
        self.set_time(0.0, 0.0)

    def set_playing(self, playing: bool) -> None:
        """Show a pause sign while playing."""
        if playing != self._playing:
            self._playing = playing
            self._name(
                self.play_button, "pause" if playing else "play", self.tr("Pause") if playing else self.tr("Play")
            )

    def set_time(self, t: float, duration: float) -> None:
        """Where the sentence is and how long it is, seconds; cheap enough for every frame."""
        text = self.tr("%1 / %2 s").replace("%1", f"{t:.2f}").replace("%2", f"{duration:.2f}")
        if text != self.time.text():
            self.time.setText(text)

    def set_loop(self, loop: bool) -> None:
        """Whether the sentence repeats; emits nothing."""
        self.loop_button.setChecked(loop)

    def _button(self, icon: str, name: str) -> QToolButton:
        button = QToolButton()
        button.setIconSize(QSize(18, 18))
        button.setAutoRaise(True)
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._name(button, icon, name)
        return button

    def _name(self, button: QToolButton, icon: str, name: str) -> None:
        button.setIcon(theme.icon(icon))
        button.setText(name)
        button.setToolTip(name)
        button.setAccessibleName(name)

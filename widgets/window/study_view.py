"""A blind comparison: two clips side by side, which moves better, how strongly; no word of what made them."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QCloseEvent, QImage, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QDialog,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from core_pipeline.study import LEFT, RIGHT, STRENGTHS

from .. import theme


class _Screen(QWidget):
    """Shows a picture as large as it can."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setMinimumSize(260, 260)
        self._image = QImage()

    def set_image(self, image: QImage) -> None:
        """Another picture; a null one for none."""
        self._image = image
        self.update()

    def sizeHint(self) -> QSize:
        """A clip's usual size."""
        return QSize(400, 400)

    def paintEvent(self, event: QPaintEvent) -> None:
        """The picture in the middle."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), theme.SUNKEN)
        if not self._image.isNull():
            size = self._image.size().scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
            x, y = (self.width() - size.width()) // 2, (self.height() - size.height()) // 2
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(self.rect().adjusted(x, y, -x, -y), self._image)


class StudyView(QDialog):
    """Values come down, wishes go up.

    folder_wanted()          open a study
    play_wanted(side)        show a clip from its start, as often as one likes
    answered(side, strength)
    observer_changed(name)   who judges
    csv_wanted()             save every answer
    """

    folder_wanted = Signal()
    play_wanted = Signal(str)
    answered = Signal(str, int)
    observer_changed = Signal(str)
    csv_wanted = Signal()
    closed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Blind comparison"))
        self.folder = QPushButton(self.tr("Open &Study…"))
        self.observer = QLineEdit()
        self.observer.setPlaceholderText(self.tr("who judges"))
        self.observer.setAccessibleName(self.tr("Observer"))
        self.observer.setMaximumWidth(160)
        self.place = QLabel(self.tr("Open a folder made by lipstitch study make."))
        self.place.setWordWrap(True)
        self.screens = {LEFT: _Screen(self.tr("Left clip")), RIGHT: _Screen(self.tr("Right clip"))}
        self.plays = {
            LEFT: self._play(self.tr("Play &Left"), LEFT),
            RIGHT: self._play(self.tr("Play &Right"), RIGHT),
        }
        self.sides, self.side_buttons = self._choice(
            [(LEFT, self.tr("Left moves better")), (RIGHT, self.tr("Right moves better"))]
        )
        self.strengths, self.strength_buttons = self._choice([(s, str(s)) for s in STRENGTHS])
        for strength, button in self.strength_buttons.items():
            button.setToolTip(self.tr("Preference from 1, weak, to 5, strong"))
            button.setAccessibleName(self.tr("Strength {0}").format(strength))
        self.next = QPushButton(self.tr("&Next Pair"))
        self.results = QLabel()
        self.results.setWordWrap(True)
        self.results.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.csv = QPushButton(self.tr("Save Answers as &CSV…"))
        for button in (self.folder, self.next, self.csv, *self.plays.values()):
            button.setAutoDefault(False)
        self._lay_out()
        self.folder.clicked.connect(self.folder_wanted)
        self.csv.clicked.connect(self.csv_wanted)
        self.observer.editingFinished.connect(lambda: self.observer_changed.emit(self.observer.text().strip()))
        self.next.clicked.connect(self._answer)
        self.set_trial(None)
        self.resize(900, 640)

    def set_observer(self, name: str) -> None:
        """Who judges; emits nothing."""
        with QSignalBlocker(self.observer):
            self.observer.setText(name)

    def set_trial(self, text: str | None, number: int = 0, total: int = 0) -> None:
        """The sentence of the pair that is judged now; None while there is none. The choice begins anew."""
        for group in (self.sides, self.strengths):
            group.setExclusive(False)
            for button in group.buttons():
                button.setChecked(False)
            group.setExclusive(True)
        self._ready = text is not None
        if text is not None:
            self.place.setText(self.tr("Pair {0} of {1}: “{2}”").format(number, total, text))
        for widget in (*self.plays.values(), *self.sides.buttons(), *self.strengths.buttons()):
            widget.setEnabled(self._ready)
        for screen in self.screens.values():
            screen.set_image(QImage())
        self._choice_made()

    def set_message(self, text: str) -> None:
        """What is to be known, in the place of the sentence."""
        self.place.setText(text)

    def set_image(self, side: str, image: QImage) -> None:
        """A picture of one clip."""
        self.screens[side].set_image(image)

    def set_results(self, lines: Sequence[str]) -> None:
        """What came out, once everything has been judged; () hides it, for it would tell."""
        self.results.setText("\n".join(lines))
        self.results.setVisible(bool(lines))
        self.csv.setVisible(bool(lines))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Whatever plays, stops."""
        self.closed.emit()
        super().closeEvent(event)

    def _answer(self) -> None:
        side = next(side for side, button in self.side_buttons.items() if button.isChecked())
        strength = next(s for s, button in self.strength_buttons.items() if button.isChecked())
        self.answered.emit(side, strength)

    def _choice_made(self) -> None:
        chosen = [group.checkedButton() is not None for group in (self.sides, self.strengths)]
        self.next.setEnabled(self._ready and all(chosen))

    def _play(self, text: str, side: str) -> QPushButton:
        button = QPushButton(theme.icon("play"), text)
        button.clicked.connect(lambda: self.play_wanted.emit(side))
        return button

    def _choice(self, options: Sequence[tuple[object, str]]) -> tuple[QButtonGroup, dict]:
        group, buttons = QButtonGroup(self), {}
        for value, text in options:
            button = QPushButton(text)
            button.setAutoDefault(False)
            button.setCheckable(True)
            button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            button.setMinimumWidth(44)
            group.addButton(button)
            buttons[value] = button
        group.buttonToggled.connect(lambda *_: self._choice_made())
        return group, buttons

    def _lay_out(self) -> None:
        top = QHBoxLayout()
        top.addWidget(self.folder)
        top.addWidget(self.observer)
        top.addWidget(self.place, 1)
        films = QGridLayout()
        for column, side in enumerate((LEFT, RIGHT)):
            films.addWidget(self.screens[side], 0, column)
            films.addWidget(self.plays[side], 1, column)
            films.addWidget(self.side_buttons[side], 2, column, Qt.AlignmentFlag.AlignHCenter)
        films.setRowStretch(0, 1)
        foot = QHBoxLayout()
        foot.addStretch(1)
        foot.addWidget(QLabel(self.tr("How strongly?  weak")))
        for button in self.strengths.buttons():
            foot.addWidget(button)
        foot.addWidget(QLabel(self.tr("strong")))
        foot.addSpacing(24)
        foot.addWidget(self.next)
        foot.addStretch(1)
        last = QHBoxLayout()
        last.addWidget(self.results, 1)
        last.addWidget(self.csv)
        column = QVBoxLayout(self)
        column.addLayout(top)
        column.addLayout(films, 1)
        column.addLayout(foot)
        column.addLayout(last)
        self.set_results(())

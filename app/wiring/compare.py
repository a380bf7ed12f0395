"""A/B: hold a key to see another curve set instead of this one; both in the overlay, differences in the picker."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QFileDialog

from core_pipeline import pipeline
from core_pipeline.compare import differences
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.pipeline import Stages
from core_pipeline.speech.utterance import Utterance

from .open_bigram import OpenBigram
from .parts import Parts

#: RMS weight over all poses at which a cell has its full tint.
FULL = 0.15


class Compare(QObject):
    """Holds set B: the version at opening, or another file.

    other  what is compared with now, None for nothing
    """

    def __init__(self, parts: Parts, bigram: OpenBigram, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._document, self._session = parts.window, parts.document, parts.session
        self._state, self._bigram = parts.state, bigram
        self._opened = self._document.curve_set
        self.other: CurveSet | None = None
        self._file_name = ""  # of `other`, when it came from a file
        self._drawn: tuple[Utterance | None, CurveSet | None] = (None, None)
        tools = self._window.actions_.tools_menu
        self.hold_action = tools.add(
            "compare.hold",
            self.tr("See the &Other Set While Held"),
            "B",
            self.tr("While the key is held, face and curves show the set you compare with"),
        )
        self.hold_action.setAutoRepeat(False)
        self.hold_action.triggered.connect(lambda _=False: self.hold())
        menu = tools.submenu(self.tr("Compare &With"))
        self._group = menu.choice()
        self.nothing = self._choice(menu.add("compare.nothing", self.tr("&Nothing"), (), checked=True))
        self.opening = self._choice(
            menu.add(
                "compare.opening", self.tr("The &Version at Opening"), (), self.tr("As the file was"), checked=False
            )
        )
        self.file = self._choice(
            menu.add("compare.file", self.tr("Another Curve &Set…"), (), self.tr("Choose a file"), checked=False)
        )
        self.nothing.triggered.connect(lambda _=False: self.use(None))
        self.opening.triggered.connect(lambda _=False: self.use(self._opened))
        self.file.triggered.connect(lambda _=False: self._ask_file())
        self._window.let_go.connect(self.let_go)
        self._document.replaced.connect(self._replaced)
        self._document.bigram_changed.connect(self._tint)
        self._document.bigrams_changed.connect(self._tint)
        self._session.stages_changed.connect(self._stages_changed)

    def _choice(self, action: QAction) -> QAction:
        self._group.addAction(action)
        return action

    def use(self, other: CurveSet | None) -> None:
        """Compare with this set; None ends it. Sets with other poses or phonemes are refused with a hint."""
        if other is not None and other.poses != self._document.curve_set.poses:
            self._window.hint_label.setText(
                self.tr("{0} has other poses: the two cannot be compared").format(other.name)
            )
            other = None
        elif other is not None:
            told = self.tr("Compared with {0}: hold {1} to see and hear it")
            keys = self.hold_action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
            self._window.hint_label.setText(told.format(self._name(other), keys))
        self.other = other
        self._mark()
        self._tint()
        self._stages_changed(self._session.stages)

    def open_file(self, path: Path) -> None:
        """Compare with the set in a file."""
        try:
            other = curve_set_json.load(path)
            self._file_name = path.name  # two versions of a set bear one name
            self.use(other)
        except UserError as error:
            self.use(None)
            self._window.hint_label.setText(str(error))

    def hold(self) -> None:
        """Show B: what is compared with, else the version at opening."""
        other = self.other if self.other is not None else self._opened
        if self._session.in_gesture or other.poses != self._document.curve_set.poses:
            return
        self._session.show_other(other)
        pair = self._bigram.pair
        if pair is not None:
            self._window.canvas.set_ghost(other.bigrams.get(pair, Bigram()).curves)
        self._window.hint_label.setText(self.tr("{0} is shown").format(self._name(other)))

    def let_go(self) -> None:
        """Show A again."""
        if self._session.shows_other:
            self._session.show_other(None)
            self._window.hint_label.setText("")

    def _name(self, other: CurveSet) -> str:
        return self.tr("The version at opening") if other is self._opened else self._file_name or other.name

    def _ask_file(self) -> None:
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Compare with"), self._state.text("folder"), self.tr("Curve sets (*.json)")
        )
        if name:
            self.open_file(Path(name))
        else:
            self._mark()

    def _mark(self) -> None:
        """Check what is compared with now."""
        known = self.nothing if self.other is None else self.opening if self.other is self._opened else self.file
        known.setChecked(True)

    def _replaced(self) -> None:
        """Another set, or a great change of this one: which of the two shows when the undo stack has heard of it."""
        QTimer.singleShot(0, self, self._begin)

    def _begin(self) -> None:
        if self._document.undo_stack.count():
            return
        self._opened = self._document.curve_set
        self.use(None)

    def _tint(self, _: object = None) -> None:
        if self.other is None:
            self._window.picker.set_differences(None)
            return
        curve_set = self._document.curve_set
        found = differences(curve_set, self.other)
        pairs = ((a, b) for a in curve_set.phonemes for b in curve_set.phonemes)
        shares = {pair: found.get(pair, 0.0) / FULL for pair in pairs}
        self._window.picker.set_differences(shares, self._name(self.other))

    def _stages_changed(self, _: Stages | None) -> None:
        now = self._session.utterance, self.other
        if now != self._drawn:  # the same all through a drag
            self._drawn = now
            utterance, other = now
            played = None if utterance is None or other is None else pipeline.run(utterance.schedule, other)
            self._window.stage_panel.set_other(played)

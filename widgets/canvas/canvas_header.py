"""The line above the canvas: which bigram is open, in what word, how often used, and a few switches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

from PySide6.QtCore import QT_TRANSLATE_NOOP, QSize, Qt, Signal, SignalInstance
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QToolButton, QWidget

from .. import theme

_GAP = "\u2002·\u2002"

#: Pixels that the text keeps; buttons that would take them are left out.
TEXT = 210
#: What no button may take beside the title: margins and the gap behind it.
_EDGES = 32
#: Pixels of the whole at least.
NARROWEST = 230
#: Letters of a note that stand in the line.
NOTE = 40

_ACTIONS = (
    ("frame_all", "arrow-expand-all", QT_TRANSLATE_NOOP("CanvasHeader", "Frame all")),
    ("reverse", "flip-horizontal", QT_TRANSLATE_NOOP("CanvasHeader", "Reverse in time")),
    ("mirror", "flip-vertical", QT_TRANSLATE_NOOP("CanvasHeader", "Mirror values")),
    ("copy", "content-copy", QT_TRANSLATE_NOOP("CanvasHeader", "Copy keys, or the active curve")),
    ("paste", "content-paste", QT_TRANSLATE_NOOP("CanvasHeader", "Paste")),
    ("duplicate", "content-duplicate", QT_TRANSLATE_NOOP("CanvasHeader", "Duplicate from a similar bigram")),
    ("slide", "compare-horizontal", QT_TRANSLATE_NOOP("CanvasHeader", "Slide to another version")),
)
#: Those that go where there is no room, the last one first: keys do the same. The others go before the title does.
_SPARE = ("duplicate", "slide", "reverse", "mirror", "copy", "paste")


class CanvasHeader(QWidget):
    """“F – Ah  as in “fat” · used 2× in this sentence · draft”, two switches, and buttons for what keys do too.

    Where there is no room some buttons go first, then words, the use, the status, the example; the tooltip always
    has the whole line.
    """

    snap_toggled = Signal(bool)
    polygon_toggled = Signal(bool)
    #: The open bigram shall be as the set below has it.
    revert_wanted = Signal()
    #: One of the canvas' actions, as keymaps name them.
    action_wanted = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._pair = ("", "")
        self._word, self._span = "", (0, 0)
        self._used: int | None = None
        self._status = ""
        self._spent = ""
        self._layer = ""
        self._note = ""
        self._title = QLabel()
        self._title.setFont(theme.font(15, bold=True))
        self._title.setAccessibleName(self.tr("Open bigram"))
        self._detail = QLabel()
        self._detail.setTextFormat(Qt.TextFormat.RichText)
        self._detail.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._detail.setAccessibleName(self.tr("About this bigram"))
        palette = self._detail.palette()
        palette.setColor(palette.ColorRole.WindowText, theme.MUTED)
        self._detail.setPalette(palette)
        self._snap = self._switch("magnet", self.tr("Snap to the grid"), self.snap_toggled)
        self._snap.setToolTip(self.tr("Snap to the grid; Ctrl while dragging does the opposite"))
        self._polygon = self._switch(
            "vector-polyline", self.tr("Show the straight lines between keys"), self.polygon_toggled
        )
        self._polygon.setChecked(True)
        self._revert = self._button("backup-restore", self.tr("Revert to base"))
        self._revert.clicked.connect(lambda _=False: self.revert_wanted.emit())
        self._revert.hide()
        self._actions: dict[str, QToolButton] = {}
        for action, icon, tip in _ACTIONS:
            button = self._actions[action] = self._button(icon, self.tr(tip))
            button.clicked.connect(lambda _=False, action=action: self.action_wanted.emit(action))
        layout = self._layout = QHBoxLayout(self)
        layout.setContentsMargins(12, 5, 8, 5)
        layout.setSpacing(2)
        layout.addWidget(self._title)
        layout.addSpacing(8)
        layout.addWidget(self._detail, 1)
        layout.addWidget(self._revert)
        for button in self.buttons:
            layout.addWidget(button)

    def _switch(self, icon: str, name: str, toggled: SignalInstance) -> QToolButton:
        button = self._button(icon, name)
        button.setCheckable(True)
        button.clicked.connect(toggled)
        return button

    def _button(self, icon: str, tip: str) -> QToolButton:
        button = QToolButton()
        button.setIcon(theme.icon(icon))
        button.setIconSize(QSize(18, 18))
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.setText(tip)
        return button

    def set_bigram(self, first: str, second: str) -> None:
        """The open bigram's phones; "" twice for none."""
        self._pair = (first, second)
        self._title.setText(f"{first.capitalize()} – {second.capitalize()}" if first or second else "")
        self._show()

    def set_example(self, word: str, span: tuple[int, int] = (0, 0)) -> None:
        """A word with this bigram, "" for none; the letters from span[0] to before span[1] are highlighted."""
        if (word, span) != (self._word, self._span):
            self._word, self._span = word, span
            self._show()

    def set_usage(self, count: int | None) -> None:
        """How often the sentence uses the bigram; None when there is no sentence."""
        if count != self._used:
            self._used = count
            self._show()

    def set_status(self, status: str) -> None:
        """How far the work has come, as a word to show."""
        if status != self._status:
            self._status = status
            self._show()

    def set_time_spent(self, text: str) -> None:
        """How long the user has worked on the bigram, shown where there is room for it."""
        if text != self._spent:
            self._spent = text
            self._show()

    def set_layer(self, text: str, own: bool) -> None:
        """Which layer the bigram comes from, "" where there is only one; its own one can be reverted."""
        self._layer = text
        self._revert.setVisible(own)
        self._show()

    def set_note(self, text: str) -> None:
        """The animator's words about the bigram; the line has their beginning, the tooltip all of them."""
        if text != self._note:
            self._note = text
            self._show()

    @property
    def revert(self) -> QToolButton:
        """The button that goes back to the set below."""
        return self._revert

    def set_snap(self, on: bool) -> None:
        """Whether keys keep to the grid."""
        self._snap.setChecked(on)

    @property
    def text(self) -> str:
        """The whole line without markup."""
        return " · ".join(part for part in (self._title.text(), *(plain for plain, _ in self._parts())) if part)

    @property
    def detail(self) -> str:
        """What stands behind the title now, with markup."""
        return self._detail.text()

    @property
    def buttons(self) -> tuple[QToolButton, ...]:
        """The switches, from the left."""
        return self._snap, self._polygon, *self._actions.values()

    def button_of(self, action: str) -> QToolButton:
        """The button of one of the canvas' actions; KeyError when it has none."""
        return self._actions[action]

    def set_keys(self, keys: Mapping[str, str]) -> None:
        """Action → its key in the present keymap, for tooltips."""
        for action, _, tip in _ACTIONS:
            key = f" ({keys[action]})" if keys.get(action) else ""
            self._actions[action].setToolTip(self.tr(tip) + key)

    def minimumSizeHint(self) -> QSize:
        """Room for the bigram and three buttons: the spare ones go where it is less than roomy."""
        return QSize(NARROWEST, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fits the line."""
        super().resizeEvent(event)
        button = self._snap.sizeHint().width() + self._layout.spacing()
        spare = [self._actions[action] for action in _SPARE]
        usual = [button for button in self.buttons if button not in spare]
        room = event.size().width() - self._title.sizeHint().width()
        for buttons, left in ((usual, room - _EDGES), (spare, room - TEXT - len(usual) * button)):
            for place, one in enumerate(buttons):
                one.setVisible(left >= (place + 1) * button)
        self._show()

    def _parts(self, *, short: bool = False) -> list[tuple[str, str]]:
        """(plain, rich) text of each part that has something to say: example, use, status."""
        parts = []
        if self._word:
            start, end = self._span
            before, letters, after = (escape(s) for s in (self._word[:start], self._word[start:end], self._word[end:]))
            marked = f'{before}<b style="color:{theme.HIGHLIGHT.name()}">{letters}</b>{after}'
            frame = self.tr("as in “{0}”")
            parts.append((frame.format(self._word), frame.format(marked)))
        if self._used is not None:
            used = self.tr("used {0}×") if short else self.tr("used {0}× in this sentence")
            used = used.format(self._used) if self._used else self.tr("not in this sentence")
            parts.append((used, escape(used)))
        if self._status:
            parts.append((self._status, escape(self._status)))
        if self._layer:
            parts.append((self._layer, escape(self._layer)))
        if self._note:
            line = " ".join(self._note.split())
            short_note = line if len(line) <= NOTE else f"{line[: NOTE - 1]}…"
            parts.append((f"“{short_note}”", escape(f"“{short_note}”")))
        return parts

    def _show(self) -> None:
        tip = f"{self.text}\n{self._note}" if self._note else self.text
        self.setToolTip(f"<qt>{escape(tip)}</qt>".replace("\n", "<br>") if "<" in tip else tip)  # never markup
        self._detail.setAccessibleDescription(self.text)
        self._layout.activate()
        room = self._detail.width() - 8
        parts = self._parts()
        if self._length(parts) > room:
            parts = self._parts(short=True)
        spent = (self._spent, f'<span style="color:{theme.FAINT.name()}">{escape(self._spent)}</span>')
        if self._spent and self._length([*parts, spent]) <= room:
            parts.append(spent)
        while parts and self._length(parts) > room:
            parts.pop(1 if self._word and len(parts) > 1 else 0)
        self._detail.setText(_GAP.join(rich for _, rich in parts))

    def _length(self, parts: Sequence[tuple[str, str]]) -> int:
        """Pixels of the line."""
        return self._detail.fontMetrics().horizontalAdvance(_GAP.join(plain for plain, _ in parts))

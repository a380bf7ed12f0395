"""Choose the bigram to work on: search, the square of all pairs, legend and coverage.

Knows pairs and what is said of them, nothing of curves, dictionaries or the document.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from itertools import pairwise
from types import MappingProxyType

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QAction, QActionGroup, QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QMenu, QSizePolicy, QSpacerItem, QToolButton, QVBoxLayout, QWidget

from core_pipeline.phonemes import Pair

from .. import theme
from .bigram_grid import BigramGrid
from .bigram_legend import BigramLegend, CoverageBar
from .bigram_model import spoken_pair

NONE: Mapping[Pair, float] = MappingProxyType({})


def phones_in(text: str, phonemes: Sequence[str]) -> tuple[str, ...]:
    """The phones a search spells, "f-ah" or "F ah d"; () when any part of it is no phone of the set."""
    known = {phone.casefold(): phone for phone in phonemes}
    parts = [part for part in re.split(r"[\s\-–—_,>→]+", text.casefold()) if part]
    return tuple(known[part] for part in parts) if all(part in known for part in parts) else ()


class BigramPicker(QWidget):
    """The left dock's upper part.

    picked(pair)         the user wants this bigram opened: click, arrow key, Enter, or its name in the search
    entered()            and wants to work on it: Enter in the square, or in a search that found only one
    search_wanted(text)  the search is no phones: whoever knows words answers with `set_matches`
    """

    picked = Signal(tuple)
    entered = Signal()
    search_wanted = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._asked = False  # the present text went out as `search_wanted`
        self._open_first = False
        self.search = QLineEdit()
        self.search.setClearButtonEnabled(True)
        self.search.setPlaceholderText(self.tr("Find: f ah, f or fat"))
        self.search.addAction(theme.icon("magnify", theme.MUTED), QLineEdit.ActionPosition.LeadingPosition)
        self.search.setAccessibleName(self.tr("Find a bigram"))
        self.search.setToolTip(
            self.tr(
                "Two phones open their bigram, one shows its row and column,\na word shows its bigrams. Enter steps on."
            )
        )
        self.search.textChanged.connect(self._search)
        self.search.returnPressed.connect(self._enter)
        self.search.installEventFilter(self)
        self.grid = BigramGrid()
        self.grid.picked.connect(self.picked)
        self.grid.entered.connect(self.entered)
        self.legend = BigramLegend()
        self.coverage = CoverageBar()
        self._matches: list[Pair] = []
        self._next = 0

        self._orders: Mapping[str, tuple[str, ...]] = {}
        self.order_name = ""
        self.order = QToolButton()
        self.order.setIcon(theme.icon("sort", theme.MUTED))
        self.order.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.order.setToolTip(self.tr("Order of rows and columns"))
        self.order.setText(self.tr("Order of rows and columns"))
        self.order.setAccessibleName(self.tr("Order of rows and columns"))
        self.order.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.order.setMenu(QMenu(self.order))
        self.order.hide()

        top = QHBoxLayout()
        top.setSpacing(4)
        top.addWidget(self.search)
        top.addWidget(self.order)
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 6, 6, 6)
        column.setSpacing(6)
        column.addLayout(top)
        column.addWidget(self.grid, 1)
        column.addWidget(self.legend)
        column.addWidget(self.coverage)
        # takes only what the grid leaves when its cells are at their largest
        column.addSpacerItem(QSpacerItem(0, 0, QSizePolicy.Policy.Minimum, QSizePolicy.Policy.MinimumExpanding))
        self.setFocusProxy(self.search)

    def set_phonemes(self, phonemes: Sequence[str]) -> None:
        """The phones of rows and columns, in order."""
        if tuple(phonemes) != self.grid.pairs.phonemes:
            current = self.current
            self.grid.pairs.set_phonemes(phonemes)
            self.grid.set_current(current)
            self._search(self.search.text(), open_pair=False)

    def set_orders(self, orders: Mapping[str, Sequence[str]]) -> None:
        """Name → the same phones in another order, for the menu beside the search; the one chosen before stays."""
        chosen = self.order_name if self.order_name in orders else next(iter(orders), "")
        self._orders = {name: tuple(phones) for name, phones in orders.items()}
        menu = self.order.menu()
        menu.clear()
        group = QActionGroup(menu)
        for name in self._orders:
            menu.addAction(QAction(name, group, checkable=True))
        group.triggered.connect(lambda action: self.set_order(action.text()))
        self.order.setVisible(len(self._orders) > 1)
        self.set_order(chosen)

    def set_order(self, name: str) -> None:
        """Shows rows and columns in one of the orders; ignored when there is none of that name."""
        if name in self._orders:
            self.order_name = name
            for action in self.order.menu().actions():
                action.setChecked(action.text() == name)
            self.order.setToolTip(self.tr("Order of rows and columns: %1").replace("%1", name))
            self.order.setText(self.tr("Order of rows and columns: %1").replace("%1", name))
            self.set_phonemes(self._orders[name])

    def set_statuses(self, statuses: Mapping[Pair, str]) -> None:
        """Pair → status; a pair not named is empty."""
        self.grid.pairs.statuses = statuses
        self.grid.pairs.refresh()

    def set_weak(self, weak: Mapping[Pair, str], shares: Mapping[Pair, float] = NONE) -> None:
        """Pair → why it is weak, in a few words, and how weak beside the weakest, 0…1; unknown: as weak as that."""
        self.grid.pairs.weak = weak
        self.grid.pairs.weakness = shares
        self.grid.pairs.refresh()

    def set_differences(self, differences: Mapping[Pair, float] | None, other: str = "") -> None:
        """Tint pairs by how much they differ from `other`, 0…1, in place of status; None: no more."""
        self.grid.pairs.differences = differences
        self.legend.set_other(other if differences is not None else "")
        self.grid.pairs.refresh()

    def set_used(self, used: Mapping[Pair, int]) -> None:
        """Pair → how often the sentence has it."""
        self.grid.pairs.used = used
        self.grid.pairs.refresh()

    def set_overridden(self, pairs: Collection[Pair]) -> None:
        """The pairs for which the character has curves of its own."""
        self.grid.pairs.overridden = pairs
        self.grid.pairs.refresh()

    def set_words(self, words: Mapping[Pair, str]) -> None:
        """Pair → a word that has it, for tooltips."""
        self.grid.pairs.words = words

    def set_current(self, pair: Pair | None) -> None:
        """Which bigram is open; emits nothing."""
        self.grid.set_current(pair)

    def set_coverage(self, text: str, fraction: float) -> None:
        """`text` over a bar filled to `fraction`, 0…1."""
        self.coverage.set_coverage(text, fraction)

    def set_matches(self, pairs: Sequence[Pair]) -> None:
        """The answer to `search_wanted`: the bigrams of that word, in its order; none when it is unknown."""
        if not self._asked:
            return  # the search has moved on
        self._show_matches(list(dict.fromkeys(pairs)))
        if self._open_first:
            self._step()

    @property
    def current(self) -> Pair | None:
        """The bigram shown as open."""
        index = self.grid.currentIndex()
        return self.grid.pairs.pair_at(index) if index.isValid() else None

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """In the search field, Escape empties and Down goes to the square."""
        if watched is self.search and isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            if event.key() == Qt.Key.Key_Escape and self.search.text():
                self.search.clear()
                return True
            if event.key() == Qt.Key.Key_Down:
                self.grid.setFocus(Qt.FocusReason.TabFocusReason)
                return True
        return super().eventFilter(watched, event)

    def _search(self, text: str, *, open_pair: bool = True) -> None:
        self._asked = self._open_first = False
        phonemes = self.grid.pairs.phonemes
        phones = phones_in(text, phonemes)
        if not text.strip():
            self.grid.set_found(None)
            self.legend.set_message("")
            self._matches = []
        elif len(phones) == 1:
            phone = phones[0]
            row = [(phone, other) for other in phonemes]
            column = [(other, phone) for other in phonemes if other != phone]
            self._show_matches(row + column, phones, ringed=False)
            self.legend.set_message(self.tr("Row and column of %1").replace("%1", phone.capitalize()))
        elif phones:
            pairs = list(dict.fromkeys(pairwise(phones)))
            self._show_matches(pairs, phones)
            if len(pairs) == 1 and open_pair and not self._may_grow(text):
                self._step()
        else:
            self._show_matches([])
            self.legend.set_message(self.tr("Looking for “%1”…").replace("%1", text.strip()))
            self._asked = True
            self.search_wanted.emit(text.strip())

    def _may_grow(self, text: str) -> bool:
        """Whether the last phone may be the beginning of a longer one: "t" of "th"."""
        rest = text.casefold()
        return any(
            rest.endswith(short.casefold()) and long != short and long.casefold().startswith(short.casefold())
            for short in phones_in(text, self.grid.pairs.phonemes)[-1:]
            for long in self.grid.pairs.phonemes
        )

    def _show_matches(self, pairs: list[Pair], phones: Collection[str] = (), *, ringed: bool = True) -> None:
        self._matches, self._next = [pair for pair in pairs if self.grid.pairs.cell(pair)], 0
        self.grid.set_found(self._matches, phones, ringed=ringed)
        if not self._matches:
            self.legend.set_message(self.tr("No such bigram and no such word"))
        elif len(self._matches) == 1:
            self.legend.set_message(spoken_pair(self._matches[0]))
        else:
            found = self.tr("%1 bigrams · Enter steps through them").replace("%1", str(len(self._matches)))
            self.legend.set_message(found)

    def _enter(self) -> None:
        self._step()
        if len(self._matches) == 1:
            self.entered.emit()

    def _step(self) -> None:
        if self._matches:
            pair = self._matches[self._next % len(self._matches)]
            self._next += 1
            self.grid.set_current(pair)
            self.picked.emit(pair)
        elif self._asked:
            self._open_first = True  # Enter came before the answer

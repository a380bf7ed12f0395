"""Tabs brought to life: several bigrams open at once, one of them in the canvas, all of one document."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from PySide6.QtCore import QObject

from core_pipeline.curves import Curve
from core_pipeline.phonemes import Pair

from .open_bigram import OpenBigram
from .parts import Parts

#: More tabs than this are no help.
MOST = 20


@dataclass(frozen=True, eq=False)
class Tab:
    """A bigram, and its curves when the tab was given it: the ghost to compare with."""

    pair: Pair | None
    ghost: Mapping[str, Curve] = field(default_factory=dict)


class Tabs(QObject):
    """What opens a bigram puts it in the present tab, unless another one has it already."""

    def __init__(self, parts: Parts, bigram: OpenBigram, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._document = parts.document
        self._bigram = bigram
        self._view = parts.window.bigram_tabs
        self._tabs: list[Tab] = [self._new(None)]
        self._at = 0
        bigram.opened.connect(self._opened)
        parts.document.replaced.connect(self._replaced)
        self._view.tab_picked.connect(self.go)
        self._view.close_wanted.connect(self.close)
        self._view.order_wanted.connect(self._reordered)
        a = parts.window.actions_
        for action, act in (
            (a.new_tab, self.add),
            (a.close_tab, self.close),
            (a.next_tab, lambda: self.go((self._at + 1) % len(self._tabs))),
            (a.previous_tab, lambda: self.go((self._at - 1) % len(self._tabs))),
        ):
            action.triggered.connect(lambda _=False, act=act: act())

    @property
    def pairs(self) -> list[Pair | None]:
        """The open bigrams."""
        return [tab.pair for tab in self._tabs]

    def add(self) -> None:
        """Keep the open bigram in its tab; the next one opened gets a new tab, where its swapped pair waits."""
        pair = self._bigram.pair
        if pair is None or len(self._tabs) == MOST:
            self._window.hint_label.setText(self.tr("There is room for {0} tabs: close one first.").format(MOST))
            return
        other = next((p for p in (pair[::-1], *self._near(pair)) if p not in self.pairs), None)
        if other is not None:
            self._tabs.insert(self._at + 1, self._new(other))
            self.go(self._at + 1)

    def go(self, index: int) -> None:
        """Bring the bigram of a tab into the canvas."""
        self._at = index
        tab = self._tabs[index]
        self._bigram.open(tab.pair)
        self._window.canvas.set_ghost(tab.ghost)
        self._show()

    def close(self, index: int | None = None) -> None:
        """Close a tab, by default the present one; the last one stays."""
        index = self._at if index is None else index
        if len(self._tabs) > 1:
            del self._tabs[index]
            was_open = index == self._at
            self._at = min(self._at - (index < self._at), len(self._tabs) - 1)
            self.go(self._at) if was_open else self._show()

    def _replaced(self) -> None:
        """Another set, or the same after a great change: the bigrams it has stay open."""
        curve_set = self._document.curve_set
        open_pair = self._tabs[self._at].pair
        kept = [self._new(pair) for pair in self.pairs if pair is not None and curve_set.has_pair(pair)]
        self._tabs = kept or [self._new(None)]
        self._at = self.pairs.index(open_pair) if open_pair in self.pairs else 0
        self._show()

    def _opened(self, pair: Pair | None) -> None:
        if pair in self.pairs:
            self._at = self.pairs.index(pair)
            self._window.canvas.set_ghost(self._tabs[self._at].ghost)
        else:
            self._tabs[self._at] = self._new(pair)
        self._show()

    def _reordered(self, source: int, target: int) -> None:
        open_tab = self._tabs[self._at]
        self._tabs.insert(target, self._tabs.pop(source))
        self._at = self._tabs.index(open_tab)

    def _new(self, pair: Pair | None) -> Tab:
        bigram = self._document.curve_set.bigrams.get(pair) if pair is not None else None
        return Tab(pair, bigram.curves if bigram is not None else {})

    def _near(self, pair: Pair) -> list[Pair]:
        """The bigrams after one, in the order of the set."""
        phones = self._document.curve_set.phonemes
        return [(pair[0], second) for second in phones]

    def _show(self) -> None:
        self._view.set_tabs(self.pairs, self._at)

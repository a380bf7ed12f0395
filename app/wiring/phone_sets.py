"""Edit → Phone Set…: changes of the phonemes on a draft, shown before they are done, then one undo step."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QObject

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.phone_sets import added, change_of, removed, renamed
from core_pipeline.phonemes import SILENCE, Pair, pair_name
from widgets.window.phone_set_dialog import PhoneRow, PhoneSetDialog

from .parts import Parts


class PhoneSets(QObject):
    """Shows the dialog and keeps the draft."""

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._document = parts.document
        self._window = parts.window
        self._draft = parts.document.curve_set
        self._dialog: PhoneSetDialog | None = None
        self._window.actions_.phone_set.triggered.connect(self.show)

    def show(self) -> None:
        """Ask, and do what was agreed on."""
        if self._document.read_only_reason:
            self._window.hint_label.setText(self._document.read_only_reason)
            return
        self._draft = self._document.curve_set
        dialog = self._dialog = PhoneSetDialog(self._window)
        dialog.added.connect(self._added)
        dialog.renamed.connect(self._renamed)
        dialog.removed.connect(self._removed)
        self._show()
        if dialog.exec() and self._draft is not self._document.curve_set:
            self._document.change_set(self._draft, self.tr("Change the phone set"))
        self._dialog = None
        dialog.deleteLater()

    def _added(self, name: str, like: str, spoken: Sequence[str]) -> None:
        self._try(lambda: added(self._draft, name, like or None, spoken), name)

    def _renamed(self, old: str, new: str) -> None:
        self._try(lambda: renamed(self._draft, old, new), new)

    def _removed(self, name: str, into: str) -> None:
        self._try(lambda: removed(self._draft, name, into), into)

    def _try(self, act: Callable[[], CurveSet], choose: str) -> None:
        assert self._dialog is not None
        try:
            self._draft = act()
        except UserError as error:
            self._dialog.set_problem(str(error))
            return
        self._dialog.set_problem("")
        self._show(choose)

    def _show(self, choose: str = "") -> None:
        assert self._dialog is not None
        spoken: dict[str, list[str]] = {phone: [] for phone in self._draft.phonemes}
        for phone, common in self._draft.phoneme_map.items():
            spoken.setdefault(common, []).append(phone)
        self._dialog.set_rows([PhoneRow(p, tuple(spoken[p])) for p in self._draft.phonemes], choose)
        self._dialog.set_preview(self._lines())

    def _lines(self) -> list[str]:
        """What the draft changes, in words."""
        change = change_of(self._document.curve_set, self._draft)
        lines = []
        if change.added or change.gone:
            before, after = len(self._document.curve_set.phonemes), len(self._draft.phonemes)
            names = ", ".join([f"+ {p}" for p in change.added] + [f"− {p}" for p in change.gone])
            lines.append(
                self.tr("{0}: {1} phonemes become {2}, {3} bigrams {4}.").format(
                    names, before, after, before * before, after * after
                )
            )
        for pairs, text in (
            (change.copied, self.tr("{0} bigrams are new and begin with the curves of others ({1})")),
            (change.blank, self.tr("{0} bigrams are new and empty ({1})")),
            (change.returned, self.tr("{0} bigrams come back with the curves they had ({1})")),
            (change.moved, self.tr("{0} bigrams go by another name ({1})")),
            (change.aside, self.tr("{0} bigrams are put aside: kept in the file, not played ({1})")),
        ):
            if pairs:
                lines.append(text.format(*_some(pairs)) + ".")
        lines += [
            self.tr("{0} plays {1} instead of {2}.").format(phone, after or "–", before or "–")
            for phone, before, after in change.spoken[:8]
        ]
        return lines


def _some(pairs: Sequence[Pair]) -> tuple[str, str]:
    """How many, with silence told apart, and the names of the first."""
    silent = sum(SILENCE in pair for pair in pairs)
    count = f"{len(pairs) - silent} + {silent}" if silent else str(len(pairs))
    return count, ", ".join(pair_name(pair) for pair in pairs[:3]) + (", …" if len(pairs) > 3 else "")

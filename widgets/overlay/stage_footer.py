"""The black rows under the stage overlay: Time, Phoneme, Start (figure 6), and Word."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QCoreApplication, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPolygonF

from core_pipeline.phonemes import EXAMPLES, SILENCE
from core_pipeline.pipeline import Stages

from .. import theme
from .time_axis import TimeAxis, clock

#: A word: text, start and end in seconds.
Span = tuple[str, float, float]
#: Height of one black row in pixels, the line between two included.
ROW = 18
BLACK = QColor("#08090a")
#: Pixels that must remain between two labels.
GAP = 3.0
#: Phones narrower than this (mean, pixels) have no names: the few that fit would mislead.
READABLE = 8.0

_SILENT = theme.mix(theme.BORDER, BLACK, 0.45)


@dataclass(frozen=True)
class Label:
    """One phone's text: the common phoneme, and the language's phone behind it where there is room."""

    phone: int
    text: str
    small: str
    x: float
    width: float


def fit_labels(
    names: Sequence[str],
    sources: Sequence[str],
    x: np.ndarray,
    first: int,
    metrics: QFontMetricsF,
    small: QFontMetricsF,
) -> list[Label]:
    """Labels of the phones first, first+1, … centred between x[0], x[1], …; none overlaps another.

    Where phones are too narrow for all names, those that do not fit beside the last one drawn are left out.
    """
    labels: list[Label] = []
    free = -np.inf
    for k, name in enumerate(names):
        left, right = float(x[k]), float(x[k + 1])
        wide = metrics.horizontalAdvance(name)
        extra = sources[k] if sources and sources[k] != name else ""
        both = wide + 3 + small.horizontalAdvance(extra) if extra else wide
        if both > right - left - 2 * GAP:
            extra, both = "", wide
        begin = (left + right - both) / 2
        # A name may stand over its phone's edges a little, but never touch its neighbour.
        if begin >= free and both <= right - left + 6:
            labels.append(Label(first + k, name, extra, begin, both))
            free = begin + both + GAP
    return labels


def phone_tip(stages: Stages, phone: int, sources: Sequence[str]) -> str:
    """What a phone of the utterance is: "ae → ah (cat, cut, ago)  0.110 – 0.260 s"."""
    name = stages.schedule.phones[phone]
    source = sources[phone] if len(sources) == len(stages.schedule) else name
    shown = name if source == name else f"{source} → {name}"
    example = f" ({EXAMPLES[name]})" if name in EXAMPLES else ""
    start, end = stages.schedule.times[phone : phone + 2].tolist()
    return f"{shown}{example}  {start:.3f} – {end:.3f} s"


class Footer:
    """Draws the three rows; holds fonts only."""

    def __init__(self) -> None:
        self._label = theme.font(8.0)
        self._name = theme.font(9.0)
        self._bold = theme.font(9.0, bold=True)
        self._small = theme.font(7.0)

    @staticmethod
    def titles(rows: int) -> list[str]:
        """The names of the first `rows` rows in the user's language."""
        tr = QCoreApplication.translate
        titles = ("Time", "Phoneme", "Start", "Word")
        return [tr("StageOverlay", title) for title in titles[:rows]]

    def draw(
        self,
        painter: QPainter,
        box: QRect,
        axis: TimeAxis,
        stages: Stages,
        sources: Sequence[str],
        lit: frozenset[int],
        loop: tuple[float, float] | None,
        words: Sequence[Span] = (),
    ) -> None:
        """Fill `box` with as many rows as fit.

        sources  the language's phone for each phone of the schedule, or empty
        lit      numbers of the phones of the open bigram
        words    text, start and end of each
        """
        rows = max(box.height() // ROW, 1)
        gutter = int(axis.x0)
        for r, title in enumerate(self.titles(rows)):
            line = QRect(box.left(), box.top() + r * ROW, box.width(), ROW - 1)
            painter.fillRect(line, BLACK)
            painter.setFont(self._label)
            painter.setPen(theme.FAINT)
            painter.drawText(line.adjusted(14, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, title)
        painter.setClipRect(QRect(gutter - 4, box.top(), box.width(), box.height()))
        self._draw_times(painter, box.top(), axis, loop)
        times, phones = stages.schedule.times, stages.schedule.phones
        first = max(int(times.searchsorted(axis.left, "right")) - 1, 0)
        last = min(int(times.searchsorted(axis.right, "left")), len(phones))
        # Clipped, so that a phone wider than the view keeps its name in sight.
        x = np.clip(axis.px(times[first : last + 1]), axis.x0, axis.x1)
        if rows > 1:
            self._draw_phones(painter, box.top() + ROW, first, x, stages, sources, lit)
        if rows > 2:
            self._draw_starts(painter, box.top() + 2 * ROW, times[first:last], x)
        if rows > 3:
            self._draw_words(painter, box.top() + 3 * ROW, axis, words)
        painter.setClipping(False)

    def _draw_times(self, painter: QPainter, top: int, axis: TimeAxis, loop: tuple[float, float] | None) -> None:
        if loop is not None:
            a, b = axis.px(loop[0]), axis.px(loop[1])
            painter.fillRect(QRectF(a, top, b - a, ROW - 1), theme.mix(theme.ACCENT, BLACK, 0.4))
        step = axis.step(64.0)
        painter.setPen(theme.BORDER)
        for t in axis.ticks(axis.step(64.0 / 5.5)):
            x = round(axis.px(t))
            painter.drawLine(x, top, x, top + 2)
        painter.setFont(self._label)
        metrics = QFontMetricsF(self._label)
        for t in axis.ticks(step):
            x = axis.px(t)
            painter.setPen(theme.FAINT)
            painter.drawLine(round(x), top, round(x), top + 4)
            painter.setPen(theme.MUTED)
            text = clock(t, step)
            wide = metrics.horizontalAdvance(text)
            # The outermost labels stay whole beside their tick.
            begin = min(max(x - wide / 2, axis.x0 - 3), axis.x1 + 8 - wide)
            painter.drawText(QRectF(begin, top + 1, wide + 2, ROW - 2), Qt.AlignmentFlag.AlignVCenter, text)

    def _draw_phones(
        self,
        painter: QPainter,
        top: int,
        first: int,
        x: np.ndarray,
        stages: Stages,
        sources: Sequence[str],
        lit: frozenset[int],
    ) -> None:
        phones = stages.schedule.phones
        names = phones[first : first + x.size - 1]
        behind = sources[first : first + x.size - 1] if len(sources) == len(phones) else ()
        dense = x.size > 1 and (x[-1] - x[0]) / (x.size - 1) < READABLE
        for k, name in enumerate(() if dense else names):
            cell = QRectF(x[k], top, x[k + 1] - x[k], ROW - 1)
            if name == SILENCE:
                painter.fillRect(cell, _SILENT)
            elif first + k in lit:
                painter.fillRect(cell, theme.mix(theme.CHECKED, BLACK, 0.75))
        if dense:
            painter.setFont(self._label)
            painter.setPen(theme.FAINT)
            text = QCoreApplication.translate("StageOverlay", "turn the wheel to zoom in and read the phones")
            box = QRectF(x[0], top, x[-1] - x[0], ROW - 2)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
            return
        painter.setPen(theme.BORDER)
        for edge in x.tolist():
            painter.drawLine(round(edge), top, round(edge), top + ROW - 2)
        self._draw_missing(painter, top, first, x, stages)
        metrics, small = QFontMetricsF(self._bold), QFontMetricsF(self._small)
        for label in fit_labels(names, behind, x, first, metrics, small):
            bright = label.phone in lit
            painter.setFont(self._bold if bright else self._name)
            unknown = label.text in stages.unknown
            quiet = label.text == SILENCE
            painter.setPen(theme.WEAK if unknown else theme.FAINT if quiet else theme.BRIGHT if bright else theme.TEXT)
            box = QRectF(label.x, top, label.width, ROW - 2)
            painter.drawText(box, Qt.AlignmentFlag.AlignVCenter, label.text)
            if label.small:
                painter.setFont(self._small)
                painter.setPen(theme.MUTED)
                painter.drawText(
                    box.adjusted(0, 1, 0, 0), Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, label.small
                )

    @staticmethod
    def _draw_missing(painter: QPainter, top: int, first: int, x: np.ndarray, stages: Stages) -> None:
        """An orange wedge on the boundary of each bigram that the set does not have."""
        if not stages.missing:
            return
        phones = stages.schedule.phones
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.WEAK)
        for k in range(1, x.size - 1):
            if (phones[first + k - 1], phones[first + k]) in stages.missing:
                corners = ((x[k] - 4, top), (x[k] + 4, top), (x[k], top + 5))
                painter.drawPolygon(QPolygonF([QPointF(px, py) for px, py in corners]))
        painter.setBrush(Qt.BrushStyle.NoBrush)

    def _draw_words(self, painter: QPainter, top: int, axis: TimeAxis, words: Sequence[Span]) -> None:
        """Each in a box as long as it sounds; one too long for its box is shortened."""
        painter.setFont(self._name)
        metrics = QFontMetricsF(self._name)
        for text, start, end in words:
            if end < axis.left or start > axis.right:
                continue
            a, b = (min(max(axis.px(t), axis.x0), axis.x1) for t in (start, end))
            painter.fillRect(QRectF(a + 1, top + 1, b - a - 1, ROW - 3), theme.mix(theme.BORDER, BLACK, 0.6))
            painter.setPen(theme.TEXT)
            shown = metrics.elidedText(text, Qt.TextElideMode.ElideRight, b - a - 4)
            if shown not in ("", "…"):
                painter.drawText(QRectF(a, top, b - a, ROW - 2), Qt.AlignmentFlag.AlignCenter, shown)

    def _draw_starts(self, painter: QPainter, top: int, times: np.ndarray, x: np.ndarray) -> None:
        painter.setFont(self._small)
        painter.setPen(theme.MUTED)
        metrics = QFontMetricsF(self._small)
        free = -np.inf
        for t, edge in zip(times.tolist(), x.tolist(), strict=False):
            text = clock(t)
            wide = metrics.horizontalAdvance(text)
            if edge + 2 >= free:
                painter.drawText(QRectF(edge + 2, top, wide + 2, ROW - 1), Qt.AlignmentFlag.AlignVCenter, text)
                free = edge + 2 + wide + 2 * GAP

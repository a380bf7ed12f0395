"""The bottom dock: switches for the stages, the reading under the mouse, the view mode, and the overlay."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from core_pipeline.weights import Weights

from .. import theme
from .method_box import MethodBox
from .phone_hand import PhoneHand
from .stage_chip import StageChip
from .stage_footer import Span
from .stage_layers import LAYERS
from .stage_marks import Mark
from .stage_picking import Reading
from .stage_rows import MODES
from .time_axis import clock

#: Pixels that the reading should have before the chips show their names.
READING = 280


class StagePanel(QWidget):
    """Everything about the stages of one sentence.

    bigram_picked(index, time, pose)  the user clicked a place that bigram `index` of the utterance made
    scrubbed(time)                    seconds, while the mouse drags along the time row
    scrub_finished(time)              the mouse let go
    pose_activated(pose)
    loop_range_changed(range)         (from, to) in seconds, or None
    hovered(text)                     what stands under the mouse, in words; empty when nothing does
    """

    bigram_picked = Signal(int, float, str)
    scrubbed = Signal(float)
    scrub_finished = Signal(float)
    pose_activated = Signal(str)
    loop_range_changed = Signal(object)
    hovered = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.overlay = PhoneHand(self)
        self.chips = [StageChip(layer.name, i + 1, self) for i, layer in enumerate(LAYERS)]
        self.mode_box = QComboBox(self)
        self.method_box = MethodBox(self)
        self.reading = QLabel(self)
        self._before_solo: frozenset[str] | None = None
        self._now: Reading | None = None
        self._build()
        for layer, chip in zip(LAYERS, self.chips, strict=True):
            chip.setChecked(layer.default_on)
            chip.toggled.connect(self._show_checked)
            chip.soloed.connect(self.solo)
        self.set_palette_safe(False)
        self.mode_box.currentIndexChanged.connect(lambda i: self.overlay.set_mode(MODES[i]))
        for name in ("bigram_picked", "scrubbed", "scrub_finished", "pose_activated", "loop_range_changed"):
            getattr(self.overlay, name).connect(getattr(self, name))
        self.overlay.read_out.connect(self._show_reading)

    def _build(self) -> None:
        self.mode_box.addItems([self.tr("Focus + context"), self.tr("All poses"), self.tr("One pose")])
        self.mode_box.setAccessibleName(self.tr("Rows of the stage overlay"))
        self.mode_box.setToolTip(self.tr("Which poses have a row, and how tall"))
        self.reading.setTextFormat(Qt.TextFormat.RichText)
        self.reading.setAccessibleName(self.tr("Reading under the mouse"))
        self.reading.setAlignment(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight)
        self.reading.setStyleSheet(f"color:{theme.MUTED.name()}")
        # It takes what room is left; a long reading must not widen the window.
        self.reading.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._bar = QHBoxLayout()
        self._bar.setContentsMargins(6, 3, 6, 3)
        self._bar.setSpacing(3)
        for chip in self.chips:
            self._bar.addWidget(chip)
        self._bar.addSpacing(8)
        self._bar.addWidget(self.reading, 1)
        self._bar.addSpacing(6)
        self._bar.addWidget(self.method_box)
        self._bar.addWidget(self.mode_box)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(self._bar)
        column.addWidget(self.overlay, 1)

    # Values come down

    def set_stages(self, stages: Stages | None) -> None:
        """Show what the pipeline made of the sentence; None shows a hint instead."""
        self.overlay.set_stages(stages)

    def set_source_phones(self, phones: Sequence[str] | None) -> None:
        """The language's own phone for each phone of the schedule; ignored while their numbers differ."""
        self.overlay.set_source_phones(phones)

    def set_words(self, words: Sequence[Span]) -> None:
        """The words of the utterance: text, start and end in seconds."""
        self.overlay.set_words(words)

    def set_active_pose(self, pose: str) -> None:
        """The pose whose row is tall."""
        self.overlay.set_active_pose(pose)

    def set_current(self, index: int | None, pair: Pair | None = None) -> None:
        """The open bigram: its number in this utterance, if it is in it, and its pair."""
        self.overlay.set_current(index, pair)

    def set_playhead(self, t: float) -> None:
        """Seconds."""
        self.overlay.set_playhead(t)

    def set_following(self, on: bool) -> None:
        """Whether a zoomed view turns the page with the playhead: while playing."""
        self.overlay.set_following(on)

    def set_ghost(self, stages: Stages | None) -> None:
        """An earlier result, its final curves in grey under the present ones."""
        self.overlay.set_ghost(stages)

    def set_other(self, stages: Stages | None) -> None:
        """What another curve set makes of the sentence, its final curves dashed; None for none."""
        self.overlay.set_other(stages)

    def set_method(self, weights: Weights | None) -> None:
        """What another method makes of the sentence, grey and dashed; None for none."""
        self.overlay.set_method(weights)

    def set_marks(self, marks: Sequence[Mark]) -> None:
        """What is weak, where it is."""
        self.overlay.set_marks(marks)

    def set_loop_range(self, loop: tuple[float, float] | None) -> None:
        """The part that is played in a loop, in seconds."""
        self.overlay.set_loop_range(loop)

    def set_palette_safe(self, safe: bool) -> None:
        """Whether the stages have colours that remain apart without full colour vision."""
        styles = theme.STAGE_STYLES_CVD if safe else theme.STAGE_STYLES
        for chip in self.chips:
            chip.set_style(styles[chip.name])
        self.overlay.set_palette_safe(safe)

    # Which stages

    def shown(self) -> frozenset[str]:
        """Names of the stages that are switched on."""
        return frozenset(chip.name for chip in self.chips if chip.isChecked())

    def solo(self, name: str) -> None:
        """Only this stage; once more brings back what was shown before."""
        shown, alone = self.shown(), frozenset({name})
        if shown == alone:
            before, self._before_solo = self._before_solo, None
            self._check(before if before and before != alone else frozenset(chip.name for chip in self.chips))
            return
        if self._before_solo is None or len(shown) != 1:  # else: from one alone to the next
            self._before_solo = shown
        self._check(alone)

    def _check(self, names: frozenset[str]) -> None:
        for chip in self.chips:
            with QSignalBlocker(chip):
                chip.setChecked(chip.name in names)
        self.overlay.set_shown(names)

    def _show_checked(self) -> None:
        self.overlay.set_shown(self.shown())

    # The reading

    def _show_reading(self, reading: Reading | None) -> None:
        self._now = reading
        self._fit_reading()
        self.hovered.emit("" if reading is None else self._describe(reading, full=True))

    def _fit_reading(self) -> None:
        """The whole reading, or where there is no room for it, its end: the final weight and the bigram."""
        if self._now is None:
            self.reading.setText("")
            return
        wide = self.reading.fontMetrics().horizontalAdvance(self._describe(self._now, full=True))
        # Bold digits are a little wider than what was measured.
        self.reading.setText(self._describe(self._now, full=1.06 * wide < self.reading.width(), rich=True))

    def _describe(self, reading: Reading, *, full: bool, rich: bool = False) -> str:
        """For example "t 3.42 s  FV  constrained 0.41 → speed-limited 0.36  from F–Ah (click to open)"."""
        bold, link = ("<b>%s</b>", f'<b style="color:{theme.LINK.name()}">%s</b>') if rich else ("%s", "%s")
        space = "&nbsp; " if rich else "  "
        steps = reading.steps()
        chain = " → ".join(
            f"{theme.STAGE_STYLES[name].label.lower()} {bold % f'{value:.2f}'}"
            for name, value in (steps if full else steps[-1:])
        )
        if reading.is_zero:  # then the bigram is only the nearest one
            chain = self.tr("at rest")
        parts = [f"t {clock(reading.time)} s", reading.pose, chain] if full else [reading.pose, chain]
        if reading.pair is not None:
            pair = link % "–".join(phone.capitalize() for phone in reading.pair)
            wish = self.tr("%1 (click to open)") if full else "%1"
            origin = pair if reading.is_zero else self.tr("from %1").replace("%1", pair)
            parts.append(wish.replace("%1", origin))
        return space.join(parts)

    # Room

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Qt's hook: in a narrow panel the chips keep only their samples, so that the reading has room."""
        super().resizeEvent(event)
        full = (
            sum(chip.full_width for chip in self.chips)
            + self.mode_box.sizeHint().width()
            + READING
            + self.method_box.sizeHint().width()
        )
        for chip in self.chips:
            chip.set_compact(full > event.size().width())
        self._fit_reading()

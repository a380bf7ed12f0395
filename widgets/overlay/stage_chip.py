"""One stage's switch above the overlay: its line as a sample, its name, Alt+number."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QIcon, QKeyEvent, QKeySequence, QMouseEvent, QPainter, QPixmap, QShortcut
from PySide6.QtWidgets import QSizePolicy, QToolButton, QWidget

from .. import theme
from ..theme import StageStyle

_ICON = QSize(24, 12)


class StageChip(QToolButton):
    """Checked while its stage is shown.

    soloed(name)  Alt+click, right-click, double-click, Shift+Alt+number, or S while it has the keyboard
    """

    soloed = Signal(str)

    def __init__(self, name: str, number: int, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.name = name
        self.setCheckable(True)
        self.setChecked(True)
        self.setIconSize(_ICON)
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        label = theme.STAGE_STYLES[name].label
        self.setText(label)
        shortcut = QKeySequence(Qt.Modifier.ALT | Qt.Key(Qt.Key.Key_0 + number))
        self.setShortcut(shortcut)  # after the text, which would replace it
        alone = QKeySequence(Qt.Modifier.SHIFT | Qt.Modifier.ALT | Qt.Key(Qt.Key.Key_0 + number))
        QShortcut(alone, self, self._solo)
        native = QKeySequence.SequenceFormat.NativeText
        tip = self.tr("%1 (%2) · only this one: Alt+click or %3")
        for mark, text in (("%1", label), ("%2", shortcut.toString(native)), ("%3", alone.toString(native))):
            tip = tip.replace(mark, text)
        self.setToolTip(tip)
        self.setAccessibleName(label)
        self.setAccessibleDescription(self.tr("Shows or hides this stage of the pipeline"))

    def set_style(self, style: StageStyle) -> None:
        """The line to show as a sample."""
        ratio = self.devicePixelRatioF()
        pixmap = QPixmap(_ICON * ratio)
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        painter.fillRect(0, 0, _ICON.width(), _ICON.height(), theme.SUNKEN)
        painter.setPen(style.pen(max(style.width, 1.6)))
        y = _ICON.height() // 2
        painter.drawLine(2, y, _ICON.width() - 2, y)
        painter.end()
        self.setIcon(QIcon(pixmap))

    def set_compact(self, compact: bool) -> None:
        """Only the sample, for a narrow panel; the name stays in the tooltip and for screen readers."""
        style = Qt.ToolButtonStyle
        self.setToolButtonStyle(style.ToolButtonIconOnly if compact else style.ToolButtonTextBesideIcon)

    def minimumSizeHint(self) -> QSize:
        """Room for the sample alone: the name must not keep the panel from shrinking."""
        return QSize(_ICON.width() + 14, self.sizeHint().height())

    @property
    def full_width(self) -> int:
        """About how many pixels the sample and the name need."""
        return self.minimumSizeHint().width() + 8 + self.fontMetrics().horizontalAdvance(self.text())

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Qt's hook."""
        by_alt = event.button() == Qt.MouseButton.LeftButton and event.modifiers() & Qt.KeyboardModifier.AltModifier
        if event.button() == Qt.MouseButton.RightButton or by_alt:
            self._solo()
        else:
            super().mousePressEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: takes back what the first click did, then asks for this stage alone."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.toggle()
            self._solo()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Qt's hook: S asks for this stage alone."""
        if event.key() == Qt.Key.Key_S and not event.modifiers():
            self._solo()
        else:
            super().keyPressEvent(event)

    def _solo(self) -> None:
        self.soloed.emit(self.name)

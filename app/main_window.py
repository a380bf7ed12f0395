"""The window: builds widgets, docks, toolbar and status bar, and nothing else. Wiring brings it to life."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QByteArray, QEvent, Qt, Signal
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QKeyEvent, QPalette, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QDockWidget,
    QHBoxLayout,
    QLabel,
    QMainWindow,
    QSizePolicy,
    QSplitter,
    QToolBar,
    QVBoxLayout,
    QWidget,
)

from widgets.canvas.bigram_transport import BigramTransport
from widgets.canvas.canvas_header import CanvasHeader
from widgets.canvas.curve_canvas import CurveCanvas
from widgets.canvas.curve_panel import CurvePanel
from widgets.canvas.pose_list import PoseList
from widgets.overlay.stage_panel import StagePanel
from widgets.picker.bigram_picker import BigramPicker
from widgets.picker.weak_panel import WeakPanel
from widgets.preview.face_view import FaceView
from widgets.preview.mapping_panel import MappingPanel
from widgets.preview.weights_bars import WeightsBars
from widgets.sentence_bar import SentenceBar
from widgets.settings.settings_panel import SettingsPanel
from widgets.transport import Transport
from widgets.window.keymap_question import KeymapQuestion

from .actions import Actions
from .document import Document

_Area = Qt.DockWidgetArea

#: In a window lower than this some docks share one place, as tabs.
LOW = 860


class MainWindow(QMainWindow):
    """The editor's window. `may_close` is asked before it closes.

    play_wanted()  Space, where nothing that has the focus wants it
    dropped(Path)  a file or folder was dropped on the window
    let_go()       a key was released, or another window came to the front
    """

    play_wanted = Signal()
    dropped = Signal(Path)
    let_go = Signal()

    def __init__(self, document: Document) -> None:
        super().__init__()
        self.setObjectName("main window")
        self.setWindowTitle("Lipstitch")
        self.setDockOptions(QMainWindow.DockOption.AllowTabbedDocks | QMainWindow.DockOption.AllowNestedDocks)
        self.setCorner(Qt.Corner.BottomLeftCorner, _Area.BottomDockWidgetArea)
        self.setCorner(Qt.Corner.BottomRightCorner, _Area.BottomDockWidgetArea)
        self._sized = False
        self.may_close: Callable[[], bool] = lambda: True

        self.picker = BigramPicker()
        self.weak_panel = WeakPanel()
        self.weak_list = self.weak_panel.list
        self.header = CanvasHeader()
        self.bigram_transport = BigramTransport()
        self.pose_list = PoseList()
        self.canvas = CurveCanvas()
        self.curve_panel = CurvePanel(self.canvas)
        self.face_view = FaceView()
        self.weights = WeightsBars()
        self.settings_panel = SettingsPanel()
        self.mapping_panel = MappingPanel()
        self.stage_panel = StagePanel()
        self.transport = Transport()
        self.sentence_bar = SentenceBar()
        self.keymap_question = KeymapQuestion()

        self.actions_ = Actions(self, document.undo_stack)
        self._toolbar()
        self._centre()
        self._docks()
        self._status()
        self._first_state = self.saveState()
        self.setAcceptDrops(True)
        self.setMinimumSize(1120, 640)
        self.resize(1600, 1000)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask first."""
        if self.may_close():
            event.accept()
        else:
            event.ignore()

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """One file or folder of this machine is welcome."""
        urls = event.mimeData().urls()
        if len(urls) == 1 and urls[0].isLocalFile():
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Say what was dropped."""
        event.acceptProposedAction()
        self.dropped.emit(Path(event.mimeData().urls()[0].toLocalFile()))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Space plays the sentence."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self.play_wanted.emit()
        else:
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Qt's hook: what lasts while a key is held ends."""
        super().keyReleaseEvent(event)
        if not event.isAutoRepeat():
            self.let_go.emit()

    def changeEvent(self, event: QEvent) -> None:
        """Qt's hook: a key let go in another window is never heard of here."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.ActivationChange and not self.isActiveWindow():
            self.let_go.emit()

    def showEvent(self, event: QShowEvent) -> None:
        """Give the docks their first sizes once the window has its own."""
        super().showEvent(event)
        if not self._sized:
            self._sized = True
            self.default_layout()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """A window made low puts its docks behind one another."""
        super().resizeEvent(event)
        if self._sized and event.size().height() < LOW <= event.oldSize().height():
            mapping = self.mapping_dock.toggleViewAction().isChecked()
            self.default_layout()
            if mapping:
                self.mapping_dock.show()
                self.mapping_dock.raise_()

    def restore_layout(self, geometry: QByteArray, docks: QByteArray) -> None:
        """Last time's layout, as far as it still fits."""
        self.restoreGeometry(geometry)
        self._sized = self.restoreState(docks)

    def default_layout(self) -> None:
        """Docks for this window's size: side by side where there is room, behind one another where not."""
        width, height = self.width(), self.height()
        self.restoreState(self._first_state)
        if height < LOW:
            self.tabifyDockWidget(self.bigrams_dock, self.weak_dock)
            self.tabifyDockWidget(self.preview_dock, self.weights_dock)
            self.tabifyDockWidget(self.weights_dock, self.settings_dock)
            self.tabifyDockWidget(self.weak_dock, self.mapping_dock)  # across from the face it changes
            self.bigrams_dock.raise_()
            self.preview_dock.raise_()
        left, right = min(420, width // 4), min(400, width // 4)
        self.resizeDocks([self.bigrams_dock, self.preview_dock], [left, right], Qt.Orientation.Horizontal)
        self.resizeDocks([self.stages_dock], [int(height * 0.34)], Qt.Orientation.Vertical)
        if height >= LOW:
            upper = int(height * 0.58)
            self.resizeDocks([self.bigrams_dock, self.weak_dock], [upper - 120, 120], Qt.Orientation.Vertical)
            self.resizeDocks([self.preview_dock, self.weights_dock], [upper - 190, 190], Qt.Orientation.Vertical)

    def _toolbar(self) -> None:
        bar = QToolBar(self.tr("Sentence"))
        bar.setObjectName("sentence bar")
        bar.setMovable(False)
        bar.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        bar.addAction(self.actions_.undo)
        bar.addAction(self.actions_.redo)
        bar.addSeparator()
        bar.addWidget(self.transport)
        self.sentence_bar.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        bar.addWidget(self.sentence_bar)
        self.addToolBar(bar)

    def _centre(self) -> None:
        head = QWidget()
        row = QHBoxLayout(head)
        row.setContentsMargins(0, 0, 8, 0)
        row.setSpacing(6)
        row.addWidget(self.header, 1)
        row.addWidget(self.bigram_transport)
        body = QSplitter(Qt.Orientation.Horizontal)
        body.setHandleWidth(3)
        body.addWidget(self.pose_list)
        body.addWidget(self.curve_panel)
        body.setStretchFactor(0, 0)
        body.setStretchFactor(1, 1)
        body.setChildrenCollapsible(False)
        centre = QWidget()
        column = QVBoxLayout(centre)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.keymap_question)
        column.addWidget(head)
        column.addWidget(body, 1)
        centre.setMinimumSize(360, 180)
        self.setCentralWidget(centre)

    def _docks(self) -> None:
        left, right, below = _Area.LeftDockWidgetArea, _Area.RightDockWidgetArea, _Area.BottomDockWidgetArea
        self.bigrams_dock = self.add_dock("bigrams", self.tr("Bigrams"), self.picker, left)
        self.weak_dock = self.add_dock("weak", self.tr("Weak bigrams"), self.weak_panel, left)
        self.preview_dock = self.add_dock("preview", self.tr("Preview"), self.face_view, right)
        self.weights_dock = self.add_dock("weights", self.tr("Pose weights"), self.weights, right)
        self.settings_dock = self.add_dock("settings", self.tr("Pipeline settings"), self.settings_panel, right)
        self.stages_dock = self.add_dock("stages", self.tr("Pipeline stages"), self.stage_panel, below)
        self.mapping_dock = self.add_dock("mapping", self.tr("Face mapping"), self.mapping_panel, right)
        self.tabifyDockWidget(self.weights_dock, self.settings_dock)
        self.tabifyDockWidget(self.settings_dock, self.mapping_dock)
        self.mapping_dock.hide()
        self.weights_dock.raise_()

    def add_dock(self, name: str, title: str, widget: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
        """A dock with a switch in View → Docks; `name` is what the layout is remembered by."""
        dock = QDockWidget(title)
        dock.setObjectName(name)
        dock.setWidget(widget)
        dock.setFeatures(
            QDockWidget.DockWidgetFeature.DockWidgetMovable | QDockWidget.DockWidgetFeature.DockWidgetClosable
        )
        self.addDockWidget(area, dock)
        show = self.actions_.docks_menu.put(f"dock.{name}", dock.toggleViewAction())
        show.setStatusTip(self.tr("Show or hide this dock"))
        show.triggered.connect(lambda on: dock.raise_() if on else None)  # before others of its place
        return dock

    def _status(self) -> None:
        self.selection_label = QLabel()
        self.hint_label = QLabel()
        self.missing_label = QLabel()
        self.timing_label = QLabel()
        self.saved_label = QLabel()
        self.hint_label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.hint_label.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        for label in (self.selection_label, self.hint_label, self.missing_label, self.timing_label, self.saved_label):
            label.setTextFormat(Qt.TextFormat.PlainText)  # names from files are no markup
        bar = self.statusBar()
        bar.setSizeGripEnabled(False)
        bar.setContentsMargins(4, 0, 8, 0)
        bar.addWidget(self.selection_label)
        bar.addWidget(self.hint_label, 1)
        for label in (self.missing_label, self.timing_label, self.saved_label):
            bar.addPermanentWidget(label)

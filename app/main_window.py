"""The window: builds widgets, docks, toolbar and status bar, and nothing else. Wiring brings it to life."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QByteArray, QEvent, QMargins, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QKeyEvent, QPalette, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QDockWidget,
    QHBoxLayout,
    QLabel,
    QMainWindow,
    QSizePolicy,
    QSplitter,
    QStyle,
    QToolBar,
    QVBoxLayout,
    QWidget,
)

from core_pipeline.speech.espeak import FASTEST, SLOWEST
from widgets.canvas.bigram_transport import BigramTransport
from widgets.canvas.canvas_header import CanvasHeader
from widgets.canvas.curve_canvas import CurveCanvas
from widgets.canvas.curve_panel import CurvePanel
from widgets.canvas.pose_list import PoseList
from widgets.overlay.stage_panel import StagePanel
from widgets.picker.bigram_picker import BigramPicker
from widgets.picker.weak_panel import WeakPanel
from widgets.preview.face_picker import FacePicker
from widgets.preview.face_view import FaceView
from widgets.preview.mapping_panel import MappingPanel
from widgets.preview.preview_panel import PreviewPanel
from widgets.preview.weights_bars import WeightsBars
from widgets.sentence_bar import SentenceBar
from widgets.settings.settings_panel import SettingsPanel
from widgets.speech.live_panel import LivePanel
from widgets.speech.recording_panel import RecordingPanel
from widgets.speech.voice_panel import VoicePanel
from widgets.transport import Transport
from widgets.voice_bar import VoiceBar
from widgets.window.beside_panel import BesidePanel
from widgets.window.bigram_tabs import BigramTabs
from widgets.window.keymap_question import KeymapQuestion
from widgets.window.sentence_list import SentenceList

from .actions import Actions
from .document import Document
from .focus_ring import FocusRing
from .layouts import AUTHOR, LOW, arrange

_Area = Qt.DockWidgetArea
#: Pixels across that the canvas keeps when pose names want room.
_CANVAS = 320


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
        self._layout = AUTHOR
        self._homes: dict[str, _Area] = {}
        self.may_close: Callable[[], bool] = lambda: True

        self.picker = BigramPicker()
        self.weak_panel = WeakPanel()
        self.weak_list = self.weak_panel.list
        self.header = CanvasHeader()
        self.bigram_transport = BigramTransport()
        self.pose_list = PoseList()
        self.canvas = CurveCanvas()
        self.curve_panel = CurvePanel(self.canvas)
        self.beside = BesidePanel()
        self.bigram_tabs = BigramTabs()
        self.face_view = FaceView()
        self.preview_panel = PreviewPanel(self.face_view)
        self.face_picker = FacePicker(self)
        self.weights = WeightsBars()
        self.settings_panel = SettingsPanel()
        self.mapping_panel = MappingPanel()
        self.stage_panel = StagePanel()
        self.transport = Transport()
        self.sentence_bar = SentenceBar()
        self.voice_bar = VoiceBar()
        self.sentence_list = SentenceList()
        self.recording_panel = RecordingPanel()
        self.voice_panel = VoicePanel(SLOWEST, FASTEST)
        self.live_panel = LivePanel()
        self.keymap_question = KeymapQuestion()

        self.actions_ = Actions(self, document.undo_stack)
        bar, centre = self._toolbar(), self._centre()
        self._docks()
        self._status()
        self._hidden = [dock.objectName() for dock in self.findChildren(QDockWidget) if dock.isHidden()]
        self.focus_ring = FocusRing(self, self._homes, bar, centre)
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
        """Say what was dropped. It is looked at only: a file manager that offers to move it keeps it."""
        event.setDropAction(Qt.DropAction.CopyAction)
        event.accept()
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
            self.use_layout(self._layout)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """A window made low puts its docks behind one another, and made high again side by side."""
        super().resizeEvent(event)
        if self._sized and (event.size().height() < LOW) != (event.oldSize().height() < LOW):
            mapping = self.mapping_dock.toggleViewAction().isChecked()
            self.use_layout(self._layout)
            if mapping:
                self.mapping_dock.show()
                self.mapping_dock.raise_()

    def fit_screen(self) -> None:
        """No larger than the screen leaves free, with a title bar above: the status bar stays in sight."""
        free = self.screen().availableSize()
        title = self.style().pixelMetric(QStyle.PixelMetric.PM_TitleBarHeight)
        self.resize(self.size().boundedTo(free.shrunkBy(QMargins(0, title, 0, 0))))

    def restore_layout(self, geometry: QByteArray, docks: QByteArray) -> None:
        """Last time's layout, as far as it still fits."""
        self.restoreGeometry(geometry)
        self._sized = self.restoreState(docks, self._lowness)

    def docks_state(self) -> QByteArray:
        """Where the docks stand, for `take_docks` and `restore_layout` of a window about as high as this one."""
        return self.saveState(self._lowness)

    def take_docks(self, state: QByteArray) -> bool:
        """Put the docks where they stood; False for no such state, or where this window is too low for it."""
        return any(self.restoreState(state, kind) for kind in range(self._lowness, 2))

    @property
    def _lowness(self) -> int:
        return int(self.height() < LOW)

    def use_layout(self, name: str = AUTHOR) -> None:
        """One of layouts.PRESETS, for this window's size."""
        self._layout = name
        arrange(self, name, self._homes, self._hidden)

    def fit_poses(self) -> None:
        """As much room for the names of the poses as the canvas can spare."""
        poses, canvas, *others = self._canvases.sizes()
        more = min(self.pose_list.sizeHint().width() - poses, canvas - _CANVAS)
        if more > 0:
            self._canvases.setSizes([poses + more, canvas - more, *others])

    def show_beside(self, on: bool) -> None:
        """One canvas, or two of the same width; Space plays where there is no room for the button."""
        self.bigram_transport.setVisible(not on)
        poses = self.pose_list.sizeHint().width()
        room = self._canvases.width() - poses
        self.beside.setVisible(on)
        sizes = [poses, room // 2, room // 2] if on else [poses, room, 0]
        QTimer.singleShot(0, self, lambda: self._canvases.setSizes(sizes))  # once the rows above are narrow

    def _toolbar(self) -> QToolBar:
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
        bar.addWidget(self.voice_bar)
        self.addToolBar(bar)
        return bar

    def _centre(self) -> QWidget:
        head = QWidget()
        row = QHBoxLayout(head)
        row.setContentsMargins(0, 0, 8, 0)
        row.setSpacing(6)
        row.addWidget(self.header, 1)
        row.addWidget(self.bigram_transport)
        first = QWidget()
        column = QVBoxLayout(first)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(head)
        column.addWidget(self.curve_panel, 1)
        body = QSplitter(Qt.Orientation.Horizontal)
        body.setHandleWidth(3)
        for i, part in enumerate((self.pose_list, first, self.beside)):
            body.addWidget(part)
            body.setStretchFactor(i, min(i, 1))
        body.setChildrenCollapsible(False)
        self._canvases = body
        self.beside.set_head_height(head.sizeHint().height())
        centre = QWidget()
        column = QVBoxLayout(centre)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.keymap_question)
        column.addWidget(self.bigram_tabs)
        column.addWidget(body, 1)
        centre.setMinimumSize(390, 180)
        self.setCentralWidget(centre)
        return centre

    def _docks(self) -> None:
        left, right, below = _Area.LeftDockWidgetArea, _Area.RightDockWidgetArea, _Area.BottomDockWidgetArea
        self.bigrams_dock = self.add_dock("bigrams", self.tr("Bigrams"), self.picker, left)
        self.weak_dock = self.add_dock("weak", self.tr("Weak bigrams"), self.weak_panel, left)
        self.sentences_dock = self.add_dock("sentences", self.tr("Sentences"), self.sentence_list, left)
        self.preview_dock = self.add_dock("preview", self.tr("Preview"), self.preview_panel, right)
        self.weights_dock = self.add_dock("weights", self.tr("Pose weights"), self.weights, right)
        self.settings_dock = self.add_dock("settings", self.tr("Pipeline settings"), self.settings_panel, right)
        self.stages_dock = self.add_dock("stages", self.tr("Pipeline stages"), self.stage_panel, below)
        self.mapping_dock = self.add_dock("mapping", self.tr("Face mapping"), self.mapping_panel, right)
        self.recording_dock = self.add_dock("recording", self.tr("Recording"), self.recording_panel, left)
        self.voice_dock = self.add_dock("voice", self.tr("Voice"), self.voice_panel, left)
        self.live_dock = self.add_dock("live", self.tr("Microphone"), self.live_panel, left)
        for dock in (self.mapping_dock, self.recording_dock, self.voice_dock, self.live_dock):
            dock.hide()

    def add_dock(self, name: str, title: str, widget: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
        """A dock with a switch in View → Docks; `name` is what the layout is remembered by."""
        dock = QDockWidget(title)
        dock.setObjectName(name)
        dock.setWidget(widget)
        dock.setFeatures(
            QDockWidget.DockWidgetFeature.DockWidgetMovable | QDockWidget.DockWidgetFeature.DockWidgetClosable
        )
        self.addDockWidget(area, dock)
        self._homes[name] = area
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
        bar.setContentsMargins(6, 0, 6, 0)
        bar.addWidget(self.selection_label)
        bar.addWidget(self.hint_label, 1)
        for label in (self.missing_label, self.timing_label, self.saved_label):
            bar.addPermanentWidget(label)

"""Menus and shortcuts: every command of the window by name."""

from __future__ import annotations

from PySide6.QtGui import QAction, QActionGroup, QKeySequence, QUndoStack
from PySide6.QtWidgets import QMainWindow

from widgets import theme

_Keys = QKeySequence.StandardKey


class Actions:
    """The window's actions; wiring connects them."""

    def __init__(self, window: QMainWindow, undo_stack: QUndoStack) -> None:
        self._window = window
        tr = window.tr
        self.new = self._action(tr("&New"), _Keys.New, tr("Start from the English set, without a file"))
        self.new_empty = self._action(tr("New &Empty Set"), None, tr("Start with 441 empty bigrams"))
        self.open = self._action(tr("&Open…"), _Keys.Open, tr("Open a curve set"))
        self.save = self._action(tr("&Save"), _Keys.Save, tr("Save the curve set"))
        self.save_as = self._action(tr("Save &As…"), "Ctrl+Shift+S", tr("Save the curve set in another file"))
        self.export = self._action(
            tr("&Export Curve Set…"), "Ctrl+E", tr("Write the curve set as JSON for other programs")
        )
        self.export_weights = self._action(
            tr("Export &Weights…"), "Ctrl+Shift+E", tr("Write this sentence's weights, frame by frame, as JSON or CSV")
        )
        self.quit = self._action(tr("&Quit"), "Ctrl+Q", tr("Close Lipstitch"))
        self.undo = undo_stack.createUndoAction(window, tr("&Undo"))
        self.undo.setShortcut(_Keys.Undo)
        self.undo.setIcon(theme.icon("undo"))
        self.redo = undo_stack.createRedoAction(window, tr("&Redo"))
        self.redo.setShortcuts([QKeySequence(_Keys.Redo), QKeySequence("Ctrl+Y")])
        self.redo.setIcon(theme.icon("redo"))
        self.find = self._action(tr("&Find Bigram"), _Keys.Find, tr("Type two phones or a word"))
        self.sentence = self._action(tr("&Type a Sentence"), "Ctrl+L", tr("Go to the sentence"))
        self.play = self._action(tr("&Play or Pause the Sentence"), "F5", tr("Play or pause the sentence"))
        self.play_bigram = self._action(tr("Play the &Bigram Alone"), "F6", tr("Play or stop the open bigram"))
        self.to_start = self._action(tr("To the &Start"), "Ctrl+Home", tr("Go to the start of the sentence"))
        self.loop = self._action(tr("&Loop"), "Ctrl+Shift+L", tr("Begin again at the end"))
        self.loop.setCheckable(True)
        self.reset_view = self._action(tr("See the Face from the &Front"), "Ctrl+0", tr("Reset the face's camera"))
        self.safe_colours = self._action(
            tr("&Colours Safe for Every Eye"), None, tr("Stage colours that remain apart without full colour vision")
        )
        self.safe_colours.setCheckable(True)
        self.lively = self._action(tr("&Blink"), None, tr("Quiet life of the face beside the speech"))
        self.lively.setCheckable(True)
        self.lively.setChecked(True)
        self.default_layout = self._action(tr("Reset &Layout"), None, tr("Put all docks back in their places"))
        self.keymaps = QActionGroup(window)
        for name, title in (("neutral", tr("&Neutral")), ("Maya", tr("Like &Maya")), ("Blender", tr("Like &Blender"))):
            keymap = QAction(title, self.keymaps, checkable=True, checked=name == "neutral")
            keymap.setData(name)
        self.open_face = self._action(tr("Open &Face…"), "Ctrl+Shift+O", tr("Show a .glb, .gltf or .vrm of yours"))
        self.open_face_folder = self._action(tr("Open Face Fol&der…"), None, tr("Show a folder of .obj poses"))
        self.new_set_for_face = self._action(
            tr("New Curve &Set for This Face's Poses"),
            None,
            tr("Start an empty set whose poses are the face's own shapes"),
        )
        self.about = self._action(tr("&About Lipstitch"), None, "")
        self._menus()

    def _action(self, text: str, keys: QKeySequence.StandardKey | str | None, tip: str) -> QAction:
        action = QAction(text, self._window)
        if keys is not None:
            action.setShortcut(QKeySequence(keys))
        if tip:
            action.setStatusTip(tip)
            action.setToolTip(tip)
        return action

    def _menus(self) -> None:
        bar = self._window.menuBar()
        tr = self._window.tr
        entries: list[tuple[str, list[QAction | None]]] = [
            (tr("&File"), [self.new, self.new_empty, self.open, None, self.save, self.save_as, None,
                           self.export, self.export_weights, None, self.quit]),
            (tr("&Edit"), [self.undo, self.redo]),
            (tr("&Bigram"), [self.find, self.play_bigram]),
            (tr("&Playback"), [self.sentence, self.play, self.to_start, self.loop]),
            (tr("&View"), [self.reset_view, self.safe_colours, self.lively, self.default_layout]),
        ]  # fmt: skip
        for title, actions in entries:
            menu = bar.addMenu(title)
            for action in actions:
                menu.addSeparator() if action is None else menu.addAction(action)
        self.view_menu = menu
        menu.addMenu(tr("Canvas &Keys")).addActions(self.keymaps.actions())
        self.characters_menu = menu.addMenu(tr("&Character"))
        bar.addMenu(tr("&Help")).addAction(self.about)

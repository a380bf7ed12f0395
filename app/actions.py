"""Every command of the window by name. A new one is one line here, in the place of its menu; wiring connects it."""

from __future__ import annotations

from PySide6.QtGui import QActionGroup, QUndoStack
from PySide6.QtWidgets import QMainWindow

from widgets import theme
from widgets.canvas.keymaps import KEYMAPS, NEUTRAL

from .menus import Registry


class Actions:
    """The window's actions, menu by menu."""

    def __init__(self, window: QMainWindow, undo_stack: QUndoStack) -> None:
        self._window = window
        self._tr = window.tr
        self.registry = Registry(window.menuBar())
        self._file()
        self._edit(undo_stack)
        self._view()
        self._bigram()
        self._sentence()
        self._playback()
        self._tools()
        self._help()

    @property
    def keymap(self) -> str:
        """The canvas's keymap that is chosen."""
        chosen = self.keymaps.checkedAction()
        return str(chosen.data()) if chosen is not None else NEUTRAL

    def _file(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&File"))
        self.file_menu = menu
        self.new = menu.add("file.new", tr("&New"), "Ctrl+N", tr("Start from the English set, without a file"))
        self.new_empty = menu.add("file.new-empty", tr("New &Empty Set"), (), tr("Start with 441 empty bigrams"))
        self.new_on_base = menu.add(
            "file.new-on-base",
            tr("New &Character Set…"),
            (),
            tr("Start a set that stores only what differs from another"),
        )
        self.open = menu.add("file.open", tr("&Open…"), "Ctrl+O", tr("Open a curve set"))
        self.open_face = menu.add(
            "file.open-face", tr("Open &Face…"), "Ctrl+Shift+O", tr("Show a .glb, .gltf or .vrm of yours")
        )
        self.open_face_folder = menu.add(
            "file.open-face-folder", tr("Open Face Fol&der…"), (), tr("Show a folder of .obj poses")
        )
        self.new_set_for_face = menu.add(
            "file.new-set-for-face",
            tr("New Curve Set for This Face's &Poses"),
            (),
            tr("Start an empty set whose poses are the face's own shapes"),
        )
        menu.line()
        self.save = menu.add("file.save", tr("&Save"), "Ctrl+S", tr("Save the curve set"))
        self.save_as = menu.add(
            "file.save-as", tr("Save &As…"), "Ctrl+Shift+S", tr("Save the curve set in another file")
        )
        self.restore = menu.add(
            "file.restore", tr("&Restore a Backup…"), (), tr("Go back to what was saved before, as one undo step")
        )
        menu.line()
        self.import_script = menu.add(
            "file.import", tr("&Import…"), "Ctrl+Shift+I", tr("Take a set from a SmartBody diphone script")
        )
        self.export = menu.add(
            "file.export", tr("E&xport Curve Set…"), "Ctrl+E", tr("Write the curve set as JSON for other programs")
        )
        self.export_weights = menu.add(
            "file.export-weights",
            tr("Export &Weights…"),
            "Ctrl+Shift+E",
            tr("Write this sentence's weights, frame by frame, as JSON or CSV"),
        )
        menu.line()
        self.quit = menu.add("file.quit", tr("&Quit"), "Ctrl+Q", tr("Close Lipstitch"))

    def _edit(self, undo_stack: QUndoStack) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Edit"))
        self.edit_menu = menu
        self.undo = menu.put("edit.undo", undo_stack.createUndoAction(self._window, tr("&Undo")), "Ctrl+Z")
        self.undo.setIcon(theme.icon("undo"))
        self.undo.setStatusTip(tr("Take the last change back"))
        self.redo = menu.put(
            "edit.redo", undo_stack.createRedoAction(self._window, tr("&Redo")), ("Ctrl+Shift+Z", "Ctrl+Y")
        )
        self.redo.setIcon(theme.icon("redo"))
        self.redo.setStatusTip(tr("Make the change again that was taken back"))
        menu.line()
        keys = menu.submenu(tr("&Keys of the Canvas"))
        self.keymaps: QActionGroup = keys.choice()
        titles = {NEUTRAL: tr("&Neutral"), "Maya": tr("Like &Maya"), "Blender": tr("Like &Blender")}
        for name in KEYMAPS:
            action = keys.add(f"keymap.{name.lower()}", titles[name], checked=name == NEUTRAL)
            action.setData(name)
            self.keymaps.addAction(action)
        self.shortcuts = menu.add(
            "edit.shortcuts", tr("Keyboard &Shortcuts…"), "Ctrl+Alt+K", tr("See and change the keys of every command")
        )

    def _view(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&View"))
        self.view_menu = menu
        self.characters_menu = menu.submenu(tr("&Character"))
        self.reset_view = menu.add(
            "view.front", tr("See the Face from the &Front"), "Ctrl+0", tr("Reset the face's camera")
        )
        self.lively = menu.add(
            "view.blink", tr("&Blink"), (), tr("Quiet life of the face beside the speech"), checked=True
        )
        menu.line()
        self.safe_colours = menu.add(
            "view.safe-colours",
            tr("Co&lours Safe for Every Eye"),
            (),
            tr("Stage colours that remain apart without full colour vision"),
            checked=False,
        )
        self.default_layout = menu.add(
            "view.reset-layout", tr("&Reset Layout"), (), tr("Put all docks back in their places")
        )
        self.docks_menu = menu.submenu(tr("&Docks"))

    def _bigram(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Bigram"))
        self.bigram_menu = menu
        self.find = menu.add("bigram.find", tr("&Find Bigram"), "Ctrl+F", tr("Type two phones or a word"))
        self.play_bigram = menu.add(
            "bigram.play", tr("&Play the Bigram Alone"), "Shift+F5", tr("Play or stop the open bigram")
        )
        menu.line()
        self.swapped = menu.add(
            "bigram.swapped", tr("Open the &Swapped Pair"), "Ctrl+Shift+B", tr("From f-ah to ah-f and back")
        )
        self.next_bigram = menu.add(
            "bigram.next", tr("&Next in the Sentence"), "Alt+Right", tr("The sentence's next bigram")
        )
        self.previous_bigram = menu.add(
            "bigram.previous", tr("P&revious in the Sentence"), "Alt+Left", tr("The sentence's previous bigram")
        )

    def _sentence(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Sentence"))
        self.sentence_menu = menu
        self.sentence = menu.add("sentence.type", tr("&Type a Sentence"), "Ctrl+L", tr("Go to the sentence"))

    def _playback(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Playback"))
        self.playback_menu = menu
        self.play = menu.add("playback.play", tr("&Play or Pause"), "F5", tr("Play or pause the sentence"))
        self.to_start = menu.add(
            "playback.start", tr("To the &Start"), "Ctrl+Home", tr("Go to the start of the sentence")
        )
        self.loop = menu.add("playback.loop", tr("&Loop"), "Ctrl+Shift+L", tr("Begin again at the end"), checked=False)

    def _tools(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Tools"))
        self.tools_menu = menu
        self.palette = menu.add(
            "tools.palette",
            tr("&Command Palette…"),
            "Ctrl+K",
            tr("Any command, bigram or pinned sentence by a few of its letters"),
        )

    def _help(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Help"))
        self.help_menu = menu
        self.about = menu.add("help.about", tr("&About Lipstitch"))

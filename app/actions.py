"""Every command of the window by name. A new one is one line here, in the place of its menu; wiring connects it."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtGui import QActionGroup, QUndoStack
from PySide6.QtWidgets import QMainWindow

from widgets import theme
from widgets.canvas.keymaps import KEYMAPS, NEUTRAL

from .layouts import PRESETS
from .menus import Menu, Registry


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
        self.open_recording = menu.add(
            "file.open-recording", tr("Open &Recording…"), "Ctrl+R", tr("Say what is said in a wav, flac, ogg or mp3")
        )
        self.open_labels = menu.add(
            "file.open-labels", tr("Open &Label File…"), (), tr("Phones with times: TextGrid, HTK, ESPS, TIMIT")
        )
        menu.line()
        self.save = menu.add("file.save", tr("&Save"), "Ctrl+S", tr("Save the curve set"))
        self.save_as = menu.add(
            "file.save-as", tr("Save &As…"), "Ctrl+Shift+S", tr("Save the curve set in another file")
        )
        self.restore = menu.add(
            "file.restore", tr("Restore a &Backup…"), (), tr("Go back to what was saved before, as one undo step")
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
        self.save_utterance = menu.add(
            "file.save-utterance",
            tr("Save P&hones and Words…"),
            (),
            tr("Keep what is said as a TextGrid or JSON, beside the recording"),
        )
        menu.line()
        self.quit = menu.add("file.quit", tr("&Quit"), "Ctrl+Q", tr("Close Lipstitch"))

    def _edit(self, undo_stack: QUndoStack) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Edit"))
        self.edit_menu = menu
        self.undo = menu.put("edit.undo", undo_stack.createUndoAction(self._window, tr("&Undo")), "Ctrl+Z", tr("Undo"))
        self.undo.setIcon(theme.icon("undo"))
        self.undo.setStatusTip(tr("Take the last change back"))
        self.redo = menu.put(
            "edit.redo", undo_stack.createRedoAction(self._window, tr("&Redo")), ("Ctrl+Shift+Z", "Ctrl+Y"), tr("Redo")
        )
        self.redo.setIcon(theme.icon("redo"))
        self.redo.setStatusTip(tr("Make the change again that was taken back"))
        menu.line()
        self.phone_set = menu.add(
            "edit.phones", tr("&Phone Set…"), (), tr("Add, split, rename and remove phonemes; see first what changes")
        )
        self.author = menu.add("edit.author", tr("&Author…"), (), tr("The name that your bigrams bear in the file"))
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
        self.pick_face = self.characters_menu.add(
            "character.pick", tr("&Choose…"), "Ctrl+Shift+F", tr("Another face, from their portraits")
        )
        self.add_face = self.characters_menu.add(
            "character.add", tr("&Add Beside…"), "Ctrl+Alt+A", tr("Another face beside, to say the same sentence")
        )
        self.characters_menu.line()
        self._looks(menu)
        self.reset_view = menu.add(
            "view.front", tr("See the Face from the &Front"), "Ctrl+0", tr("Reset the face's camera")
        )
        self.lively = menu.add(
            "view.blink", tr("&Blink"), (), tr("Quiet life of the face beside the speech"), checked=True
        )
        menu.line()
        self.safe_colours = menu.add(
            "view.safe-colours",
            tr("Colours &Safe for Every Eye"),
            (),
            tr("Stage colours that remain apart without full colour vision"),
            checked=False,
        )
        menu.line()
        layouts = self.layouts_menu = menu.submenu(tr("&Layout"))
        self.layouts = [
            layouts.add(
                f"layout.{name}", tr(preset.title), f"Ctrl+Alt+{i}", tr("Put the docks in their places for this")
            )
            for i, (name, preset) in enumerate(PRESETS.items(), 1)
        ]
        layouts.line()
        self.save_layout = layouts.add(
            "layout.save", tr("&Save This Layout…"), (), tr("Keep the docks as they are now, under a name")
        )
        self.remove_layout = layouts.add("layout.remove", tr("Re&move a Layout…"), (), tr("Forget a saved layout"))
        self.docks_menu = menu.submenu(tr("&Docks"))
        menu.line()
        self.next_part = menu.add(
            "view.next-part", tr("&Next Part of the Window"), "F6", tr("Toolbar, canvas, each dock")
        )
        self.previous_part = menu.add(
            "view.previous-part", tr("&Previous Part of the Window"), "Shift+F6", tr("Each dock, canvas, toolbar")
        )

    def _looks(self, menu: Menu) -> None:
        """How the faces are seen."""
        tr = self._tr
        backgrounds = {
            "studio": tr("&Studio"), "daylight": tr("&Daylight"), "night": tr("&Night"), "grey": tr("Flat &Grey"),
            "checker": tr("&Checkers"), "green": tr("Gr&een for Keying"),
        }  # fmt: skip
        lights = {"left": tr("From the &Left"), "right": tr("From the &Right"), "top": tr("From A&bove")}
        angles = {
            "front": tr("&Front"), "left": tr("Three-quarter &Left"), "right": tr("Three-quarter &Right"),
            "profile": tr("&Profile"), "mouth": tr("&Mouth"),
        }  # fmt: skip
        ground = menu.submenu(tr("Back&ground"))
        self.backgrounds = self._one_of(ground, "background", backgrounds)
        self.next_background = ground.add("background.next", tr("Ne&xt Background"), "Ctrl+Alt+B")
        light = menu.submenu(tr("L&ight"))
        self.lights = self._one_of(light, "light", lights)
        self.next_light = light.add("light.next", tr("Ne&xt Light"), "Ctrl+Alt+L")
        self.angles = self._one_of(menu.submenu(tr("Ca&mera")), "camera", angles, numbered=True)
        self.angles.setExclusionPolicy(QActionGroup.ExclusionPolicy.ExclusiveOptional)  # none, once turned by hand
        self.turntable = menu.add(
            "view.turntable", tr("&Turntable"), "Ctrl+Alt+T", tr("Let the faces turn by themselves"), checked=False
        )

    def _one_of(self, menu: Menu, kind: str, titles: Mapping[str, str], *, numbered: bool = False) -> QActionGroup:
        """A choice of exactly one, the first at the start; `numbered`: Ctrl+2 and so on choose the others."""
        group = menu.choice()
        for number, (name, title) in enumerate(titles.items(), 1):
            action = menu.add(
                f"{kind}.{name}", title, f"Ctrl+{number}" if numbered and number > 1 else (), checked=number == 1
            )
            action.setData(name)
            group.addAction(action)
        return group

    def _bigram(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Bigram"))
        self.bigram_menu = menu
        self.find = menu.add("bigram.find", tr("&Find Bigram"), "Ctrl+F", tr("Type two phones or a word"))
        self.play_bigram = menu.add(
            "bigram.play", tr("&Play the Bigram Alone"), "Shift+F5", tr("Play or stop the open bigram")
        )
        menu.line()
        self.note = menu.add("bigram.note", tr("Not&e…"), (), tr("A few words about the open bigram, kept in the file"))
        self.revert = menu.add(
            "bigram.revert", tr("Revert to B&ase"), (), tr("The open bigram as the set below has it")
        )
        self.theirs = menu.add(
            "bigram.theirs",
            tr("S&wap with the Other Side's Curves"),
            (),
            tr("Where a merge left this bigram undecided; editing or approving decides"),
        )
        self.swapped = menu.add(
            "bigram.swapped", tr("Open the &Swapped Pair"), "Ctrl+Shift+B", tr("From f-ah to ah-f and back")
        )
        self.next_bigram = menu.add(
            "bigram.next", tr("&Next in the Sentence"), "Alt+Right", tr("The sentence's next bigram")
        )
        self.previous_bigram = menu.add(
            "bigram.previous", tr("P&revious in the Sentence"), "Alt+Left", tr("The sentence's previous bigram")
        )

        self.work_menu = menu.submenu(tr("Work Throu&gh All"))

        menu.line()
        self.new_tab = menu.add(
            "bigram.new-tab",
            tr("In a New &Tab"),
            "Ctrl+T",
            tr("Keep this bigram in its tab and open its swapped pair in another"),
        )
        self.close_tab = menu.add("bigram.close-tab", tr("&Close the Tab"), "Ctrl+W", tr("Close this bigram's tab"))
        self.next_tab = menu.add("bigram.next-tab", tr("Ne&xt Tab"), "Ctrl+Tab", tr("The bigram of the next tab"))
        self.previous_tab = menu.add(
            "bigram.previous-tab", tr("Previo&us Tab"), "Ctrl+Shift+Tab", tr("The bigram of the previous tab")
        )
        self.beside = menu.add(
            "bigram.beside",
            tr("Swapped Pair &Beside It"),
            "Ctrl+B",
            tr("A second canvas: b-a beside a-b, or any bigram that is pinned there"),
            checked=False,
        )

    def _sentence(self) -> None:
        tr, menu = self._tr, self.registry.menu(self._tr("&Sentence"))
        self.sentence_menu = menu
        self.sentence = menu.add("sentence.type", tr("&Type a Sentence"), "Ctrl+L", tr("Go to the sentence"))
        self.live = menu.add("sentence.live", tr("&Microphone…"), (), tr("Let the face say what is spoken now"))
        menu.line()
        self.pin_sentence = menu.add(
            "sentence.pin", tr("&Pin This Sentence"), "Ctrl+Shift+P", tr("Keep it in the list of test sentences")
        )
        self.next_sentence = menu.add(
            "sentence.next", tr("&Next Pinned Sentence"), "Alt+Down", tr("Say the next sentence of the list")
        )
        self.previous_sentence = menu.add(
            "sentence.previous", tr("P&revious Pinned Sentence"), "Alt+Up", tr("Say the previous sentence of the list")
        )
        self.import_sentences = menu.add(
            "sentence.import", tr("&Import Sentences…"), (), tr("Pin the lines of a text file")
        )

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

"""Three keymaps: each key does what the map says, and the hints name the keys of the present map."""

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QApplication

from tests.helpers.curve_hand import ALT, CTRL, FV, NONE, SHIFT
from widgets.canvas.keymaps import IN_GESTURE, KEYMAPS, action_of

Key = Qt.Key
MODIFIERS = {"Ctrl": CTRL, "Shift": SHIFT, "Alt": ALT}
PEAK = [("FV", 1), ("FV", 2), ("FV", 3)]


def press(hand, keys):
    """Sends a key as the maps write it."""
    combination = QKeySequence(keys)[0]
    hand.key(combination.key(), combination.keyboardModifiers())


@pytest.mark.parametrize("name", KEYMAPS)
def test_no_key_means_two_things_and_every_action_has_one(name):
    keymap = KEYMAPS[name]
    assert keymap.keys() == KEYMAPS["neutral"].keys()
    for in_gesture in (False, True):
        actions = [action for action in keymap if (action in IN_GESTURE) == in_gesture]
        keys = [key for action in actions for key in keymap[action]]
        assert len(keys) == len(set(keys))
        assert all(action_of(keymap, key, in_gesture=in_gesture) in actions for key in keys)
    for keys in keymap.values():
        assert keys
        assert all(QKeySequence(key).toString(QKeySequence.SequenceFormat.PortableText) == key for key in keys)


@pytest.mark.parametrize("name", KEYMAPS)
def test_every_key_of_a_map_is_claimed_by_the_canvas(canvas, name):
    canvas.set_keymap(name)
    for action, keys in KEYMAPS[name].items():
        for key in keys if action not in IN_GESTURE else ():
            combination = QKeySequence(key)[0]
            held = combination.keyboardModifiers()
            event = QKeyEvent(QEvent.Type.ShortcutOverride, combination.key(), held)
            event.ignore()
            QApplication.sendEvent(canvas, event)
            assert event.isAccepted(), key


@pytest.mark.parametrize(("name", "scale", "grab"), [("neutral", "S", "G"), ("Maya", "R", "W"), ("Blender", "S", "G")])
def test_scaling_and_grabbing_in_each_map(hand, canvas, name, scale, grab):
    canvas.set_keymap(name)
    canvas.select(PEAK)
    for keys, label in ((scale, "Scale keys"), (grab, "Move keys")):
        press(hand, keys)
        assert canvas.busy
        for _ in range(4):
            press(hand, "Right")
        press(hand, "Return")
        assert hand.edits[-1][1] == label


@pytest.mark.parametrize("name", KEYMAPS)
def test_adding_deleting_selecting_walking_and_framing_in_each_map(hand, canvas, name):
    canvas.set_keymap(name)
    keymap = KEYMAPS[name]
    home = canvas.shown
    for select in keymap["select_all"]:
        press(hand, keymap["select_none"][0])
        assert not canvas.selection
        press(hand, select)
        assert len(canvas.selection) == 6
    press(hand, keymap["select_none"][0])
    press(hand, keymap["next_key"][0])
    press(hand, keymap["next_key"][0])
    press(hand, keymap["previous_key"][0])
    assert canvas.selection == {("FV", 0)}
    press(hand, keymap["frame"][0])
    assert canvas.shown != home
    for all_keys in keymap["frame_all"]:
        press(hand, all_keys)
        assert canvas.shown == home
    for add in keymap["add"]:
        count = len(canvas.curves["FV"])
        press(hand, add)
        assert len(canvas.curves["FV"]) == count + 1
    for delete in keymap["delete"]:
        hand.canvas.select([("FV", 1)])
        count = len(canvas.curves["FV"])
        press(hand, delete)
        assert len(canvas.curves["FV"]) == count - 1


@pytest.mark.parametrize("name", KEYMAPS)
def test_hints_tell_the_keys_of_the_present_map(hand, canvas, name):
    canvas.set_keymap(name)
    canvas.select(PEAK)
    assert f"{KEYMAPS[name]['scale'][0]} or the box scales" in hand.hints[-1]
    press(hand, KEYMAPS[name]["scale"][0])
    assert "Enter keeps · X/Y or Shift: one axis" in hand.hints[-1]


@pytest.mark.parametrize("name", KEYMAPS)
@pytest.mark.parametrize("gesture", ["grab", "scale"])
@pytest.mark.parametrize("axis", ["X", "Y"])
def test_x_and_y_keep_to_one_axis_in_each_map(hand, canvas, name, gesture, axis):
    canvas.set_keymap(name)
    canvas.select(PEAK)
    press(hand, KEYMAPS[name][gesture][0])
    press(hand, axis)
    for key in ("Right", "Right", "Up", "Up"):
        press(hand, key)
    press(hand, "Return")
    ((changes, _),) = hand.edits
    assert (changes["FV"].t.tolist() != FV.t.tolist()) == (axis == "X")
    assert (changes["FV"].v.tolist() != FV.v.tolist()) == (axis == "Y")


@pytest.mark.parametrize("name", KEYMAPS)
def test_reversing_mirroring_copying_and_other_versions_in_each_map(hand, canvas, name):
    canvas.set_keymap(name)
    keymap = KEYMAPS[name]
    canvas.set_ghost({"FV": FV.without([1])})
    canvas.set_neighbours({"F – Aa": {"FV": FV.without([2])}})
    for action in ("reverse", "mirror", "copy", "paste", "paste_reversed", "swap"):
        press(hand, keymap[action][0])
    assert [label for _, label in hand.edits] == [
        "Reverse keys", "Mirror values", "Paste keys", "Swap with previous version",
    ]  # fmt: skip
    for action, towards in (("slide", 0), ("duplicate", 100)):
        press(hand, keymap[action][0])
        assert canvas.blend_bar.slider.value() == towards
        press(hand, "Esc")
        assert not canvas.busy


def test_x_deletes_in_the_blender_map_and_keeps_an_axis_during_a_gesture(hand, canvas):
    canvas.set_keymap("Blender")
    canvas.select(PEAK)
    press(hand, "G")
    press(hand, "X")
    press(hand, "Up")
    assert canvas.curves["FV"] is FV
    press(hand, "Esc")
    press(hand, "X")
    assert [label for _, label in hand.edits] == ["Delete keys"]


def test_every_key_is_claimed_while_a_gesture_runs(hand, canvas):
    canvas.select(PEAK)
    press(hand, "G")
    event = QKeyEvent(QEvent.Type.ShortcutOverride, Key.Key_Z, CTRL)
    event.ignore()
    QApplication.sendEvent(canvas, event)
    assert event.isAccepted()
    press(hand, "Esc")
    event.ignore()
    QApplication.sendEvent(canvas, event)
    assert not event.isAccepted()


def test_symbols_are_found_wherever_a_keyboard_has_them(hand, canvas):
    canvas.set_keymap("Blender")
    wishes = []
    canvas.solo_wanted.connect(wishes.append)
    hand.key(Key.Key_Slash, SHIFT, "/")
    hand.key(Key.Key_Slash, Qt.KeyboardModifier.KeypadModifier, "/")
    hand.key(Key.Key_Slash, CTRL, "/")
    assert wishes == [{"FV"}, {"FV"}]


def test_isolate_wishes_the_active_pose_alone_and_then_all_again(hand, canvas):
    wishes = []
    canvas.solo_wanted.connect(wishes.append)
    canvas.solo_wanted.connect(canvas.set_solo)
    press(hand, "I")
    hand.click(0.72, 0.8)  # on a key of the pose that is not shown
    assert canvas.active == "FV"
    press(hand, "I")
    assert wishes == [{"FV"}, set()]


def test_solo_hides_the_others_whatever_their_eyes_say_and_keeps_their_data(hand, canvas):
    canvas.set_visible_poses({"open"})
    canvas.set_solo({"FV"})
    hand.click(0.26, 0.97)
    assert canvas.selection == {("FV", 2)}
    canvas.set_active("open")
    hand.key(Key.Key_Insert)
    assert not hand.edits
    assert "hidden while others are solo" in hand.hints[-1]
    canvas.set_solo(())
    assert not canvas.selection
    assert canvas.curves["FV"] is FV


def test_page_keys_walk_the_visible_poses(hand, canvas):
    canvas.set_visible_poses({"open", "FV", "wide"})
    seen = []
    for keys in ("PgDown", "PgDown", "PgDown", "PgUp", "PgUp"):
        press(hand, keys)
        seen.append(canvas.active)
    assert seen == ["wide", "open", "FV", "open", "wide"]
    assert hand.actives == seen


def test_an_unknown_map_is_refused(canvas):
    with pytest.raises(KeyError):
        canvas.set_keymap("vi")


def test_insert_puts_keys_into_the_widest_gap_or_after_the_selected_one(hand, canvas):
    hand.key(Key.Key_Insert)
    assert hand.edits[-1][0]["FV"].t.tolist() == [0, 0.12, 0.26, 0.42, 0.56, 0.78, 1]
    canvas.select([("FV", 1)])
    hand.key(Key.Key_Insert, NONE)
    assert canvas.curves["FV"].keys()[2] == (0.19, 0.875)
    assert canvas.selection == {("FV", 2)}

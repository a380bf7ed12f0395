"""From a row per phone to all curves: the recipe of the shipped set, and the laws of making curves from rows."""

import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.curve_set import Bigram
from core_pipeline.errors import UserError
from core_pipeline.files.curve_set_json import dumps, load
from core_pipeline.phone_parts import Recipe, bigram_of, curve_set_of, read_recipe, write
from core_pipeline.phonemes import COMMON, SILENCE, TABLE_1

ROOT = Path(__file__).parents[2]
ENGLISH = ROOT / "assets" / "curves" / "english.toml"
STEADY = ("ah", "aa", "ao", "eh", "er", "ih", "w", "r", "l", "z", "sh", "th", "f", "d", "kg", "bmp")
DIPHTHONGS = ("ow", "aw", "oy", "ay")


@pytest.fixture(scope="module")
def recipe() -> Recipe:
    return read_recipe(ENGLISH)


def peak_time(bigram: Bigram, pose: str) -> float:
    curve = bigram.curves[pose]
    return float(curve.t[curve.v.argmax()])


def test_the_shipped_set_is_what_the_recipe_makes(recipe: Recipe) -> None:
    assert ENGLISH.with_suffix(".json").read_bytes() == dumps(curve_set_of(recipe)).encode()


def test_writing_it_anew_gives_the_same_file(tmp_path: Path) -> None:
    copy = tmp_path / "english.toml"
    copy.write_bytes(ENGLISH.read_bytes())
    written = write(copy)
    assert written.read_bytes() == ENGLISH.with_suffix(".json").read_bytes()
    assert load(written).missing() == []


def test_every_phone_has_a_row_that_does_something(recipe: Recipe) -> None:
    assert tuple(recipe.phones) == COMMON
    for phone in COMMON:
        assert not bigram_of(recipe, (phone, phone)).is_empty, phone


def test_all_pairs_are_there_and_those_with_silence(recipe: Recipe) -> None:
    pairs = set(curve_set_of(recipe).bigrams)
    assert {(a, b) for a in COMMON for b in COMMON} < pairs
    assert {pair for pair in pairs if SILENCE in pair} == {(SILENCE, p) for p in COMMON} | {
        (p, SILENCE) for p in COMMON
    }


def test_curves_are_easy_to_edit(recipe: Recipe) -> None:
    """Few keys, short numbers, from the very start to the very end of the bigram."""
    for pair, bigram in curve_set_of(recipe).bigrams.items():
        assert 1 <= len(bigram.curves) <= 7, pair
        for pose, curve in bigram.curves.items():
            assert 3 <= len(curve) <= 6, (pair, pose)
            assert (curve.t[0], curve.t[-1]) == (0, 1), (pair, pose)
            assert all(round(number, 3) == number for number in (*curve.t, *curve.v)), (pair, pose)


def test_the_bigram_of_figure_3(recipe: Recipe) -> None:
    """f-ah: the lip is tucked early; jaw and corners open late."""
    bigram = bigram_of(recipe, ("f", "ah"))
    assert list(bigram.curves) == ["open", "FV", "wide"]
    assert peak_time(bigram, "FV") < 0.4
    assert peak_time(bigram, "open") == peak_time(bigram, "wide") > 0.6


@given(strength=st.floats(0.01, 1), first=st.booleans())
def test_a_target_is_reached_early_as_first_and_late_as_second_phone(strength: float, first: bool) -> None:
    recipe = read_recipe(ENGLISH)
    recipe.phones["d"].clear()
    recipe.phones["kg"].update(open=strength)
    curve = bigram_of(recipe, ("kg", "d") if first else ("d", "kg")).curves["open"]
    assert curve.v.max() == pytest.approx(strength, abs=5e-4)
    assert curve.t[curve.v.argmax()] == (recipe.times.first.mid if first else recipe.times.second.mid)
    assert recipe.times.first.mid < 0.5 < recipe.times.second.mid
    assert curve.v[0] == curve.v[-1] == 0


@pytest.mark.parametrize("first", [*STEADY, SILENCE])
@pytest.mark.parametrize("second", [*STEADY, SILENCE])
def test_a_pair_of_steady_phones_is_the_mirror_of_the_other_order(recipe: Recipe, first: str, second: str) -> None:
    forth, back = bigram_of(recipe, (first, second)), bigram_of(recipe, (second, first))
    assert forth.curves.keys() == back.curves.keys()
    for pose, curve in forth.curves.items():
        assert [(pytest.approx(1 - t), v) for t, v in reversed(curve.keys())] == back.curves[pose].keys()


@pytest.mark.parametrize("phone", DIPHTHONGS)
def test_diphthongs_move(recipe: Recipe, phone: str) -> None:
    """The jaw opens before the second target, in whichever half of the pair the diphthong plays."""
    goal = "wide" if phone in ("oy", "ay") else "W"
    for pair in ((phone, "f"), ("f", phone)):
        bigram = bigram_of(recipe, pair)
        assert peak_time(bigram, "open") < peak_time(bigram, goal), pair


@pytest.mark.parametrize(("phone", "pose"), [("bmp", "PBM"), ("f", "FV")])
def test_closures_are_held_from_pair_to_pair(recipe: Recipe, phone: str, pose: str) -> None:
    full = recipe.phones[phone][pose]
    double = bigram_of(recipe, (phone, phone)).curves[pose]
    assert double.at([0.2, 0.5, 0.8]).min() == full
    before, after = bigram_of(recipe, ("ah", phone)).curves[pose], bigram_of(recipe, (phone, "ah")).curves[pose]
    assert before.v[-1] == after.v[0] > 0


@pytest.mark.parametrize(("phone", "pose"), [("bmp", "PBM"), ("f", "FV")])
def test_closures_are_over_sooner_beside_long_vowels(recipe: Recipe, phone: str, pose: str) -> None:
    """In the bigram's own time; a bigram with a long vowel lasts longer."""
    for vowel in recipe.closures.long:
        assert bigram_of(recipe, (phone, vowel)).curves[pose].at(0.72) == 0
        assert bigram_of(recipe, (phone, "ih")).curves[pose].at(0.72) > 0
        assert bigram_of(recipe, (vowel, phone)).curves[pose].at(0.28) == 0
    assert bigram_of(recipe, (phone, "ih")).curves[pose].at(0.65) > 0.2


def test_two_phones_with_one_pose_hold_it_without_a_dip(recipe: Recipe) -> None:
    roof = bigram_of(recipe, ("d", "l")).curves["tRoof"]
    assert roof.at([0.3, 0.5, 0.7]).min() == recipe.phones["d"]["tRoof"]


def test_h_takes_the_shape_of_the_vowel_to_come(recipe: Recipe) -> None:
    assert bigram_of(recipe, ("h", "aa")).curves["open"].at(0.3) > bigram_of(recipe, ("h", "d")).curves["open"].at(0.3)
    assert bigram_of(recipe, ("h", "w")).curves["W"].at(0.3) > 0.4
    assert bigram_of(recipe, ("h", "aw")).curves["W"].at(0.3) == 0, "the end of a diphthong is not to come yet"
    assert bigram_of(recipe, ("h", "bmp")).curves["PBM"].at(0.2) == 0, "a closure would silence the breath"
    assert bigram_of(recipe, ("w", "h")).curves["W"].at(0.8) == 0, "the vowel before is over"


def test_neighbours_of_a_closure_let_the_lips_close(recipe: Recipe) -> None:
    for pose, limit in recipe.beside["bmp"].items():
        for phone in COMMON:
            for pair in ((phone, "bmp"), ("bmp", phone)):
                curve = bigram_of(recipe, pair).curves.get(pose)
                assert curve is None or curve.at(0.5) <= limit, (pair, pose)


def test_what_lies_far_from_a_closure_need_not_give_way(recipe: Recipe) -> None:
    assert bigram_of(recipe, ("bmp", "ay")).curves["wide"].v.max() == recipe.phones["ay"]["wide"]["late"]


def test_between_silences_nothing_moves(recipe: Recipe) -> None:
    assert bigram_of(recipe, (SILENCE, SILENCE)).is_empty


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("[phones.kg] ", "[phones.xx] ", "no row for kg"),
        ("tBack = 0.55", "tBack = 1.55", "phones"),
        ("tBack = 0.55", "tongue = 0.55", "kg has the pose 'tongue'"),
        ("open = { early = 0.44 }", "open = { soon = 0.44 }", "soon"),
        ("[beside.w]", "[beside.ww]", "'ww'"),
        ('long = ["aa"', 'long = ["aaa"', "'aaa'"),
        ("[[0, 0.4], [0.2, 1], [0.38, 1], [0.8, 0]]", "[[0, 0.4], [0.8, 0]]", "never reaches 1"),
        ("[borrow]\nh", "[borrows]\nh", "borrows"),
        ("[reach]", "[reach", "line"),
    ],
)
def test_a_mistake_in_a_recipe_is_named_and_writes_nothing(tmp_path: Path, old: str, new: str, named: str) -> None:
    text = ENGLISH.read_text("utf-8")
    assert old in text
    broken = tmp_path / "broken.toml"
    broken.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(UserError, match=named) as error:
        write(broken)
    assert str(broken) in str(error.value)
    assert not broken.with_suffix(".json").exists()


SETTINGS = """
[settings]
windows = { PBM = 0.12 }
constraints = [["open", "PBM", 0.4]]
priorities = ["open", "PBM"]
l_max = 12.0
"""


def with_more(tmp_path: Path, more: str) -> Path:
    path = tmp_path / "more.toml"
    path.write_text(ENGLISH.read_text("utf-8") + more, "utf-8")
    return path


def test_a_recipe_may_bring_settings_and_a_phoneme_map(tmp_path: Path) -> None:
    made = curve_set_of(read_recipe(with_more(tmp_path, f'{SETTINGS}[phoneme_map]\nm = "bmp"\n')))
    assert made.settings is not None
    assert (made.settings.window_of("PBM"), made.settings.speed_limit) == (0.12, 12)
    assert [(c.a, c.b, c.limit) for c in made.settings.constraints] == [("open", "PBM", 0.4)]
    assert made.settings.priorities == ("open", "PBM")
    assert dict(made.phoneme_map) == {"m": "bmp"}
    without = curve_set_of(read_recipe(ENGLISH))
    assert (without.settings, dict(without.phoneme_map)) == (None, dict(TABLE_1))


@pytest.mark.parametrize(
    ("more", "named"),
    [
        (SETTINGS.replace("windows", "window_s"), "window_s"),
        (SETTINGS.replace('"open", "PBM", 0.4', '"mouth", "PBM", 0.4'), "'mouth'"),
        (SETTINGS.replace('["open", "PBM"]', '["open", "MBP"]'), "'MBP'"),
        (SETTINGS.replace("0.4", "4"), "choose 0 to 2"),
        (SETTINGS.replace("12.0", '"fast"'), "settings"),
        ('[phoneme_map]\nm = "mbp"\n', "m to 'mbp'"),
    ],
)
def test_a_mistake_in_settings_or_map_is_named(tmp_path: Path, more: str, named: str) -> None:
    path = with_more(tmp_path, more)
    with pytest.raises(UserError, match=named) as error:
        read_recipe(path)
    assert str(path) in str(error.value)


def test_the_command_says_what_it_wrote_and_what_it_could_not_read(tmp_path: Path) -> None:
    copy = tmp_path / "mine.toml"
    copy.write_bytes(ENGLISH.read_bytes())
    command = [sys.executable, "-m", "core_pipeline.phone_parts"]
    good = subprocess.run([*command, copy], cwd=ROOT, capture_output=True, text=True, timeout=60, check=False)
    assert (good.returncode, good.stdout.strip()) == (0, str(tmp_path / "mine.json"))
    bad = subprocess.run([*command, "none.toml"], cwd=ROOT, capture_output=True, text=True, timeout=60, check=False)
    assert bad.returncode == 1
    assert "none.toml cannot be read" in bad.stderr
    assert "Traceback" not in bad.stderr

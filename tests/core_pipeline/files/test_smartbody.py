"""Diphone scripts: read as text, never run; every oddity of real ones is mended and told; written and read the same."""

import contextlib
import time
from pathlib import Path

import pytest
from hypothesis import given

from app import resources
from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.smartbody_read import Import, import_set
from core_pipeline.files.smartbody_script import MAX_BYTES, parse_script, read_script
from core_pipeline.files.smartbody_write import save_script, script
from core_pipeline.phonemes import COMMON, TABLE_1
from core_pipeline.poses import FACEFX
from tests.helpers import strategies as ours

#: A script with everything that real ones have.
REAL = r"""# the set of a game
diphoneManager = scene.getDiphoneManager()
print "441 of them"

diphone = diphoneManager.createDiphone("ao", "er", "default")
diphone.addKey("W", 0.0574413, -0.00291545)
diphone.addKey("W", 0.502611, 0.667638)

diphone.addKey("open", -0.0130548, 0.2)
diphone.addKey("open", 1.01567, 0.1)
diphone.addKey("open", 0.522193, 0.4)

diphone = diphoneManager.createDiphone('_', 'f', 'default')   # silence
diphone.addKey('FV', .5, .3);
diphone.addKey('FV', .5, .9)
diphone.addKey('FV', 1e0, +8.1E-1)

diphone = diphoneManager.createDiphone("j", "oo", "default")
diphone.addKey("W", 0, 0.5)
diphone = diphoneManager.createDiphone("f", "f", "default")
diphone = diphoneManager.createDiphone("ao", "er", "default")
diphone.addKey("W", 1, 0)
dm.createDiphone("l", "l", "default")
brad = dm.createDiphone("ao", "er", "brad")
brad.addKey("Smile", 0.5, 0.5)
"""


def imported(text: str, name: str | None = None) -> Import:
    return import_set(parse_script(text.encode(), "set.py"), name)


def diphone(first: str, second: str, keys: str = "") -> str:
    lines = "".join(f'd.addKey("open", {key})\n' for key in keys.split(";") if key)
    return f'd = m.createDiphone("{first}", "{second}", "default")\n{lines}'


def keys_of(done: Import, first: str, second: str, pose: str) -> list[tuple[float, float]]:
    return done.curve_set.bigrams[first, second].curves[pose].keys()


def test_a_real_script_is_mended_and_everything_is_told() -> None:
    done = imported(REAL)
    assert done.curve_set.phonemes == COMMON
    assert done.curve_set.poses == FACEFX
    assert done.curve_set.phoneme_map == TABLE_1
    assert set(done.curve_set.bigrams) == {("ao", "er"), ("sil", "f"), ("f", "f"), ("l", "l")}
    assert keys_of(done, "ao", "er", "W") == [(0.0574413, 0), (0.502611, 0.667638), (1, 0)]
    assert keys_of(done, "ao", "er", "open") == [(0, 0.2), (0.522193, 0.4), (1, 0.1)]
    assert keys_of(done, "sil", "f", "FV") == [(0.5, 0.9), (1, 0.81)]
    assert set(done.curve_set.aside) == {("j", "oo")}
    assert done.curve_set.status_of(("ao", "er")) == "approved"
    assert done.curve_set.status_of(("f", "f")) == "empty"
    assert list(done.report) == [
        'set.py: 1 line not understood and passed over (the first is line 3: print "441 of them").',
        "set.py: “default” was taken; there are other sets too: brad (1 diphone).",
        "set.py: 1 diphone made more than once: the keys were put together (ao-er).",
        "set.py: 2 diphones without keys: left empty (f-f, l-l).",
        "set.py: 1 diphone with phones outside the set (j oo): kept in the file, under “aside”, and not played.",
        "set.py: 3 keys outside 0…1 clipped, in 2 curves (first: ao-er W).",
        "set.py: keys out of order sorted, in 1 curve (first: ao-er open).",
        "set.py: 1 key at the time of another merged, the highest kept, in 1 curve (first: sil-f FV).",
    ]


def test_another_set_of_the_script_has_its_own_poses() -> None:
    done = imported(REAL, "brad")
    assert done.curve_set.name == "brad"
    assert done.curve_set.poses == ("Smile",)
    assert keys_of(done, "ao", "er", "Smile") == [(0.5, 0.5)]
    with pytest.raises(UserError, match="no set “bob”: choose among default, brad"):
        imported(REAL, "bob")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_any_encoding_and_line_end_is_read_the_same(encoding: str, newline: str) -> None:
    expected = imported(REAL)
    done = import_set(parse_script(REAL.replace("\n", newline).encode(encoding), "set.py"))
    assert curve_set_json.dumps(done.curve_set) == curve_set_json.dumps(expected.curve_set)
    assert done.report == expected.report


def test_a_script_of_an_old_editor_is_read_as_latin_1_and_that_is_told() -> None:
    done = import_set(parse_script(("# © Zoë\n" + REAL).encode("latin-1"), "set.py"))
    assert done.report[0] == "set.py is not UTF-8: it was read as Latin-1."
    assert len(done.curve_set.bigrams) == 4


def test_nothing_is_run(tmp_path: Path) -> None:
    """Not even where Python would run it."""
    witness = tmp_path / "witness"
    evil = f"__import__('pathlib').Path({str(witness)!r}).touch()"
    done = imported(f'{evil}\n{diphone("f", "ah", "0, 1")}d.addKey("open", {evil}, 0)\nexec("{evil}")\n')
    assert not witness.exists()
    assert keys_of(done, "f", "ah", "open") == [(0, 1)]
    assert "3 lines not understood" in done.report[0]


def test_comments_and_strings_over_several_lines_add_nothing() -> None:
    added = 'd.addKey("open", 1, 1)'
    done = imported(
        f'"""\n{added}\n"""\n{diphone("f", "ah", "0, 1")}# {added}\n\'\'\'{added}\n{added}\'\'\'\n#"""\n{added}'
    )
    assert keys_of(done, "f", "ah", "open") == [(0, 1), (1, 1)]


def test_keys_without_a_diphone_are_told() -> None:
    done = imported(f'x.addKey("open", 0, 1)\n{diphone("f", "ah", "0, 1")}y.addKey("open", 0, 1)\n')
    assert done.report[0].startswith("set.py: 2 keys of no diphone or no usable pose left out (the first is in line 1)")


def test_capitals_are_our_small_letters() -> None:
    done = imported(diphone("F", "Ah", "0, 1") + diphone("f", "ah", "1, 1"))
    assert keys_of(done, "f", "ah", "open") == [(0, 1), (1, 1)]
    assert "renamed to small letters: Ah F" in done.report[0]


def test_a_phone_with_a_full_row_becomes_a_phoneme() -> None:
    rows = "".join(diphone("b", p, "0, 1") + diphone(p, "b", "0, 1") for p in COMMON)
    rest = "".join(diphone(p, p, "0, 1") for p in COMMON)
    done = imported(rest + rows + diphone("j", "ah", "0, 1"))
    assert done.curve_set.phonemes == (*COMMON, "b")
    assert done.curve_set.phoneme_map["b"] == "b"
    assert set(done.curve_set.aside) == {("j", "ah")}
    assert any("b became phonemes of the set, beside the 21" in line for line in done.report)


def test_a_script_of_other_phones_has_its_own_phoneme_set() -> None:
    done = imported(diphone("p1", "p2", "0, 1") + diphone("p3", "f", "0, 1"))
    assert done.curve_set.phonemes == ("p1", "p2", "p3", "f")
    assert len(done.curve_set.bigrams) == 2


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "is no diphone script"),
        (b"import os\n", "is no diphone script"),
        (b'd = m.createDiphone("f"\n', "no createDiphone line is whole"),
        (b"\xff\x00\xfe", "not text in UTF-8"),
        (b'"""\nd = m.createDiphone("f", "ah")\n', 'line 1: a string begins with """ and never ends'),
        (b"createDiphone\n" * 6000, "thousands of lines that no diphone script has"),
        (diphone("f", "ah", ";".join(["0, 1"] * 2001)).encode(), "line 2002: a curve of more than 2000 keys"),
        ("".join(diphone(f"p{i}", f"q{i}") for i in range(201)).encode(), "402 phones; at most 400"),
    ],
)  # fmt: skip
def test_what_is_no_script_is_refused(data: bytes, told: str) -> None:
    with pytest.raises(UserError) as caught:
        import_set(parse_script(data, "set.py"))
    assert told in str(caught.value)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize(
    "data",
    [
        b'createDiphone("f", "ah")' + b"a" * (MAX_BYTES - 30),
        b'd = createDiphone("f", "ah")\n' + b"\n" * (MAX_BYTES - 30),
        b'd = createDiphone("f", "ah")\n' + b"d." * 4_000_000,
        b'd = createDiphone("f", "ah")\n' + b'"""a' * 2_000_000,
        b'd = createDiphone("f", "ah")\n' + b'd.addKey("open", ' * 400_000,
        b'd = createDiphone("f", "ah")\n' + b'd.addKey("W", 0, 0)\n' * 400_000,
    ],
    ids=["one line", "empty lines", "dots", "quotes", "halves", "keys"],
)
def test_a_hostile_script_takes_no_time(data: bytes) -> None:
    start = time.process_time()
    with contextlib.suppress(UserError):
        import_set(parse_script(data, "set.py"))
    assert time.process_time() - start < 3


def test_a_huge_file_is_refused_without_reading_it_all(tmp_path: Path) -> None:
    path = tmp_path / "huge.py"
    with path.open("wb") as file:
        file.truncate(2**40)
    with pytest.raises(UserError, match="larger than 8 MB, too large for a diphone script"):
        read_script(path)


# ── writing ──────────────────────────────────────────────────────────────────────────────────────


def test_our_english_set_goes_out_and_comes_back_key_by_key(tmp_path: Path) -> None:
    english = curve_set_json.load(resources.english_curves())
    save_script(english, tmp_path / "english.py")
    done = import_set(read_script(tmp_path / "english.py"))
    assert done.report == ()
    assert set(done.curve_set.bigrams) == set(english.bigrams)
    for pair, bigram in english.bigrams.items():
        curves = done.curve_set.bigrams[pair].curves
        assert list(curves) == list(bigram.curves)
        assert all(curves[pose].same_as(curve) for pose, curve in bigram.curves.items())


def test_neither_phones_nor_poses_change_places_when_a_script_goes_round() -> None:
    lines = [
        f'd = m.createDiphone("{pair[0]}", "{pair[1]}", "s")\nd.addKey("{pose}", 0.5, 1)\n'
        for pair, pose in (("yz", "b"), ("xx", "c"), ("yx", "a"), ("zw", "d"), ("yy", "e"))
    ]
    first = imported("".join(lines)).curve_set
    again = imported(script(first)).curve_set
    assert (again.phonemes, again.poses) == (first.phonemes, first.poses)


@given(ours.curve_sets(nasty=True))
def test_what_is_written_is_read_and_written_the_same(curve_set: CurveSet) -> None:
    text = script(curve_set)
    if not curve_set.bigrams:
        return
    done = import_set(parse_script(text.encode(), "set.py"))
    assert script(done.curve_set).count("addKey") == text.count("addKey")
    again = script(import_set(parse_script(script(done.curve_set).encode(), "set.py")).curve_set)
    assert again == script(done.curve_set)


def test_the_imported_set_is_written_as_it_stood() -> None:
    text = script(imported(REAL).curve_set)
    assert 'createDiphone("_", "f", "Untitled")' not in text
    assert 'diphone = diphoneManager.createDiphone("_", "f", "default")\n\ndiphone.addKey("FV", 0.5, 0.9)\n' in text
    assert 'createDiphone("j", "oo", "default")' in text
    assert script(imported(text).curve_set) == text


def test_a_name_that_would_end_the_string_is_refused() -> None:
    with pytest.raises(UserError, match="without quotes"):
        script(CurveSet(name='x", __import__("os").system("true"), "', bigrams=imported(REAL).curve_set.bigrams))

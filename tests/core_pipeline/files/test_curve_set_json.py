"""Curve-set files: what is written is read again, what is damaged is mended or refused in one sentence."""

import difflib
import json
import os
import re
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app import resources
from core_pipeline.curve_set import STATUSES, Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.phonemes import COMMON, TABLE_1
from core_pipeline.poses import FACEFX
from core_pipeline.settings import Settings
from tests.helpers import strategies as ours

SCHEMA = curve_set_json.SCHEMA
F_AH = ("f", "ah")
ENGLISH = resources.english_curves().read_text("utf-8")

#: What JSON can hold, a few levels deep.
ANY_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=2) | st.dictionaries(st.text(max_size=4), inner, max_size=2),
    max_leaves=4,
)


def file_of(**fields: Any) -> bytes:
    return json.dumps({"schema": SCHEMA, **fields}).encode()


def one_bigram(bigram: Any, name: str = "f-ah") -> bytes:
    return file_of(bigrams={name: bigram})


def with_keys(keys: str, pose: str = "open") -> bytes:
    return f'{{"schema": "{SCHEMA}", "bigrams": {{"f-ah": {{"curves": {{"{pose}": {keys}}}}}}}}}'.encode()


def read(data: bytes) -> curve_set_json.Reading:
    return curve_set_json.parse(data, "set.json")


def refusal(data: bytes) -> str:
    """The sentence with which a file is refused: one line, naming the file, not too long to read."""
    with pytest.raises(UserError) as caught:
        read(data)
    sentence = str(caught.value)
    assert "set.json" in sentence
    assert sentence.isprintable()
    assert len(sentence) < 500
    return sentence


def curve_of(reading: curve_set_json.Reading) -> list[tuple[float, float]]:
    return reading.curve_set.bigrams[F_AH].curves["open"].keys()


# ── what is written is read again ────────────────────────────────────────────────────────────────


@given(
    ours.curve_sets(nasty=True),
    st.none() | ours.settings(),
    st.dictionaries(st.text(max_size=5).map(lambda s: "x" + s), ANY_JSON, max_size=2),
    st.text(max_size=20),
    st.sampled_from(STATUSES),
)
def test_a_written_set_is_read_again_and_written_the_same(
    curve_set: CurveSet, settings: Settings | None, extra: dict[str, Any], name: str, status: str
) -> None:
    curve_set = replace(
        curve_set,
        name=name,
        language=name[:5],
        settings=settings,
        extra=extra,
        bigrams={pair: replace(b, status=status, note=name, extra=extra) for pair, b in curve_set.bigrams.items()},
    )
    text = curve_set_json.dumps(curve_set)
    reading = read(text.encode("utf-8"))
    again = reading.curve_set
    assert reading.repairs == ()
    assert not reading.newer
    assert (again.name, again.language, again.base) == (name, name[:5], None)
    assert (again.phonemes, again.poses, dict(again.phoneme_map)) == (curve_set.phonemes, curve_set.poses, {})
    assert again.effective_settings == curve_set.effective_settings
    assert again.extra == extra
    assert set(again.bigrams) == set(curve_set.bigrams)
    for pair, bigram in curve_set.bigrams.items():
        other = again.bigrams[pair]
        assert (other.status, other.source, other.note, other.extra) == (status, bigram.source, name, extra)
        assert set(other.curves) == set(bigram.curves)
        for pose, curve in bigram.curves.items():
            assert len(other.curves[pose]) == len(curve)
            np.testing.assert_allclose(other.curves[pose].t, curve.t, atol=5.1e-5)
            np.testing.assert_allclose(other.curves[pose].v, curve.v, atol=5.1e-5)
    assert curve_set_json.dumps(again) == text


@given(ours.curve_sets(), ours.settings())
def test_the_minified_set_holds_the_same(curve_set: CurveSet, settings: Settings) -> None:
    curve_set = curve_set.with_settings(settings)
    small = curve_set_json.dumps(curve_set, minified=True)
    assert small.count("\n") == 1
    assert len(small) < len(curve_set_json.dumps(curve_set))
    assert curve_set_json.dumps(read(small.encode()).curve_set) == curve_set_json.dumps(curve_set)


def test_our_english_set_is_in_canonical_form() -> None:
    assert curve_set_json.dumps(read(ENGLISH.encode()).curve_set) == ENGLISH


def test_the_order_of_the_file_is_not_that_of_editing() -> None:
    one = read(ENGLISH.encode()).curve_set
    backwards = CurveSet(
        name=one.name,
        language=one.language,
        settings=one.settings,
        bigrams={
            pair: replace(b, curves=dict(reversed(b.curves.items()))) for pair, b in reversed(one.bigrams.items())
        },
    )
    assert curve_set_json.dumps(backwards) == ENGLISH


def test_a_one_key_edit_is_a_one_line_diff() -> None:
    curve_set = read(ENGLISH.encode()).curve_set
    bigram = curve_set.bigrams[F_AH]
    curve = bigram.curves["open"]
    edited = bigram.with_curve("open", curve.with_key(0.123, 0.456))
    text = curve_set_json.dumps(curve_set.with_bigram(F_AH, edited))
    changed = [line for line in difflib.ndiff(ENGLISH.split("\n"), text.split("\n")) if line[0] in "+-"]
    assert [line[0] for line in changed] == ["-", "+"]
    assert "[0.123, 0.456]" in changed[1]


def test_at_most_four_decimals_and_no_trailing_zeros() -> None:
    curve = Curve.of([(0.0, 1 / 3), (0.123456, 0.5), (1.0, 0.00001)])
    text = curve_set_json.dumps(CurveSet(bigrams={F_AH: Bigram({"open": curve})}))
    assert "[[0, 0.3333], [0.1235, 0.5], [1, 0]]" in text
    assert not re.search(r"\d\.\d{5,}", text)
    assert not re.search(r"\.\d*0[],}\s]", text)


def test_keys_nearer_than_four_decimals_stay_apart() -> None:
    curve = Curve.of([(0.5, 0.0), (0.500001, 1.0), (0.500002, 0.0)])
    text = curve_set_json.dumps(CurveSet(bigrams={F_AH: Bigram({"open": curve})}))
    assert curve_of(read(text.encode())) == curve.keys()


def test_text_is_utf8_with_lf_and_ends_with_a_line(tmp_path: Path) -> None:
    path = tmp_path / "mandarin.json"
    curve_set_json.save(CurveSet(name="普通话 ü"), path)
    data = path.read_bytes()
    assert "普通话 ü".encode() in data
    assert data.endswith(b"}\n")
    assert b"\r" not in data
    assert curve_set_json.load(path).name == "普通话 ü"


def test_fields_of_a_later_program_survive_at_every_level() -> None:
    data = file_of(
        author={"name": "Ann", "since": 2013},
        settings={"l_max": 9, "viscosity": [1, 2.5]},
        bigrams={"f-ah": {"author": "Bo", "curves": {}}},
    )
    text = curve_set_json.dumps(read(data).curve_set)
    top = json.loads(text)
    assert top["author"] == {"name": "Ann", "since": 2013}
    assert top["settings"]["viscosity"] == [1, 2.5]
    assert top["settings"]["l_max"] == 9
    assert top["bigrams"]["f-ah"]["author"] == "Bo"
    assert curve_set_json.dumps(read(text.encode()).curve_set) == text


# ── what may be missing ──────────────────────────────────────────────────────────────────────────


def test_a_file_may_leave_out_all_but_its_schema() -> None:
    curve_set = read(file_of()).curve_set
    assert curve_set.phonemes == COMMON
    assert curve_set.poses == FACEFX
    assert curve_set.phoneme_map == TABLE_1
    assert curve_set.settings is None
    assert curve_set.effective_settings == Settings.paper()
    assert not curve_set.bigrams


def test_a_file_may_leave_out_part_of_its_settings() -> None:
    settings = read(file_of(settings={"l_max": 6, "spline": "linear"})).curve_set.effective_settings
    assert settings == replace(Settings.paper(), speed_limit=6.0, spline="linear")


@given(ours.settings())
def test_settings_are_written_and_read(settings: Settings) -> None:
    text = curve_set_json.dumps(CurveSet(settings=settings))
    assert read(text.encode()).curve_set.settings == settings


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ({"window": 1.5}, "smoothing window is 1.5 s: choose a value from 0 to 1"),
        ({"windows": {"PBM": -0.1}}, "smoothing window of PBM is -0.1 s"),
        ({"windows": [0.1]}, "got `array` - at `$.windows`"),
        ({"constraints": [["open", "FV", 3]]}, "constraint of open and FV is 3: choose 0 to 2"),
        ({"constraints": [["open", "open", 1]]}, "open is constrained against itself"),
        ({"constraints": [["open", "FV"]]}, "length 3, got 2 - at `$.constraints[0]`"),
        ({"priorities": ["open", "open"]}, "twice in the priorities"),
        ({"l_max": 0}, "speed limit is 0/s: choose a value from 0.01"),
        ({"l_max": "15"}, "expected `float | null`, got `str` - at `$.l_max`"),
        ({"l_max": 10**400}, "out of range - at `$.l_max`"),
        ({"spline": "bezier"}, "no spline 'bezier': choose one of pchip"),
        ([], "expected `object`, got `array`"),
    ],
)
def test_settings_out_of_range_are_refused_by_name(settings: Any, told: str) -> None:
    sentence = refusal(file_of(settings=settings))
    assert "settings" in sentence
    assert told in sentence


# ── what is mended, and said ─────────────────────────────────────────────────────────────────────


@pytest.mark.parametrize(
    ("keys", "mended", "told"),
    [
        ("[[0.5, 1], [0.2, 0.3]]", [(0.2, 0.3), (0.5, 1.0)], "out of order were sorted"),
        ("[[-0.04, 0.2], [1.05, 1.02]]", [(0.0, 0.2), (1.0, 1.0)], "2 keys a little outside 0…1 were clipped"),
        ("[[0.5, 0.2], [0.5, 0.7], [0.5, 0.1]]", [(0.5, 0.7)], "2 keys at the time of another were merged"),
        ("[[-0.01, 0.5], [0, 0.2]]", [(0.0, 0.5)], "merged"),
    ],
)
def test_small_faults_are_mended_and_reported(keys: str, mended: list[tuple[float, float]], told: str) -> None:
    reading = read(with_keys(keys))
    assert curve_of(reading) == mended
    assert any(told in line for line in reading.repairs)
    for line in reading.repairs:
        assert line.startswith("set.json, bigram f-ah, pose open: ")
    assert read(curve_set_json.dumps(reading.curve_set).encode()).repairs == ()


def test_a_curve_without_keys_is_left_out_and_said() -> None:
    reading = read(with_keys("[]"))
    assert not reading.curve_set.bigrams[F_AH].curves
    assert reading.repairs == ("set.json, bigram f-ah, pose open: a curve without keys was left out.",)


# ── what is refused ──────────────────────────────────────────────────────────────────────────────


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ("[[0, 0], [0.5, 1.2]]", "key 1: 0.5, 1.2 lies outside 0…1"),
        ("[[0, 0], [-3, 0.5]]", "key 1: -3, 0.5 lies outside"),
        ("[[0, 0], [0.5]]", "key 1: not a pair of numbers"),
        ("[[0, 0, 0]]", "key 0: not a pair of numbers"),
        ("[[0, 0], null]", "key 1: not a pair"),
        ('[["0", 0]]', "key 0: not a pair"),
        ("[[true, false]]", "key 0: not a pair"),
        ("[0, 1]", "key 0: not a pair"),
        (f"[[{'9' * 400}, 0]]", "key 0: a number of hundreds of digits, 0 lies outside"),
        (f"[[{'9' * 5000}, 0]]", "thousands of digits"),
        (json.dumps([[i / 3000, 0] for i in range(3000)]), "3000 keys; at most 2000"),
    ],
)
def test_a_refused_key_is_named_by_bigram_pose_and_number(keys: str, told: str) -> None:
    sentence = refusal(with_keys(keys))
    assert told in sentence
    assert "set.json, bigram f-ah, pose open" in sentence or "digits" in told


@pytest.mark.parametrize(
    ("name", "bigram", "told"),
    [
        ("f-xx", {}, "bigram f-xx: not two phonemes of this set"),
        ("f", {}, "bigram f: not two phonemes"),
        ("f-ah-d", {}, "bigram f-ah-d: not two"),
        ("", {}, "bigram : not two"),
        ("f\n\x1b[31m", {}, r"bigram f\n\x1b[31m: not two"),
        ("y" * 100_000, {}, "bigram yyy"),
        ("f-ah", {"curves": {"Open": [[0, 0]]}}, "f-ah: the pose “Open” is not in"),
        ("f-ah", {"curves": {"p" * 9999: [[0, 0]]}}, "f-ah: the pose “ppp"),
        ("f-ah", {"curves": {"open": {}}}, "f-ah: expected `array`, got `object`"),
        ("f-ah", {"curves": None}, "f-ah: expected `object`, got `null`"),
        ("f-ah", {"status": "done"}, "f-ah: there is no status “done”; write one of empty, suggestion, draft"),
        ("f-ah", {"note": 3}, "f-ah: expected `str`, got `int` - at `$.note`"),
        ("f-ah", {"note": "n" * 20_000}, "f-ah: expected `str` of length <= 10000 - at `$.note`"),
        ("f-ah", [], "f-ah: expected `object`, got `array`"),
        ("f-ah", None, "f-ah: expected `object`, got `null`"),
    ],
)
def test_a_refused_bigram_is_named(name: str, bigram: Any, told: str) -> None:
    assert told in refusal(one_bigram(bigram, name))


@pytest.mark.parametrize(
    ("fields", "told"),
    [
        ({"name": 3}, "at `$.name`"),
        ({"name": "n" * 1000}, "length <= 200 - at `$.name`"),
        ({"phonemes": "ah"}, "at `$.phonemes`"),
        ({"phonemes": []}, '"phonemes" has 0 names; write 1 to 400'),
        ({"phonemes": ["ah", "a-b"]}, "'a-b' in \"phonemes\" is not a usable name"),
        ({"phonemes": ["ah", "a\nb"]}, "is not a usable name"),
        ({"phonemes": ["ah", "eh", "ah"]}, "\"phonemes\" names 'ah' twice"),
        ({"phonemes": ["ah", "sil"]}, '"sil" means silence'),
        ({"phonemes": [str(i) for i in range(50_000)] + ["49999"]}, "50001 names; write 1 to 400"),
        ({"poses": []}, '"poses" has 0 names'),
        ({"poses": ["open", ""]}, "'' in \"poses\" is not a usable name"),
        ({"poses": ["open", "open"]}, "names 'open' twice"),
        ({"phoneme_map": {"ae": 1}}, "at `$.phoneme_map[...]`"),
        ({"bigrams": []}, '"bigrams" is not an object'),
        ({"bigrams": None}, '"bigrams" is not an object'),
    ],
)
def test_refused_fields_of_the_set_are_named(fields: dict[str, Any], told: str) -> None:
    assert told in refusal(file_of(**fields))


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "damaged at line 1, column 1"),
        (ENGLISH[:5000].encode(), "damaged at line"),
        (b"[]", "does not begin with an object"),
        (b"{}", f'should say "schema": "{SCHEMA}"'),
        (b'{"schema": "lipstitch.CurveSet.0"}', "not a curve set"),
        (b'{"schema": "lipstitch.Schedule.1", "phones": [], "times": []}', "not a curve set"),
        (b'{"schema": ["lipstitch.CurveSet.1"]}', "not a curve set"),
        (bytes(range(256)), "not text in UTF-8 (byte 128)"),
        (b'{"schema": "lipstitch.CurveSet.1", "x": NaN}', "holds NaN"),
        (b'{"schema": "lipstitch.CurveSet.1", "x": -Infinity}', "holds -Infinity"),
        (b'{"schema": "lipstitch.CurveSet.1", "x": 1e999}', "holds 1e999"),
        (with_keys("[[NaN, 0]]"), "holds NaN"),
        (b'{"schema": "lipstitch.CurveSet.1", "schema": "lipstitch.CurveSet.1"}', "names 'schema' twice"),
        (with_keys('[[0, 0]], "open": [[0, 1]]'), "names 'open' twice"),
        (b'{"schema": "lipstitch.CurveSet.1", "name": "\\ud800"}', "half a character"),
        (b'{"schema": "lipstitch.CurveSet.1", "x": ' + b"[" * 100_000, "nested too deeply"),
        (b'{"schema": "lipstitch.CurveSet.1", "x": ' + b"[" * 900 + b"]" * 900 + b"}", "nested too deeply"),
        (one_bigram({"x": json.loads("[" * 200 + "]" * 200)}), "nested too deeply"),
        (b"-" * 1000, "damaged at line 1"),
    ],
    ids=lambda value: None if isinstance(value, bytes) else value,
)
def test_what_is_no_curve_set_is_refused(data: bytes, told: str) -> None:
    assert told in refusal(data)


def test_all_faults_of_a_file_are_listed_up_to_a_limit() -> None:
    data = file_of(bigrams={f"q{i}-ah": {} for i in range(200)})
    reading, problems = curve_set_json.examine(data, "set.json")
    assert reading is None
    assert len(problems) == curve_set_json.MAX_TOLD + 1
    assert problems[-1] == "set.json: further problems are not listed."
    assert "(50 more problems; `check` lists them)" in refusal(data)


def test_a_newer_file_is_read_and_known_as_newer() -> None:
    data = file_of(bigrams={"f-ah": {"curves": {"open": [[0, 0.5]]}}}).replace(b"CurveSet.1", b"CurveSet.7")
    reading = read(data)
    assert reading.newer
    assert curve_of(reading) == [(0.0, 0.5)]


def test_a_newer_file_that_cannot_be_read_says_that_it_is_newer() -> None:
    data = with_keys('[{"time": 0, "weight": 1}]').replace(b"CurveSet.1", b"CurveSet.7")
    assert "(written by a newer Lipstitch)" in refusal(data)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-be with bom"])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_any_encoding_an_editor_saves_is_read(encoding: str, newline: str) -> None:
    text = curve_set_json.dumps(CurveSet(name="Zoë", bigrams={F_AH: Bigram({"open": Curve.of([(0, 1)])})}))
    text = text.replace("\n", newline)
    data = b"\xfe\xff" + text.encode("utf-16-be") if "with bom" in encoding else text.encode(encoding)
    reading = read(data)
    assert reading.curve_set.name == "Zoë"
    assert curve_of(reading) == [(0.0, 1.0)]


# ── files ────────────────────────────────────────────────────────────────────────────────────────


def test_a_huge_file_is_refused_without_reading_it_all(tmp_path: Path) -> None:
    path = tmp_path / "huge.json"
    with path.open("wb") as file:
        file.truncate(200 * 2**30)  # sparse: takes no room, and no memory could hold it
    start = time.perf_counter()
    with pytest.raises(UserError, match=r"huge\.json is larger than 16 MB, too large for a curve set"):
        curve_set_json.load(path)
    assert time.perf_counter() - start < 5


@pytest.mark.parametrize(("megabytes", "told"), [(15, "length <= 200"), (50, "far more than any curve set")])
def test_megabytes_of_one_string_are_refused_quickly(megabytes: int, told: str) -> None:
    start = time.perf_counter()
    assert told in refusal(file_of(name="n" * megabytes * 2**20))
    assert time.perf_counter() - start < 5


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("missing.json", "there is no such file"),
        ("", "is a folder: choose the curve set file in it"),
        ("file/below.json", "part of the path is a file"),
        ("n" * 300, "the name is too long"),
        ("a\0b", "no possible path"),
    ],
)
def test_what_cannot_be_read_says_why(tmp_path: Path, name: str, told: str) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match=told):
        curve_set_json.load(os.path.join(tmp_path, name))  # noqa: PTH118 - Path would normalise

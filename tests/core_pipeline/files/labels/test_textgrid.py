"""TextGrids as Praat, MFA, WebMAUS and praatio write them, and ours as praatio reads them."""

import codecs

import pytest
from hypothesis import given
from hypothesis import strategies as st
from praatio import textgrid as praat
from praatio.utilities.textgrid_io import parseTextgridStr

from core_pipeline.files.labels import textgrid
from core_pipeline.files.labels.read import parse, read
from core_pipeline.phonemes import SILENCE
from core_pipeline.schedule import Schedule
from core_pipeline.speech.utterance import Word
from tests.helpers.outcome import outcome
from tests.helpers.strategies import schedules

PHONES = [(0.0, 0.2, ""), (0.2, 0.3, "HH"), (0.3, 0.4, "AH0"), (0.4, 0.55, "L"), (0.55, 0.9, "OW1"), (0.9, 1.0, "sp")]
WORDS = [(0.0, 0.2, ""), (0.2, 0.9, "hello"), (0.9, 1.0, "")]

BY_HAND = """File type = "ooTextFile"
Object class = "TextGrid"

xmin = 0
xmax = 1
tiers? <exists>
size = 2
item []:
    item [1]:
        class = "IntervalTier"
        name = "phones"
        xmin = 0
        xmax = 1
        intervals: size = 2
        intervals [1]:
            xmin = 0
            xmax = 0.4
            text = "AA1"
        intervals [2]:
            xmin = 0.4
            xmax = 1
            text = "T"
    item [2]:
        class = "TextTier"
        name = "words"
        xmin = 0
        xmax = 1
        points: size = 1
        points [1]:
            number = 0.5
            mark = "x"
"""


def written(tmp_path, kind, tiers):
    grid = praat.Textgrid()
    for name, intervals in tiers:
        grid.addTier(praat.IntervalTier(name, intervals, 0, 1.0))
    path = tmp_path / "a.TextGrid"
    grid.save(str(path), format=kind, includeBlankSpaces=True)
    return path


def said(intervals):
    return [(i.start, i.end, i.name) for i in intervals if i.name]


@pytest.mark.parametrize("kind", ["long_textgrid", "short_textgrid"])
@pytest.mark.parametrize(
    "names", [("words", "phones"), ("A - words", "A - phones"), ("ORT", "MAU"), ("Word", "Segment"), ("x", "y")]
)
def test_what_praatio_writes_is_read(tmp_path, kind, names):
    found = read(written(tmp_path, kind, [(names[0], WORDS), (names[1], PHONES)]))
    assert said(found.phones) == [p for p in PHONES if p[2]]
    assert said(found.words) == ([w for w in WORDS if w[2]] if names[0] != "x" else [])
    assert (found.start, found.end) == (0, 1)


def test_the_json_of_mfa_is_read(tmp_path):
    found = read(written(tmp_path, "json", [("words", WORDS), ("phones", PHONES)]))
    assert said(found.phones) == [p for p in PHONES if p[2]]
    assert said(found.words) == [(0.2, 0.9, "hello")]


@pytest.mark.parametrize(
    "bytes_of",
    [
        lambda t: t.encode(),
        lambda t: codecs.BOM_UTF8 + t.encode(),
        lambda t: t.encode("utf-16"),
        lambda t: codecs.BOM_UTF16_BE + t.encode("utf-16-be"),
        lambda t: t.encode("utf-16-le"),
        lambda t: t.replace("\n", "\r\n").encode(),
        lambda t: t.replace("\n", "\r").encode(),
        lambda t: t.replace("    ", "\t").encode(),
        lambda t: t.replace("xmax = 0.4", "xmax = 0.4 ! a comment with 7 numbers").encode(),
        lambda t: t.replace(" = ", "=").encode(),
        lambda t: t.replace("intervals [", "intervals[").encode(),
        lambda t: t.replace('"T"', '"T"" item [2]: class = ""IntervalTier"""').encode(),
        lambda t: t.replace('"T"', '"T"\n\n').encode(),
    ],
)
def test_encodings_line_ends_and_spellings_do_not_matter(bytes_of):
    found = parse(bytes_of(BY_HAND), "a.TextGrid")
    assert [i.name[0] for i in found.phones] == ["A", "T"]
    assert [i.start for i in found.phones] == [0, 0.4]
    assert found.notes == ()


def test_a_file_cut_off_gives_what_it_holds_and_says_so():
    found = parse(BY_HAND[: BY_HAND.index("intervals [2]")].encode(), "a.TextGrid")
    assert said(found.phones) == [(0, 0.4, "AA1")]
    assert "cut off" in found.notes[0]


def test_several_speakers_the_one_who_speaks_most_is_taken(tmp_path):
    path = written(
        tmp_path, "long_textgrid", [("A - phones", PHONES[:2]), ("B - words", WORDS), ("B - phones", PHONES)]
    )
    found = read(path)
    assert len(said(found.phones)) == 5
    assert said(found.words) == [(0.2, 0.9, "hello")]
    assert "“B - phones” was taken" in found.notes[0]


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "empty"),
        (b"ooBinaryFile\x08TextGrid", "binary"),
        (BY_HAND.replace("IntervalTier", "TextTier").encode(), "no interval tier"),
        (BY_HAND.replace('"phones"', '"words"').encode(), ""),
        (b'File type = "ooTextFile"\n"TextGrid"\n', "no interval tier"),
        (b'"ooTextFile"\n"Praat chronological TextGrid text file"\n', "chronological"),
        (b"\x00\x01\x02binary" * 99, "not text"),
        (BY_HAND.replace("size = 2", "size = 1e300").encode()[:200], "no interval tier"),
    ],
)
def test_what_cannot_be_read_is_one_sentence(data, says):
    found, refusal = outcome(lambda: parse(data, "a.TextGrid"))
    if says:
        assert says in refusal
        assert "a.TextGrid" in refusal
        assert "\n" not in refusal
    else:
        assert [i.name for i in found.phones] == ["AA1", "T"]  # its labels are phones, whatever its name


_LABELS = st.text(st.characters(codec="utf-8", exclude_characters="\0\r\n"), min_size=1)


@given(schedules(), st.lists(_LABELS, max_size=4))
def test_what_we_write_comes_back_and_praatio_agrees(schedule, texts):
    cuts = [schedule.start + schedule.duration * i / (len(texts) + 1) for i in range(len(texts) + 1)]
    words = [Word(text, a, b) for text, a, b in zip(texts, cuts, cuts[1:], strict=False) if b - a > 1e-4]
    text = textgrid.dumps(schedule, words)
    found = parse(text.encode(), "x")
    named = [(p, float(a)) for p, a in zip(schedule.phones, schedule.times, strict=False) if p != SILENCE]
    assert [i.name for i in found.phones if i.name] == [p for p, _ in named]
    assert all(abs(i.start - a) < 1e-5 for i, (_, a) in zip((i for i in found.phones if i.name), named, strict=True))
    if schedule.start < 0:  # which praatio cannot read
        return
    witness = parseTextgridStr(textgrid.dumps(schedule, []), includeEmptyIntervals=True)
    phones = witness["tiers"][1]["entries"]
    assert [p[-1] or SILENCE for p in phones] == list(schedule.phones)


@given(st.binary(max_size=400))
def test_no_bytes_are_a_fault_of_ours(data):
    for start in (b"", BY_HAND.encode()[:240]):
        found, refusal = outcome(lambda start=start: parse(start + data, "x"))
        assert found is not None or "x" in refusal


def test_words_never_overlap_in_what_we_write(tmp_path):
    path = tmp_path / "a.TextGrid"
    textgrid.save(
        path, Schedule(["f", "ah"], [0, 0.5, 1]), [Word("a", 0, 0.6), Word("b", 0.4, 1.2), Word("c", 0.5, 0.6)]
    )
    grid = praat.openTextgrid(str(path), includeEmptyIntervals=True)
    assert [tuple(e) for e in grid.getTier("words").entries] == [(0, 0.6, "a"), (0.6, 1, "b")]

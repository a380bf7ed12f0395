"""Label files of one interval a line, as HTK, TIMIT, Festival, Audacity and MFA write them."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.files.labels.read import parse, read
from tests.helpers.outcome import outcome


def spans(text, ending=".lab", rate=None):
    found = parse(text.encode(), f"a{ending}", ending, rate)
    return found.kind, [(round(i.start, 4), round(i.end, 4), i.name) for i in found.phones], found


HTK = "0 2900000 sil\n2900000 3800000 f\n3800000 4900000 ae\n4900000 6000000 t\n"
TIMIT = "0 3050 h#\n3050 4559 sh\n4559 5723 ix\n5723 6642 hv\n"
FESTIVAL = "signal tts\nnfields 1\n#\n\t0.2200 100 pau\n\t0.3100 100 hh\n\t0.4000 121 ax\n"
WANTED = [(0, 0.29, "sil"), (0.29, 0.38, "f"), (0.38, 0.49, "ae"), (0.49, 0.6, "t")]


@pytest.mark.parametrize(
    "text",
    [
        HTK,
        HTK.replace("\n", "\r\n"),
        HTK.replace(" ", "\t"),
        "\n" + HTK + "\n\n",
        HTK.replace("f\n", "f -123.45\n").replace("sil\n", "sil -1.5e3\n"),
        HTK.replace(" f\n", " sil-f+ae\n").replace(" ae\n", " f-ae+t\n"),
        HTK.replace(" f\n", " x^sil-f+ae=t@1_2/A:0\n"),
        '#!MLF!#\n"*/one.lab"\n' + HTK + ".\n",
        "0 sil\n2900000 f\n3800000 ae\n4900000 t\n",
    ],
)
def test_htk(text):
    kind, found, _ = spans(text)
    assert kind == "HTK label file"
    assert found[:3] == WANTED[:3]
    assert found[3][::2] == WANTED[3][::2]


def test_htk_words_stand_at_their_first_phone():
    _, _, found = spans(HTK.replace(" sil", " sil -9 silence").replace(" f\n", " f -55.1 fat\n"))
    assert [(round(w.start, 2), round(w.end, 2), w.name) for w in found.words] == [(0.29, 0.6, "fat")]


def test_timit_in_samples_with_the_rate_said_or_assumed():
    kind, found, labels = spans(TIMIT, ".phn")
    assert kind == "TIMIT label file"
    assert found[1] == (0.1906, 0.2849, "sh")
    assert "16000 per second" in labels.notes[0]
    _, found, labels = spans(TIMIT, ".phn", rate=8000)
    assert found[1] == (0.3813, 0.5699, "sh")
    assert labels.notes == ()
    assert spans(TIMIT, ".lab")[0] == "TIMIT label file"  # by its numbers, not its name


def test_timit_words_are_found_beside_the_phones(tmp_path):
    (tmp_path / "a.phn").write_text(TIMIT)
    (tmp_path / "a.wrd").write_text("3050 6642 she\n")
    assert [w.name for w in read(tmp_path / "a.phn").words] == ["she"]


@pytest.mark.parametrize("text", [FESTIVAL, FESTIVAL.replace("\n", "\r\n"), FESTIVAL.replace("hh\n", "hh ; x\n")])
def test_festival_gives_ends(text):
    kind, found, _ = spans(text)
    assert kind == "ESPS label file"
    assert found == [(0, 0.22, "pau"), (0.22, 0.31, "hh"), (0.31, 0.4, "ax")]


def test_seconds_in_columns():
    assert spans("0.0\t0.2\tsil\n0.2\t0.4\tAA1\n", ".txt")[1] == [(0, 0.2, "sil"), (0.2, 0.4, "AA1")]
    assert spans("0.2 sil\n0.4 aa\n", ".txt")[1] == [(0, 0.2, "sil"), (0.2, 0.4, "aa")]
    assert spans("5.5 6.0 aa\n6.0 6.5 b\n", ".txt")[1][0] == (5.5, 6.0, "aa")


def test_the_table_of_mfa():
    table = "Begin,End,Label,Type,Speaker\n0.0,0.5,hello,words,s\n0.0,0.2,HH,phones,s\n0.2,0.5,AH0,phones,s\n"
    kind, found, labels = spans(table, ".csv")
    assert kind == "MFA table"
    assert found == [(0, 0.2, "HH"), (0.2, 0.5, "AH0")]
    assert labels.words[0].name == "hello"


def test_the_first_of_many_utterances_is_taken_and_said():
    _, found, labels = spans('#!MLF!#\n"*/a.lab"\n' + HTK + '.\n"*/b.lab"\n0 900000 x\n.\n', ".mlf")
    assert len(found) == 4
    assert "2 utterances" in labels.notes[0]


def test_labels_without_a_length_are_left_out_and_counted():
    _, found, labels = spans(HTK + "6000000 6000000 sp\n7000000 6500000 x\n")
    assert len(found) == 4
    assert labels.notes == ("2 labels without a length or a usable time left out.",)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("sil\nf\nae\n", "no label file"),
        ("hello world, this is no label file at all\n", "no label file"),
        (HTK + "oops 3 4\n", "label 5"),
        ("#\nx 1 2\n", "label 1"),
        ("#\n", "no labels"),
        ("#!MLF!#\n", "no labels"),
        ("Begin,End,Label,Type\n0,x,HH,phones\n", "damaged table"),
        ("Begin,End,Label,Type\n0,1,hi,words\n", "no phones"),
        ("{}", "no label file"),
        ('{"tiers": {"phones": {"entries": [[1]]}}}', "damaged"),
        ('{"tiers": {}}', "no tier of phones"),
    ],
)
def test_what_cannot_be_read_is_one_sentence(text, says):
    with pytest.raises(UserError, match=says) as told:
        parse(text.encode(), "a.lab", ".lab")
    assert "a.lab" in str(told.value)


def test_numbers_beyond_all_numbers_are_no_times(tmp_path):
    path = tmp_path / "a.lab"
    path.write_text("9" * 400 + " 5 a\n")
    with pytest.raises(UserError, match="no labels with a length"):
        read(path)


@given(st.text(st.sampled_from('0123456789.- \t\n#aesil;"e+'), max_size=80), st.sampled_from([".lab", ".phn", ".txt"]))
def test_no_text_is_a_fault_of_ours(text, ending):
    found, refusal = outcome(lambda: parse(text.encode(), "x", ending))
    assert "x" in refusal if found is None else all(i.end > i.start for i in found.phones)

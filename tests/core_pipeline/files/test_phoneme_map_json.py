"""Phoneme maps are data: those we ship are whole, what is wrong is named."""

import json
from pathlib import Path

import pytest

from core_pipeline.errors import UserError
from core_pipeline.files import phoneme_map_json
from core_pipeline.phonemes import COMMON, TABLE_1

SHIPPED = sorted(Path("assets/phoneme_maps").glob("*.json"))


@pytest.mark.parametrize("path", SHIPPED, ids=lambda p: p.stem)
def test_every_shipped_map_knows_all_english_phones(path, tmp_path):
    found = phoneme_map_json.load(path)
    assert set(TABLE_1) <= set(found.table)
    assert found.phonemes[:21] == COMMON
    assert found.note
    phoneme_map_json.save(found, tmp_path / "a.json")
    assert (tmp_path / "a.json").read_bytes() == path.read_bytes()


def test_the_default_is_table_1_of_the_paper():
    assert len(SHIPPED) == 5
    table = phoneme_map_json.load("assets/phoneme_maps/table-1.json")
    assert dict(table.table) == dict(TABLE_1)
    assert phoneme_map_json.load("assets/phoneme_maps/mandarin.json").phonemes == (*COMMON, "ü")


def test_a_phoneme_of_thousands_of_letters_does_not_fill_the_sentence():
    with pytest.raises(UserError, match="leads to “x”") as told:
        phoneme_map_json.parse(
            json.dumps({"schema": phoneme_map_json.SCHEMA, "phonemes": ["a" * 9000], "map": {"ae": "x"}}).encode(), "m"
        )
    assert len(str(told.value)) < 500


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"map": {"ae": "xx"}}, "“ae” leads to “xx”"),
        ({"phonemes": ["ah", "ah"]}, "twice"),
        ({"phonemes": []}, "no phonemes"),
        ({"phonemes": ["a-b"]}, "cannot be a phoneme"),
        ({"phonemes": "ah"}, "expected `array`"),
        ({"map": {"ae": 3}}, "expected `str`"),
        ({"schema": "lipstitch.Schedule.1"}, "not a phoneme map"),
    ],
)
def test_what_is_wrong_is_named(change, says):
    whole = {"schema": phoneme_map_json.SCHEMA, "phonemes": ["ah"], "map": {"ae": "ah"}}
    with pytest.raises(UserError, match=says):
        phoneme_map_json.parse(json.dumps(whole | change).encode(), "m.json")

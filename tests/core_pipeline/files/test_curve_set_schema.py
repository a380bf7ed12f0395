"""The published JSON Schema is made from the typed structures and tells sound files from others; old files upgrade."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from app import resources
from core_pipeline.curve_set import STATUSES
from core_pipeline.files import curve_set_json
from core_pipeline.files.curve_set_records import MAX_KEYS, SCHEMA, VERSION, json_schema
from core_pipeline.files.layers import built_in
from core_pipeline.files.upgrades import STEPS, upgraded

FOLDER = resources.assets() / "curves"
PUBLISHED = FOLDER / "curve_set.schema.json"
OLD = Path(__file__).parents[2] / "data" / "curve_sets"


@pytest.fixture(scope="module")
def validator() -> Any:
    schema = json.loads(PUBLISHED.read_text("utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def test_the_published_schema_is_what_the_structures_say() -> None:
    assert PUBLISHED.read_text("utf-8") == json_schema()


@pytest.mark.parametrize("name", built_in())
def test_the_shipped_sets_fit_it(validator: Any, name: str) -> None:
    validator.validate(json.loads((FOLDER / f"{name}.json").read_text("utf-8")))


def test_it_names_all_statuses(validator: Any) -> None:
    for status in STATUSES:
        validator.validate({"schema": SCHEMA, "bigrams": {"f-ah": {"status": status}}})


@pytest.mark.parametrize(
    "fields",
    [
        {"schema": "lipstitch.Schedule.1"},
        {"name": 3},
        {"phonemes": []},
        {"phonemes": ["a-b"]},
        {"bigrams": {"f-ah": {"status": "done"}}},
        {"bigrams": {"f-ah": {"curves": {"open": []}}}},
        {"bigrams": {"f-ah": {"curves": {"open": [[0, 1.5]]}}}},
        {"bigrams": {"f-ah": {"curves": {"open": [[0, 0, 0]]}}}},
        {"bigrams": {"f-ah": {"curves": {"open": [[0, 0]] * (MAX_KEYS + 1)}}}},
        {"settings": {"l_max": "fast"}},
    ],
)
def test_it_refuses_what_we_refuse(validator: Any, fields: dict[str, Any]) -> None:
    assert not validator.is_valid({"schema": SCHEMA, **fields})
    reading, _ = curve_set_json.examine(json.dumps({"schema": SCHEMA, **fields}).encode(), "set.json")
    assert reading is None or reading.repairs or fields["bigrams"]["f-ah"]["curves"]["open"] == [[0, 1.5]]


# ── versions ─────────────────────────────────────────────────────────────────────────────────────


@pytest.mark.parametrize("version", range(1, VERSION + 1))
def test_a_file_of_every_version_still_reads(version: int) -> None:
    data = (OLD / f"version-{version}.json").read_bytes()
    reading = curve_set_json.parse(data, "old.json")
    assert reading.repairs == ()
    assert not reading.newer
    assert reading.curve_set.bigrams["f", "ah"].curves["FV"].keys() == [(0, 0.2), (0.26, 0.97), (0.42, 0.55), (1, 0)]
    if version == VERSION:
        assert curve_set_json.dumps(reading.curve_set).encode() == data


def test_every_old_version_has_its_step() -> None:
    assert set(STEPS) == set(range(1, VERSION))


def test_steps_follow_each_other() -> None:
    steps = {1: lambda top: {"b": top["a"]}, 2: lambda top: {"c": top["b"] + 1}}
    assert upgraded({"a": 1}, 1, steps, 3) == {"c": 2}
    assert upgraded({"b": 1}, 2, steps, 3) == {"c": 2}
    assert upgraded({"d": 1}, 4, steps, 3) == {"d": 1}

"""Schedule files: written and read, refused by phone and number."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import schedule_json
from core_pipeline.schedule import Schedule
from tests.helpers import strategies as ours


def parse(text: str, curve_set: CurveSet | None = None) -> Schedule:
    return schedule_json.parse(text.encode(), "times.json", curve_set)


def file_of(phones: object, times: object) -> str:
    return json.dumps({"schema": schedule_json.SCHEMA, "phones": phones, "times": times})


@given(ours.schedules())
def test_a_written_schedule_is_read_again(schedule: Schedule) -> None:
    text = schedule_json.dumps(schedule)
    again = parse(text)
    assert again.phones == schedule.phones
    np.testing.assert_allclose(again.times, schedule.times, atol=1e-6)
    assert schedule_json.dumps(again) == text


def test_the_documented_shape_is_read(tmp_path: Path) -> None:
    path = tmp_path / "times.json"
    path.write_text(
        '{"schema": "lipstitch.Schedule.1", "phones": ["f","ah","d"], "times": [0.0, 0.1, 0.22, 0.3], "by": "Ann"}'
    )
    schedule = schedule_json.load(path, CurveSet())
    assert schedule.phones == ("f", "ah", "d")
    assert schedule.times.tolist() == [0.0, 0.1, 0.22, 0.3]
    schedule_json.save(schedule, path)
    assert json.loads(path.read_text()) == {
        "schema": "lipstitch.Schedule.1",
        "phones": ["f", "ah", "d"],
        "times": [0.0, 0.1, 0.22, 0.3],
    }


@pytest.mark.parametrize("times", ["[]", "[0.5]"])
def test_a_schedule_of_nothing_is_read(times: str) -> None:
    assert len(parse(f'{{"schema": "{schedule_json.SCHEMA}", "phones": [], "times": {times}}}')) == 0


def test_phones_of_the_set_of_its_map_and_silence_are_known() -> None:
    assert len(parse(file_of(["sil", "bmp", "p", "sil"], [0, 1, 2, 3, 4]), CurveSet())) == 4


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (file_of(["f", "ah"], [0, 0.2, 0.1]), "phone 1 ('ah') starts at 0.2 s and ends at 0.1 s"),
        (file_of(["f", "ah"], [0, 0.2, 0.2]), "Times must rise: phone 1"),
        (file_of(["f"], [0, float("nan")]), "holds NaN"),
        (file_of(["f"], [0, float("inf")]), "holds Infinity"),
        ('{"schema": "lipstitch.Schedule.1", "phones": ["f"], "times": [0, 1e999]}', "holds 1e999"),
        (file_of(["f"], [0, 10**400]), "out of range - at `$.times[1]`"),
        (file_of(["f"], [0, 1e9]), "more than 11 days from 0"),
        (file_of(["f"], [0, None]), "expected `float`, got `null` - at `$.times[1]`"),
        (file_of(["f"], [0, "1"]), "got `str` - at `$.times[1]`"),
        (file_of(["f"], [0]), "1 phones needs 2 times, this one has 1"),
        (file_of(["f"], []), "this one has 0"),
        (file_of([], [0, 1]), "0 phones needs 1 times, this one has 2"),
        (file_of("f", [0, 1]), "expected `array`, got `str` - at `$.phones`"),
        (file_of(["f", 3], [0, 1, 2]), "at `$.phones[1]`"),
        (file_of(["f", "xx"], [0, 1, 2]), "phone 1 is “xx”, which the curve set 'Untitled' does not know; write"),
        (file_of(["x\n\x1b[2J"], [0, 1]), r"phone 0 is “x\n\x1b[2J”"),
        ('{"schema": "lipstitch.Schedule.1", "times": [0]}', "missing required field `phones`"),
        ('{"schema": "lipstitch.Schedule.2", "phones": [], "times": []}', 'it should say "schema": "lipstitch.Sch'),
        ("", "damaged at line 1"),
        ("[" * 100_000, "nested too deeply"),
    ],
)  # fmt: skip
def test_what_is_no_schedule_is_refused_by_phone_or_place(text: str, told: str) -> None:
    with pytest.raises(UserError) as caught:
        parse(text, CurveSet())
    assert str(caught.value).startswith("times.json")
    assert told in str(caught.value)
    assert str(caught.value).isprintable()

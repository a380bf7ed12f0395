"""The table of frequencies: written and read without a change, and refused with a reason."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.files import frequencies_json
from core_pipeline.statistics import Frequencies

PHONES = ("a", "b", "ü")


@settings(max_examples=25)
@given(st.dictionaries(st.tuples(st.sampled_from(PHONES), st.sampled_from(PHONES)), st.integers(0, 2**40)))
def test_what_is_written_is_read(tmp_path_factory: pytest.TempPathFactory, counts: dict[tuple[str, str], int]) -> None:
    path = tmp_path_factory.getbasetemp() / "table.json"
    said = Frequencies(PHONES, counts, 7)
    frequencies_json.save(said, path)
    again = frequencies_json.load(path)
    assert (again.phonemes, list(again.counts.items()), again.utterances) == (PHONES, list(said.counts.items()), 7)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("{", "damaged at line 1"),
        ("{}", "is no table of frequencies"),
        ('{"schema": "lipstitch.Frequencies.1"}', "required field"),
        ('{"schema": "lipstitch.Frequencies.1", "phonemes": ["a"], "counts": {"a": {"a": -1}}}', "expected `int` >= 0"),
        ('{"schema": "lipstitch.Frequencies.1", "phonemes": ["a"], "counts": {"a": {"b": 1}}}', "'b' in \"counts\""),
    ],
)
def test_another_file_is_refused_with_a_reason(tmp_path: Path, text: str, told: str) -> None:
    path = tmp_path / "table.json"
    path.write_text(text, "utf-8")
    with pytest.raises(UserError, match=r"table\.json") as error:
        frequencies_json.load(path)
    assert told in str(error.value)

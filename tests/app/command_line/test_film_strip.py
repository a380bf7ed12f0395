"""`lipstitch film-strip`: one picture for each phone that is heard, and one sentence for what it cannot draw."""

from pathlib import Path

import pytest
from PIL import Image

from app import cli
from app.command_line.film_strip import COLUMNS, moments_of
from core_pipeline.schedule import Schedule


def test_a_sentence_becomes_a_row_of_pictures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "strip.png"
    assert cli.main(["film-strip", "Bob", "--face", "toon", "--size", "64x80", "--out", str(out)]) == 0
    assert "3 pictures in" in capsys.readouterr().out
    with Image.open(out) as strip:
        assert strip.size == (3 * 64, 80 + 30)
        first, second, third = (strip.crop((i * 64, 0, i * 64 + 64, 80)).tobytes() for i in range(3))
    assert first != second != third


def test_silence_has_no_picture() -> None:
    schedule = Schedule(["sil", "f", "ae", "sil"], [0, 0.1, 0.2, 0.4, 0.5])
    assert moments_of(schedule) == [("f", pytest.approx(0.15)), ("ae", pytest.approx(0.3))]
    assert COLUMNS == 12


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["Hello", "--out", "strip.jpg"], "name the picture .png"),
        (["Hello", "--out", "s.png", "--size", "8192x8192"], "choose a smaller --size"),
    ],
)
def test_what_cannot_be_drawn_is_said(arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["film-strip", *arguments]) == 2
    assert told in capsys.readouterr().err

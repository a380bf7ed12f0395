"""Recordings of Live Link Face and ARKit: every trap of theirs is understood or named."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.learning.capture_csv import is_capture, parse
from tests.helpers.captures import ARKIT, live_link
from tests.helpers.refusals import told


def test_a_take_of_live_link_face():
    """Sixty frames a second, 63 columns in PascalCase."""
    data, jaw = live_link(seconds=3, fps=60)
    capture = parse(data, "take.csv")
    assert len(capture.channels) == 61
    assert capture.channels[17] == "JawOpen"
    assert (capture.fps, capture.start) == (60.0, 0.0)
    assert capture.seen.all()
    assert capture.values[:, 17] == pytest.approx(jaw, abs=2e-3)
    assert capture.notes == ()


def test_a_camera_at_30_under_a_frame_field_of_60():
    """Rows are 1/30 s apart, though the frame field counts 60ths: 00, 02, 04, …"""
    data, jaw = live_link(seconds=3, fps=30, base=60)
    capture = parse(data, "take.csv")
    assert capture.fps == 30.0
    assert len(capture.values) == len(jaw)
    assert capture.values[:, 17] == pytest.approx(jaw, abs=2e-3)


def test_a_frame_field_that_contradicts_the_clock():
    """The field counts 0 to 59 while a second has thirty rows: the seconds are believed."""
    data, jaw = live_link(seconds=6, fps=30, base=60, frame=lambda i: i % 60)
    capture = parse(data, "take.csv")
    assert capture.fps == 30.0
    assert "contradict" in capture.notes[0]
    assert len(capture.values) == pytest.approx(len(jaw), abs=1)
    assert capture.values[:170, 17] == pytest.approx(jaw[:170], abs=0.05)


@pytest.mark.parametrize("base", [24, 25, 30])
def test_other_frame_fields(base):
    data, jaw = live_link(seconds=4, fps=base, base=base)
    capture = parse(data, "take.csv")
    assert capture.fps == base
    assert len(capture.values) == len(jaw)


def test_midnight():
    data, jaw = live_link(seconds=4, fps=30, base=60, start=86_398)
    capture = parse(data, "take.csv")
    assert len(capture.values) == len(jaw)


def test_rows_without_a_face_are_not_seen():
    """A lost face leaves two columns, timecode and 0."""
    data, jaw = live_link(seconds=3, fps=60, lost=range(50, 80))
    capture = parse(data, "take.csv")
    assert not capture.seen[51:79].any()
    assert capture.seen[:50].all()
    assert capture.seen[81:].all()
    assert "30 of 181 rows" in capture.notes[0]
    assert capture.values[:50, 17] == pytest.approx(jaw[:50], abs=2e-3)


def test_a_short_loss_is_bridged():
    data, _ = live_link(seconds=2, fps=60, lost=[30])
    assert parse(data, "take.csv").seen.all()


def test_rows_with_nan_are_not_seen():
    data, _ = live_link(seconds=2, fps=60)
    lines = data.decode().split("\n")
    for i in range(41, 61):
        lines[i] = lines[i].replace(",0.", ",NaN,0.", 1).rsplit(",", 1)[0]
    capture = parse("\n".join(lines).encode(), "take.csv")
    assert not capture.seen[41:59].any()
    assert np.isfinite(capture.values).all()


def test_dropped_frames_leave_time_as_it_was():
    data, jaw = live_link(seconds=3, fps=60, dropped=range(60, 90))
    capture = parse(data, "take.csv")
    assert len(capture.values) == len(jaw)
    assert not capture.seen[62:88].any()
    assert capture.values[100:, 17] == pytest.approx(jaw[100:], abs=2e-3)
    assert any("gaps" in note for note in capture.notes)


@pytest.mark.parametrize(
    ("header", "row", "step"),
    [
        ("time,jawOpen,mouthClose", "{t},{v},0", 1 / 60),
        ("Timestamp;jawOpen;mouth_smile_L", "{t};{v};0", 1 / 60),
        ("time\tJawOpen", "{t}\t{v}", 1 / 30),
        ("frame,jawOpen", "{i},{v}", 1 / 60),
        ("timestamp,jawOpen", "{ms},{v}", 1 / 60),
    ],
)
def test_other_programs(header, row, step):
    values = 0.3 + 0.2 * np.sin(np.arange(120) / 9)
    lines = [
        row.format(i=i, t=f"{i * step:.5f}", ms=round(i * step * 1000), v=f"{v:.5f}") for i, v in enumerate(values)
    ]
    capture = parse("\n".join([header, *lines]).encode(), "x.csv")
    assert capture.fps == pytest.approx(1 / step, rel=0.04)
    assert capture.values[:110, 0] == pytest.approx(values[:110], abs=0.03)


def test_decimal_commas_and_utf_16():
    text = "time;jawOpen\r\n0,0;0,25\r\n0,02;0,5\r\n0,04;0,75\r\n"
    for data in (text.encode("utf-16"), text.encode("utf-8-sig")):
        assert parse(data, "x.csv").values[:, 0] == pytest.approx([0.25, 0.5, 0.75])


def test_per_cent():
    capture = parse(b"time,jawOpen\n0,0\n0.1,50\n0.2,100", "x.csv")
    assert capture.values[:, 0] == pytest.approx([0, 0.5, 1])
    assert "divided by 100" in capture.notes[0]


def test_a_single_row():
    assert parse(b"time,jawOpen\n0,0.5\n", "x.csv").values.tolist() == [[0.5]]


@pytest.mark.parametrize(
    ("data", "sentence"),
    [
        (b"", "no row of a recording"),
        (b"time,jawOpen\n", "no row of a recording"),
        (b"jawOpen,mouthClose\n0,1\n", "no column Timecode or time"),
        (b"Timecode,BlendshapeCount\n00:00:00:00.0,0\n", "no column of a blendshape"),
        (b"time,jawOpen\n0,0.1,7\n", "line 2 has 3 columns"),
        (b"time,jawOpen\n0,wide\n", "line 2 holds “wide”"),
        (b"time,jawOpen\nsoon,0.1\n", "line 2 holds “soon”"),
        (b"time,jawOpen\n,0.1\n1,0.2\n", "line 2 has no readable time"),
        (b"Timecode,BlendshapeCount,JawOpen\n00:00:00:00.0,0\n00:00:00:02.0,0\n", "lost in every row"),
        (b"time,jawOpen\n0,0.1\n1e14,0.2\n", "hours"),
        (b"\xff\xfe\x00", "not a table"),
        (b"\x89PNG\r\n\x1a\n\xff", "not a table"),
        (b"time," + b",".join(b"c%d" % i for i in range(3000)) + b"\n0" + b",0" * 3000, "more than a face"),
    ],
)
def test_what_is_no_recording_is_refused_in_a_sentence(data, sentence):
    with pytest.raises(UserError, match=sentence) as refused:
        parse(data, "x.csv")
    assert str(refused.value).startswith("x.csv")
    assert "\n" not in str(refused.value)


@given(st.binary(max_size=300), st.integers(0, 4000))
def test_no_damage_is_a_traceback(noise, at):
    data, _ = live_link(seconds=0.2, fps=60)
    spoilt = data[:at] + noise + data[at + len(noise) :]
    assert (told(lambda: parse(spoilt, "x.csv")) or "x.csv").startswith("x.csv")


def test_captures_and_weights_are_told_apart():
    assert is_capture(["Timecode", "BlendshapeCount", *ARKIT])
    assert is_capture(["time", "jawOpen"])
    assert not is_capture(["time", "open", "W"])
    assert not is_capture([])

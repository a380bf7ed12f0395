"""The loudspeaker as data: what goes into its buffers, which moment is heard; and life without a device."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.audio_output import AudioOutput, Playback, advanced, heard
from core_pipeline.speech.utterance import Audio

RATE = 1000
#: A ramp: every sample says which one it is.
RAMP = Audio(np.arange(RATE, dtype=np.float32) / RATE, RATE)
FADE = 4


def _times(now: float, heard_at: float) -> SimpleNamespace:
    return SimpleNamespace(currentTime=now, outputBufferDacTime=heard_at)


@pytest.fixture
def output(qtbot):
    """Not opened: buffers are asked for by the test."""
    made = AudioOutput()
    made._rate = float(RATE)
    yield made
    made.close()


def test_at_full_speed_the_samples_come_out_as_they_are():
    playback = Playback(RAMP, 0.1, 1.0, 1.0, None)
    out = np.ones(200, np.float32)
    playback.fill(out, RATE)
    np.testing.assert_allclose(out[FADE:], RAMP.samples[100 + FADE : 300], atol=1e-6)
    assert playback.time == pytest.approx(0.3)


def test_the_beginning_fades_in():
    out = np.ones(10, np.float32)
    Playback(Audio(np.ones(100, np.float32), RATE), 0.0, 0.1, 1.0, None).fill(out, RATE)
    np.testing.assert_allclose(out[: FADE + 1], [0, 0.25, 0.5, 0.75, 1])


@pytest.mark.parametrize("speed", [0.25, 0.5, 0.8])
def test_slower_is_the_same_sound_stretched(speed):
    playback = Playback(RAMP, 0.0, 1.0, speed, None)
    out = np.empty(400, np.float32)
    playback.fill(out, RATE)
    np.testing.assert_allclose(out[FADE:], np.arange(FADE, 400) * speed / RATE, atol=1e-6)
    assert playback.time == pytest.approx(0.4 * speed)


@given(st.lists(st.integers(1, 300), min_size=1, max_size=10), st.floats(0.25, 1), st.floats(0, 0.99), st.booleans())
def test_the_size_of_the_buffers_does_not_matter(sizes, speed, start, looping):
    loop = (0.2, 0.7) if looping else None
    whole, pieces = (Playback(RAMP, start, 1.0, speed, loop) for _ in range(2))
    at_once = np.empty(sum(sizes), np.float32)
    whole.fill(at_once, 44100)
    in_parts = [np.empty(size, np.float32) for size in sizes]
    for part in in_parts:
        pieces.fill(part, 44100)
    joined = np.concatenate(in_parts)
    fade = round(0.004 * 44100)
    # rounding may put the end of the sound, or the one jump of the loop, a sample earlier or later
    assert np.count_nonzero(np.abs(joined[fade:] - at_once[fade:]) > 1e-4) <= 1
    apart = abs(pieces.time - whole.time)
    assert min(apart, abs(0.5 - apart) if looping else apart) < 1e-6


def test_after_the_sound_there_is_silence_and_time_stays_at_the_end():
    playback = Playback(RAMP, 0.9, 1.5, 1.0, None)
    out = np.ones(1000, np.float32)
    playback.fill(out, RATE)
    assert (out[100:] == 0).all()
    assert playback.time == 1.5


def test_a_loop_jumps_back_within_a_buffer():
    playback = Playback(RAMP, 0.5, 1.0, 1.0, (0.2, 0.6))
    out = np.empty(250, np.float32)
    playback.fill(out, RATE)
    np.testing.assert_allclose(out[98:103], [0.598, 0.599, 0.2, 0.201, 0.202], atol=1e-5)
    assert playback.time == pytest.approx(0.35)


@given(st.floats(0, 1), st.floats(0, 100), st.floats(0, 0.4), st.floats(0.5, 1))
def test_time_never_leaves_the_utterance_and_a_loop_keeps_its_range(time, by, first, last):
    assert float(advanced(time, by, 1.0, None)) == min(1.0, time + by)
    looped = float(advanced(time, by, 1.0, (first, last)))
    assert 0 <= looped <= 1
    if by > 2:
        assert first - 1e-9 <= looped <= last + 1e-9


@pytest.mark.parametrize("channels", [1, 2])
def test_every_channel_carries_the_sound(output, channels):
    output._playback = Playback(RAMP, 0.2, 1.0, 1.0, None)
    out = np.full((100, channels), 9, np.float32)
    output._fill(out, 100, _times(5.0, 5.05), None)
    for channel in range(channels):
        np.testing.assert_allclose(out[FADE:, channel], RAMP.samples[200 + FADE : 300], atol=1e-6)


def test_nothing_to_play_is_silence(output):
    out = np.full((50, 2), 9, np.float32)
    output._fill(out, 50, _times(5.0, 5.05), None)
    assert (out == 0).all()


def test_what_is_cut_off_fades_out(output):
    output._playback = Playback(Audio(np.ones(1000, np.float32), RATE), 0.0, 1.0, 1.0, None)
    out = np.empty((50, 1), np.float32)
    output._fill(out, 50, _times(5.0, 5.05), None)
    output.stop()
    output._fill(out, 50, _times(5.05, 5.1), None)
    np.testing.assert_allclose(out[: FADE + 1, 0], [1, 2 / 3, 1 / 3, 0, 0], atol=1e-6)
    assert (out[FADE:] == 0).all()


def test_the_position_is_what_is_heard_not_what_was_handed_out(output):
    playback = output._playback = Playback(RAMP, 0.2, 1.0, 0.5, None)
    out = np.empty((100, 1), np.float32)
    output._fill(out, 100, _times(5.0, 5.06), None)
    output._fill(out, 100, _times(5.1, 5.16), None)
    blocks = list(output._blocks)
    assert playback.time == pytest.approx(0.3)
    assert heard(blocks, 5.0) == 0.2  # still on its way
    assert heard(blocks, 5.1) == pytest.approx(0.22)
    assert heard(blocks, 5.2) == pytest.approx(0.27)
    assert heard(blocks, 9.0) == pytest.approx(0.3)  # never beyond what was handed out


def test_a_driver_that_does_not_tell_when_it_sounds_gets_the_usual_latency(output):
    output._playback = Playback(RAMP, 0.0, 1.0, 1.0, None)
    output._fill(np.empty((100, 1), np.float32), 100, _times(5.0, 0.0), None)
    assert heard(list(output._blocks), 5.16) == pytest.approx(0.1)


def test_few_buffers_are_remembered(output):
    output._playback = Playback(RAMP, 0.0, 1.0, 1.0, None)
    for i in range(200):
        output._fill(np.empty((10, 1), np.float32), 10, _times(i, i + 0.05), None)
    assert len(output._blocks) <= 64


def test_opening_tells_whether_sound_can_be_heard(qtbot, capfd):
    """On a machine without card or PortAudio it says why, and nothing is printed."""
    made = AudioOutput()
    assert not made.available
    with qtbot.waitSignal(made.ready, timeout=10_000) as told:
        made.open()
    assert told.args == [made.available]
    assert made.available == (made.reason == "")
    assert capfd.readouterr().err == ""
    made.close()
    assert not made.available


def test_without_a_device_there_is_no_position_and_nothing_fails(qtbot):
    made = AudioOutput()
    with qtbot.waitSignal(made.ready, timeout=10_000):
        made.play(RAMP, 0.25)
        assert made.position() in (0.25, None)  # None once the device is known to be missing
    assert (made.position() is None) == (not made.available)
    made.stop()
    made.close()
    made.play(RAMP, 0.0)
    assert made.position() is None
    made.close()

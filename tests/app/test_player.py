"""Time of the utterance: by the machine's clock in silence, by the sound where there is some."""

import numpy as np
import pytest

from app.audio_output import AudioOutput
from app.player import Player
from core_pipeline.speech.utterance import Audio


class Clock:
    """Seconds, moved by hand."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def player(qtbot, clock):
    """Two seconds of silence, with a clock moved by hand."""
    made = Player(clock=clock)
    made.set_utterance(2.0, None)
    yield made
    made.pause()


def _heard(signal) -> list:
    values: list = []
    signal.connect(lambda *args: values.append(args[0] if args else None))
    return values


def test_time_passes_only_while_it_plays(player, clock):
    clock.now += 5
    player.update()
    assert player.time == 0
    player.play()
    clock.now += 0.5
    player.update()
    assert player.time == pytest.approx(0.5)
    player.pause()
    clock.now += 5
    player.update()
    assert player.time == pytest.approx(0.5)
    player.play()
    clock.now += 0.25
    player.update()
    assert player.time == pytest.approx(0.75)


def test_a_slow_picture_drops_frames_and_never_time(player, clock):
    times = _heard(player.time_changed)
    player.play()
    for step in (0.016, 0.9, 0.016):
        clock.now += step
        player.update()
    assert times == pytest.approx([0.016, 0.916, 0.932])


def test_it_ends_once_exactly_at_the_end(player, clock):
    times, ends, playing = map(_heard, (player.time_changed, player.ended, player.playing_changed))
    player.play()
    clock.now += 7
    player.update()
    player.update()
    assert times[-1] == 2.0
    assert ends == [None]
    assert playing == [True, False]
    assert not player.playing


def test_play_at_the_end_starts_again(player, clock):
    player.seek(2.0)
    player.play()
    assert player.time == 0
    assert player.playing


def test_seeking_is_clamped_and_playing_goes_on_from_there(player, clock):
    player.seek(9)
    assert player.time == 2.0
    player.seek(-1)
    assert player.time == 0
    player.play()
    clock.now += 0.1
    player.seek(1.5)
    clock.now += 0.2
    player.update()
    assert player.time == pytest.approx(1.7)


def test_a_new_speed_counts_from_now_on(player, clock):
    player.play()
    clock.now += 0.4
    player.set_speed(0.5)
    clock.now += 0.4
    player.update()
    assert player.time == pytest.approx(0.6)


@pytest.mark.parametrize(("wished", "got"), [(0.0, 0.25), (0.6, 0.6), (3.0, 1.0)])
def test_the_speed_is_clamped(player, wished, got):
    player.set_speed(wished)
    assert player.speed == got


def test_looping_starts_over_without_end(player, clock):
    ends = _heard(player.ended)
    player.set_looping(True)
    player.play()
    clock.now += 5.5
    player.update()
    assert player.time == pytest.approx(1.5)
    assert player.playing
    assert ends == []


def test_a_loop_range_is_repeated(player, clock):
    player.set_looping(True)
    player.set_loop_range((1.5, 0.5))  # drawn from right to left
    assert player.loop_range == (0.5, 1.5)
    player.play()
    clock.now += 1.75
    player.update()
    assert player.time == pytest.approx(0.75)
    player.set_loop_range((0.6, 0.61))  # too short to hear
    assert player.loop_range is None


def test_a_new_utterance_stops_at_its_start(player, clock):
    player.set_loop_range((0.5, 1.0))
    player.play()
    clock.now += 1
    player.set_utterance(3.0, None)
    assert (player.time, player.duration, player.playing, player.loop_range) == (0, 3.0, False, None)


def test_nothing_cannot_be_played(player):
    playing = _heard(player.playing_changed)
    player.set_utterance(0.0, None)
    player.toggle()
    assert not player.playing
    assert playing == []


def test_toggle(player):
    player.toggle()
    assert player.playing
    player.toggle()
    assert not player.playing


def test_by_its_own_timer_it_plays_to_the_end(qtbot):
    """The real clock: as long as it should take, with about 60 pictures a second."""
    player = Player()
    player.set_utterance(0.4, None)
    times = _heard(player.time_changed)
    with qtbot.waitSignal(player.ended, timeout=5000):
        player.play()
    assert times[-1] == 0.4
    assert (np.diff(times) > 0).all()
    assert len(times) > 8  # 25 expected; the machine may be busy


def test_without_a_device_the_sound_is_silent_and_time_goes_on(qtbot):
    """The device is looked for while it plays: here there is none, and the machine's clock takes over."""
    output = AudioOutput()
    player = Player(output)
    player.set_utterance(0.4, Audio(np.zeros(4000, np.float32), 10000))
    times = _heard(player.time_changed)
    with qtbot.waitSignal(player.ended, timeout=10_000):
        player.play()
    assert times[-1] == 0.4
    assert (np.diff(times) > 0).all()
    output.close()


class Sound(AudioOutput):
    """A device whose position the test sets; everything else is the real output."""

    heard_at: float | None = None

    def position(self) -> float | None:
        return self.heard_at


def test_the_picture_follows_the_sound_not_the_machine(qtbot, clock):
    output = Sound()
    player = Player(output, clock)
    player.set_utterance(2.0, Audio(np.zeros(2000, np.float32), 1000))
    player.play()
    for output.heard_at in (0.0, 0.1, 0.35):
        clock.now += 0.2
        player.update()
        assert player.time == output.heard_at
    output.heard_at = None  # the device is unplugged
    clock.now += 0.2
    player.update()
    assert player.time == pytest.approx(0.55)
    player.pause()
    output.close()


# Scrubbing


@pytest.fixture
def loud(qtbot, clock):
    output = AudioOutput()
    player = Player(output, clock)
    player.set_utterance(2.0, Audio(np.zeros(2000, np.float32), 1000))
    yield player
    player.pause()
    output.close()


def _sounding(player) -> float | None:
    """Where the sound began that is being played, None in silence."""
    playback = player._output._playback
    return None if playback is None else playback.start


def test_a_moment_scrubbed_over_is_heard_shortly(loud, qtbot):
    times = _heard(loud.time_changed)
    loud.scrub(0.5)
    assert times == [0.5]
    assert _sounding(loud) == 0.5
    assert not loud.playing
    qtbot.waitUntil(lambda: _sounding(loud) is None)
    assert loud.time == 0.5


def test_while_the_hand_goes_on_moments_follow_one_another_and_the_last_is_where_it_stopped(loud, qtbot):
    loud.scrub(0.5)
    for time in (0.6, 0.7, 0.9):
        loud.scrub(time)
        assert _sounding(loud) == 0.5  # none is cut off before it can be heard
    qtbot.waitUntil(lambda: _sounding(loud) == 0.9)
    qtbot.waitUntil(lambda: _sounding(loud) is None)


def test_scrubbing_while_it_plays_only_seeks_and_playing_ends_a_moment(loud, qtbot):
    loud.scrub(0.5)
    loud.play()
    loud.scrub(1.0)
    assert loud.playing
    assert _sounding(loud) == 1.0
    qtbot.waitUntil(lambda: not loud._grain.isActive())
    assert _sounding(loud) == 1.0


def test_another_utterance_ends_the_moment_at_once(loud):
    loud.scrub(0.5)
    loud.set_utterance(1.0, None)
    assert _sounding(loud) is None
    assert not loud._grain.isActive()
    loud.scrub(0.2)  # there is no sound to hear
    assert _sounding(loud) is None

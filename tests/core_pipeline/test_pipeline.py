"""The five stages together: the laws of the whole, the empty cases, and what is reported."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.phonemes import COMMON
from core_pipeline.pipeline import STAGES, Settings, Stages, run
from core_pipeline.schedule import Schedule
from core_pipeline.tracks import COLLINEAR
from tests.helpers.strategies import PHONES, POSES, curve_sets, curves, knots, schedules, settings

HILL = Curve.of([(0, 0), (0.5, 1), (1, 0)])


def hills(phonemes=("x", "y"), poses=("a",)) -> CurveSet:
    """A set whose every bigram lifts every pose to 1."""
    bigram = Bigram(dict.fromkeys(poses, HILL))
    pairs = {(p, q): bigram for p in phonemes for q in phonemes}
    return CurveSet(phonemes=phonemes, poses=poses, bigrams=pairs, phoneme_map={})


def same(one: Stages, two: Stages, poses, colours=STAGES, moved=lambda t: t, tolerance=1e-6) -> None:
    """Asserts that both hold the same functions, the second one's times being `moved`."""
    for colour in colours:
        for pose in poses:
            a, b = one.stage(colour)[pose], two.stage(colour)[pose]
            t = np.concatenate((a.t, (a.t[1:] + a.t[:-1]) / 2, np.linspace(a.t[0], a.t[-1], 50)))
            assert b.at(moved(t)) == pytest.approx(a.at(t), abs=tolerance)


# --- by hand -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("speed", "top"), [(15.0, 1.0), (6.0, 0.6)])
def test_one_bigram_one_pose(speed, top):
    stages = run(Schedule(["x", "y"], [0, 0.1, 0.2]), hills(), Settings(speed_limit=speed))
    assert knots(stages.blue["a"]) == knots(stages.cyan["a"]) == [(0, 0), (0.1, 1), (0.2, 0)]
    assert knots(stages.magenta["a"]) == [(0, 0), (0.1, top), (0.2, 0)]
    (red,) = stages.red
    assert (red.index, red.bigram, red.pose) == (0, ("x", "y"), "a")


def test_two_near_peaks_through_the_whole_pipeline():
    def peak(height):
        return Bigram({"a": Curve.of([(0.3, 0), (0.5, height), (0.7, 0)])})

    pairs = {("x", "y"): peak(0.8), ("y", "x"): peak(0.6)}
    curve_set = CurveSet(phonemes=("x", "y"), poses=("a",), bigrams=pairs)
    schedule = Schedule(["x", "y", "x"], [-0.02, 0.1, 0.22, 0.34])
    filled = run(schedule, curve_set, Settings(window=0.18)).yellow["a"]
    assert knots(filled) == [(0.052, 0), (0.1, 0.8), (0.22, 0.6), (0.268, 0)]
    left = run(schedule, curve_set, Settings(window=0.10))
    assert knots(left.yellow["a"]) == knots(left.blue["a"])
    assert left.yellow["a"].at(np.array([0.16])) == pytest.approx(0)


# --- nothing, and nearly nothing ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phones", "times"),
    [
        ([], []),
        ([], [3.0]),
        (["x"], [0, 1]),
        (["sil"], [0, 1]),
        (["?"], [0, 1]),
        (["sil", "sil"], [0, 1, 2]),
        (["sil", "sil", "sil", "sil"], [0, 0.5, 1, 1.5, 2]),
        (["?", "!"], [0, 1, 2]),
    ],
)
@pytest.mark.parametrize("curve_set", [hills(), hills(phonemes=("x",)), hills(poses=()), CurveSet()])
def test_an_utterance_in_which_nothing_moves(phones, times, curve_set):
    schedule = Schedule(phones, times)
    stages = run(schedule, curve_set)
    assert stages.red == ()
    for colour in STAGES:
        assert tuple(stages.stage(colour)) == curve_set.poses == stages.poses
        for track in stages.stage(colour).values():
            assert track.v.tolist() == [0.0] * track.t.size
            assert (track.t[0], track.t[-1]) == (schedule.start, schedule.end)
    assert all(stages.winner(pose, 0.5) is None for pose in curve_set.poses)


def test_a_set_with_one_phoneme():
    stages = run(Schedule(["x"] * 4, [0, 0.1, 0.2, 0.3, 0.4]), hills(phonemes=("x",)), Settings(window=0))
    assert knots(stages.blue["a"]) == [(0, 0), (0.1, 1), (0.15, 0.5), (0.2, 1), (0.25, 0.5), (0.3, 1), (0.4, 0)]
    assert stages.missing == {}


def test_a_set_without_poses_and_without_bigrams():
    schedule = Schedule(["x", "y", "x"], range(4))
    assert run(schedule, hills(poses=())).magenta.x.size == 0
    empty = replace(hills(), bigrams={})
    stages = run(schedule, empty)
    assert stages.missing == {("x", "y"): 1, ("y", "x"): 1}
    assert knots(stages.magenta["a"]) == [(0, 0), (3, 0)]


# --- what is reported --------------------------------------------------------------------------------------------


def test_missing_bigrams_are_counted_and_silence_is_not_one():
    curve_set = hills().with_bigram(("x", "y"), None)
    stages = run(Schedule(["sil", "x", "y", "x", "y", "y", "sil"], range(8)), curve_set)
    assert stages.missing == {("x", "y"): 2}
    assert stages.unknown == ()


def test_unknown_phones_are_named_once():
    stages = run(Schedule(["q", "x", "q", "z", "sil"], range(6)), hills())
    assert stages.unknown == ("q", "z")
    assert stages.red == ()


def test_the_phones_of_a_language_are_mapped_first():
    curve_set = replace(hills(), phoneme_map={"iy": "x", "ey": "y"})
    mapped = run(Schedule(["iy", "ey"], [0, 0.1, 0.2]), curve_set)
    assert mapped.schedule.phones == ("x", "y")
    assert knots(mapped.magenta["a"]) == knots(run(Schedule(["x", "y"], [0, 0.1, 0.2]), curve_set).magenta["a"])


def test_the_usual_set_reports_what_it_lacks():
    stages = run(Schedule(["hh", "ah", "l", "ow"], range(5)), CurveSet())
    assert set(stages.schedule.phones) <= set(COMMON)
    assert stages.missing == {("h", "ah"): 1, ("ah", "l"): 1, ("l", "ow"): 1}


def test_settings_come_from_the_caller_then_the_set_then_the_paper():
    schedule = Schedule(["x", "y"], [0, 0.1, 0.2])
    slow, slower = Settings(speed_limit=6), Settings(speed_limit=2)
    assert run(schedule, hills()).magenta.v.max() == 1
    assert run(schedule, hills().with_settings(slow)).magenta.v.max() == pytest.approx(0.6)
    assert run(schedule, hills().with_settings(slow), slower).magenta.v.max() == pytest.approx(0.2)


# --- laws of the whole -------------------------------------------------------------------------------------------


@given(schedules(nasty=True), curve_sets(nasty=True), settings())
def test_every_track_is_a_function_within_zero_and_one(schedule, curve_set, settings):
    stages = run(schedule, curve_set, settings)
    for colour in STAGES:
        for track in stages.stage(colour).values():
            assert (np.diff(track.t) > 0).all()
            assert np.isfinite(track.v).all()
            assert 0 <= track.v.min() <= track.v.max() <= 1
            assert track.v[0] == track.v[-1] == 0
            assert schedule.start - 1e-8 <= track.t[0] <= track.t[-1] <= schedule.end + 1e-8
            assert not ((track.v > 0) & (track.v < 1e-9) & (colour != "magenta")).any(), "dust is 0"


@given(schedules(), curve_sets(), settings())
def test_no_track_has_a_knot_too_many(schedule, curve_set, settings):
    stages = run(schedule, curve_set, settings)
    for colour in STAGES:
        for track in stages.stage(colour).values():
            if not track.v.any():
                assert track.t.size <= 2
                continue
            assert track.v[1] > 0
            assert track.v[-2] > 0
            dt, dv = np.diff(track.t), np.diff(track.v)
            off_the_line = np.abs(dv[:-1] * dt[1:] - dv[1:] * dt[:-1]) / (dt[:-1] + dt[1:])
            assert (off_the_line[track.v[1:-1] > 0] > COLLINEAR * 0.9).all()


@given(schedules(), curve_sets(), settings(), st.sampled_from([0.125, -3.0, 1000.0]))
def test_shifting_the_schedule_shifts_the_result(schedule, curve_set, settings, seconds):
    one = run(schedule, curve_set, settings)
    two = run(Schedule(schedule.phones, schedule.times + seconds), curve_set, settings)
    same(one, two, POSES, moved=lambda t: t + seconds)


@given(schedules(), curve_sets(at_rest=True), settings(), st.sampled_from([0.5, 0.25, 2.0]))
def test_scaling_time_scales_the_result(schedule, curve_set, settings, factor):
    # the ramps of 1 ms do not scale: so all curves rest at both ends, and nothing is constrained
    window, speed = min(settings.window, 0.5), max(settings.speed_limit, 0.1)
    settings = replace(settings, constraints=(), windows={}, window=window, speed_limit=speed)
    about = schedule.start + (schedule.times - schedule.start) * factor
    scaled = replace(settings, window=window * factor, speed_limit=speed / factor)
    one, two = run(schedule, curve_set, settings), run(Schedule(schedule.phones, about), curve_set, scaled)
    same(one, two, POSES, moved=lambda t: schedule.start + (t - schedule.start) * factor)


@given(schedules(), curve_sets(), settings(), curves(), st.sampled_from(POSES))
def test_poses_do_not_influence_each_other_before_cyan(schedule, curve_set, settings, curve, pose):
    edited = curve_set
    for pair, bigram in curve_set.bigrams.items():
        edited = edited.with_bigram(pair, bigram.with_curve(pose, curve))
    others = [p for p in POSES if p != pose]
    one, two = run(schedule, curve_set, settings), run(schedule, edited, settings)
    same(one, two, others, colours=("blue", "yellow"))
    free = replace(settings, constraints=())
    same(run(schedule, curve_set, free), run(schedule, edited, free), others)


def reach(stages: Stages, spans, settings: Settings) -> list[tuple[float, float]]:
    """The spans widened by every window and plateau that touches them.

    A fill between two peaks may decide about the next one, and whether a plateau is a peak is decided at both its ends.
    """
    widened = []
    for span in spans:
        begin, end = span
        touched = True
        while touched:
            touched = False
            for pose in POSES:
                window, track = settings.window_of(pose) + 1e-6, stages.blue[pose]
                near = (track.t >= begin - window) & (track.t <= end + window)
                flat = (np.abs(np.diff(track.v)) < 1e-9) & (track.v[1:] > 0)
                flat &= (track.t[1:] >= begin - window) & (track.t[:-1] <= end + window)
                near[1:] |= flat
                near[:-1] |= flat
                found = track.t[near]
                if found.size and (found[0] < begin or found[-1] > end):
                    begin, end, touched = min(begin, found[0]), max(end, found[-1]), True
        widened.append((begin, end))
    return widened


@given(schedules(most=12), curve_sets(), settings(), st.sampled_from(PHONES), st.sampled_from(PHONES), curves())
def test_an_edit_stays_within_its_spans_and_the_windows_that_touch_them(
    schedule, curve_set, settings, first, second, curve
):
    settings = replace(settings, window=min(settings.window, 0.1), windows={}, speed_limit=50.0)
    pair = (first, second)
    edited = curve_set.with_bigram(pair, curve_set.bigrams.get(pair, Bigram()).with_curve("a", curve))
    one, two = run(schedule, curve_set, settings), run(schedule, edited, settings)
    spans = [(schedule.times[i], schedule.times[i + 2]) for i, p in enumerate(schedule.pairs()) if p == pair]
    margin = 1 / settings.speed_limit + 0.003  # a cone reaches that far, and a constraint's ramps
    inside = [
        (min(b, d) - margin, max(e, f) + margin)
        for (b, e), (d, f) in zip(reach(one, spans, settings), reach(two, spans, settings), strict=True)
    ]
    t = np.linspace(schedule.start, schedule.end, 400)
    outside = t[~np.any([(t >= b) & (t <= e) for b, e in inside] or [np.zeros(t.size, bool)], axis=0)]
    for colour in STAGES:
        for pose in POSES:
            a, b = one.stage(colour)[pose].at(outside), two.stage(colour)[pose].at(outside)
            assert b == pytest.approx(a, abs=1e-7)


def test_thousands_of_phones_at_once_equal_the_same_phones_in_pieces():
    rng = np.random.default_rng(7)
    heights = rng.random((4, 3)).round(2)
    pairs = [(p, q) for p in PHONES for q in PHONES]
    bigrams = {
        pair: Bigram({"abc"[k]: Curve.of([(0, 0), (0.3, heights[row, k]), (1, 0)]) for k in range(3)})
        for row, pair in enumerate(pairs)
    }
    curve_set = CurveSet(phonemes=PHONES, poses=POSES, bigrams=bigrams, phoneme_map={})
    piece = [*rng.choice(PHONES, 49), "sil"]
    lengths = rng.uniform(0.03, 0.2, 50)
    lengths[-1] = 2.0  # a silence longer than any window parts the pieces
    long = run(Schedule(piece * 80, np.concatenate(([0], np.tile(lengths, 80).cumsum()))), curve_set)
    short = run(Schedule(piece, np.concatenate(([0], lengths.cumsum()))), curve_set)
    at = np.linspace(0, lengths.sum(), 500)
    for pose in POSES:
        for k in (0, 40, 79):
            assert long.magenta[pose].at(at + k * lengths.sum()) == pytest.approx(short.magenta[pose].at(at), abs=1e-6)

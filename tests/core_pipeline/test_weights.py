"""Weights: tracks sampled at any times; baked to frames, every peak is kept."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from core_pipeline.pipeline import run
from core_pipeline.settings import SPLINES
from core_pipeline.spline import interpolate
from core_pipeline.weights import bake, peaks, sample
from tests.helpers.strategies import curve_sets, schedules, settings, tracks_of

CLOSURE = [(0.0, 0.0), (0.11, 0.0), (0.125, 1.0), (0.14, 0.0)]
RATES = st.sampled_from([24.0, 25.0, 29.97, 30.0, 60.0, 100.0])


@given(schedules(), curve_sets(), settings())
def test_sampled_pchip_equals_scipys_for_each_track(schedule, curve_set, settings):
    tracks = run(schedule, curve_set, settings).magenta
    times = np.linspace(schedule.start - 0.6, schedule.end + 0.6, 173)
    made = sample(tracks, "pchip", times)
    assert made.shape == (173, 3)
    for p, pose in enumerate(tracks.poses):
        t, v = tracks[pose].t, tracks[pose].v
        own = np.zeros(times.size)
        if t.size > 1:
            inside = (times >= t[0]) & (times <= t[-1])
            own[inside] = PchipInterpolator(t, v)(times[inside])
        assert made[:, p] == pytest.approx(own, abs=1e-7)


@given(schedules(nasty=True), curve_sets(nasty=True), settings(), st.sampled_from(SPLINES), RATES)
def test_frames_lie_within_zero_and_one_and_span_the_utterance(schedule, curve_set, settings, spline, fps):
    weights = bake(run(schedule, curve_set, settings).magenta, spline, fps)
    frames = weights.frames
    assert frames.dtype == np.float32
    assert np.isfinite(frames).all()
    assert frames.min(initial=0) >= 0
    assert frames.max(initial=0) <= 1
    assert (weights.poses, weights.fps, weights.start) == (curve_set.poses, fps, schedule.start)
    assert frames.shape[1] == len(curve_set.poses)
    last = schedule.start + (len(frames) - 1) / fps
    assert schedule.end - 1e-5 <= last < schedule.end + 1 / fps


@given(schedules(), curve_sets(), settings(), st.sampled_from(SPLINES), RATES)
def test_snapping_keeps_every_peak_and_lowers_nothing(schedule, curve_set, settings, spline, fps):
    tracks = run(schedule, curve_set, settings).magenta
    plain, snapped = bake(tracks, spline, fps, snap=False).frames, bake(tracks, spline, fps).frames
    assert (snapped >= plain).all()
    times = schedule.start + np.arange(len(plain)) / fps
    assert plain == pytest.approx(sample(tracks, spline, times), abs=1e-6)
    for p, pose in enumerate(tracks.poses):
        track = tracks[pose]
        for k in peaks(track.v):
            nearest = np.abs(times - track.t[k]).argmin()
            height = interpolate(track.t, track.v, spline, track.t[k])
            around = snapped[max(nearest - 1, 0) : nearest + 2, p]  # two frames may be equally near
            assert around.max() >= height - 1e-6
            if spline == "pchip":
                assert around.max() >= track.v[k] - 1e-6


def test_a_closure_between_two_frames_is_not_lost():
    tracks = tracks_of({"PBM": CLOSURE})
    assert bake(tracks, "pchip", 30, snap=False).frames.max() < 0.7
    frames = bake(tracks, "pchip", 30).frames
    assert frames.max() == 1
    assert frames.argmax() == 4, "4/30 = .133 is nearer to .125 than 3/30 = .1"


def test_count_and_times_of_frames():
    assert len(bake(tracks_of({"a": CLOSURE}, end=1.0), "pchip", 30).frames) == 31
    assert len(bake(tracks_of({"a": CLOSURE}, end=1.01), "pchip", 30).frames) == 32


def test_frame_i_is_at_start_plus_i_over_fps():
    here, later = tracks_of({"a": CLOSURE}), tracks_of({"a": [(t + 7, v) for t, v in CLOSURE]}, start=7.0, end=8.0)
    frames = bake(here, "linear", 200, snap=False).frames
    assert frames[23:28, 0] == pytest.approx([1 / 3, 2 / 3, 1, 2 / 3, 1 / 3], abs=1e-6)
    assert bake(later, "linear", 200, snap=False).frames == pytest.approx(frames, abs=1e-6)


@pytest.mark.parametrize("fps", [0.0, 0.5, -30.0, 1001.0, float("nan"), float("inf")])
def test_odd_frame_rates_are_refused(fps):
    with pytest.raises(ValueError, match="choose 1 to 1000"):
        bake(tracks_of({"a": CLOSURE}), "pchip", fps)


@pytest.mark.parametrize("spline", SPLINES)
def test_nothing_to_sample(spline):
    assert sample(tracks_of({}), spline, [0.0, 1.0]).shape == (2, 0)
    assert sample(tracks_of({"a": []}), spline, [-1.0, 0.5]).tolist() == [[0], [0]]
    assert sample(tracks_of({"a": [], "b": CLOSURE}), spline, 0.5).tolist() == [[0, 0]]
    assert bake(tracks_of({}, end=0.0), spline, 30).frames.shape == (1, 0)


def test_peaks_are_knots_above_zero_without_a_higher_neighbour():
    assert peaks(np.array([0, 1, 0, 0.5, 0.5, 0, 0.2, 0.3, 0])).tolist() == [1, 3, 4, 7]
    assert peaks(np.array([0, 0])).tolist() == []

"""What stages did to a pose, as lines; and how rows, labels and readings come from it."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.pipeline import STAGES, run
from core_pipeline.poses import FACEFX
from core_pipeline.schedule import Schedule
from tests.helpers.stages import curve_set, schedule, sentence
from widgets.overlay.stage_lines import Line, change, pose_lines
from widgets.overlay.stage_picking import bigram_at, phone_at, read
from widgets.overlay.stage_rows import ACTIVE, MODES, lay_out


def test_red_halves_hold_exactly_the_warped_curves():
    stages = sentence()
    lines = pose_lines(stages)
    for pose in FACEFX:
        for parity in (0, 1):
            curves = [c for c in stages.red if c.pose == pose and c.index % 2 == parity]
            t = np.concatenate([c.t for c in curves]) if curves else np.zeros(0)
            v = np.concatenate([c.v for c in curves]) if curves else np.zeros(0)
            assert np.allclose(lines[pose].red[parity].t, t)
            assert np.allclose(lines[pose].red[parity].v, v)


def test_every_stage_is_the_pipelines_track():
    stages = sentence()
    lines = pose_lines(stages)
    grid = np.linspace(0, stages.schedule.end, 301)
    for pose in FACEFX:
        for colour in STAGES:
            assert [lines[pose].stage[colour].at(t) for t in grid] == pytest.approx(stages.stage(colour)[pose].at(grid))


def test_an_edit_changes_only_the_lines_of_its_pose():
    curves = curve_set()
    edited = curves.with_bigram(
        ("ah", "f"), curves.bigrams["ah", "f"].with_curve("tBack", Curve.of([(0, 0), (0.5, 0.4), (1, 0)]))
    )
    before, after = pose_lines(sentence(curves=curves)), pose_lines(sentence(curves=edited))
    assert [pose for pose in FACEFX if not before[pose].same_as(after[pose])] == ["tBack"]


def test_change_is_exact_between_knots():
    before = Line(np.array([0.0, 1.0, 2.0, 3.0]), np.array([0.0, 1.0, 0.2, 1.0]))
    after = Line(np.array([0.0, 1.0, 3.0]), np.array([0.0, 1.0, 1.0]))
    changed = change(before, after)
    assert changed.t.tolist() == [0, 1, 2, 3]
    assert changed.differs.tolist() == [False, True, True]
    assert changed
    assert not change(before, before)


def test_thinning_keeps_every_peak_and_the_pixel_limit():
    t = np.linspace(0, 10, 20_000)
    v = np.abs(np.sin(t * 300))
    v[7777] = 1.0
    thin = Line(t, v).thinned(0.0, 0.01)
    assert thin.t.size <= 2 * 1001
    assert thin.v.max() == 1.0
    assert abs(thin.t[int(thin.v.argmax())] - t[7777]) <= 0.01
    short = Line(t[:50], v[:50])
    assert short.thinned(0.0, 1e-9) is short


def test_seen_keeps_the_knots_around_the_view():
    line = Line(np.arange(10.0), np.arange(10.0))
    assert line.seen(3.5, 5.5).t.tolist() == [3, 4, 5, 6]
    assert line.seen(-1, 20) is line


# Rows

peaks = st.fixed_dictionaries({pose: st.one_of(st.just(0.0), st.floats(0.01, 1)) for pose in FACEFX})


@given(peaks, st.sampled_from(FACEFX), st.sampled_from(MODES), st.integers(20, 900))
def test_rows_fill_the_height_in_order_and_always_show_the_active_pose(peaks, active, mode, height):
    rows = lay_out(FACEFX, active, peaks, mode, height)
    assert rows[0].top == 0
    assert rows[-1].bottom == height
    assert all(a.bottom == b.top for a, b in pairwise(rows))
    assert [row.index for row in rows] == sorted(row.index for row in rows)
    assert [row.pose for row in rows if row.active] == [active]
    if height >= ACTIVE:
        assert min(row.height for row in rows) >= 13
    hidden = [pose for pose in FACEFX if pose not in {row.pose for row in rows}]
    if mode != "one":
        assert all(peaks[gone] <= peaks[row.pose] for gone in hidden for row in rows if not row.active)


def test_focus_gives_the_active_pose_the_most_room_and_rest_the_least():
    peaks = dict.fromkeys(FACEFX, 0.5) | {"W": 0.0}
    rows = {row.pose: row for row in lay_out(FACEFX, "FV", peaks, "focus", 242)}
    assert len(rows) == 9
    assert rows["FV"].height > 3 * rows["open"].height > 3 * rows["W"].height
    assert rows["W"].idle
    assert len({row.height for row in lay_out(FACEFX, "FV", peaks, "all", 270)}) == 1
    assert [row.pose for row in lay_out(FACEFX, "FV", peaks, "one", 242)] == ["FV"]
    assert lay_out((), "", {}, "focus", 242) == ()


# Back to the bigram


def test_the_bigram_that_won_the_maximum_is_found():
    stages = sentence("ah f ah bmp")
    for pose in ("open", "FV", "PBM"):
        for t in np.linspace(0.0, 0.4, 81):
            heights = {c.index: float(np.interp(t, c.t, c.v, 0, 0)) for c in stages.red if c.pose == pose}
            best = max(heights.values(), default=0.0)
            if best > 1e-3:
                assert heights[bigram_at(stages, pose, float(t))] == pytest.approx(best)


def test_in_a_filled_valley_without_any_curve_the_higher_neighbour_is_found():
    hump = {"W": Curve.of([(0, 0), (0.2, 0.4), (0.4, 0)])}
    higher = {"W": Curve.of([(0, 0), (0.2, 0.9), (0.4, 0)])}
    curves = CurveSet(bigrams={("ah", "f"): Bigram(hump), ("f", "d"): Bigram(higher)})
    stages = run(Schedule(["ah", "f", "d"], [0, 0.1, 0.2, 0.3]), curves)
    assert stages.blue["W"].at(np.array(0.09)) == 0
    assert stages.yellow["W"].at(np.array(0.09)) > 0.3
    assert bigram_at(stages, "W", 0.09) == 1


def test_at_rest_the_nearest_phone_boundary_decides():
    stages = run(schedule("ah f d l"), CurveSet())
    assert [bigram_at(stages, "open", t) for t in (0.02, 0.14, 0.16, 0.39)] == [0, 0, 1, 2]
    assert bigram_at(stages, "open", 0.5) is None
    assert bigram_at(run(schedule("ah"), CurveSet()), "open", 0.05) is None


def test_a_reading_tells_only_the_steps_that_changed_something():
    stages = sentence("ah f ah bmp")
    reading = read(stages, "open", 0.26)
    assert reading.pair == (stages.schedule.phones[reading.index], stages.schedule.phones[reading.index + 1])
    names = [name for name, _ in reading.steps()]
    assert names[0] == "blue"
    values = dict(zip(STAGES, reading.values, strict=True))
    assert all(values[name] == value for name, value in reading.steps())
    assert reading.steps()[-1][1] == pytest.approx(values["magenta"], abs=0.005)


def test_the_phone_at_a_time():
    stages = sentence("ah f ah bmp")
    assert [phone_at(stages, t) for t in (-1, 0, 0.15, 0.39, 9)] == [0, 0, 1, 3, 3]

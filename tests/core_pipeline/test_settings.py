"""Settings: the two presets as the design lists them, and every wrong value refused with a cure."""

import math

import pytest

from core_pipeline.errors import UserError
from core_pipeline.settings import PRESETS, SPLINES, Constraint, Settings


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ({"window": -0.01}, "smoothing window is -0.01 s"),
        ({"window": 1.01}, "from 0 to 1"),
        ({"window": math.nan}, "smoothing window"),
        ({"windows": {"PBM": 2.0}}, "window of PBM"),
        ({"speed_limit": 0.0}, "speed limit is 0/s"),
        ({"speed_limit": -1.0}, "speed limit"),
        ({"speed_limit": math.inf}, "speed limit"),
        ({"speed_limit": math.nan}, "speed limit"),
        ({"spline": "bezier"}, "no spline 'bezier'"),
        ({"priorities": ("a", "b", "a")}, "twice"),
        ({"constraints": (Constraint("a", "b", 2.1),)}, "constraint of a and b is 2.1"),
        ({"constraints": (Constraint("a", "b", math.nan),)}, "constraint of a and b"),
        ({"constraints": (Constraint("a", "a", 1.0),)}, "against itself"),
    ],
)
def test_wrong_values_are_refused(wrong, why):
    with pytest.raises(UserError, match=why):
        Settings(**wrong)


def test_the_ends_of_every_range_are_allowed():
    for window in (0.0, 1.0):
        for speed in (0.01, 1e4):
            for limit in (0.0, 2.0):
                made = Settings(window=window, speed_limit=speed, constraints=(Constraint("a", "b", limit),))
                assert made.window_of("a") == window


def limits(settings: Settings) -> dict[frozenset[str], float]:
    return {frozenset((c.a, c.b)): c.limit for c in settings.constraints}


def test_paper():
    paper = Settings.paper()
    assert limits(paper) == {frozenset(("open", p)): 0.5 for p in ("FV", "PBM", "ShCh")}
    assert paper.priorities == ("open", "W", "wide", "ShCh", "FV", "PBM")
    assert paper.speed_limit == 15
    assert (paper.window_of("open"), paper.window_of("PBM"), paper.window_of("FV")) == (0.18, 0.10, 0.10)
    assert paper.spline == "pchip"


def test_smartbody():
    smartbody = Settings.smartbody()
    pairs = "open PBM, wide PBM, ShCh PBM, open FV, wide FV, open W, open wide"
    halves = {frozenset(pair.split()): 0.5 for pair in pairs.split(", ")}
    assert limits(smartbody) == {**halves, frozenset(("open", "ShCh")): 0.7}
    assert smartbody.speed_limit == 6


@pytest.mark.parametrize("name", ["paper", "smartbody"])
@pytest.mark.parametrize("spline", SPLINES)
def test_a_preset_is_known_again_whatever_its_spline(name, spline):
    assert PRESETS[name].with_spline(spline).preset_name() == name
    assert Settings(window=0.5, spline=spline).preset_name() == ""


def test_who_gives_way_is_told_by_priority_not_by_the_order_of_the_pair():
    both = (Constraint("a", "b", 0.5), Constraint("b", "a", 0.3), Constraint("b", "c", 2.0), Constraint("a", "d", 0.1))
    assert Settings(constraints=both, priorities=("a", "b", "c")).clashes == {"a": (("b", 0.3),)}
    assert Settings(constraints=both, priorities=("c", "b", "a")).clashes == {"b": (("a", 0.3),)}
    assert Settings(constraints=both).clashes == {}

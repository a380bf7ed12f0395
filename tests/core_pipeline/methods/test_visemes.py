"""Viseme interpolation and comparing two methods."""

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.methods import visemes
from core_pipeline.methods.bigram import BigramMethod
from core_pipeline.methods.compare import Difference, differences, held_out_error
from core_pipeline.schedule import Schedule
from core_pipeline.weights import Weights
from tests.helpers.corpora import baked, corpus, english, schedules


def test_shapes_stand_in_the_middle_and_lines_between():
    model = visemes.Visemes(("open",), ("aa", "b"), {}, np.array([[0.8], [0.0], [0.3]]))
    weights = model.synthesize(Schedule(["aa", "b"], [0, 0.2, 0.4]), ("open",), 20)
    assert weights.frames[:, 0] == pytest.approx([0.8, 0.8, 0.8, 0.6, 0.4, 0.2, 0, 0, 0], abs=1e-6)


def test_fit_takes_the_middle_of_each_phone():
    model = visemes.fit(corpus(baked()[:20]))
    closed = model.shapes[model.phones.index("bmp"), model.poses.index("PBM")]
    assert closed > 0.7
    assert held_out_error(model, baked()[40:]) < 0.12


def test_the_bigram_method_is_the_pipeline_and_reproduces_its_own_clips():
    assert held_out_error(BigramMethod(english()), baked()[:3]) < 1e-6


def test_differences_per_pose():
    a = Weights(("open", "W"), 60.0, 0.0, np.array([[0, 0], [0.5, 0]], np.float32))
    b = Weights(("open", "W"), 60.0, 0.0, np.array([[0, 0], [0.9, 0]], np.float32))
    found = differences(a, b)
    assert found[0] == Difference("open", pytest.approx(0.4 / 2**0.5), pytest.approx(0.4))
    assert found[1] == Difference("W", 0.0, 0.0)


def test_other_lengths_are_not_compared():
    a = Weights(("open",), 60.0, 0.0, np.zeros((2, 1), np.float32))
    with pytest.raises(ValueError, match="lengths"):
        differences(a, Weights(("open",), 60.0, 0.0, np.zeros((3, 1), np.float32)))


def test_every_method_lays_its_frames_as_the_baker_does():
    model = visemes.fit(corpus(baked()[:2]))
    for schedule in schedules()[:5]:
        ours = BigramMethod(english()).synthesize(schedule, model.poses, 30)
        theirs = model.synthesize(schedule, model.poses, 30)
        assert (ours.frames.shape, ours.start, ours.fps) == (theirs.frames.shape, theirs.start, theirs.fps)


def test_the_bigram_method_refuses_poses_by_name():
    with pytest.raises(UserError, match="does not know jaw"):
        BigramMethod(english()).synthesize(schedules()[0], ("jaw",), 30)

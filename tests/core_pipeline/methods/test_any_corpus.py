"""Whatever a corpus holds, learning ends in a model that works or in a sentence."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.files import model_npz
from core_pipeline.learning.bigram_curves import learn_bigrams
from core_pipeline.learning.corpus import Clip, Corpus
from core_pipeline.methods import animpho_fit, dam_fit, visemes
from core_pipeline.schedule import Schedule
from core_pipeline.weights import Weights

ASKED = Schedule(["aa", "zz", "sil"], [0, 0.1, 0.2, 0.3])


@st.composite
def corpora(draw: st.DrawFn) -> Corpus:
    """One or two clips of no phones to five, some of 20 µs, some unknown; few frames, lost ones, another clock."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    phones = rng.choice(["aa", "b", "sil", "??", "iy"], rng.integers(0, 6)).tolist()
    times = np.concatenate(([0], rng.choice([2e-5, 0.01, 0.1, 0.3], len(phones)).cumsum())) if phones else []
    frames = rng.choice([0, 0.5, 1], (int(rng.integers(1, 60)), 2)).astype(np.float32)
    start, fps = float(rng.choice([0, -0.1, 0.1, 5])), float(rng.choice([1, 10, 60, 1000]))
    known = rng.random(len(frames)) < rng.choice([0, 0.5, 1])
    clip = Clip("x", Schedule(phones, times), Weights(("a", "b"), fps, start, frames), known)
    return Corpus.of([clip] * int(rng.integers(1, 3)))


@pytest.mark.parametrize("fit", [visemes.fit, dam_fit.fit, dam_fit.fit_cohen_massaro, animpho_fit.fit])
@settings(max_examples=25)
@given(corpora())
def test_a_model_or_a_sentence(fit, corpus):
    try:
        model = fit(corpus)
    except UserError:
        return
    weights = model.synthesize(ASKED, ("b", "a"), 30)
    assert weights.frames.shape == (10, 2)
    assert np.isfinite(weights.frames).all()
    data = model_npz.dumps(model)
    assert model_npz.dumps(model_npz.parse(data, "m").model) == data


@settings(max_examples=25)
@given(corpora())
def test_curves_or_a_sentence(corpus):
    try:
        learned = learn_bigrams(corpus)
    except UserError:
        return
    assert learned.found
    assert not set(learned.found) & set(learned.offered)

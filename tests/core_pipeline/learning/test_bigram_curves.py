"""Curves from animation: what was drawn is found again, and what was never seen is only offered."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.learning.bigram_curves import LEARNED, Learned, LearnOptions, learn_bigrams
from core_pipeline.learning.corpus import Clip, Corpus
from core_pipeline.learning.occurrences import NODES, PLACES, occurrences_of
from core_pipeline.methods.bigram import BigramMethod
from core_pipeline.methods.compare import held_out_error
from core_pipeline.methods.method import Cancelled
from core_pipeline.schedule import Schedule
from core_pipeline.settings import Settings
from core_pipeline.weights import Weights
from tests.helpers.corpora import baked, corpus, english


@cache
def learned() -> Learned:
    return learn_bigrams(corpus(baked()[:40]))


def full_set(found: Learned) -> CurveSet:
    """With the guesses for what was not heard."""
    own = found.curve_set("Learned", english())
    return replace(own, bigrams={**found.offered, **own.bigrams})


def lone_bigram(curve: Curve, repeats: int = 3, gap: float = 0.5) -> Corpus:
    """Clips in which only the pair a-b moves `open`, exactly as drawn, at different speeds."""
    clips = []
    for i in range(repeats):
        long = 0.2 + 0.05 * i
        schedule = Schedule(["sil", "aa", "b", "sil"], [0, gap, gap + long, gap + 2 * long, 2 * gap + 2 * long])
        times = np.arange(round(schedule.end * 100) + 1) / 100
        heights = np.interp((times - gap) / (2 * long), curve.t, curve.v, left=0, right=0)
        clips.append(Clip.of(str(i), schedule, Weights(("open",), 100.0, 0.0, heights[:, None].astype(np.float32))))
    return Corpus.of(clips, ("aa", "b"), {})


def test_a_drawn_curve_is_found_again():
    drawn = Curve.of([(0, 0), (0.5, 0.8), (1, 0)])
    found = learn_bigrams(lone_bigram(drawn), LearnOptions(lean=0.0, refine=True)).found["aa", "b"]
    assert found.bigram.curves["open"].at(PLACES) == pytest.approx(drawn.at(PLACES), abs=0.08)
    assert len(found.bigram.curves["open"]) <= 5
    assert found.occurrences == 3
    assert found.residual < 0.05


def test_learning_beats_the_other_methods_on_hidden_sentences():
    """And stays far below the size of the motion itself (0.21)."""
    assert held_out_error(BigramMethod(full_set(learned())), baked()[40:]) < 0.06


def test_refining_against_stitching_helps():
    plain, refined = (learn_bigrams(corpus(baked()[:30]), LearnOptions(refine=r)) for r in (False, True))
    a, b = (held_out_error(BigramMethod(full_set(found)), baked()[40:]) for found in (plain, refined))
    assert b < a


def test_provenance_is_kept():
    pair, found = next(iter(learned().found.items()))
    assert found.bigram.source == LEARNED
    assert found.bigram.extra["learned"] == {"occurrences": found.occurrences, "residual": round(found.residual, 4)}
    assert found.occurrences == max(f.occurrences for f in learned().found.values())
    spoken = learned().spoken(pair, "open")
    assert len(spoken) == found.occurrences
    assert all(t.size == v.size == NODES for t, v in spoken)


def test_pairs_never_heard_are_only_offered():
    heard = {pair for clip in corpus(baked()[:40]).clips for pair in clip.schedule.pairs()}
    assert not set(learned().offered) & heard
    assert set(learned().found) == heard - {("sil", "sil")}
    assert len(learned().offered) + len(learned().found) == 22 * 22 - 1
    assert {b.status for b in learned().offered.values()} == {"suggestion"}


def test_one_clip_teaches_its_own_pairs():
    found = learn_bigrams(corpus(baked()[:1]))
    assert set(found.found) == set(corpus(baked()[:1]).clips[0].schedule.pairs())
    assert held_out_error(BigramMethod(found.curve_set("One", english())), baked()[:1]) < 0.12


def test_frames_that_were_not_seen_teach_nothing():
    clip = baked()[0]
    known = np.ones(len(clip.weights.frames), bool)
    known[30:90] = False
    spoilt = clip.weights.frames.copy()
    spoilt[30:90] = 1.0
    a = learn_bigrams(corpus((replace(clip, known=known),)))
    b = learn_bigrams(corpus((replace(clip, known=known, weights=replace(clip.weights, frames=spoilt)),)))
    assert set(a.found) == set(b.found)
    for pair, found in a.found.items():
        for pose, curve in found.bigram.curves.items():
            assert curve.same_as(b.found[pair].bigram.curves[pose])


def test_other_bigrams_under_way_are_known():
    """Bigram i meets i−1 in its first phone and i+1 in its second, at the same moment of the clip."""
    clip = baked()[3]
    heard = occurrences_of(corpus((clip,)))
    times = clip.schedule.times
    for i in range(len(clip.schedule) - 1):
        at = times[i] + PLACES * (times[i + 2] - times[i])
        for node in range(NODES):
            other = heard.other[i, node]
            if other >= 0:
                assert other == (i - 1 if at[node] < times[i + 1] else i + 1)
                there = times[other] + heard.place[i, node] * (times[other + 2] - times[other])
                assert there == pytest.approx(at[node], abs=1e-9)


@pytest.mark.parametrize("phones", [[], ["aa"], ["?", "!"], ["sil", "sil"]])
def test_nothing_to_learn_is_said(phones):
    schedule = Schedule(phones, np.arange(len(phones) + 1) * 0.2 if phones else [])
    weights = Weights(("open",), 60.0, 0.0, np.zeros((30, 1), np.float32))
    with pytest.raises(UserError, match="no pair of phones") as refused:
        learn_bigrams(Corpus.of([Clip.of("x", schedule, weights)], ("aa",), {}))
    assert "\n" not in str(refused.value)


def test_learning_can_be_cancelled():
    def stop(share: float, what: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        learn_bigrams(corpus(baked()[:2]), progress=stop)


def test_poses_of_another_set_stay_out_of_it():
    found = learn_bigrams(corpus(baked()[:2]))
    made = found.curve_set("Mine", replace(english(), settings=Settings.smartbody()))
    assert made.poses == english().poses
    assert made.settings == Settings.smartbody()
    assert all(isinstance(b, Bigram) for b in made.bigrams.values())

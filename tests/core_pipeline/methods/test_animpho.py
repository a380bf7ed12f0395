"""AnimPhos: selection as in figures 4 and 5, blending and interpolation as in equations 3 to 5."""

from functools import cache
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.learning.corpus import Clip, Corpus
from core_pipeline.methods import animpho_fit
from core_pipeline.methods.animpho import AnimPho, hermite_frames, slopes
from core_pipeline.methods.animpho_fit import AnimPhoOptions
from core_pipeline.methods.animpho_select import Priority, naive, priority, viterbi
from core_pipeline.methods.method import Cancelled
from core_pipeline.schedule import Schedule
from core_pipeline.weights import Weights
from tests.helpers.corpora import baked, corpus, schedules


@cache
def learned() -> AnimPho:
    return animpho_fit.fit(corpus(baked()[:40]))


def drawn(seed: int, m: int = 8, phones: int = 3) -> AnimPho:
    """Tables drawn by chance; every phone has an AnimPho."""
    rng = np.random.default_rng(seed)
    labels = rng.random((phones + 1, m)) < 0.4
    labels[np.arange(phones + 1), rng.integers(0, m, phones + 1)] = True
    names = tuple(f"p{i}" for i in range(phones))
    return AnimPho(("open",), names, {}, rng.random((m, 5, 1)), rng.random((m, m)) < 0.25, labels)


class TestPaperExample:
    """Figures 4 and 5: nine AnimPhos, three a phone; the third is taken first."""

    @pytest.fixture
    def model(self) -> AnimPho:
        follows = np.zeros((9, 9), bool)
        for a, b in [(1, 4), (1, 5), (2, 5), (4, 8), (5, 8)]:  # the third, 3, leads nowhere
            follows[a - 1, b - 1] = True
        labels = np.zeros((4, 9), bool)
        for phone in range(3):
            labels[phone, 3 * phone : 3 * phone + 3] = True
        labels[3] = True
        starts = np.array([0.9, 0.9, 0.0, 0.5, 0.2, 0.01, 0.3, 0.9, 0.9])  # 6 begins nearest to where 3 ends
        centres = np.repeat(starts[:, None, None], 5, 1)
        return AnimPho(("open",), ("p1", "p2", "p3"), {}, centres, follows, labels)

    def test_the_naive_way_misses_all(self, model):
        schedule = Schedule(["p1", "p2", "p3"], [0, 0.1, 0.2, 0.3])
        assert model.with_selection("naive").missing_rate([schedule]) == 1.0

    def test_priority_prefers_what_was_really_spoken(self, model):
        """5 before 4, for it begins nearer; then 8, the only one reached by three."""
        assert [a + 1 for a in priority(model, [0, 1, 2])] == [3, 5, 8]

    def test_viterbi_begins_where_the_sentence_goes_on(self, model):
        assert [a + 1 for a in viterbi(model, [0, 1, 2])] == [1, 4, 8]


@given(st.integers(0, 2**32 - 1))
def test_priority_is_the_longest_spoken_sequence(seed):
    """Equation (2), against all sequences that end here."""
    model = drawn(seed)
    phones = np.random.default_rng(seed).integers(0, 3, 5).tolist()
    live = Priority(model)
    for t, phone in enumerate(phones):
        chosen = live.step(phone)

        def longest(a: int, t: int = t) -> int:
            before = [b for b in np.flatnonzero(model.labels[phones[t - 1]]) if model.follows[b, a]] if t else []
            return 1 + max((longest(int(b), t - 1) for b in before), default=0)

        mine = np.flatnonzero(model.labels[phone])
        assert longest(chosen) == max(longest(int(a)) for a in mine)


@given(st.integers(0, 2**32 - 1))
def test_viterbi_misses_least_of_all_sequences(seed):
    model = drawn(seed, m=6)
    phones = np.random.default_rng(seed + 1).integers(0, 3, 4).tolist()

    def misses(path):
        return sum(not model.follows[a, b] for a, b in pairwise(path))

    everything = product(*(np.flatnonzero(model.labels[phone]) for phone in phones))
    assert misses(viterbi(model, phones)) == min(map(misses, everything))


@given(st.integers(0, 2**32 - 1))
def test_naive_takes_the_smoothest_that_follows(seed):
    model = drawn(seed)
    phones = np.random.default_rng(seed).integers(0, 3, 5).tolist()
    chosen = naive(model, phones)
    for before, now, phone in zip(chosen[:-1], chosen[1:], phones[1:], strict=True):
        able = np.flatnonzero(model.labels[phone] & model.follows[before])
        able = able if able.size else np.arange(8)
        gaps = np.abs(model.centres[able, 0, 0] - model.centres[before, -1, 0])
        assert now in able
        assert np.abs(model.centres[now, 0, 0] - model.centres[before, -1, 0]) == gaps.min()


def test_the_relation_of_the_three_selections():
    """Eight phrases, as in figure 6: naive misses most, priority fewer, a look at the whole sentence fewest."""
    phrases = schedules()[40:48]
    naive_, priority_, viterbi_ = (
        learned().with_selection(name).missing_rate(phrases) for name in ("naive", "priority", "viterbi")
    )
    assert naive_ > priority_ > viterbi_


@given(st.integers(0, 2**32 - 1))
def test_b_is_a_where_they_are_connected(seed):
    """Equation (3) and the note below it; where nothing ever followed, b is a too."""
    model = drawn(seed)
    for before, now in product(range(8), range(8)):
        twin = model.twin(before, now)
        if model.follows[before, now] or not model.follows[before].any():
            assert twin == now
        else:
            assert model.follows[before, twin]
            gaps = ((model.centres - model.centres[now]) ** 2).sum((1, 2))
            assert gaps[twin] == gaps[model.follows[before]].min()


def test_each_motion_begins_where_the_one_before_ends_and_ends_as_chosen():
    choices = learned().choices(schedules()[45])
    motion = learned().motion(choices)
    assert motion[1:, 0] == pytest.approx(motion[:-1, -1])
    assert motion[:, -1] == pytest.approx(learned().centres[[c.animpho for c in choices], -1])


def test_the_curve_is_smooth_where_phones_meet():
    """C¹ across phones of different length: the slope from the left is that from the right."""
    rng = np.random.default_rng(3)
    bounds = np.array([0, 0.1, 0.35, 0.4])
    motion = rng.random((3, 5, 1))
    motion[1:, 0] = motion[:-1, -1]
    tiny = 1e-6
    for joint in bounds[1:-1]:
        before, at, after = hermite_frames(motion, bounds, joint + np.array([-tiny, 0, tiny]))[:, 0]
        assert (at - before) / tiny == pytest.approx((after - at) / tiny, rel=1e-3, abs=1e-2)


def test_slopes_as_printed():
    motion = np.array([[0.0, 1, 4, 9, 16], [16, 17, 18, 19, 20]])[:, :, None]
    d = slopes(motion, np.array([0.1, 0.2]))[:, :, 0]
    assert d[0].tolist() == [1, 2, 4, 6, 7]
    assert d[1].tolist() == [14, 1, 1, 1, 1]  # 7 a sample of 25 ms are 14 a sample of 50 ms


def test_synthesis_passes_through_the_five_frames():
    schedule = Schedule(["ah", "b", "iy"], [0, 0.2, 0.4, 0.6])
    weights = learned().synthesize(schedule, learned().poses, 20)
    motion = learned().motion(learned().choices(schedule))
    expected = np.concatenate([motion[0], motion[1, 1:], motion[2, 1:]])
    assert weights.frames == pytest.approx(np.clip(expected, 0, 1), abs=1e-6)


def test_transitions_do_not_leap_from_clip_to_clip():
    """Two clips, each of its own motion: nothing of one ever follows anything of the other."""
    clips = []
    for name, height in (("low", 0.1), ("high", 0.9)):
        frames = np.full((31, 1), height, np.float32)
        clips.append(Clip.of(name, Schedule(["aa", "b"], [0, 0.25, 0.5]), Weights(("open",), 60.0, 0.0, frames)))
    model = animpho_fit.fit(Corpus.of(clips), AnimPhoOptions(share=1.0))
    for a, b in zip(*model.follows.nonzero(), strict=True):
        assert model.centres[a, 0, 0] == model.centres[b, 0, 0]


@pytest.mark.parametrize("phones", [[], ["sil"], ["aa"], ["ʘ", "aa", "ʘ"]])
@pytest.mark.parametrize("selection", ["naive", "priority", "viterbi"])
def test_strange_schedules_have_a_result(phones, selection):
    schedule = Schedule(phones, np.arange(len(phones) + 1) * 0.1 if phones else [])
    weights = learned().with_selection(selection).synthesize(schedule, learned().poses, 60)
    assert np.isfinite(weights.frames).all()
    assert len(weights.frames) == len(phones) * 6 + 1


def test_a_phone_never_heard_borrows_from_its_class():
    model = animpho_fit.fit(corpus(baked()[:3]))
    oy = model.phones.index("oy")
    vowels = [i for i, p in enumerate(model.phones) if p in ("ah", "aa", "eh", "ih")]
    assert model.labels[oy].any()
    assert not model.labels[oy].all()
    assert (model.labels[vowels] <= model.labels[oy]).all()


def test_a_fit_can_be_cancelled():
    def stop(share: float, what: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        animpho_fit.fit(corpus(baked()[:2]), progress=stop)


def test_poses_it_does_not_know_are_refused():
    with pytest.raises(UserError, match="does not know jaw"):
        learned().synthesize(Schedule(["aa"], [0, 1]), ("jaw",), 30)

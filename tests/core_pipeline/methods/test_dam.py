"""Dominated animemes: the equations as printed, and fits that find what made the data."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import legendre

from core_pipeline.errors import UserError
from core_pipeline.learning.corpus import Clip, Corpus
from core_pipeline.methods import dam_fit
from core_pipeline.methods.compare import held_out_error
from core_pipeline.methods.dam import Dam
from core_pipeline.methods.dam_fit import DamOptions
from core_pipeline.methods.dominance import EPSILON, WINDOW, joined, reach_of
from core_pipeline.methods.em import Control, Shared
from core_pipeline.methods.method import Cancelled, frame_times
from core_pipeline.methods.modes import ModeTable, choose_modes, joint_mismatch
from core_pipeline.schedule import Schedule
from core_pipeline.weights import Weights
from tests.helpers.corpora import baked, corpus, damped, only

POSES = ("open", "W")
PHONES = ("aa", "b", "d", "iy", "sil")


def made(degree: int, seed: int, phones: tuple[str, ...] = PHONES) -> Dam:
    """A model drawn by chance, one mode a phone, whose weights stay well within 0…1."""
    rng = np.random.default_rng(seed)
    coefficients = rng.uniform(-0.03, 0.03, (len(phones) + 1, degree + 1, len(POSES)))
    coefficients[:, 0] = rng.uniform(0.1, 0.25, (len(phones) + 1, len(POSES)))
    sigma = rng.uniform(0.3, 1.2, (len(phones) + 1, len(POSES)))
    first = np.arange(len(phones) + 2)
    return Dam(POSES, phones, {}, first, coefficients, sigma, ModeTable.of([]), np.zeros(len(POSES)))


def random_schedule(rng: np.random.Generator, phones: int = 30) -> Schedule:
    times = np.concatenate(([0], rng.uniform(0.05, 0.2, phones).cumsum())) + rng.uniform(-2, 2)
    return Schedule(rng.choice(PHONES, phones).tolist(), times)


def by_the_equations(model: Dam, schedule: Schedule, t: float, pose: int) -> float:
    """Equations (1) and (2) phone by phone, as one would read them aloud."""
    n, times = len(schedule), schedule.times
    now = min(max(int(times.searchsorted(t, side="right")) - 1, 0), n - 1)
    total = shares = 0.0
    for j in range(max(now - WINDOW, 0), min(now + WINDOW, n - 1) + 1):
        state = model.phones.index(schedule.phones[j])
        local = (t - times[j]) / (times[j + 1] - times[j])
        outside = max(0.0, -local, local - 1.0) if j != now else 0.0
        dominance = np.exp(-(outside**2) / (model.sigma[state, pose] ** 2 + EPSILON)) if outside else 1.0
        x = 2 * min(max(local, 0.0), 1.0) - 1
        total += dominance * legendre.legval(x, model.coefficients[state, :, pose])
        shares += dominance
    return total / shares if model.degree == 0 else total


@pytest.mark.parametrize("degree", [0, 2, 4])
def test_synthesis_is_the_printed_sum(degree):
    """With M = 0 the sum is divided by that of the dominances: Cohen and Massaro's model is this one with M = 0."""
    model = made(degree, 1)
    schedule = random_schedule(np.random.default_rng(2))
    weights = model.synthesize(schedule, POSES, 60)
    for i in range(0, len(weights.frames), 7):
        expected = [by_the_equations(model, schedule, schedule.start + i / 60, p) for p in range(2)]
        assert weights.frames[i] == pytest.approx(np.clip(expected, 0, 1), abs=1e-6)


def test_cohen_massaro_is_the_fit_of_degree_0():
    clips = corpus(tuple(only(clip, ("open",)) for clip in baked()[:6]))
    plain, named = dam_fit.fit(clips, DamOptions(degree=0, modes=1)), dam_fit.fit_cohen_massaro(clips)
    assert named.title == "Cohen–Massaro"
    assert np.array_equal(plain.coefficients, named.coefficients)
    assert np.array_equal(plain.sigma, named.sigma)


@pytest.mark.parametrize("degree", [0, 3])
def test_the_animemes_are_the_least_squares_ones(degree):
    """The E step, against a dense matrix with a column for every coefficient."""
    rng = np.random.default_rng(4)
    states, frames = 4, []
    for _ in range(3):
        schedule = random_schedule(rng, 12)
        frames.append(reach_of(schedule, rng.integers(0, states, 12), frame_times(schedule, 90), degree))
    reach = joined(frames)
    target, log_sigma = rng.random(len(reach.own)), rng.uniform(-1, 0.5, states)
    shares = reach.dominance(np.exp(log_sigma))
    dense = np.zeros((len(target), states, degree + 1))
    for f in range(len(target)):
        dense[f, reach.own[f]] += reach.basis[f]
        for k in range(shares.shape[1]):
            dense[f, reach.other[f, k]] += shares[f, k] * legendre.legvander([-1.0, 1.0], degree)[reach.side[f, k]]
        if degree == 0:
            dense[f] /= 1 + shares[f].sum()
    expected = np.linalg.lstsq(dense.reshape(len(target), -1), target, rcond=None)[0]
    control = Control(Shared.of(reach, states, normalised=degree == 0), target, ridge=1e-10)
    assert control._animemes(log_sigma).ravel() == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize("degree", [0, 4])
def test_a_known_generator_is_found_again(degree):
    """Tied parameters: data made by a model of one mode a phone gives that model back."""
    truth = made(degree, 5)
    rng = np.random.default_rng(6)
    schedules = [random_schedule(rng, 40) for _ in range(12)]
    clips = [Clip.of(str(i), s, truth.synthesize(s, POSES, 60)) for i, s in enumerate(schedules)]
    options = DamOptions(degree=degree, modes=1, rounds=60, still=0.0, ridge=1e-9)
    found = dam_fit.fit(Corpus.of(clips[:-1], ("aa", "b", "d", "iy"), {}), options)
    assert held_out_error(found, clips[-1:]) < 2e-3
    order = [found.phones.index(phone) for phone in PHONES]
    assert np.median(np.abs(np.log(found.sigma[order] / truth.sigma[:-1]))) < 0.1


@pytest.mark.parametrize("clips", [baked, damped])
def test_animemes_beat_single_shapes(clips):
    """The paper's relation, 0.75 : 1, on data of our own pipeline and on data of another kind."""
    some = tuple(only(clip, ("open", "wide")) for clip in clips())
    train, rest = corpus(some[:24]), some[40:]
    animemes, shapes = dam_fit.fit(train), dam_fit.fit_cohen_massaro(train)
    assert held_out_error(animemes, rest) < held_out_error(shapes, rest)


def test_modes_are_chosen_by_context():
    """A phone that moves in two ways, each in its own company, is given the right one."""
    table = ModeTable.of([(0, 2, 0, 0)] * 20 + [(1, 2, 1, 1)] * 20)
    first = np.array([0, 1, 2, 4, 5])
    flat = np.zeros((5, 5))
    assert choose_modes(np.array([0, 2, 0]), first, table, flat).tolist() == [0, 2, 0]
    assert choose_modes(np.array([1, 2, 1]), first, table, flat).tolist() == [1, 3, 1]


def test_where_context_is_silent_the_smoother_mode_is_taken():
    """E_s decides between modes of equal likelihood: that whose start is where the phone before ends."""
    coefficients = np.zeros((4, 2, 1))
    coefficients[:, 0, 0] = [0.7, 0.1, 0.7, 0.4]  # phone 0; phone 1, two modes; unknown
    table = ModeTable.of([(-1, 1, -1, 0), (-1, 1, -1, 1)])
    states = choose_modes(np.array([0, 1]), np.array([0, 1, 3, 4]), table, joint_mismatch(coefficients))
    assert states.tolist() == [0, 2]


def test_a_fit_finds_the_modes():
    model = dam_fit.fit(corpus(tuple(only(clip, ("open", "wide")) for clip in baked()[:30])))
    per_phone = np.diff(model.first)[:-1]
    assert 2 <= per_phone.max() <= 4
    assert per_phone.min() == 1  # too rare for two of twelve
    states = model.states_of(baked()[40].schedule)
    assert (states < model.first[-1]).all()


def test_affinity_propagation_is_an_option():
    some = corpus(tuple(only(clip, ("open",)) for clip in baked()[:12]))
    model = dam_fit.fit(some, DamOptions(clusters="affinity", rounds=2))
    assert np.diff(model.first).max() > 1
    assert held_out_error(model, some.clips) < 0.2


@given(st.integers(0, 2**32 - 1))
def test_shifting_the_schedule_shifts_the_result(seed):
    model = made(4, 8)
    schedule = random_schedule(np.random.default_rng(seed), 6)
    later = Schedule(schedule.phones, schedule.times + 3.0)
    a, b = model.synthesize(schedule, POSES, 30), model.synthesize(later, POSES, 30)
    assert b.start == pytest.approx(a.start + 3)
    count = min(len(a.frames), len(b.frames))  # rounding may move the last frame
    assert a.frames[:count] == pytest.approx(b.frames[:count], abs=1e-5)


@pytest.fixture(scope="module")
def model() -> Dam:
    """Of three sentences and one pose."""
    return dam_fit.fit(corpus(tuple(only(clip, ("open",)) for clip in baked()[:3])))


class TestStrangePhones:
    def test_a_phone_never_heard_has_the_mean_of_its_class(self, model):
        """Three sentences have no `oy`: it moves as vowels do, not as everything does."""
        assert "oy" not in {p for clip in baked()[:3] for p in clip.schedule.phones}
        row, unknown = model.first[model.phones.index("oy")], -1
        assert model.coefficients[row, 0, 0] > model.coefficients[unknown, 0, 0] > 0

    def test_an_unknown_phone_moves_as_all_do(self, model):
        weights = model.synthesize(Schedule(["sil", "ʘ", "sil"], [0, 0.3, 0.5, 0.8]), ("open",), 60)
        assert 0 < weights.frames[24, 0] < 1

    @pytest.mark.parametrize("phones", [[], ["aa"], ["sil"], ["aa", "sil"]])
    def test_any_length_has_a_result(self, model, phones):
        schedule = Schedule(phones, np.arange(len(phones) + 1) * 0.1 if phones else [])
        weights = model.synthesize(schedule, ("open",), 60)
        assert len(weights.frames) == round(len(phones) * 6) + 1
        assert np.isfinite(weights.frames).all()

    def test_the_shortest_phones_have_a_result(self, model):
        schedule = Schedule(["aa", "p", "iy"], [0, 1e-5, 2e-5, 0.1])
        assert np.isfinite(model.synthesize(schedule, ("open",), 60).frames).all()

    def test_poses_are_given_in_the_order_asked_for_and_others_refused(self, model):
        schedule = Schedule(["aa"], [0, 0.1])
        with pytest.raises(UserError, match="does not know wide, jaw; it was learned for open"):
            model.synthesize(schedule, ("open", "wide", "jaw"), 60)


def test_one_clip_is_a_corpus():
    one = corpus((only(baked()[0], ("open",)),))
    model = dam_fit.fit(one)
    assert held_out_error(model, one.clips) < 0.15


def test_lost_frames_are_not_learned_from():
    clip = only(baked()[0], ("open",))
    frames = clip.weights.frames.copy()
    known = np.ones(len(frames), bool)
    known[20:40] = False
    frames[20:40] = 1.0
    spoilt = Clip("spoilt", clip.schedule, Weights(("open",), 60.0, clip.weights.start, frames), known)
    whole = Clip("whole", clip.schedule, clip.weights, known)
    options = DamOptions(modes=1)
    a, b = dam_fit.fit(Corpus.of([spoilt]), options), dam_fit.fit(Corpus.of([whole]), options)
    assert np.array_equal(a.coefficients, b.coefficients)


def test_a_corpus_that_shows_nothing_is_refused():
    weights = Weights(("open",), 60.0, 100.0, np.zeros((10, 1), np.float32))
    with pytest.raises(UserError, match="labels and animation belong together"):
        dam_fit.fit(Corpus.of([Clip.of("x", Schedule(["aa"], [0, 1]), weights)]))


def test_a_fit_can_be_cancelled():
    def stop(share: float, what: str) -> None:
        if share > 0.2:
            raise Cancelled

    with pytest.raises(Cancelled):
        dam_fit.fit(corpus(baked()[:2]), progress=stop)

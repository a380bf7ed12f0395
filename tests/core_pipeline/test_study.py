"""A blind comparison: fair sides, honest sums, and it can go on any day."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import chisquare

from core_pipeline.errors import UserError
from core_pipeline.files import study_json
from core_pipeline.study import LEFT, RIGHT, Answer, Study, results, to_csv, told
from tests.helpers.refusals import told as refusal

TEXTS = [f"Sentence {i}." for i in range(10)]


def made(seed: int = 1) -> Study:
    return Study.of(("ours", "theirs"), TEXTS, ["toon", "ada"], seed)


def preferring(study: Study, wins: dict[str, int]) -> Study:
    """Each face's first so many trials go to contender 0 with strength 4, the others to 1 with strength 2."""
    seen: dict[str, int] = {}
    for i, trial in enumerate(study.trials):
        seen[trial.face] = seen.get(trial.face, 0) + 1
        winner = 0 if seen[trial.face] <= wins[trial.face] else 1
        side = LEFT if trial.left == winner else RIGHT
        study = study.with_answer(Answer(i, "me", side, 4 - 2 * winner))
    return study


@given(st.integers(0, 10**6))
def test_sides_are_random_but_even(seed):
    trials = made(seed).trials
    assert sum(trial.left for trial in trials) == len(trials) // 2
    assert sorted({(t.text, t.face) for t in trials}) == sorted((t, f) for t in TEXTS for f in ("toon", "ada"))


def test_the_order_is_another_with_another_seed():
    assert made(1) == made(1)
    assert made(1).trials != made(2).trials


def test_results_are_the_paper_s():
    """Its figure 12 in small: preference, χ² goodness of fit, mean strength, for each face and for all."""
    found = results(preferring(made(), {"toon": 9, "ada": 5}))
    assert {r.face for r in found} == {"toon", "ada", ""}
    by_face = {r.face: r for r in found}
    assert by_face["toon"].chosen == (9, 1)
    assert by_face["toon"].percent == (90, 10)
    assert by_face["toon"].strength == (4, 2)
    assert (by_face["toon"].chi2, by_face["toon"].p) == pytest.approx(tuple(chisquare([9, 1])))
    assert by_face["toon"].chi2 == pytest.approx(6.4)
    assert by_face["ada"].p == 1.0
    assert by_face[""].chosen == (14, 6)
    assert "toon: ours 90 %, theirs 10 % of 10 answers; χ² = 6.40, p = 0.0114" in "\n".join(told(made_with_answers()))


def made_with_answers() -> Study:
    return preferring(made(), {"toon": 9, "ada": 5})


def test_nobody_has_answered_yet():
    assert [(r.chosen, r.percent, r.chi2, r.p) for r in results(made())] == [((0, 0), (0, 0), 0, 1)] * 3


def test_an_observer_may_change_their_mind_and_others_count_apart():
    study = made().with_answer(Answer(3, "me", LEFT, 1)).with_answer(Answer(3, "me", RIGHT, 5))
    study = study.with_answer(Answer(3, "you", LEFT, 2))
    assert study.answers == (Answer(3, "me", RIGHT, 5), Answer(3, "you", LEFT, 2))
    assert len(study.waiting("me")) == 19
    assert 3 not in study.waiting("you")
    assert len(study.waiting("third")) == 20


@pytest.mark.parametrize("answer", [Answer(99, "me", LEFT, 1), Answer(0, "me", "up", 1), Answer(0, "me", LEFT, 6)])
def test_impossible_answers(answer):
    with pytest.raises(ValueError, match=r"trial|strength"):
        made().with_answer(answer)


def test_it_needs_something_to_compare():
    with pytest.raises(UserError, match="at least one sentence"):
        Study.of(("a", "b"), [], ["toon"], 1)


def test_csv_has_every_answer_and_no_formulas():
    study = made().with_answer(Answer(0, "=evil()", LEFT, 3))
    rows = list(csv.DictReader(io.StringIO(to_csv(study))))
    assert rows[0]["observer"] == "'=evil()"
    assert rows[0]["preferred"] == study.contenders[study.trials[0].left]
    assert rows[0]["strength"] == "3"


def test_a_file_brings_it_all_back(tmp_path):
    study = made_with_answers()
    study_json.save(study, tmp_path)
    assert study_json.load(tmp_path) == study
    assert study_json.clip_path(tmp_path, 0, LEFT).name == "001-left.mp4"


GOOD = study_json.dumps(made().with_answer(Answer(0, "me", LEFT, 3)))


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("lipstitch.Study.1", "x", "is not a study"),
        ('"left": 0', '"left": 7', "trials are not those"),
        ('"strength": 3', '"strength": 9', "answer 1 is none"),
        ('"strength": 3', '"strength": "x"', "expected `int`"),
        ('"trial": 0', '"trial": 900', "answer 1 is none"),
        ('"contenders"', '"competitors"', "contenders"),
        ("{", "", "damaged"),
    ],
)
def test_damaged_ones_are_refused(old, new, sentence):
    assert sentence in (refusal(lambda: study_json.parse(GOOD.replace(old, new, 1).encode(), "s")) or "")

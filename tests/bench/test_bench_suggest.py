"""Suggestions and diagnosis: a refit within 50 ms of an edit, and nothing of it on the way of a drag."""

import pytest

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.diagnose import Corpus, SetFindings, findings_of
from core_pipeline.pipeline import run
from core_pipeline.suggest import Suggestions, fill
from tests.helpers.animators import drawn_set
from tests.helpers.budget import within
from tests.helpers.lip_measures import sentences


@pytest.fixture(scope="module")
def drawn() -> CurveSet:
    return drawn_set(seed=3)


def edits(curve_set: CurveSet):
    """The set with one key of one bigram moved, another each time."""
    pairs = list(curve_set.bigrams)
    for i in range(10**6):
        height = 0.2 + 0.6 * (i % 97) / 97
        yield curve_set.with_bigram(
            pairs[i % len(pairs)], Bigram({"jaw": Curve.of([(0, 0), (0.4, height), (1, 0)])}, "draft")
        )


def test_refit_after_an_edit_and_the_open_bigrams_suggestion(benchmark, drawn):
    Suggestions.of(drawn)
    sets = edits(drawn)
    benchmark(lambda: Suggestions.of(next(sets)).bigram(("oy", "h")))
    within(benchmark, 0.05)


def test_findings_of_a_whole_set(benchmark, drawn):
    sets = edits(drawn)
    benchmark(lambda: SetFindings.of(next(sets)))
    within(benchmark, 0.15)


def test_fill_all(benchmark, drawn):
    half = {pair: b for i, (pair, b) in enumerate(drawn.bigrams.items()) if i % 2}
    part = CurveSet(poses=drawn.poses, bigrams=half)
    benchmark.pedantic(lambda: fill(part), rounds=5)
    within(benchmark, 0.5)


def test_findings_of_a_sentence(benchmark, drawn):
    checks = SetFindings.of(drawn)
    schedule = max((schedule for _, schedule in sentences()), key=len)
    stages = run(schedule, drawn)

    def diagnose():
        corpus = Corpus()
        corpus.add(stages, findings_of(stages, drawn, checks))
        return corpus.ranking()

    assert benchmark(diagnose)
    within(benchmark, 0.03)


def test_a_drag_waits_for_no_diagnosis(editor, qtbot):
    """While a key is held nothing is asked for; when it is let go, it is."""
    editor.wiring.sentence.type("Fat cats often find fish.", play=False)
    with qtbot.waitSignal(editor.wiring.weak.diagnosed, timeout=20_000, check_params_cb=lambda d: d.stages is not None):
        pass
    weak = editor.wiring.weak
    asked = weak._diagnoser._number
    curve = Curve.of([(0, 0), (0.5, 0.9), (1, 0)])
    for _ in range(5):
        with qtbot.waitSignal(editor.session.stages_changed):
            editor.session.set_preview(("f", "ah"), {"open": curve})
    qtbot.waitUntil(lambda: not weak._late.isActive())
    assert weak._diagnoser._number == asked
    with qtbot.waitSignal(weak.diagnosed, timeout=20_000):
        editor.session.set_preview(("f", "ah"), None)

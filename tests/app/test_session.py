"""The session: any number of changes in one turn, one run of the pipeline; a gesture shows without being kept."""

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication
from pytestqt.qtbot import QtBot

from app.session import Session
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.pipeline import Settings, run
from core_pipeline.speech.utterance import Utterance
from core_pipeline.weights import sample
from tests.helpers import stages as small

F_AH = ("f", "ah")
LOW, HIGH = Curve.of([(0, 0), (0.5, 0.2), (1, 0)]), Curve.of([(0, 0), (0.5, 0.9), (1, 0)])


def said(phones: str) -> Utterance:
    return Utterance(phones, small.schedule(phones))


@pytest.fixture
def session(qtbot: QtBot) -> Session:
    session = Session(small.curve_set())
    session.set_utterance(said("sil f ah d sil"))
    session.recompute()
    return session


def top(session: Session, pose: str) -> float:
    assert session.stages is not None
    return float(session.stages.blue[pose].v.max())


def test_many_changes_in_one_turn_are_computed_once(session: Session, qtbot: QtBot) -> None:
    runs: list[object] = []
    session.stages_changed.connect(runs.append)
    with qtbot.waitSignal(session.stages_changed):
        for height in (0.3, 0.5, 0.7):
            session.set_curve_set(small.curve_set(height=height))
        session.set_utterance(said("f ah"))
    QCoreApplication.processEvents()
    assert len(runs) == 1
    assert session.stages is runs[0]
    assert session.stages.schedule.phones == ("f", "ah")
    assert top(session, "open") == pytest.approx(0.7)


def test_stages_and_weights_are_those_of_the_pipeline(session: Session) -> None:
    assert session.utterance is not None
    expected = run(session.utterance.schedule, small.curve_set())
    for moment in (0.0, 0.137, 0.25, 0.4999):
        np.testing.assert_array_equal(session.weights_at(moment), sample(expected.magenta, "pchip", moment)[0])
    assert session.pipeline_ms > 0


def test_a_gesture_is_shown_while_it_lasts_and_leaves_no_trace(session: Session, qtbot: QtBot) -> None:
    before = top(session, "W")
    with qtbot.waitSignal(session.stages_changed):
        session.set_preview(F_AH, {"W": HIGH})
    assert top(session, "W") == pytest.approx(0.9)
    assert session.curve_set.bigrams[F_AH].curves["W"] is HIGH
    with qtbot.waitSignal(session.stages_changed):
        session.set_preview(F_AH, None)
    assert top(session, "W") == before == 0
    assert "W" not in session.curve_set.bigrams[F_AH].curves


def test_a_gesture_ends_when_the_edit_arrives(session: Session, qtbot: QtBot) -> None:
    session.set_preview(F_AH, {"W": HIGH})
    with qtbot.waitSignal(session.stages_changed):
        session.set_curve_set(small.curve_set().with_bigram(F_AH, Bigram({"W": LOW})))
    assert top(session, "W") == pytest.approx(0.2)


def test_a_gesture_may_delete_a_curve_or_make_a_bigram(session: Session) -> None:
    session.set_curve_set(CurveSet(bigrams={("ah", "d"): Bigram({"open": HIGH})}))
    session.set_preview(F_AH, {"FV": HIGH})
    session.recompute()
    assert top(session, "FV") == pytest.approx(0.9)
    session.set_preview(("ah", "d"), {"open": None})
    session.recompute()
    assert top(session, "open") == 0


def test_without_a_sentence_the_face_rests(session: Session, qtbot: QtBot) -> None:
    with qtbot.waitSignal(session.stages_changed) as changed:
        session.set_utterance(None)
    assert changed.args == [None]
    assert session.stages is None
    assert session.used() == {}
    np.testing.assert_array_equal(session.weights_at(0.2), np.zeros(9))


def test_a_bigram_alone_plays_its_own_curves(session: Session) -> None:
    session.set_curve_set(
        CurveSet(bigrams={F_AH: Bigram({"FV": HIGH})}, settings=Settings.paper().with_spline("linear"))
    )
    weights = session.bigram_weights_at(F_AH, 0.25)
    assert weights[session.curve_set.poses.index("FV")] == pytest.approx(0.45)
    assert weights.sum() == pytest.approx(0.45)
    assert not session.bigram_weights_at(("d", "d"), 0.5).any()


def test_used_counts_the_bigrams_of_the_sentence(session: Session) -> None:
    session.set_utterance(said("f ah f ah"))
    session.recompute()
    assert session.used() == {F_AH: 2, ("ah", "f"): 1}

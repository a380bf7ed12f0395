"""Speech on a thread: answers come as signals, and only to the latest request."""

import pytest

from app.workers.speech_worker import SpeechWorker
from core_pipeline.speech.dictionary import Dictionary
from core_pipeline.speech.espeak import Espeak
from core_pipeline.speech.speaker import Speaker


@pytest.fixture
def worker(qtbot):
    made = SpeechWorker()
    yield made
    made.stop()


def test_a_sentence_is_spoken(worker, qtbot):
    with qtbot.waitSignal(worker.spoken, timeout=10_000) as told:
        worker.request("Hello there.", "gmw/en", 200)
    assert [w.text for w in told.args[0].words] == ["Hello", "there"]
    assert told.args[0].audio is not None


def test_what_cannot_be_spoken_is_told(worker, qtbot):
    with qtbot.waitSignal(worker.failed, timeout=10_000) as told:
        worker.request("…")
    assert "type at least one word" in told.args[0]


def test_only_the_latest_request_is_answered(worker, qtbot):
    texts = []
    worker.spoken.connect(lambda utterance: texts.append(utterance.text))
    with qtbot.waitSignal(worker.spoken, timeout=10_000):
        for i in range(50):
            worker.request(f"Sentence number {i}.")
    with qtbot.waitSignal(worker.spoken, timeout=10_000):
        worker.request("The last one.")
    assert texts == ["Sentence number 49.", "The last one."]


def test_after_a_failure_it_speaks_on(worker, qtbot):
    with qtbot.waitSignal(worker.failed, timeout=10_000):
        worker.request("")
    with qtbot.waitSignal(worker.spoken, timeout=10_000):
        worker.request("Better.")


def test_without_a_voice_it_is_silent_and_says_why(qtbot):
    worker = SpeechWorker(Speaker(Espeak(library="/nowhere/libespeak-ng.so"), Dictionary(None)))
    with qtbot.waitSignal(worker.spoken, timeout=10_000) as told:
        worker.request("Hello.")
    assert told.args[0].audio is None
    assert "There is no sound" in told.args[0].notes[0]
    worker.stop()


def test_stopping_ends_thread_and_process(qtbot):
    espeak = Espeak()
    worker = SpeechWorker(Speaker(espeak))
    with qtbot.waitSignal(worker.spoken, timeout=10_000):
        worker.request("Hello.")
    assert espeak.process_id is not None
    worker.request("A long text. " * 300)
    worker.stop()
    assert espeak.process_id is None
    assert not worker._thread.is_alive()
    worker.stop()  # again does nothing

"""How fast a sentence becomes sound: python -m pytest tests/bench/test_bench_speech.py --benchmark-only

Goals on two cores: a warm sentence within 20 ms, a start within 300 ms.
"""

from itertools import count

from core_pipeline.speech.dictionary import installed
from core_pipeline.speech.espeak import Espeak
from core_pipeline.speech.sentence import clean
from tests.helpers.budget import within


def test_a_warm_sentence(benchmark):
    espeak = Espeak()
    espeak.warm_up()
    number = count()
    # a new text each time, or the cache would answer
    u = benchmark(lambda: espeak.speak(clean(f"The quick brown fox jumps over {next(number)} lazy dogs.")))
    assert u.audio.duration > 2
    within(benchmark, 0.02)
    espeak.close()


def test_a_sentence_spoken_before(benchmark):
    espeak = Espeak()
    sentence = clean("The quick brown fox jumps over the lazy dog.")
    assert benchmark(espeak.speak, sentence) is espeak.speak(sentence)
    espeak.close()


def test_start(benchmark):
    def start():
        espeak = Espeak()
        espeak.warm_up()
        espeak.close()

    benchmark.pedantic(start, rounds=10)
    within(benchmark, 0.3)


def test_without_a_voice(benchmark):
    sentence = clean("The quick brown fox jumps over the lazy dog.")
    u = benchmark(installed().speak, sentence)
    assert u.schedule.duration > 2

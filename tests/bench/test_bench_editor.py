"""The whole editor: how long from the hand to the eye. Budgets are those of the design's latency table."""

from itertools import count

import pytest
from PySide6.QtCore import QEventLoop, QPointF, Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app import resources
from tests.helpers import mouse
from tests.helpers.budget import within

#: Forty phones, about three seconds.
SENTENCE = "My mother bought five blue shoes above the big shop."


def _type(editor, qtbot, text):
    field = editor.window.sentence_bar.field
    field.setText(text)
    with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000):
        QTest.keyClick(field, Qt.Key.Key_Return)


def test_a_step_of_a_drag_through_all_stages_to_the_screen(benchmark, editor, qtbot):
    """Mouse event → key, five stages and overlay painted; the face draws in its own thread."""
    _type(editor, qtbot, SENTENCE)
    editor.preview.player.pause()
    editor.wiring.bigram.open(editor.session.stages.schedule.pairs()[5], 5)
    canvas = editor.window.canvas
    curve = canvas.curves[canvas.active]
    top = int(curve.v.argmax())
    start = canvas.point_of(float(curve.t[top]), float(curve.v[top]))
    steps = count()
    mouse.press(canvas.viewport(), start)
    mouse.move(canvas.viewport(), start + QPointF(0, 30))

    def step():
        before = editor.session.stages
        mouse.move(canvas.viewport(), start + QPointF(0, 20 + 3 * (next(steps) % 20)))
        while editor.session.stages is before:
            QApplication.processEvents(QEventLoop.ProcessEventsFlag.AllEvents)
        QApplication.processEvents()

    benchmark(step)
    mouse.release(canvas.viewport(), start)
    within(benchmark, 0.033)


def test_enter_to_the_first_frame_of_the_face(benchmark, editor, qtbot):
    texts = (f"Number {i} is a fine number." for i in count(1))
    _type(editor, qtbot, SENTENCE)

    def enter():
        with qtbot.waitSignal(editor.preview.frame_ready, timeout=20_000):
            _type(editor, qtbot, next(texts))

    benchmark.pedantic(enter, rounds=10, warmup_rounds=1)
    within(benchmark, 0.2)


def test_another_bigram_in_the_canvas(benchmark, editor, qtbot):
    _type(editor, qtbot, SENTENCE)
    editor.preview.player.pause()
    pairs = [("f", "ah"), ("l", "ow"), ("bmp", "aa"), ("d", "ih")]
    turn = count()

    def switch():
        editor.wiring.bigram.open(pairs[next(turn) % len(pairs)])
        QApplication.processEvents()

    benchmark(switch)
    within(benchmark, 0.05)


@pytest.mark.parametrize("beside", [(), ("man", "woman")], ids=["one face", "three faces"])
def test_a_second_of_playing(benchmark, editor, qtbot, beside):
    """How many pictures are shown in a second of speech; sound never waits for them."""
    for name in beside:
        editor.wiring.character.company.add(resources.face_folder(name))
    qtbot.waitUntil(lambda: len(editor.preview.actors) == 1 + len(beside), timeout=20_000)
    _type(editor, qtbot, SENTENCE)
    editor.preview.player.set_looping(True)
    shown = []
    editor.preview.frame_ready.connect(shown.append)

    def second():
        shown.clear()
        loop = QEventLoop()
        QTimer.singleShot(1000, loop, loop.quit)
        loop.exec()
        return len(shown)

    pictures = benchmark.pedantic(second, rounds=3, warmup_rounds=1)
    benchmark.extra_info["pictures per second"] = pictures
    editor.preview.player.pause()
    if benchmark.enabled:
        assert pictures >= 30

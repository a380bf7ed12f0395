"""The render thread: latest wish wins, a still picture gets its full quality, failure is a sentence."""

import threading

import numpy as np
import pytest
from PySide6.QtCore import QThread
from PySide6.QtGui import QImage

from app.preview.gl_platform import QtPlatform, make_platform
from app.preview.render_worker import RenderWorker
from core_pipeline.faces.render.context import process_context
from core_pipeline.faces.render.renderer import FaceRenderer, Figure
from core_pipeline.faces.view import View
from tests.helpers.ball import ball

BALL = ball()
VIEW = View.of(BALL.camera)
REST = np.zeros(2, np.float32)
STILL = [Figure(BALL, REST, VIEW)]
SIZE = (64, 48)


class Frames(list):
    """What a worker emitted, as (image, time, milliseconds)."""

    def __init__(self, worker):
        super().__init__()
        worker.frame.connect(lambda *frame: self.append(frame))


@pytest.fixture
def worker(qtbot):
    worker = RenderWorker()
    yield worker
    worker.stop()
    assert worker.isFinished() or not worker.isRunning()


def pixels(image: QImage):
    """(h, w, 4) copy."""
    return np.array(image.constBits()).reshape(image.height(), image.width(), 4)


def test_a_wish_becomes_a_frame_at_its_time(qtbot, worker):
    worker.start()
    with qtbot.waitSignal(worker.frame, timeout=5000) as caught:
        worker.request(STILL, SIZE, 1.25)
    image, time, milliseconds = caught.args
    assert (image.width(), image.height()) == SIZE
    assert time == 1.25
    assert milliseconds > 0


def test_a_still_picture_is_drawn_again_in_full_quality_and_then_no_more(qtbot, worker):
    worker.start()
    frames = Frames(worker)
    worker.request(STILL, SIZE, 0.5)
    qtbot.waitUntil(lambda: len(frames) == 2, timeout=5000)
    renderer = FaceRenderer(BALL)
    for (image, time, _), full_quality in zip(frames, (False, True), strict=True):
        np.testing.assert_array_equal(pixels(image), renderer.frame(REST, VIEW, SIZE, full_quality))
        assert time == 0.5
    renderer.close()
    with qtbot.assertNotEmitted(worker.frame, wait=200):
        pass


def test_frames_keep_their_pixels_while_others_are_drawn(qtbot, worker):
    worker.start()
    frames = Frames(worker)
    worker.request(STILL, SIZE, 0.0)
    qtbot.waitUntil(lambda: len(frames) == 1, timeout=5000)
    before = pixels(frames[0][0])
    worker.request([Figure(BALL, np.ones(2, np.float32), VIEW.orbited(90, 40))], SIZE, 1.0)
    qtbot.waitUntil(lambda: any(time == 1.0 for _, time, _ in frames), timeout=5000)
    np.testing.assert_array_equal(pixels(frames[0][0]), before)
    assert not np.array_equal(pixels(frames[-1][0]), before)


def test_the_latest_wish_wins_and_the_others_are_counted(qtbot, worker):
    frames = Frames(worker)
    for time in range(5):  # before the thread runs: only one can be waiting
        worker.request(STILL, SIZE, float(time))
    assert worker.dropped == 4
    worker.start()
    qtbot.waitUntil(lambda: len(frames) == 2, timeout=5000)
    assert [time for _, time, _ in frames] == [4.0, 4.0]


def test_the_amounts_of_a_wish_may_change_after_it(qtbot, worker):
    amounts = REST.copy()
    frames = Frames(worker)
    worker.request([Figure(BALL, amounts, VIEW)], SIZE, 0.0)
    amounts[:] = 1.0
    worker.start()
    qtbot.waitUntil(lambda: len(frames) >= 1, timeout=5000)
    renderer = FaceRenderer(BALL)
    np.testing.assert_array_equal(pixels(frames[0][0]), renderer.frame(REST, VIEW, SIZE, False))
    renderer.close()


def test_the_last_wish_of_many_is_always_drawn(qtbot, worker):
    worker.start()
    frames = Frames(worker)
    for step in range(300):
        worker.request([Figure(BALL, np.full(2, step / 300, np.float32), VIEW)], SIZE, float(step))
    qtbot.waitUntil(lambda: len(frames) > 1 and [time for _, time, _ in frames[-2:]] == [299.0, 299.0], timeout=10000)
    times = [time for _, time, _ in frames]
    assert times == sorted(times)
    assert len(set(times)) + worker.dropped == 300


def test_another_face_takes_the_place_of_the_old_one(qtbot, worker):
    frames = Frames(worker)
    worker.start()
    worker.request(STILL, SIZE, 0.0)
    qtbot.waitUntil(lambda: len(frames) >= 1, timeout=5000)
    worker.request([Figure(ball(12, colour=(0.0, 0.0, 0.9, 0.0)), REST, VIEW)], SIZE, 7.0)
    qtbot.waitUntil(lambda: frames[-1][1] == 7.0, timeout=5000)
    colour = frames[-1][0].pixelColor(32, 24)
    assert colour.blue() > colour.red()


def test_stop_ends_the_thread_and_start_goes_on(qtbot, worker):
    for time in (1.0, 2.0):
        worker.start()
        with qtbot.waitSignal(worker.frame, timeout=5000, check_params_cb=lambda _, at, __, t=time: at == t):
            worker.request(STILL, SIZE, time)
        worker.stop()
        assert worker.isFinished()
    worker.stop()


def test_the_main_thread_may_draw_at_the_same_time(qtbot, worker):
    worker.start()
    frames = Frames(worker)
    renderer = FaceRenderer(BALL)
    first = renderer.frame(REST, VIEW, SIZE, False).copy()
    for step in range(30):
        worker.request(STILL, SIZE, float(step))
        np.testing.assert_array_equal(renderer.frame(REST, VIEW, SIZE, False), first)
    renderer.close()
    qtbot.waitUntil(lambda: bool(frames) and frames[-1][1] == 29.0, timeout=5000)


def test_drawing_happens_in_the_workers_own_thread(qtbot):
    seen = []

    class Watched(Repaired):
        def make_current(self):
            seen.append(QThread.currentThread())
            super().make_current()

    worker = RenderWorker(platform=Watched(works=True))
    worker.start()
    with qtbot.waitSignal(worker.frame, timeout=5000):
        worker.request(STILL, SIZE, 0.0)
    worker.stop()
    assert set(seen) == {worker}


class Repaired:
    """A platform that has no context until somebody mends it; then it lends the process's own."""

    def __init__(self, works=False):
        self.works = works
        self.deleted = threading.Event()

    def init_context(self):
        if not self.works:
            raise RuntimeError("the driver is missing")

    def make_current(self):
        process_context().__enter__()

    def make_uncurrent(self):
        process_context().__exit__()

    def delete_context(self):
        self.deleted.set()


def test_failure_is_one_sentence_and_retry_draws_the_last_wish(qtbot):
    platform = Repaired()
    worker = RenderWorker(platform=platform)
    worker.start()
    frames = Frames(worker)
    with qtbot.waitSignal(worker.failed, timeout=5000) as caught:
        worker.request(STILL, SIZE, 1.0)
    assert "no OpenGL on this machine (the driver is missing)" in caught.args[0]

    with qtbot.assertNotEmitted(worker.failed, wait=50):  # it says so once, not with every wish
        worker.request(STILL, SIZE, 2.0)
    with qtbot.waitSignal(worker.failed, timeout=5000):
        worker.retry()
    platform.works = True
    worker.retry()
    qtbot.waitUntil(lambda: len(frames) == 2, timeout=5000)
    assert [time for _, time, _ in frames] == [2.0, 2.0]
    worker.stop()
    assert platform.deleted.is_set()


def test_on_linux_the_renderer_finds_egl_itself_elsewhere_qt_gives_the_context(qapp, monkeypatch):
    monkeypatch.setattr("sys.platform", "linux")
    assert make_platform() is None
    monkeypatch.setattr("sys.platform", "win32")
    assert isinstance(make_platform(), QtPlatform)

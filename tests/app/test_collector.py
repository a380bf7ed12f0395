"""Garbage of Python's: collected by the thread of the interface, and by no other."""

import gc
import threading
import weakref

import pytest

from app.collector import Collector


class Knot:
    """Holds itself, so that only the collector frees it; tells where it died."""

    def __init__(self, deaths):
        self.me = self
        weakref.finalize(self, lambda: deaths.append(threading.current_thread()))


@pytest.fixture
def collector(qapp):
    collector = Collector()
    yield collector
    collector.stop()
    assert gc.isenabled()


def much():
    return [[i] for i in range(20_000)]


def test_another_threads_work_frees_nothing_and_the_interface_does(qtbot, collector):
    deaths = []
    Knot(deaths)
    thread = threading.Thread(target=much)
    thread.start()
    thread.join()
    assert deaths == []
    kept = much()
    qtbot.waitUntil(lambda: bool(deaths))
    assert deaths == [threading.main_thread()]
    assert kept


def test_after_it_has_stopped_python_collects_again(qapp):
    collector = Collector()
    assert not gc.isenabled()
    collector.stop()
    assert gc.isenabled()

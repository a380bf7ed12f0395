"""A thread of which only the newest wish counts."""

import threading

import pytest

from app.workers.latest import Latest
from core_pipeline.errors import UserError


@pytest.fixture
def made(qtbot):
    workers = []

    def make(work):
        worker = Latest("test", work)
        workers.append(worker)
        return worker

    yield make
    for worker in workers:
        worker.stop()


def test_a_wish_is_answered(qtbot, made):
    worker = made(lambda wish, _: wish * 2)
    with qtbot.waitSignal(worker.answered) as answer:
        worker.request(21)
    assert answer.args == [42]


def test_only_the_newest_of_many_is_answered_and_the_old_know_it(qtbot, made):
    begun, go, gave_up = threading.Event(), threading.Event(), []

    def work(wish, is_old):
        if wish == "old":
            begun.set()
            go.wait(10)
            gave_up.append(is_old())
        return wish

    worker, answers = made(work), []
    worker.answered.connect(answers.append)
    worker.request("old")
    assert begun.wait(10)
    worker.request("older than the newest")
    worker.request("new")
    go.set()
    qtbot.waitUntil(lambda: bool(answers))
    assert answers == ["new"]
    assert gave_up == [True]


def test_what_was_cancelled_is_never_answered(qtbot, made):
    begun, go = threading.Event(), threading.Event()

    def work(wish, is_old):
        if wish == "first":
            begun.set()
            go.wait(10)
        return wish

    worker, answers = made(work), []
    worker.answered.connect(answers.append)
    worker.request("first")
    assert begun.wait(10)
    worker.cancel()
    go.set()
    worker.request("second")
    qtbot.waitUntil(lambda: bool(answers))
    assert answers == ["second"]


def test_an_error_of_the_users_is_one_sentence(qtbot, made):
    def work(wish, is_old):
        raise UserError("That is no text: choose another.")

    worker = made(work)
    with qtbot.waitSignal(worker.failed) as failed:
        worker.request(1)
    assert failed.args == ["That is no text: choose another."]


def test_a_fault_of_ours_is_raised_where_the_log_sees_it(qtbot, made):
    def work(wish, is_old):
        raise ZeroDivisionError("ours")

    worker = made(work)
    with qtbot.captureExceptions() as faults:
        worker.request(1)
        qtbot.waitUntil(lambda: bool(faults))
    assert faults[0][0] is ZeroDivisionError

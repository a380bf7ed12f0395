"""Moving pictures become coarser when they take too long, and finer again when there is time."""

from app.preview.pace import BUDGET, SMALLEST, STEPS, Pace

SIZE = (800, 600)


def run(pace, seconds, count, what="faces"):
    for _ in range(count):
        size = pace.size(SIZE, what)
        pace.took(seconds)
    return size


def test_quick_pictures_stay_whole():
    assert run(Pace(), BUDGET / 2, 100) == SIZE


def test_slow_pictures_become_coarser_step_by_step_and_no_coarser_than_the_last():
    pace, seen = Pace(), []
    for _ in range(100):
        seen.append(pace.size(SIZE, "faces")[0] / SIZE[0])
        pace.took(BUDGET * 2)
    assert list(dict.fromkeys(seen)) == list(STEPS)
    assert seen[:5] == [1.0] * 5, "one slow picture means nothing"


def test_one_slow_picture_among_many_changes_nothing():
    pace = Pace()
    for _ in range(20):
        run(pace, BUDGET / 2, 4)
        assert run(pace, BUDGET * 20, 1) == SIZE


def test_when_there_is_time_again_it_becomes_finer():
    pace = Pace()
    coarse = run(pace, BUDGET * 2, 8)
    assert coarse < SIZE
    assert run(pace, BUDGET * 0.3, 200) == SIZE


def test_between_the_two_it_stays_where_it_is():
    pace = Pace()
    run(pace, BUDGET * 2, 7)
    coarse = run(pace, BUDGET * 0.8, 1)
    assert run(pace, BUDGET * 0.8, 300) == coarse


def test_other_faces_begin_whole():
    pace = Pace()
    run(pace, BUDGET * 2, 8)
    assert pace.size(SIZE, "other faces") == SIZE


def test_small_pictures_are_never_made_smaller():
    pace = Pace()
    for _ in range(50):
        assert pace.size((300, SMALLEST), "faces") == (300, SMALLEST)
        pace.took(1.0)
    assert min(pace.size((900, 240), "faces")) >= SMALLEST

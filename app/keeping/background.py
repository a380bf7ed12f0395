"""Slow work beside the window: it goes on painting, and waits with the user's next word until the work is done."""

from __future__ import annotations

import threading
from collections.abc import Callable

from PySide6.QtCore import QEventLoop, QObject, Qt, Signal


class _Done(QObject):
    done = Signal()


def in_background(work: Callable[[], object]) -> None:
    """Run `work` in a thread and return when it is done, raising what it raised. Keys and clicks wait till then."""
    failure: list[BaseException] = []
    loop, news = QEventLoop(), _Done()
    news.done.connect(loop.quit, Qt.ConnectionType.QueuedConnection)

    def run() -> None:
        try:
            work()
        except BaseException as error:  # noqa: BLE001 - it is raised again where it belongs
            failure.append(error)
        finally:
            news.done.emit()

    thread = threading.Thread(target=run, name="saving")
    thread.start()
    loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
    thread.join()
    if failure:
        raise failure[0]

"""Work on a thread of its own, of which only the newest wish counts."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal, Slot

from core_pipeline.errors import UserError

#: (wish, whether it has become old meanwhile) → answer; None when it gave up because it had.
Work = Callable[[Any, Callable[[], bool]], Any]


class Latest(QObject):
    """Answers each `request` with `answered` or `failed`, unless a newer one came. Call `stop` at the end.

    answered(answer), failed(sentence)
    """

    answered = Signal(object)
    failed = Signal(str)
    _done = Signal(int, object)  # number of the request; answer or exception

    def __init__(self, name: str, work: Work, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._work = work
        self._number = 0
        self._wish: tuple[int, Any] | None = None
        self._stopped = False
        self._changed = threading.Condition()
        self._done.connect(self._deliver, Qt.ConnectionType.QueuedConnection)
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def request(self, wish: Any) -> None:
        """Work on this; earlier requests are given up."""
        with self._changed:
            self._number += 1
            self._wish = (self._number, wish)
            self._changed.notify()

    def cancel(self) -> None:
        """Give up what is under way."""
        with self._changed:
            self._number += 1
            self._wish = None

    def stop(self) -> None:
        """End the thread; nothing is emitted afterwards."""
        with self._changed:
            self._number += 1
            self._wish, self._stopped = None, True
            self._changed.notify()
        self._thread.join(5)

    def _run(self) -> None:
        while wish := self._next():
            number, what = wish

            def is_old(number: int = number) -> bool:
                return number != self._number

            answer: object
            try:
                answer = self._work(what, is_old)
            except Exception as error:  # noqa: BLE001 - told or raised on the thread of the interface
                answer = error
            if not is_old():
                self._done.emit(number, answer)

    def _next(self) -> tuple[int, Any] | None:
        """Wait for the newest request; None at the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._wish or self._stopped)
            wish, self._wish = self._wish, None
            return wish

    @Slot(int, object)
    def _deliver(self, number: int, answer: object) -> None:
        if number != self._number or self._stopped:
            return
        if isinstance(answer, UserError):
            self.failed.emit(str(answer))
        elif isinstance(answer, Exception):
            raise answer
        else:
            self.answered.emit(answer)

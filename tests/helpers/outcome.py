"""What an act on bad input came to: its result, or the sentence it was refused with."""

from collections.abc import Callable
from typing import TypeVar

from core_pipeline.errors import UserError

T = TypeVar("T")


def outcome(act: Callable[[], T]) -> tuple[T | None, str]:
    """(result, "") or (None, the sentence). Any other exception is a fault of ours."""
    try:
        return act(), ""
    except UserError as error:
        return None, str(error)

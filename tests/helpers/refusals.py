"""What a user is told, for tests that throw anything at a reader."""

from __future__ import annotations

from collections.abc import Callable

from core_pipeline.errors import UserError


def told(read: Callable[[], object]) -> str | None:
    """The sentence with which something is refused; None when it is taken. Any other exception goes through."""
    try:
        read()
    except UserError as error:
        return str(error)
    return None

"""The editor of the end-to-end tests, for measuring it."""

from tests.end_to_end.conftest import editor

__all__ = ["editor"]

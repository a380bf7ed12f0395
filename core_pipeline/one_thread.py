"""Linear algebra on one thread: on matrices as small as ours those of OpenBLAS cost ten times what they save."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def one_thread() -> Iterator[None]:
    """Until the block ends, BLAS works on the caller's thread alone."""
    from threadpoolctl import threadpool_limits

    with threadpool_limits(limits=1, user_api="blas"):
        yield

"""The same work on a Dask cluster, whose workers have Lipstitch and see the same files at the same places."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from core_pipeline.errors import UserError
from core_pipeline.files.json_text import shown

from .batch_job import Done, Job, run

#: Seconds to wait for the scheduler.
_TIMEOUT = 20


def run_on_cluster(jobs: Sequence[Job], address: str) -> Iterator[Done]:
    """Each job's outcome, as they come. UserError when the cluster cannot be reached."""
    try:
        from distributed import Client, as_completed
    except ImportError:
        raise UserError("--dask needs the package distributed: pip install distributed.") from None
    try:
        client = Client(address, timeout=_TIMEOUT)  # type: ignore[no-untyped-call]
    except (OSError, ValueError, TypeError) as error:
        raise UserError(f"No Dask scheduler answers at {shown(address)} ({shown(str(error), 100)}).") from None
    with client:
        futures = {client.submit(run, job, pure=False): job for job in jobs}
        for future in as_completed(list(futures)):  # type: ignore[no-untyped-call]
            failure = future.exception()
            job = futures[future]
            yield future.result() if failure is None else Done(job.name, job.line, f"The cluster failed: {failure}")

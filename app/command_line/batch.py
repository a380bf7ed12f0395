"""`lipstitch batch`: a table of sentences, recordings and label files becomes weights, many at a time.

A line counts as done when its file of weights is there and neither the line nor what it names has
changed; the journal in the folder knows. So a run that was interrupted goes on where it stopped.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import io
import json
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from pathlib import Path

from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json, manifest_csv
from core_pipeline.files.atomic import write_atomically
from core_pipeline.speech.intake import Source

from .. import resources
from .batch_job import Done, Job, ignore_interrupts, moved, run
from .progress import Progress
from .steps import make_folder, tell

JOURNAL, FAILURES = "batch-done.jsonl", "batch-failures.csv"
#: A line whose process died so often is given up.
_DEATHS = 2


def batch(options: argparse.Namespace) -> int:
    """All lines of a manifest; 1 when some failed, and a report says which and why."""
    if not 1 <= options.fps <= 1000:
        raise UserError(f"{options.fps:g} frames per second is not possible: choose 1 to 1000 for --fps.")
    if options.workers is not None and not 1 <= options.workers <= 512:
        raise UserError(f"{options.workers} workers are not possible: choose 1 to 512.")
    jobs = _jobs(options)
    make_folder(options.out)
    journal = options.out / JOURNAL
    prints = {job.name: _fingerprint(job) for job in jobs}
    finished = {} if options.again else _read(journal)
    waiting = [job for job in jobs if not (finished.get(job.name) == prints[job.name] and job.out.is_file())]
    skipped = len(jobs) - len(waiting)
    failures: list[Done] = []
    seconds = 0.0
    with Progress(len(jobs), "lines") as progress, journal.open("a", encoding="utf-8") as log:
        progress.step(skipped)
        for count, done in enumerate(_work(waiting, options), skipped + 1):
            if done.problem:
                failures.append(done)
            else:
                log.write(json.dumps([done.name, prints[done.name]]) + "\n")
                log.flush()
                seconds += done.speech_seconds
            progress.step(count)
    _report(options.out / FAILURES, failures)
    new = len(waiting) - len(failures)
    before = f", {skipped} were done before" if skipped else ""
    print(f"{new} of {len(jobs)} lines baked ({seconds:.1f} s of speech){before}; {len(failures)} failed.")
    if failures:
        tell(f"what failed, and why, is in {options.out / FAILURES}")
    return 1 if failures else 0


def _jobs(options: argparse.Namespace) -> list[Job]:
    folder = options.manifest.absolute().parent
    out, curves = options.out.absolute(), (options.curves or resources.english_curves()).absolute()
    curve_set_json.load(curves)  # refuse it once, not on every line
    jobs = []
    for row in manifest_csv.load(options.manifest):
        cells = row.cells
        source = Source(
            text=cells["text"],
            audio=Path(cells["audio"]) if cells["audio"] else None,
            transcript=cells["transcript"],
            labels=Path(cells["labels"]) if cells["labels"] else None,
            voice=cells["voice"] or "en-us",
        )
        target = out / f"{row.name}.{options.format}"
        said = moved(source, folder)
        jobs.append(Job(row.name, row.line, said, target, curves, options.preset, options.fps, options.textgrids))
    return jobs


def _fingerprint(job: Job) -> str:
    """Of the line, the options, and the size and time of every file that is read."""
    parts: list[object] = [job]
    for path in (job.source.audio, job.source.labels, Path(job.source.transcript), job.curves):
        try:
            info = path.stat() if path is not None and str(path) not in ("", ".") else None
        except (OSError, ValueError):
            info = None
        parts.append((info.st_size, info.st_mtime_ns) if info is not None else None)
    return hashlib.sha256(repr(parts).encode("utf-8", "surrogatepass")).hexdigest()[:32]


def _read(journal: Path) -> dict[str, str]:
    """Name → fingerprint of what was done; a line cut off by an interruption is not done."""
    found: dict[str, str] = {}
    try:
        lines = journal.read_text("utf-8", "replace").splitlines()
    except OSError:
        return found
    for line in lines:
        try:
            name, mark = json.loads(line)
        except (ValueError, TypeError, RecursionError):
            continue
        found[str(name)] = str(mark)
    return found


def _work(jobs: Sequence[Job], options: argparse.Namespace) -> Iterator[Done]:
    """Each job's outcome, as they come."""
    if options.dask:
        from .batch_dask import run_on_cluster

        yield from run_on_cluster(jobs, options.dask)
        return
    workers = min(options.workers or os.cpu_count() or 1, max(1, len(jobs)))
    deaths: dict[str, int] = {}
    while jobs:
        again: list[Job] = []
        with ProcessPoolExecutor(workers, get_context("spawn"), initializer=ignore_interrupts) as pool:
            waiting: dict[Future[Done], Job] = {pool.submit(run, job): job for job in jobs}
            try:
                for future in as_completed(waiting):
                    try:
                        yield future.result()
                    except BrokenProcessPool:  # one of its processes died: whose line it was is not known
                        again.append(waiting[future])
            except (KeyboardInterrupt, GeneratorExit):
                processes = list(pool._processes.values())  # or they would finish their lines first
                pool.shutdown(wait=False, cancel_futures=True)
                for process in processes:
                    process.terminate()
                raise
        for job in again:
            deaths[job.name] = deaths.get(job.name, 0) + 1
        for job in again:
            if deaths[job.name] >= _DEATHS:
                yield Done(job.name, job.line, "The process that worked on it died twice: is there enough memory?")
        jobs = [job for job in again if deaths[job.name] < _DEATHS]
        workers = 1  # so that only the line that kills a process is blamed


def _report(path: Path, failures: Sequence[Done]) -> None:
    """One table of all that failed; none when nothing did."""
    if not failures:
        path.unlink(missing_ok=True)
        return
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(["line", "name", "problem"])
    table.writerows((done.line, done.name, done.problem) for done in sorted(failures, key=lambda d: d.line))
    write_atomically(path, out.getvalue())

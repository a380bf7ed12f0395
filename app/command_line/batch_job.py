"""One line of a batch: done by a process of the pool, or by a worker of a Dask cluster."""

from __future__ import annotations

import signal
import time
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from core_pipeline import pipeline
from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json, weights_files
from core_pipeline.files.labels import textgrid
from core_pipeline.settings import PRESETS
from core_pipeline.speech.intake import Intake, Source
from core_pipeline.weights import bake

#: Frames; nine hours at 30 a second.
MAX_FRAMES = 1_000_000


@dataclass(frozen=True)
class Job:
    """What to say, with what curves, and where the weights go. All paths are absolute."""

    name: str
    line: int
    source: Source
    out: Path
    curves: Path
    preset: str | None
    fps: float
    textgrid: bool


@dataclass(frozen=True)
class Done:
    """problem: one sentence, "" when all went well. seconds: of speech, and of work."""

    name: str
    line: int
    problem: str = ""
    notes: tuple[str, ...] = ()
    speech_seconds: float = 0.0
    work_seconds: float = 0.0


def ignore_interrupts() -> None:
    """For processes of the pool: Ctrl+C is for the one that started them."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def run(job: Job) -> Done:
    """Speak or align, bake, write. Whatever goes wrong with this line is told, never raised."""
    begin = time.perf_counter()
    try:
        curve_set = _curves(job.curves, job.preset)
        utterance = _intake().utter(job.source, [*curve_set.phonemes, *curve_set.phoneme_map])
        schedule = utterance.schedule
        if schedule.duration * job.fps > MAX_FRAMES:
            raise UserError(f"{schedule.duration:g} s at {job.fps:g} frames per second are too many frames.")
        stages = pipeline.run(schedule, curve_set)
        weights = bake(stages.magenta, curve_set.effective_settings.spline, job.fps)
        if job.textgrid:
            textgrid.save(job.out.with_suffix(".TextGrid"), schedule, utterance.words)
        weights_files.save(weights, job.out)  # last: it says that the line is done
    except UserError as error:
        return Done(job.name, job.line, str(error))
    except MemoryError:
        return Done(job.name, job.line, "There is not enough memory for this recording: cut it, or use fewer workers.")
    except Exception as error:  # noqa: BLE001 - a fault of ours must not end the other lines
        return Done(job.name, job.line, f"A fault of Lipstitch's own: {type(error).__name__}: {error}")
    work = time.perf_counter() - begin
    return Done(job.name, job.line, "", utterance.notes, schedule.duration, work)


@cache
def _intake() -> Intake:
    """Voice and ears of this process, warm until it ends."""
    return Intake()


@cache
def _curves(path: Path, preset: str | None) -> CurveSet:
    curve_set = curve_set_json.load(path)
    return curve_set.with_settings(PRESETS[preset]) if preset else curve_set


def moved(source: Source, folder: Path) -> Source:
    """With paths that stood relative to `folder`."""
    return replace(
        source,
        audio=folder / source.audio if source.audio else None,
        labels=folder / source.labels if source.labels else None,
        transcript=str(folder / source.transcript) if _is_file_name(source.transcript) else source.transcript,
    )


def _is_file_name(transcript: str) -> bool:
    return transcript.lower().endswith(".txt") and "\n" not in transcript

"""`lipstitch convert`, `diff` and `merge`: curve sets from and for others."""

from __future__ import annotations

import argparse
from pathlib import Path

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.atomic import read_bytes, write_atomically
from core_pipeline.files.curve_set_diff import differences
from core_pipeline.files.curve_set_merge import merge as merged
from core_pipeline.files.json_text import shown
from core_pipeline.files.smartbody_read import import_set
from core_pipeline.files.smartbody_script import read_script
from core_pipeline.files.smartbody_write import script

from .steps import tell


def convert(options: argparse.Namespace) -> int:
    """A script or a curve set → a curve set or a script; every repair is told."""
    source: Path = options.source
    target: Path = options.target
    if target.exists() and source.exists() and target.samefile(source):
        raise UserError(f"{target} would be overwritten while it is read: name another file.")
    if target.suffix.lower() not in (".json", ".py"):
        raise UserError(f"{target} tells no format: end its name in .json, .min.json or .py.")
    if source.suffix.lower() == ".json":
        if options.set is not None:
            raise UserError("--set chooses a set of a diphone script: leave it out for a curve set.")
        curve_set, report = _read(source)
    else:
        done = import_set(read_script(source), options.set)
        curve_set, report = done.curve_set, done.report
    for line in report:
        tell(shown(line, 2000))
    small = target.name.lower().endswith(".min.json")
    if options.flat or small:
        curve_set = curve_set.flattened()
    if target.suffix.lower() == ".py":
        write_atomically(target, script(curve_set))
        tell("a diphone script holds curves only: statuses, notes and settings stay behind.")
    else:
        _write(curve_set, source, target, minified=small)
    print(f"{target}: {len(curve_set.bigrams)} bigrams.")
    return 0


def diff(options: argparse.Namespace) -> int:
    """One line per difference from A to B."""
    (first, told), (second, told_too) = _read(options.first), _read(options.second)
    for line in (*told, *told_too):
        tell(shown(line, 2000))
    lines = differences(first, second)
    for line in lines:
        print(shown(line, 2000))
    return 1 if lines else 0


def merge(options: argparse.Namespace) -> int:
    """Three curve sets → one, marked where both sides changed the same."""
    folder = options.path.parent if options.path is not None else None
    base, ours, theirs = (_read(p, folder)[0] for p in (options.base, options.ours, options.theirs))
    done = merged(base, ours, theirs)
    target = options.out or options.ours
    if options.path is None:
        _write(done.curve_set, options.ours, target)
    else:  # git's own copies lie elsewhere for a moment
        write_atomically(target, curve_set_json.dumps(done.curve_set))
    for line in done.conflicts:
        tell(shown(f"conflict: {line}; ours stays, theirs is kept beside it.", 2000))
    return 1 if done.conflicts else 0


def _read(path: Path, folder: Path | None = None) -> tuple[CurveSet, tuple[str, ...]]:
    """The set and the repairs made; an empty file, git's word for "there was none", is a set without anything."""
    data = read_bytes(path, curve_set_json.MAX_BYTES, "curve set")
    if not data:
        return CurveSet(phonemes=(), poses=(), phoneme_map={}), ()
    reading = curve_set_json.parse(data, str(path), folder or path.parent)
    if reading.newer:
        raise UserError(f"{path} was written by a newer Lipstitch, which this one may misread: update first.")
    return reading.curve_set, reading.repairs


def _write(curve_set: CurveSet, source: Path, target: Path, *, minified: bool = False) -> None:
    """Save, with a base that is found from the new place too."""
    placed = curve_set_json.moved(curve_set, source.parent, target.parent)
    write_atomically(target, curve_set_json.dumps(placed, minified=minified))

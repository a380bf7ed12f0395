"""Learned models as .npz: a JSON header as bytes, and the arrays of the model.

    header   {"schema": "lipstitch.Model.1", "kind": "dam", "poses": […], "phones": […], "phone_map": {…}, "about": {…}}
    others   the fields of the model, such as coefficients and sigma

A model fits one pose set and one phoneme set; `check` says by name what another one lacks.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..methods.animpho import AnimPho
from ..methods.animpho_select import SELECTIONS
from ..methods.dam import Dam
from ..methods.method import check_phones, columns_of
from ..methods.modes import ModeTable
from ..methods.segments import SAMPLES
from ..methods.visemes import Visemes
from .atomic import read_bytes, write_atomically
from .json_text import decode_json
from .npz import MAX_BYTES, pack, unpack

SCHEMA = "lipstitch.Model.1"
MAX_NAMES = 400

Model = Dam | AnimPho | Visemes
Arrays = Mapping[str, NDArray[Any]]


class Header(msgspec.Struct):
    """What stands in the header; `about` is for people: how many clips, how long, how good."""

    schema: str
    kind: str
    poses: list[str]
    phones: list[str]
    phone_map: dict[str, str]
    about: dict[str, Any] = {}
    selection: str = "priority"


@dataclass(frozen=True, eq=False)
class ModelFile:
    """A model and what its header says about its making."""

    model: Model
    about: Mapping[str, Any]


def save(model: Model, path: Path | str, about: Mapping[str, Any] | None = None) -> None:
    """Write the model atomically; UserError when that fails, and then nothing is half written."""
    write_atomically(path, dumps(model, about))


def dumps(model: Model, about: Mapping[str, Any] | None = None) -> bytes:
    """The file's bytes."""
    kind, arrays = _arrays_of(model)
    header: dict[str, Any] = {
        "schema": SCHEMA,
        "kind": kind,
        "poses": list(model.poses),
        "phones": list(model.phones),
        "phone_map": dict(model.phone_map),
        "about": dict(about or {}),
    }
    if isinstance(model, AnimPho):
        header["selection"] = model.selection
    text = json.dumps(header, ensure_ascii=False).encode("utf-8")
    return pack({"header": np.frombuffer(text, np.uint8), **arrays})


def load(path: Path | str) -> Model:
    """The model in a file; UserError when it is none, or damaged."""
    return read(path).model


def read(path: Path | str) -> ModelFile:
    """The model in a file and what is said about it; UserError when it is none, or damaged."""
    return parse(read_bytes(path, MAX_BYTES, "model"), str(path))


def parse(data: bytes, place: str) -> ModelFile:
    """As `read`, from bytes; `place` names the file in messages."""
    arrays = unpack(data, place)
    text = arrays.pop("header", None)
    if text is None or text.dtype != np.uint8 or text.ndim != 1:
        raise UserError(f"{place} has no header: it is not a model of ours. Choose another file.")
    top = decode_json(text.tobytes(), f"{place}, header")
    if top.get("schema") != SCHEMA:
        raise UserError(f'{place} is not a model: its header should say "schema": "{SCHEMA}". Choose another file.')
    try:
        header = msgspec.convert(top, Header)
    except msgspec.ValidationError as error:
        raise UserError(f"{place}, header: {str(error)[:200].lower()}. Learn the model again.") from error
    _check_names(header, place)
    make = _MAKERS.get(header.kind)
    if make is None:
        raise UserError(f"{place} holds a model of an unknown kind ({header.kind[:40]!r}): use a newer Lipstitch.")
    return ModelFile(make(header, Checked(arrays, place)), header.about)


def check(model: Model, poses: Sequence[str], phonemes: Sequence[str], what: str = "This model") -> None:
    """UserError, with names, unless the model can make these poses from these phonemes."""
    columns_of(model.poses, poses)
    check_phones(model.phones, phonemes, what)


class Checked:
    """Arrays of a file, given out only with the right type and shape."""

    def __init__(self, arrays: Arrays, place: str) -> None:
        self._arrays = arrays
        self._place = place

    def fail(self, what: str) -> UserError:
        """The error to raise about this file."""
        return UserError(f"{self._place}: {what}. Learn the model again.")

    def take(self, name: str, dtype: type, *shape: int | None, low: float = -1e6, high: float = 1e6) -> NDArray[Any]:
        """An array of exactly this type, with as many sides; a side of None may be any length above 0."""
        array = self._arrays.get(name)
        if array is None or array.dtype != dtype or array.ndim != len(shape):
            raise self.fail(f"“{name}” is missing or not as it should be")
        if any(want is not None and have != want for have, want in zip(array.shape, shape, strict=True)) or any(
            want is None and not have for have, want in zip(array.shape, shape, strict=True)
        ):
            raise self.fail(f"“{name}” is {' × '.join(map(str, array.shape))}, which does not fit its poses and phones")
        if array.size and not (low <= array.min() and array.max() <= high):
            raise self.fail(f"“{name}” holds values outside {low:g} to {high:g}")
        return array


def _check_names(header: Header, place: str) -> None:
    for what, names in (("poses", header.poses), ("phones", header.phones)):
        odd = [n for n in names if not n or len(n) > 60 or not n.isprintable()]
        if not 1 <= len(names) <= MAX_NAMES or odd or len(set(names)) < len(names):
            raise UserError(f"{place}: the names of its {what} are not usable. Learn the model again.")


def _arrays_of(model: Model) -> tuple[str, dict[str, NDArray[Any]]]:
    if isinstance(model, Visemes):
        return "visemes", {"shapes": model.shapes}
    if isinstance(model, AnimPho):
        return "animpho", {"centres": model.centres, "follows": model.follows, "labels": model.labels}
    table = model.modes
    return "dam", {
        "first": model.first.astype(np.int64),
        "coefficients": model.coefficients,
        "sigma": model.sigma,
        "modes": np.stack([table.before, table.phone, table.after, table.mode, table.count], 1).astype(np.int64),
        "error": model.error,
    }


def _visemes(header: Header, arrays: Checked) -> Visemes:
    shapes = arrays.take("shapes", np.float64, len(header.phones) + 1, len(header.poses))
    return Visemes(tuple(header.poses), tuple(header.phones), header.phone_map, shapes)


def _animpho(header: Header, arrays: Checked) -> AnimPho:
    if header.selection not in SELECTIONS:
        raise arrays.fail(f"there is no selection {header.selection[:40]!r}")
    centres = arrays.take("centres", np.float64, None, SAMPLES, len(header.poses))
    m = len(centres)
    labels = arrays.take("labels", np.bool_, len(header.phones) + 1, m)
    if not labels.any(1).all():
        raise arrays.fail("a phone has no AnimPho")
    return AnimPho(
        tuple(header.poses),
        tuple(header.phones),
        header.phone_map,
        centres,
        arrays.take("follows", np.bool_, m, m),
        labels,
        header.selection,
    )


def _dam(header: Header, arrays: Checked) -> Dam:
    phones, poses = len(header.phones), len(header.poses)
    first = arrays.take("first", np.int64, phones + 2, low=0)
    if first[0] != 0 or (np.diff(first) < 1).any() or first[-1] != first[-2] + 1:
        raise arrays.fail("its modes are not counted as they should be")
    states = int(first[-1])
    coefficients = arrays.take("coefficients", np.float64, states, None, poses)
    if coefficients.shape[1] > 9:
        raise arrays.fail("its polynomials are of a higher degree than 8")
    modes = arrays.take("modes", np.int64, None, 5, low=-1)
    before, phone, after, mode, count = (np.ascontiguousarray(column).astype(np.intp) for column in modes.T)
    inside = (phone >= 0) & (phone < phones) & (before < phones) & (after < phones) & (mode >= 0) & (count > 0)
    if not inside.all() or (mode >= np.diff(first)[phone]).any():
        raise arrays.fail("its modes are not those of its phones")
    return Dam(
        tuple(header.poses),
        tuple(header.phones),
        header.phone_map,
        first.astype(np.intp),
        coefficients,
        arrays.take("sigma", np.float64, states, poses, low=1e-3, high=100.0),
        ModeTable(before, phone, after, mode, count),
        arrays.take("error", np.float64, poses, low=0.0),
    )


_MAKERS: Mapping[str, Callable[[Header, Checked], Model]] = {"visemes": _visemes, "animpho": _animpho, "dam": _dam}

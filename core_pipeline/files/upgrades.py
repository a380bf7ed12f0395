"""Old curve-set files → the present version: one step a version, applied one after the other.

A step takes the file's top object as its version wrote it and gives it as the next one writes it. An old file of
every version stays in tests/data/curve_sets for ever.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from ..errors import UserError
from .curve_set_records import SCHEMA, VERSION

Step = Callable[[dict[str, Any]], dict[str, Any]]

#: Version → the step to the one after it. Version 1 is the first.
STEPS: Mapping[int, Step] = {}


def version_of(top: Mapping[str, Any], place: str) -> int:
    """The version that wrote the file; UserError when it is no curve set at all."""
    schema = top.get("schema")
    match = re.fullmatch(r"lipstitch\.CurveSet\.(\d{1,6})", schema, re.ASCII) if isinstance(schema, str) else None
    if match is None or int(match[1]) < 1:
        raise UserError(f'{place} is not a curve set: it should say "schema": "{SCHEMA}". Choose another file.')
    return int(match[1])


def upgraded(top: dict[str, Any], version: int, steps: Mapping[int, Step] = STEPS, to: int = VERSION) -> dict[str, Any]:
    """The top object as version `to` writes it. That of a newer version comes back as it is."""
    for old in range(version, to):
        top = steps[old](top)
    return top

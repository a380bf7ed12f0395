"""Bytes to checked JSON values: any encoding an editor may have saved, no doubled names, no NaN, no bombs."""

from __future__ import annotations

import codecs
import json
import math
from typing import Any

from ..errors import UserError


class DoubledNameError(ValueError):
    """An object names the same thing twice."""


class NotFiniteError(ValueError):
    """NaN or Infinity, which JSON does not have, or a number too large for any computer."""


def decode_json(data: bytes, place: str) -> dict[str, Any]:
    """The top object of a JSON file; UserError names place, line and cure.

    UTF-8 with or without BOM, and UTF-16 with BOM, are read.
    """
    text = decode_text(data, place)
    try:
        value = json.loads(text, object_pairs_hook=_no_doubles, parse_constant=_no_constant, parse_float=_finite)
    except json.JSONDecodeError as error:
        raise UserError(
            f"{place} is damaged at line {error.lineno}, column {error.colno}: {error.msg.lower()}. "
            "Mend that line or go back to a backup."
        ) from error
    except DoubledNameError as error:
        raise UserError(f"{place} names {error} twice in one object: remove one of the two.") from error
    except RecursionError as error:
        raise UserError(f"{place} is nested too deeply to be one of our files: choose another.") from error
    except NotFiniteError as error:
        raise UserError(f"{place} holds {error}: write a finite number there.") from error
    except ValueError as error:
        raise UserError(f"{place} holds a number of thousands of digits: write a shorter one.") from error
    if "\\ud" in text.lower():  # half a surrogate pair could be read but never written again
        try:
            json.dumps(value, ensure_ascii=False).encode("utf-8")
        except UnicodeEncodeError as error:
            raise UserError(f"{place} holds half a character (\\ud8…): remove it.") from error
    if not isinstance(value, dict):
        raise UserError(f"{place} does not begin with an object {{…}}: it is not one of our files.")
    return value


def decode_text(data: bytes, place: str) -> str:
    """The text of a file in UTF-8, with or without BOM, or UTF-16 with BOM; UserError when it is none."""
    encoding = "utf-8-sig"
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encoding = "utf-16"
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise UserError(f"{place} is not text in UTF-8 (byte {error.start}): choose another file.") from error


def _no_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        seen: set[str] = set()
        for name, _ in pairs:
            if name in seen:
                raise DoubledNameError(repr(name[:60]))
            seen.add(name)
    return found


def _no_constant(name: str) -> float:
    raise NotFiniteError(name)


def _finite(text: str) -> float:
    """1e999 would be read as infinity, and could not be written again."""
    value = float(text)
    if not math.isfinite(value):
        raise NotFiniteError(text[:40])
    return value


def shown(text: str, length: int = 40) -> str:
    """A name from a file, fit for a message of one line: short, line ends and control characters escaped."""
    short = text if len(text) <= length else text[: length - 1] + "…"
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in short)


def is_deeper(value: Any, levels: int) -> bool:
    """Whether lists and objects are nested more than `levels` deep."""
    layer = [value]
    for _ in range(levels + 1):
        nested = (v for v in layer if isinstance(v, dict | list))
        layer = [item for v in nested for item in (v.values() if isinstance(v, dict) else v)]
        if not layer:
            return False
    return True

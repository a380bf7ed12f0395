"""The `settings` part of a curve-set file: windows, constraints, priorities, l_max, spline."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import msgspec

from ..errors import UserError
from ..settings import Constraint, Settings


class SettingsRecord(msgspec.Struct):
    """As the file holds it; every field may be missing and is then that of the preset "Paper"."""

    window: float | None = None
    windows: dict[str, float] | None = None
    constraints: list[tuple[str, str, float]] | None = None
    priorities: list[str] | None = None
    l_max: float | None = None
    spline: str | None = None


def decode_settings(value: Any, place: str) -> Settings:
    """Settings from the file's object; UserError names the place."""
    try:
        record = msgspec.convert(value, SettingsRecord)
        default = Settings.paper()
        return Settings(
            window=default.window if record.window is None else record.window,
            windows=default.windows if record.windows is None else record.windows,
            constraints=default.constraints
            if record.constraints is None
            else tuple(Constraint(a, b, limit) for a, b, limit in record.constraints),
            priorities=default.priorities if record.priorities is None else tuple(record.priorities),
            speed_limit=default.speed_limit if record.l_max is None else record.l_max,
            spline=default.spline if record.spline is None else record.spline,
        )
    except msgspec.ValidationError as error:
        raise UserError(f"{place}, settings: {str(error)[:200].lower()}. Correct that value.") from error
    except UserError as error:
        raise UserError(f"{place}, settings: {error}") from error


def unknown_fields(value: dict[str, Any]) -> dict[str, Any]:
    """What the file's object holds beyond what this version knows."""
    return {name: v for name, v in value.items() if name not in SettingsRecord.__struct_fields__}


def encode_settings(settings: Settings, extra: Mapping[str, Any]) -> str:
    """The object as text, one constraint a line, indented for its place in the file; then the unknown fields."""
    rows = ",\n".join(f"      [{_text(c.a)}, {_text(c.b)}, {number(c.limit)}]" for c in settings.constraints)
    windows = ", ".join(f"{_text(pose)}: {number(width)}" for pose, width in settings.windows.items())
    more = "".join(f",\n    {_text(name)}: {_text(value)}" for name, value in extra.items())
    return (
        "{\n"
        f'    "window": {number(settings.window)},\n'
        f'    "windows": {{{windows}}},\n'
        f'    "constraints": [{chr(10) + rows + chr(10) + "    " if rows else ""}],\n'
        f'    "priorities": {_text(list(settings.priorities))},\n'
        f'    "l_max": {number(settings.speed_limit)},\n'
        f'    "spline": {_text(settings.spline)}{more}\n'
        "  }"
    )


def number(value: float) -> str:
    """At most four decimals, no trailing zeros: 0.5, 1, 0.0123."""
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _text(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)

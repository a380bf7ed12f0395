"""What is typed into a field of values: “.3”, “=.3”, “*0.5”, “/2”, “+0.1”, “50%”, chains: “*0.5 -0.1”. No Qt."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import isfinite

from .canvas.curve_geometry import Array

_STEP = re.compile(r"\s*([=*/+\-−×]?)\s*([0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)\s*(%?)\s*")


@dataclass(frozen=True)
class Typed:
    """A change of numbers, step by step: each an operator, one of "=", "*", "+", and any finite number."""

    steps: tuple[tuple[str, float], ...]

    def of(self, values: Array) -> Array:
        """The values after it."""
        for operator, number in self.steps:
            if operator == "*":
                values = values * number
            elif operator == "+":
                values = values + number
            else:
                values = values * 0.0 + number
        return values


def parse_typed(text: str) -> Typed | None:
    """What a text asks for, None when it is none of these.

    A plain number sets; “-0.1” takes away, because no time or weight is below 0. Several in a row act one
    after the other: “*0.5 +0.1”.
    """
    steps: list[tuple[str, float]] = []
    at = 0
    while at < len(text) or not steps:
        match = _STEP.match(text, at)
        if match is None or (steps and not match[1]):
            return None
        step = _step(*match.groups())
        if step is None:
            return None
        steps.append(step)
        at = match.end()
    return Typed(tuple(steps))


def _step(sign: str, digits: str, percent: str) -> tuple[str, float] | None:
    number = float(digits.replace(",", ".")) / (100.0 if percent else 1.0)
    if sign == "/":
        sign, number = "*", 1.0 / number if number else float("inf")
    elif sign in ("-", "−"):
        sign, number = "+", -number
    return ({"": "=", "×": "*"}.get(sign, sign), number) if isfinite(number) else None

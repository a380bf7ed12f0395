"""What is typed into a field of values: “.3”, “=.3”, “*0.5”, “/2”, “+0.1”, “-0.1”, “50%”. No Qt."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import isfinite

from .canvas.curve_geometry import Array

_FORM = re.compile(r"\s*([=*/+\-−×]?)\s*([0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)\s*(%?)\s*")


@dataclass(frozen=True)
class Typed:
    """A change of numbers: `operator` is one of "=", "*", "+"; number is any finite one."""

    operator: str
    number: float

    def of(self, values: Array) -> Array:
        """The values after it."""
        if self.operator == "*":
            return values * self.number
        if self.operator == "+":
            return values + self.number
        return values * 0.0 + self.number


def parse_typed(text: str) -> Typed | None:
    """What a text asks for, None when it is none of these.

    A plain number sets; “-0.1” takes away, because no time or weight is below 0.
    """
    match = _FORM.fullmatch(text)
    if match is None:
        return None
    sign, digits, percent = match.groups()
    number = float(digits.replace(",", ".")) / (100.0 if percent else 1.0)
    if sign == "/":
        sign, number = "*", 1.0 / number if number else float("inf")
    elif sign in ("-", "−"):
        sign, number = "+", -number
    if not isfinite(number):
        return None
    return Typed({"": "=", "×": "*"}.get(sign, sign), number)

"""Numbers as English words, for speech without espeak-ng."""

from __future__ import annotations

_SMALL = [
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"),
    *("thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"),
]
_TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")


def in_words(number: str) -> str:
    """ "1,250.5" → "one thousand two hundred fifty point five"; from a milliard on digit by digit."""
    whole, _, fraction = number.replace(",", "").partition(".")
    if len(whole) > 9 or (len(whole) > 1 and whole.startswith("0")):
        spoken = _digits(whole)
    else:
        spoken = _whole(int(whole))
    return f"{spoken} point {_digits(fraction)}" if fraction else spoken


def _digits(digits: str) -> str:
    return " ".join(_SMALL[int(digit)] for digit in digits)


def _whole(n: int) -> str:
    if n < 20:
        return _SMALL[n]
    if n < 100:
        return _TENS[n // 10 - 2] + (f" {_SMALL[n % 10]}" if n % 10 else "")
    for size, name in ((1_000_000, "million"), (1000, "thousand"), (100, "hundred")):
        if n >= size:
            return f"{_whole(n // size)} {name}" + (f" {_whole(n % size)}" if n % size else "")
    raise AssertionError(n)

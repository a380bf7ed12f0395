"""Phones: the 21 common phonemes and the map from the 40 English ones (section 3.1.1, table 1).

A phoneme set is data: a curve set carries its own list and map, so 441 = 21² is a consequence here
and never a constant.
"""

from collections.abc import Mapping
from types import MappingProxyType

SILENCE = "sil"

COMMON: tuple[str, ...] = (
    "ah", "aa", "ao", "eh", "er", "ih", "w", "ow", "aw", "oy", "ay",
    "h", "r", "l", "z", "sh", "th", "f", "d", "kg", "bmp",
)  # fmt: skip

_ROWS = {
    "ah": "ae ah ax", "aa": "aa", "ao": "ao", "eh": "ey eh", "er": "er", "ih": "ih iy",
    "w": "w uw uh", "ow": "ow", "aw": "aw", "oy": "oy", "ay": "ay", "h": "h hh", "r": "r",
    "l": "l", "z": "s z", "sh": "sh ch jh zh y", "th": "th dh", "f": "f v", "d": "d t n ng",
    "kg": "k g", "bmp": "p b m",
}  # fmt: skip

#: English phone (ARPAbet, lower case) → common phoneme. `hh` is ARPAbet's name for the paper's `h`.
TABLE_1: Mapping[str, str] = MappingProxyType(
    {phone: common for common, phones in _ROWS.items() for phone in phones.split()}
)

VOWELS = frozenset(["ah", "aa", "ao", "eh", "er", "ih", "w", "ow", "aw", "oy", "ay"])

#: A short word for each English phone, as table 1 gives them.
EXAMPLES: Mapping[str, str] = MappingProxyType(
    {
        "ah": "cat, cut, ago", "aa": "father", "ao": "dog", "eh": "ate, pet", "er": "fur",
        "ih": "feel, fill, debit", "w": "with, too, book", "ow": "go", "aw": "foul", "oy": "toy",
        "ay": "bite", "h": "help", "r": "red", "l": "lid", "z": "sit, zap",
        "sh": "she, chin, joy, pleasure, yard", "th": "thin, then", "f": "fork, vat",
        "d": "dig, talk, no, sing", "kg": "cut, gut", "bmp": "put, big, mat",
    }
)  # fmt: skip

#: The first and the second phone of a bigram.
Pair = tuple[str, str]


def pair_name(pair: Pair) -> str:
    """("f", "ah") → "f-ah", the name used in files."""
    return f"{pair[0]}-{pair[1]}"

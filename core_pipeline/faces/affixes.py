"""What all the shapes of a rig have before or after their names: the mesh, the tool, a number, and nothing of the name.

"head__jawOpen", "facs_bs_JawOpen_div2", "A25_Jaw_Open": exporters and artists put such things there, each their own.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

#: So many of the names must share an affix, and at least so many.
_MOST, _SEVERAL = 0.5, 3
#: No affix has more words.
_WORDS = 6
_BETWEEN = re.compile(r"[_\-\s]+")
_COUNTER = re.compile(r"[A-Za-z]?\d+")


def bare_names(names: Iterable[str]) -> dict[str, str]:
    """Name → what is left of it, for those of which something was taken off; the words of it joined by "_"."""
    words = {name: [word for word in _BETWEEN.split(name) if word] for name in names}
    enough = max(_MOST * len(words), _SEVERAL)
    counted = {name for name, parts in words.items() if len(parts) > 1 and _COUNTER.fullmatch(parts[0])}
    bare = {name: parts[1:] if len(counted) >= enough and name in counted else parts for name, parts in words.items()}
    before = _shared(bare.values(), enough)
    bare = {name: parts[len(before) :] if _begins(parts, before) else parts for name, parts in bare.items()}
    after = _shared((parts[::-1] for parts in bare.values()), enough)
    bare = {
        name: parts[: len(parts) - len(after)] if _begins(parts[::-1], after) else parts for name, parts in bare.items()
    }
    return {name: "_".join(parts) for name, parts in bare.items() if parts != words[name]}


def _shared(names: Iterable[list[str]], enough: float) -> list[str]:
    """The words that most names begin with, if enough do; as many as there are, but never a whole name."""
    counts = Counter(tuple(parts[:size]) for parts in names for size in range(1, min(len(parts), _WORDS + 1)))
    words, count = max(counts.items(), key=lambda item: (item[1], len(item[0])), default=((), 0))
    return list(words) if count >= enough else []


def _begins(parts: list[str], words: list[str]) -> bool:
    return bool(words) and len(parts) > len(words) and parts[: len(words)] == words

"""What the user typed → a text a voice can read."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from ..errors import UserError

#: Characters; about five minutes of speech.
LONGEST = 5000
FOREIGN = "Letters of another alphabet are not spoken as its readers would."


@dataclass(frozen=True)
class Sentence:
    """A text with at least one letter or digit, on one line; the notes say what was left out."""

    text: str
    notes: tuple[str, ...] = ()


def clean(text: str) -> Sentence:
    """Without control characters and pictures, blanks joined. UserError when nothing can be spoken."""
    blank = " ".join(unicodedata.normalize("NFC", text).split())
    kept = "".join(c for c in blank if not (_is_control(c) or _is_picture(c)))
    notes = []
    if any(_is_picture(c) for c in blank):
        notes.append("Emoji and other pictures are not spoken.")
    if any(_is_control(c) and c not in _JOINERS for c in blank):
        notes.append("Control characters were removed from the text.")
    kept = " ".join(kept.split())
    if not kept:
        raise UserError("There is nothing to say: type a sentence, such as “Hello there.”")
    if not any(c.isalnum() for c in kept):
        raise UserError(f"Nothing in “{shortened(kept)}” can be spoken: type at least one word.")
    if len(kept) > LONGEST:
        raise UserError(
            f"The text has {len(kept):,} characters, the longest that can be spoken is {LONGEST:,}: "
            "speak it in several parts."
        )
    if any(c.isalpha() and not unicodedata.name(c, "LATIN").startswith(("LATIN", "FULLWIDTH LATIN")) for c in kept):
        notes.append(FOREIGN)
    return Sentence(kept, tuple(notes))


def tokens(text: str) -> list[tuple[str, int, int]]:
    """The words between blanks: (without the punctuation around it, start, end) in characters of `text`."""
    found = []
    for match in re.finditer(r"\S+", text):
        word = re.sub(r"^[^\w$£€]+|[^\w%]+$", "", match[0])
        found.append((word or match[0], match.start(), match.end()))
    return found


def shortened(text: str, length: int = 40) -> str:
    """For a message: the beginning of a long text."""
    return text if len(text) <= length else text[: length - 1] + "…"


#: Part of emoji and of some scripts; nobody types them knowingly.
_JOINERS = "\u200b\u200c\u200d\ufeff"


def _is_control(c: str) -> bool:
    return unicodedata.category(c) in ("Cc", "Cf", "Co", "Cs", "Cn")


def _is_picture(c: str) -> bool:
    """Emoji with their skin tones, variation marks and key caps; not © or °, which a voice can read."""
    return (
        (unicodedata.category(c) == "So" and c >= "\u2190")
        or "\U0001f3fb" <= c <= "\U0001f3ff"
        or "\ufe00" <= c <= "\ufe0f"
        or c == "\u20e3"
    )

"""A script or any other text → the sentences to be spoken, one by one."""

from __future__ import annotations

import re
from pathlib import Path

from ..errors import UserError
from ..speech.sentence import LONGEST
from .atomic import read_bytes
from .json_text import decode_text

#: Far more than a feature film's dialogue.
MAX_BYTES = 2 * 2**20

#: After the end of a sentence, quotes and brackets included, where the next begins.
_END = re.compile(r"""([.!?…]["'”’)\]]*)\s+(?=["'“‘(\[]*[A-Z0-9])""")


def load(path: Path | str) -> list[str]:
    """The sentences of a text file; UserError when it cannot be read, is no text, or has nothing to say."""
    return sentences_of(read_bytes(path, MAX_BYTES, "text"), str(path))


def sentences_of(data: bytes, place: str) -> list[str]:
    """Every sentence with at least one letter or digit. Lines that begin with # are remarks.

    A line ends a sentence, unless the next begins with a small letter: then the text was only wrapped.
    """
    text = decode_text(data, place)
    if "\0" in text:
        raise UserError(f"{place} is not a text: choose a file with one sentence a line, such as a script.")
    paragraphs: list[str] = []
    open_ = False
    for line in text.splitlines():
        words = line.strip()
        if words.startswith("#") or not any(c.isalnum() for c in words):
            open_ = False
        elif open_ and words[0].islower() and not paragraphs[-1].endswith((".", "!", "?", "…")):
            paragraphs[-1] += f" {words}"
        else:
            paragraphs.append(words)
            open_ = True
    ended = (_END.sub(r"\1\n", paragraph).split("\n") for paragraph in paragraphs)
    pieces = (piece for sentences in ended for sentence in sentences for piece in _short(sentence))
    found = [piece for piece in pieces if any(c.isalnum() for c in piece)]
    if not found:
        raise UserError(f"{place} has no word in it: choose a file with one sentence a line, such as a script.")
    return found


def _short(sentence: str) -> list[str]:
    """In pieces that a voice can speak at once; only a text without any full stop needs more than one."""
    pieces = []
    while len(sentence) > LONGEST:
        cut = sentence.rfind(" ", 0, LONGEST)
        cut = cut if cut > 0 else LONGEST
        pieces.append(sentence[:cut])
        sentence = sentence[cut:].lstrip()
    return [*pieces, sentence]

"""Bytes of a label file, transcript or table → text, in whatever encoding its program wrote."""

from __future__ import annotations

import codecs

from ...errors import UserError

_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)


def decode(data: bytes, place: str, what: str = "label file") -> str:
    """Text with \\n as line end: by its byte order mark, else UTF-16 by its zeros, UTF-8, Latin-1.

    what  it should be, for the UserError when it is no text at all
    """
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return _lines(_decoded(data[len(mark) :], encoding, place))
    head = data[:4096]
    zeros = head.count(0)
    if zeros > len(head) / 4:
        return _lines(_decoded(data, "utf-16-le" if head[1::2].count(0) > head[::2].count(0) else "utf-16-be", place))
    if zeros:
        raise UserError(f"{place} is no {what} (it is not text): choose another file.")
    try:
        return _lines(data.decode("utf-8"))
    except UnicodeDecodeError:
        return _lines(data.decode("latin-1"))


def _decoded(data: bytes, encoding: str, place: str) -> str:
    try:
        return data.decode(encoding)
    except UnicodeDecodeError:
        if encoding.startswith("utf-16"):  # cut in the middle of a character
            return data.decode(encoding, "ignore")
        raise UserError(f"{place} is damaged: it is not the {encoding.upper()} it claims to be.") from None


def _lines(text: str) -> str:
    return text.replace("\r\n", "\n").replace("\r", "\n")

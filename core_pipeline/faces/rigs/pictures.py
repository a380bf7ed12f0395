"""The pictures of a rig as pixels: PNG, JPEG, WebP, and KTX 2 by the optional package opengl-basisu.

A file can announce any number of pixels in a few bytes: it is asked before they are unpacked.
"""

from __future__ import annotations

import io
import struct
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from core_pipeline.errors import UserError

#: (h, w, 4) sRGB and alpha
Picture = NDArray[np.uint8]

#: Pixels a picture may announce; it is not unpacked before.
MAX_PIXELS = 8192 * 8192
#: WebP is unpacked by its library, into more than one copy; KTX 2 too.
MAX_PIXELS_WEBP = MAX_PIXELS // 4
#: Pixels a side, of what is kept.
SIDE = 2048
GLTF_FORMATS = ("PNG", "JPEG", "WEBP")
_KTX = b"\xabKTX 20\xbb\r\n\x1a\n"


class Rig(Protocol):
    """Whose pictures they are."""

    def fail(self, what: str) -> UserError:
        """The error to raise about it."""

    def note(self, what: str) -> None:
        """Something odd that is no reason to refuse it."""


class Unpacker:
    """Unpacks the pictures of one rig, and no more pixels in all than `most`."""

    def __init__(self, rig: Rig, formats: tuple[str, ...] = GLTF_FORMATS, most: int = 16 * MAX_PIXELS) -> None:
        self._rig, self._formats, self._room = rig, formats, most

    def unpacked(self, raw: bytes, title: str) -> Picture | None:
        """The pixels, `SIDE` a side at most; None after a note when they cannot be read.

        title  what sentences call the picture
        UserError when it announces too many pixels.
        """
        try:
            if raw[:12] == _KTX:
                return self._ktx(raw, title)
            with Image.open(io.BytesIO(raw), formats=self._formats) as image:
                self._check(title, *image.size, MAX_PIXELS_WEBP if image.format == "WEBP" else MAX_PIXELS)
                image.draft("RGB", (SIDE, SIDE))
                return _pixels(image)
        except UserError:
            raise
        except Image.DecompressionBombError:
            raise self._rig.fail(f"{title} unpacks to far too many pixels; reduce its size.") from None
        except (UnidentifiedImageError, OSError, ValueError, SyntaxError, EOFError, KeyError, IndexError, TypeError):
            self._rig.note(f"{title[0].upper()}{title[1:]} cannot be read: what it covers shows a plain colour.")
            return None

    def _check(self, title: str, width: int, height: int, most: int) -> None:
        if width * height > most:
            raise self._rig.fail(f"{title} has {width:,} × {height:,} pixels, more than we take; reduce it.")
        self._room -= width * height
        if self._room < 0:
            raise self._rig.fail("its pictures have too many pixels, taken together; reduce them.")

    def _ktx(self, raw: bytes, title: str) -> Picture | None:
        """Basis Universal inside KTX 2, at the smallest of its sizes that is large enough."""
        try:
            import opengl_basisu  # type: ignore[import-not-found, import-untyped, unused-ignore]
        except ImportError:
            self._rig.note(
                "Its textures are KTX 2: parts show a plain colour; to see them install Lipstitch with the extra “ktx” "
                '(pip install "lipstitch[ktx]").'
            )
            return None
        width, height = struct.unpack_from("<II", raw.ljust(28, b"\0"), 20)
        self._check(title, width, height, MAX_PIXELS_WEBP)
        try:
            texture = opengl_basisu.open(raw)
            level = min(max((max(width, height) // SIDE).bit_length() - 1, 0), texture.levels - 1)
            pixels: Picture = np.array(texture.transcode("rgba8", level=level).data, np.uint8)
        except Exception as error:  # noqa: BLE001 - whatever the library comes up with, the file is to blame
            raise ValueError(error) from None
        while max(pixels.shape) > SIDE:
            pixels = halved(pixels)
        return pixels


def halved(picture: Picture) -> Picture:
    """Half as many pixels in both directions, each the mean of four; a side of one pixel stays."""
    height, width = picture.shape[:2]
    down, across = min(height, 2), min(width, 2)
    even = picture[: height // down * down, : width // across * across]
    total = np.zeros((height // down, width // across, 4), np.uint16)
    for row in range(down):
        for column in range(across):
            total += even[row::down, column::across]
    smaller: Picture = ((total + down * across // 2) // (down * across)).astype(np.uint8)
    return smaller


def _pixels(image: Image.Image) -> Picture:
    """Made smaller first, so that the largest never stands in memory twice."""
    if max(image.size) <= SIDE:
        return np.asarray(image.convert("RGBA"))
    if image.mode not in ("RGBA", "LA", "PA") and "transparency" not in image.info:
        plain = image.convert("RGB") if image.mode == "P" else image  # else its numbers would be mixed, not its colours
        plain.thumbnail((SIDE, SIDE), Image.Resampling.BOX)
        return np.asarray(plain.convert("RGBA"))
    # Channel by channel: all at once, Pillow blackens what is see-through, and black would seep into the edges.
    whole = image if image.mode == "RGBA" else image.convert("RGBA")
    return np.stack([_small(whole.getchannel(name)) for name in "RGBA"], -1)


def _small(channel: Image.Image) -> NDArray[np.uint8]:
    channel.thumbnail((SIDE, SIDE), Image.Resampling.BOX)
    return np.asarray(channel)

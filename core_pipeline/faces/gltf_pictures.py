"""The pictures inside a glTF file as pixels: PNG, JPEG, WebP, and KTX 2 by the optional package opengl-basisu."""

from __future__ import annotations

import io
import struct

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from core_pipeline.errors import UserError
from core_pipeline.faces.gltf_file import GltfFile

#: (h, w, 4) sRGB and alpha
Picture = NDArray[np.uint8]

#: Pixels a picture may announce; it is not unpacked before.
MAX_PIXELS = 8192 * 8192
#: WebP is unpacked by its library, into more than one copy; KTX 2 too.
MAX_PIXELS_WEBP = MAX_PIXELS // 4
#: Pictures are looked up at this size: one value per vertex wants no more.
_SIDE = 1024
_KTX = b"\xabKTX 20\xbb\r\n\x1a\n"


def unpacked(gltf: GltfFile, raw: bytes, index: int) -> Picture | None:
    """The pixels of image `index`; None after a note when it cannot be read. UserError when it is too large."""
    try:
        if raw[:12] == _KTX:
            return _ktx(gltf, raw, index)
        with Image.open(io.BytesIO(raw), formats=("PNG", "JPEG", "WEBP")) as image:
            _check(gltf, index, *image.size, MAX_PIXELS_WEBP if image.format == "WEBP" else MAX_PIXELS)
            image.draft("RGB", (_SIDE, _SIDE))
            image.thumbnail((_SIDE, _SIDE), Image.Resampling.BOX)
            return np.asarray(image.convert("RGBA"))
    except UserError:
        raise
    except Image.DecompressionBombError:
        raise gltf.fail(f"image {index} unpacks to far too many pixels; reduce its size.") from None
    except (UnidentifiedImageError, OSError, ValueError, SyntaxError, EOFError, KeyError, IndexError, TypeError):
        gltf.note(f"Image {index} cannot be read: what it covers shows a plain colour.")
        return None


def _check(gltf: GltfFile, index: int, width: int, height: int, most: int) -> None:
    if width * height > most:
        raise gltf.fail(f"image {index} has {width:,} × {height:,} pixels, more than we take; reduce it.")


def _ktx(gltf: GltfFile, raw: bytes, index: int) -> Picture | None:
    """Basis Universal inside KTX 2, at the smallest of its sizes that is large enough."""
    try:
        import opengl_basisu  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        gltf.note(
            "Its textures are KTX 2: parts show a plain colour; to see them install Lipstitch with the extra “ktx” "
            '(pip install "lipstitch[ktx]").'
        )
        return None
    width, height = struct.unpack_from("<II", raw.ljust(28, b"\0"), 20)
    _check(gltf, index, width, height, MAX_PIXELS_WEBP)
    try:
        texture = opengl_basisu.open(raw)
        level = min(max((max(width, height) // _SIDE).bit_length() - 1, 0), texture.levels - 1)
        pixels: Picture = np.array(texture.transcode("rgba8", level=level).data, np.uint8)
    except Exception as error:  # noqa: BLE001 - whatever the library comes up with, the file is to blame
        raise ValueError(error) from None
    return pixels

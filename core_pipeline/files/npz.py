"""Arrays in a zip (.npz), read without trusting a byte: no pickles, no bombs, no surprise of size or type.

numpy's own reader believes an array's header before it looks at the data; here every size is known first.
"""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from ..errors import UserError

#: Bytes of all arrays together, and how many there may be.
MAX_BYTES = 256 * 2**20
MAX_ARRAYS = 64
_KINDS = "fiub"
_DAMAGE = (zipfile.BadZipFile, zlib.error, struct.error, EOFError, ValueError, RuntimeError, OverflowError)
_STAMP = (1980, 1, 1, 0, 0, 0)


def pack(arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """The file; equal arrays give equal bytes."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            member = io.BytesIO()
            npy.write_array(member, np.ascontiguousarray(array), allow_pickle=False)
            info = zipfile.ZipInfo(f"{name}.npy", _STAMP)
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, member.getvalue())
    return out.getvalue()


def unpack(data: bytes, place: str) -> dict[str, NDArray[Any]]:
    """The arrays, of numbers or truth values, all finite; UserError when the file is anything else."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = archive.infolist()
            if len(members) > MAX_ARRAYS or sum(member.file_size for member in members) > MAX_BYTES:
                raise UserError(f"{place} would unpack to more than a model takes: choose another file.")
            names = [member.filename.removesuffix(".npy") for member in members]
            if len(set(names)) < len(names):
                raise UserError(f"{place} names an array twice: choose another file.")
            return {
                name: _array(_bytes(archive, member), name, place) for name, member in zip(names, members, strict=True)
            }
    except (*_DAMAGE, OSError) as error:
        raise UserError(f"{place} is no model of ours or is damaged: choose another, or learn it again.") from error


def _bytes(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes:
    """What the directory announces and not a byte more."""
    with archive.open(member) as file:
        raw = file.read(member.file_size + 1)
    if len(raw) != member.file_size:
        raise zipfile.BadZipFile
    return raw


def _array(raw: bytes, name: str, place: str) -> NDArray[Any]:
    stream = io.BytesIO(raw)
    try:
        version = npy.read_magic(stream)
        read = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}.get(version)
        if read is None:
            raise ValueError("version")
        shape, fortran, dtype = read(stream)
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError) as error:
        raise UserError(f"{place}: {name[:40]!r} is not an array: choose another file, or learn it again.") from error
    if dtype.kind not in _KINDS or dtype.hasobject or fortran or dtype.itemsize > 8:
        raise UserError(f"{place}: {name[:40]!r} holds {str(dtype)[:40]}, not numbers: choose another file.")
    rest = raw[stream.tell() :]
    count = 1
    for side in shape:
        count *= side
    if count < 0 or any(side < 0 for side in shape) or count * dtype.itemsize != len(rest):
        raise UserError(f"{place}: {name[:40]!r} is cut off or damaged: copy it again, or learn it again.")
    array = np.frombuffer(rest, dtype).reshape(shape)
    if dtype.kind == "f" and not np.isfinite(array).all():
        raise UserError(f"{place}: {name[:40]!r} holds values that are not numbers (NaN): learn it again.")
    if dtype.kind == "b" and array.size and np.frombuffer(rest, np.uint8).max() > 1:
        raise UserError(f"{place}: {name[:40]!r} is cut off or damaged: copy it again, or learn it again.")
    return array.astype(dtype.newbyteorder("="))

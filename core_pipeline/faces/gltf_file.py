"""glTF 2.0 as a file: the JSON, its buffers, and numbers read out of them. Knows nothing of faces.

Nothing is believed: every size is checked against what is really there before memory is taken for it.
"""

from __future__ import annotations

import base64
import binascii
import json
import struct
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from core_pipeline.errors import UserError

MAX_FILE = 512 * 2**20
MAX_VALUES = 64 * 2**20
LARGEST = 1e6
KNOWN_EXTENSIONS = frozenset({"KHR_mesh_quantization", "KHR_materials_unlit", "KHR_texture_transform"})
_MAGIC = b"glTF"
_TYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_TOP = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535, 5125: 2**32 - 1}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}

Json = dict[str, Any]


class GltfFile:
    """An opened .glb or .gltf. UserError when it is not one, is cut off, or asks for what we cannot read."""

    def __init__(self, path: Path) -> None:
        self.path = path
        raw = _read(path, path.name)
        self._inline: bytes | None = None
        self.json = self._parse(raw)
        self._check_version()
        self._buffers: dict[int, bytes] = {}

    def fail(self, what: str) -> UserError:
        """The error to raise about this file."""
        return UserError(f"{self.path.name}: {what}")

    def items(self, name: str) -> list[Json]:
        """A top-level list of the document, such as `nodes`; empty when there is none."""
        return self.parts(self.json, name)

    def item(self, name: str, index: object) -> Json:
        """One entry of a top-level list."""
        found = self.items(name)
        if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index < len(found):
            raise self.fail(f"it refers to {name} {index!r}, but has {len(found)}; export the file again.")
        return found[index]

    def part(self, entry: Json, key: str) -> Json:
        """An object inside another one; empty when it is not there."""
        found = entry.get(key, {})
        if not isinstance(found, dict):
            raise self.fail(f"“{key}” is not an object; export the file again.")
        return found

    def parts(self, entry: Json, key: str) -> list[Json]:
        """A list of objects inside an object; empty when it is not there."""
        found = entry.get(key, [])
        if not isinstance(found, list) or not all(isinstance(item, dict) for item in found):
            raise self.fail(f"“{key}” is not a list of objects; export the file again.")
        return found

    def numbers(self, entry: Json, key: str) -> list[int]:
        """A list of whole numbers inside an object; empty when it is not there."""
        found = entry.get(key, [])
        if not isinstance(found, list) or not all(type(value) is int for value in found):
            raise self.fail(f"“{key}” is not a list of numbers; export the file again.")
        return found

    def count(self, index: object) -> int:
        """Number of elements of an accessor, without reading it."""
        return self._whole(self.item("accessors", index), "count")

    def read(self, index: object, kind: str) -> NDArray[Any]:
        """(count, width) values of an accessor of type `kind`; normalised integers become floats, as glTF says."""
        accessor = self.item("accessors", index)
        where = f"accessor {index}"
        if accessor.get("type") != kind:
            raise self.fail(f"{where} is {accessor.get('type')!r} where {kind} is expected; export the file again.")
        component = accessor.get("componentType")
        if type(component) is not int or component not in _TYPES:
            raise self.fail(f"{where} has the unknown component type {component!r}; export the file again.")
        count, width, dtype = self._whole(accessor, "count"), _WIDTHS[kind], np.dtype(_TYPES[component])
        if count * width > MAX_VALUES:
            raise self.fail(f"{where} announces {count:,} elements, more than we take; reduce the mesh.")
        if "bufferView" in accessor:
            start = self._whole(accessor, "byteOffset", 0)
            values = self._view(accessor["bufferView"], start, count, width, dtype, where)
        else:
            values = np.zeros((count, width), dtype)
        if "sparse" in accessor:
            values = self._with_sparse(values, self.part(accessor, "sparse"), where)
        if accessor.get("normalized") and dtype.kind in "iu":
            fractions: NDArray[Any] = np.maximum(values.astype(np.float32) / _TOP[component], -1.0)
            return fractions
        if dtype.kind == "f" and not np.isfinite(values).all():
            raise self.fail(f"{where} holds values that are not numbers (NaN or infinite); export the file again.")
        if dtype.kind == "f" and np.abs(values).max(initial=0) > LARGEST:
            raise self.fail(f"{where} holds values above {LARGEST:,.0f}; export the file in metres or centimetres.")
        return values

    def _with_sparse(self, values: NDArray[Any], sparse: Json, where: str) -> NDArray[Any]:
        count = self._whole(sparse, "count")
        indices, changed = self.part(sparse, "indices"), self.part(sparse, "values")
        if count > len(values):
            raise self.fail(
                f"{where}: its sparse part changes {count} of {len(values)} elements; export the file again."
            )
        component = indices.get("componentType")
        if component not in (5121, 5123, 5125):
            raise self.fail(f"{where}: sparse indices of component type {component!r}; export the file again.")
        start = self._whole(indices, "byteOffset", 0)
        places = self._view(indices.get("bufferView"), start, count, 1, np.dtype(_TYPES[component]), where)[:, 0]
        if count and places.max() >= len(values):
            raise self.fail(f"{where}: a sparse index {places.max()} is past its {len(values)} elements.")
        start = self._whole(changed, "byteOffset", 0)
        full = values.copy()
        full[places] = self._view(changed.get("bufferView"), start, count, values.shape[1], values.dtype, where)
        return full

    def _view(
        self, index: object, start: int, count: int, width: int, dtype: np.dtype[Any], where: str
    ) -> NDArray[Any]:
        view = self.item("bufferViews", index)
        if "EXT_meshopt_compression" in self.part(view, "extensions"):
            raise self.fail("it is compressed with meshopt, which we cannot read; export it without compression.")
        offset, length = self._whole(view, "byteOffset", 0), self._whole(view, "byteLength")
        size = width * dtype.itemsize
        stride = self._whole(view, "byteStride", size) or size
        if stride < size:
            raise self.fail(f"bufferView {index}: stride {stride} is below an element's {size} bytes.")
        buffer = self._buffer(view.get("buffer"))
        if offset + length > len(buffer):
            raise self.fail(
                f"bufferView {index} ends at byte {offset + length:,} of a buffer of {len(buffer):,} bytes."
            )
        if count and start + stride * (count - 1) + size > length:
            raise self.fail(
                f"{where} reaches past the end of bufferView {index}; the file is damaged, export it again."
            )
        little = dtype.newbyteorder("<")
        rows: NDArray[Any] = np.ndarray(
            (count, width), little, buffer, offset + start if count else 0, (stride, dtype.itemsize)
        )
        return rows.astype(dtype)

    def _buffer(self, index: object) -> bytes:
        entry = self.item("buffers", index)
        assert isinstance(index, int)
        if index not in self._buffers:
            data = self._load(entry, index)
            if len(data) < self._whole(entry, "byteLength"):
                raise self.fail(f"buffer {index} is cut off: {len(data):,} of {entry['byteLength']:,} bytes.")
            self._buffers[index] = data
        return self._buffers[index]

    def _load(self, entry: Json, index: int) -> bytes:
        uri = entry.get("uri")
        if uri is None:
            if index or self._inline is None:
                raise self.fail(f"buffer {index} has no data; the file is cut off or incomplete.")
            return self._inline
        if not isinstance(uri, str):
            raise self.fail(f"buffer {index} has no readable uri; export the file again.")
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2], validate=True)
            except (binascii.Error, ValueError):
                raise self.fail(f"the data inside buffer {index} is not base64; export the file again.") from None
        folder = self.path.parent.resolve()
        beside = (folder / unquote(uri)).resolve()
        if ":" in uri.split("/")[0] or not beside.is_relative_to(folder):
            raise self.fail(f"buffer {index} lies outside the file's folder ({uri[:60]}); put it beside the file.")
        return _read(beside, f"{self.path.name}: buffer {unquote(uri)}")

    def _parse(self, raw: bytes) -> Json:
        text: bytes | None = raw if raw.lstrip()[:1] == b"{" else None
        if raw[:4] == _MAGIC:
            text = self._chunks(raw)
        if text is None:
            raise self.fail("this is not a glTF 2.0 file; export the face as .glb or .gltf.")
        try:
            document = json.loads(text)
        except (ValueError, RecursionError):
            raise self.fail("its glTF description is damaged; export the file again.") from None
        if not isinstance(document, dict):
            raise self.fail("its glTF description is damaged; export the file again.")
        return document

    def _chunks(self, raw: bytes) -> bytes:
        if len(raw) < 20:
            raise self.fail("the file is cut off after its first bytes; copy it again.")
        version, length = struct.unpack_from("<II", raw, 4)
        if version != 2:
            raise self.fail(f"it is glTF version {version}; export it as glTF 2.0.")
        if length > len(raw):
            raise self.fail(f"the file is cut off: {len(raw):,} of {length:,} bytes; copy it again.")
        text, at = None, 12
        while at + 8 <= length:
            size, kind = struct.unpack_from("<I4s", raw, at)
            if at + 8 + size > length:
                raise self.fail("a part of the file is cut off; copy it again.")
            if kind == b"JSON" and text is None:
                text = raw[at + 8 : at + 8 + size]
            elif kind == b"BIN\0" and self._inline is None:
                self._inline = raw[at + 8 : at + 8 + size]
            at += 8 + size
        if text is None:
            raise self.fail("it has no glTF description inside; export the file again.")
        return text

    def _check_version(self) -> None:
        asset = self.json.get("asset")
        version = asset.get("version") if isinstance(asset, dict) else None
        if not str(version).startswith("2."):
            raise self.fail(f"it is glTF version {version}; export it as glTF 2.0.")
        required = self.json.get("extensionsRequired", [])
        if not isinstance(required, list):
            raise self.fail("“extensionsRequired” is not a list; export the file again.")
        missing = sorted({str(name) for name in required} - KNOWN_EXTENSIONS)
        if missing:
            raise self.fail(f"it needs {', '.join(missing)}, which we cannot read; export it without.")

    def _whole(self, entry: Json, key: str, default: int | None = None) -> int:
        value = entry.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 2**40:
            raise self.fail(f"“{key}” is {value!r} where a size is expected; export the file again.")
        return value


def _read(path: Path, name: str) -> bytes:
    try:
        size = path.stat().st_size
        if size > MAX_FILE:
            raise UserError(
                f"{name}: {size / 2**20:,.0f} MB is more than we read (512 MB); reduce the mesh or its textures."
            )
        return path.read_bytes()
    except OSError as error:
        raise UserError(f"{name}: cannot be read ({error.strerror}); check the path.") from None

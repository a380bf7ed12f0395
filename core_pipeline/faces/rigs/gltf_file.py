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
from core_pipeline.faces.rigs import meshopt
from core_pipeline.faces.rigs.limits import LARGEST, MAX_FILE, MAX_TEXT, MAX_UNPACKED
from core_pipeline.files.json_text import shown

#: Values of one accessor, announced before any is read.
MAX_VALUES = 16 * 2**20
#: Values in the description: each takes a hundred bytes once it is read.
MAX_ENTRIES = 1_000_000
#: What a file may insist on; materials may insist on anything, we take their colour alone.
KNOWN_EXTENSIONS = frozenset(
    {
        "KHR_mesh_quantization",
        "KHR_texture_transform",
        "KHR_draco_mesh_compression",
        "EXT_meshopt_compression",
        "EXT_texture_webp",
        "KHR_texture_basisu",
        "KHR_lights_punctual",
    }
)
_MAGIC = b"glTF"
_TYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_TOP = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535, 5125: 2**32 - 1}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}

Json = dict[str, Any]
Buffer = bytes | memoryview


class GltfFile:
    """An opened .glb or .gltf. UserError when it is not one, is cut off, or asks for what we cannot read."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.files = [path]
        self.notes: list[str] = []
        self._lists: dict[str, list[Json]] = {}
        self._decoded: dict[int, NDArray[Any]] = {}
        self._room = MAX_UNPACKED
        self._unpacked: dict[int, bytes] = {}
        raw = _read(path, path.name)
        self._inline: Buffer | None = None
        self.json = self._parse(raw)
        self._check_version()
        self._buffers: dict[int, Buffer] = {}

    def fail(self, what: str) -> UserError:
        """The error to raise about this file."""
        return UserError(f"{self.path.name}: {what}")

    def items(self, name: str) -> list[Json]:
        """A top-level list of the document, such as `nodes`; empty when there is none."""
        if name not in self._lists:
            self._lists[name] = self.parts(self.json, name)
        return self._lists[name]

    def item(self, name: str, index: object) -> Json:
        """One entry of a top-level list."""
        found = self.items(name)
        if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index < len(found):
            raise self.fail(f"it refers to {name} {shown(repr(index))}, but has {len(found)}; export the file again.")
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

    def floats(self, values: object, count: int) -> NDArray[np.floating[Any]]:
        """(count,) numbers of a transform or a colour."""
        try:
            numbers = np.asarray(values, float)
        except (TypeError, ValueError, OverflowError):
            numbers = np.array(np.nan)
        if numbers.shape != (count,) or not (np.abs(numbers) <= LARGEST).all():
            raise self.fail(f"a transform or colour is not {count} sensible numbers; export the file again.")
        return numbers

    def note(self, what: str) -> None:
        """Something odd that is no reason to refuse the file; said once."""
        if what not in self.notes:
            self.notes.append(what)

    def decoded(self, index: object, values: NDArray[Any]) -> None:
        """From now on an accessor has these (count, width) values: they came compressed."""
        self.item("accessors", index)
        assert isinstance(index, int)
        self._decoded[index] = values

    def data(self, index: object) -> bytes:
        """The bytes of a buffer view."""
        view = self.item("bufferViews", index)
        buffer, offset = self._bytes_of(view, index)
        return bytes(buffer[offset : offset + self.whole(view, "byteLength")])

    def count(self, index: object) -> int:
        """Number of elements of an accessor, without reading it."""
        return self.whole(self.item("accessors", index), "count")

    def read(self, index: object, kind: str) -> NDArray[Any]:
        """(count, width) values of an accessor of type `kind`; normalised integers become floats, as glTF says."""
        accessor = self.item("accessors", index)
        assert isinstance(index, int)
        where = f"accessor {index}"
        if accessor.get("type") != kind:
            raise self.fail(f"{where} is {accessor.get('type')!r} where {kind} is expected; export the file again.")
        component = accessor.get("componentType")
        if type(component) is not int or component not in _TYPES:
            raise self.fail(f"{where} has the unknown component type {component!r}; export the file again.")
        count, width, dtype = self.whole(accessor, "count"), _WIDTHS[kind], np.dtype(_TYPES[component])
        if count * width > MAX_VALUES:
            raise self.fail(f"{where} announces {count:,} elements, more than we take; reduce the mesh.")
        if index in self._decoded:
            values = self._decoded[index]
        elif "bufferView" in accessor:
            start = self.whole(accessor, "byteOffset", 0)
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
        count = self.whole(sparse, "count")
        indices, changed = self.part(sparse, "indices"), self.part(sparse, "values")
        if count > len(values):
            raise self.fail(
                f"{where}: its sparse part changes {count} of {len(values)} elements; export the file again."
            )
        component = indices.get("componentType")
        if component not in (5121, 5123, 5125):
            raise self.fail(f"{where}: sparse indices of component type {component!r}; export the file again.")
        start = self.whole(indices, "byteOffset", 0)
        places = self._view(indices.get("bufferView"), start, count, 1, np.dtype(_TYPES[component]), where)[:, 0]
        if count and places.max() >= len(values):
            raise self.fail(f"{where}: a sparse index {places.max()} is past its {len(values)} elements.")
        start = self.whole(changed, "byteOffset", 0)
        full = values.copy()
        full[places] = self._view(changed.get("bufferView"), start, count, values.shape[1], values.dtype, where)
        return full

    def _view(
        self, index: object, start: int, count: int, width: int, dtype: np.dtype[Any], where: str
    ) -> NDArray[Any]:
        view = self.item("bufferViews", index)
        length = self.whole(view, "byteLength")
        size = width * dtype.itemsize
        stride = self.whole(view, "byteStride", size) or size
        if stride < size:
            raise self.fail(f"bufferView {index}: stride {stride} is below an element's {size} bytes.")
        buffer, offset = self._bytes_of(view, index)
        if count and start + stride * (count - 1) + size > length:
            raise self.fail(
                f"{where} reaches past the end of bufferView {index}; the file is damaged, export it again."
            )
        little = dtype.newbyteorder("<")
        rows: NDArray[Any] = np.ndarray(
            (count, width), little, buffer, offset + start if count else 0, (stride, dtype.itemsize)
        )
        return rows.astype(dtype)

    def _bytes_of(self, view: Json, index: object) -> tuple[Buffer, int]:
        """The bytes a buffer view looks at, decompressed when need be, and where in them it begins."""
        packed = self.part(self.part(view, "extensions"), "EXT_meshopt_compression")
        if packed:
            assert isinstance(index, int)
            if index not in self._unpacked:
                self._unpacked[index] = self._unpack(packed, self.whole(view, "byteLength"), index)
            return self._unpacked[index], 0
        offset, length = self.whole(view, "byteOffset", 0), self.whole(view, "byteLength")
        buffer = self._buffer(view.get("buffer"))
        if offset + length > len(buffer):
            raise self.fail(
                f"bufferView {index} ends at byte {offset + length:,} of a buffer of {len(buffer):,} bytes."
            )
        return buffer, offset

    def _unpack(self, packed: Json, length: int, index: int) -> bytes:
        count, stride = self.whole(packed, "count"), self.whole(packed, "byteStride")
        self._room -= length
        if self._room < 0:
            raise self.fail(f"it unpacks to more than {MAX_UNPACKED // 2**20} MB; export the head alone.")
        if count * stride != length:
            raise self.fail(f"bufferView {index} unpacks {count:,} × {stride} bytes where {length:,} are announced.")
        raw, offset = self._bytes_of({key: value for key, value in packed.items() if key != "extensions"}, None)
        data = bytes(raw[offset : offset + self.whole(packed, "byteLength")])
        try:
            return meshopt.decode(data, count, stride, str(packed.get("mode")), str(packed.get("filter", "NONE")))
        except ValueError as error:
            raise self.fail(f"bufferView {index} is packed with meshopt, but {error}; export the file again.") from None

    def _buffer(self, index: object) -> Buffer:
        entry = self.item("buffers", index)
        assert isinstance(index, int)
        if index not in self._buffers:
            data = self._load(entry, index)
            if len(data) < self.whole(entry, "byteLength"):
                raise self.fail(f"buffer {index} is cut off: {len(data):,} of {entry['byteLength']:,} bytes.")
            self._buffers[index] = data
        return self._buffers[index]

    def _load(self, entry: Json, index: int) -> Buffer:
        uri = entry.get("uri")
        if uri is None:
            if index or self._inline is None:
                raise self.fail(f"buffer {index} has no data; the file is cut off or incomplete.")
            return self._inline
        return self.beside(uri, f"buffer {index}")

    def beside(self, uri: object, what: str) -> bytes:
        """Data inside a uri, or in a file in the folder of this one; nowhere else."""
        if not isinstance(uri, str):
            raise self.fail(f"{what} has no readable uri; export the file again.")
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2], validate=True)
            except (binascii.Error, ValueError):
                raise self.fail(f"the data inside {what} is not base64; export the file again.") from None
        name, path = unquote(uri), None
        if ":" not in uri.split("/")[0] and "\0" not in name:
            folder = self.path.parent.resolve()
            path = (folder / name).resolve()
        if path is None or not path.is_relative_to(folder):
            raise self.fail(f"{what} lies outside the file's folder ({shown(uri, 60)}); put it beside the file.")
        self.files.append(path)
        return _read(path, f"{self.path.name}: {what}, {shown(name, 60)}")

    def _parse(self, raw: bytes) -> Json:
        text: bytes | None = raw if raw.lstrip()[:1] == b"{" else None
        if raw[:4] == _MAGIC:
            text = self._chunks(raw)
        if text is None:
            raise self.fail("this is not a glTF 2.0 file; export the face as .glb or .gltf.")
        if len(text) > MAX_TEXT:
            raise self.fail(
                f"its description has {len(text) / 2**20:,.0f} MB, more than {MAX_TEXT // 2**20}; export it as .glb."
            )
        if sum(text.count(mark) for mark in (b"[", b"{", b",")) > MAX_ENTRIES:
            raise self.fail(f"its description has more than {MAX_ENTRIES:,} entries; export the head alone.")
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
                self._inline = memoryview(raw)[at + 8 : at + 8 + size]  # half a gigabyte wants no copy
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
        missing = [shown(name) for name in missing if not name.startswith("KHR_materials_")]
        if missing:
            raise self.fail(f"it needs {', '.join(missing[:5])}, which we cannot read; export it without.")

    def whole(self, entry: Json, key: str, default: int | None = None) -> int:
        """A size inside an object."""
        value = entry.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 2**40:
            raise self.fail(f"“{key}” is {value!r} where a size is expected; export the file again.")
        return value


def _read(path: Path, name: str) -> bytes:
    try:
        if path.exists() and not path.is_file():
            raise UserError(f"{name}: is no file; choose the .glb or .gltf itself.")
        size = path.stat().st_size
        if size > MAX_FILE:
            raise UserError(
                f"{name}: {size / 2**20:,.0f} MB is more than we read (512 MB); reduce the mesh or its textures."
            )
        return path.read_bytes()
    except OSError as error:
        raise UserError(f"{name}: cannot be read ({error.strerror}); check the path.") from None

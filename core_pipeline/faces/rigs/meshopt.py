"""Unpacks glTF buffer views compressed with EXT_meshopt_compression, version 0 of the attribute codec.

Written from the extension's description: attributes are byte columns of zigzag differences in groups of sixteen,
triangles refer to recent edges and vertices, filters turn integers into directions, rotations and floats.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

_GROUP = 16
_TAIL = 32
_SIXTEEN = np.arange(_GROUP)

Bytes = NDArray[np.uint8]


def decode(data: bytes, count: int, stride: int, mode: str, kind: str = "NONE") -> bytes:
    """`count` elements of `stride` bytes each.

    mode  ATTRIBUTES, TRIANGLES or INDICES
    kind  the filter: NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
    ValueError says what is wrong with the data. Memory is taken only for count × stride bytes and a few times `data`.
    """
    if mode == "ATTRIBUTES":
        if stride % 4 or not 0 < stride <= 256:
            raise ValueError(f"its elements have {stride} bytes")
        unpacked = _attributes(data, count, stride)
        if kind in ("", "NONE"):
            return unpacked.tobytes()
        if kind not in _FILTERS or stride not in _FILTERS[kind][0]:
            raise ValueError(f"its filter {kind[:20]!r} does not fit elements of {stride} bytes")
        return _FILTERS[kind][1](unpacked, stride).tobytes()
    if mode not in ("TRIANGLES", "INDICES") or stride not in (2, 4):
        raise ValueError(f"it is packed as {mode[:20]!r} of {stride} bytes")
    if count > 3 * len(data):
        raise ValueError(f"{len(data):,} bytes cannot hold {count:,} indices")
    try:
        found = _triangles(data, count) if mode == "TRIANGLES" else _indices(data, count)
    except IndexError:
        raise ValueError("its indices are cut off") from None
    return (np.array(found, np.int64) & 0xFFFFFFFF).astype(f"<u{stride}").tobytes()


def _attributes(data: bytes, count: int, stride: int) -> Bytes:
    if data[:1] != b"\xa0":
        raise ValueError("its attributes are of an unknown version")
    end = len(data) - max(stride, _TAIL)
    block = min(8192 // stride & ~15, 256)
    if end < 1 or count > block * 4 * len(data):
        raise ValueError("it is cut off")
    raw = np.frombuffer(data, np.uint8)
    places, columns, rows, kinds = _groups(raw, end, count, stride, block)
    deltas = np.zeros((-(-count // _GROUP) * _GROUP, stride), np.uint8)
    for kind in (1, 2, 3):
        mine = kinds == kind
        if mine.any():
            values = _values(raw, places[mine], kind)
            deltas[rows[mine][:, None] + _SIXTEEN, columns[mine][:, None]] = values
    deltas = deltas[:count]
    steps = (deltas >> 1) ^ (np.uint8(0) - (deltas & 1))
    unpacked: Bytes = np.cumsum(steps, axis=0, dtype=np.uint8) + raw[len(data) - stride :]
    return unpacked


def _groups(raw: Bytes, end: int, count: int, stride: int, block: int) -> tuple[NDArray[np.intp], ...]:
    """Where each group that is not all zeros begins, its column, its first row, and how it is coded (1, 2, 3).

    A group's length depends on what it holds, so they are walked one by one; the rest is done for all at once.
    """
    data = raw.tolist()
    length = [None, _lengths(raw, 2), _lengths(raw, 4), None]
    two_bits, four_bits = length[1] or [], length[2] or []
    places, columns, rows, kinds = [], [], [], []
    at = 1
    for first in range(0, count, block):
        groups = -(-min(block, count - first) // _GROUP)
        header = -(-groups // 4)
        for column in range(stride):
            head = int.from_bytes(data[at : at + header], "little")
            at += header
            if not head and at <= end:  # most of a blendshape moves nothing
                continue
            for group in range(groups):
                kind = head >> 2 * group & 3
                if not kind:
                    continue
                if at >= end:
                    raise ValueError("it is cut off")
                places.append(at)
                columns.append(column)
                rows.append(first + group * _GROUP)
                kinds.append(kind)
                at += two_bits[at] if kind == 1 else four_bits[at] if kind == 2 else _GROUP
            if at > end:
                raise ValueError("it is cut off")
    if at != end:
        raise ValueError("it is longer than its elements")
    return tuple(np.array(part, np.intp) for part in (places, columns, rows, kinds))


def _lengths(raw: Bytes, bits: int) -> list[int]:
    """Length of a group of `bits` bits a value that begins at each byte: the largest value sends for a whole byte."""
    base = 2 * bits
    top = (1 << bits) - 1
    padded = np.concatenate([raw, np.zeros(base, np.uint8)])
    escapes = np.sum([(padded >> shift & top) == top for shift in range(0, 8, bits)], axis=0)
    before = np.concatenate([[0], np.cumsum(escapes)])
    lengths: list[int] = (base + before[base:-1] - before[: len(raw)]).tolist()
    return lengths


def _values(raw: Bytes, places: NDArray[np.intp], kind: int) -> Bytes:
    """(groups, 16) zigzag differences."""
    if kind == 3:
        whole: Bytes = raw[places[:, None] + _SIXTEEN]
        return whole
    bits = 2 * kind
    each = 8 // bits
    top = (1 << bits) - 1
    small = raw[places[:, None] + _SIXTEEN // each] >> (8 - bits - bits * (_SIXTEEN % each)) & top
    escaped = small == top
    after = places[:, None] + 2 * bits + np.cumsum(escaped, axis=1) - escaped
    values: Bytes = np.where(escaped, raw[np.minimum(after, len(raw) - 1)], small).astype(np.uint8)
    return values


def _varint(data: bytes, at: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128 or shift > 28:
            return value, at


def _signed(value: int) -> int:
    return (value >> 1) ^ -(value & 1)


def _indices(data: bytes, count: int) -> list[int]:
    if data[:1] != b"\xd1":
        raise ValueError("its indices are of an unknown version")
    last, found, at = [0, 0], [], 1
    for _ in range(count):
        value, at = _varint(data, at)
        which = value & 1
        last[which] += _signed(value >> 1)
        found.append(last[which])
    if at != len(data) - 4:
        raise ValueError("its indices are cut off")
    return found


def _triangles(data: bytes, count: int) -> list[int]:
    if data[:1] != b"\xe1" or count % 3:
        raise ValueError("its triangles are of an unknown version")
    reader = _Triangles(data, count // 3)
    found: list[int] = []
    for code in data[1 : 1 + count // 3]:
        found += reader.beside(code) if code < 0xF0 else reader.alone(code)
    if reader.at != len(data) - 16 or len(found) != count:
        raise ValueError("its triangles are cut off")
    return found


class _Triangles:
    """Triangles as one byte each, which points back at the last sixteen edges and vertices."""

    def __init__(self, data: bytes, count: int) -> None:
        self.at = 1 + count
        self._data = data
        self._edges = [(0, 0)] * 16
        self._corners = [0] * 16
        self._edge = self._corner = 0
        self._fresh = self._last = 0

    def beside(self, code: int) -> tuple[int, int, int]:
        """A triangle on a recent edge."""
        a, b = self._edges[self._edge - 1 - (code >> 4) & 15]
        third = code & 15
        if 0 < third < 13:
            c = self._corners[self._corner - 1 - third & 15]
        else:
            c = self._near(third) if third else self._new()
            self._remember(c)
        self._remember_edges((c, b), (a, c))
        return a, b, c

    def alone(self, code: int) -> tuple[int, int, int]:
        """A triangle that names its three corners: new, recent, or (with the codes 254 and 255) spelled out."""
        if code < 0xFE:
            packed, spelled = self._data[len(self._data) - 16 + (code & 15)], False
        else:
            packed, spelled = self._data[self.at], True
            self.at += 1
            if not packed:
                self._fresh = 0
        kinds = (15 if code == 0xFF else 0, packed >> 4, packed & 15)
        # recent vertices are counted from before this triangle; spelled ones are read after all new ones are given
        a, b, c = (self._new() if not kind else self._corners[self._corner - kind & 15] for kind in kinds)
        if spelled:
            a, b, c = (self._near(15) if kind == 15 else v for kind, v in zip(kinds, (a, b, c), strict=True))
        for kind, vertex in zip(kinds, (a, b, c), strict=True):
            if not kind or (spelled and kind == 15):
                self._remember(vertex)
        self._remember_edges((b, a), (c, b), (a, c))
        return a, b, c

    def _new(self) -> int:
        self._fresh += 1
        return self._fresh - 1

    def _near(self, kind: int) -> int:
        """A vertex by its distance from the last one spelled out: one before, one after, or written down."""
        step = {13: -1, 14: 1}.get(kind)
        if step is None:
            value, self.at = _varint(self._data, self.at)
            step = _signed(value)
        self._last += step
        return self._last

    def _remember(self, vertex: int) -> None:
        self._corners[self._corner & 15] = vertex
        self._corner += 1

    def _remember_edges(self, *edges: tuple[int, int]) -> None:
        for edge in edges:
            self._edges[self._edge & 15] = edge
            self._edge += 1


def _octahedral(packed: Bytes, stride: int) -> NDArray[np.signedinteger]:
    """Directions folded on an octahedron: two coordinates and the scale → three; the fourth value stays."""
    whole = packed.view("<i1" if stride == 4 else "<i2")
    top = 127 if stride == 4 else 32767
    x, y, one, _ = (whole[:, i].astype(np.float64) for i in range(4))
    z = one - np.abs(x) - np.abs(y)
    fold = np.maximum(-z, 0)
    x, y = x - np.copysign(fold, x), y - np.copysign(fold, y)
    length = np.sqrt(x * x + y * y + z * z)
    unit = np.stack([x, y, z], -1) * (top / np.where(length > 0, length, 1))[:, None]
    full = whole.copy()
    full[:, :3] = np.trunc(unit + np.copysign(0.5, unit))
    return full


def _quaternion(packed: Bytes, _stride: int) -> NDArray[np.signedinteger]:
    """Rotations without their largest part, whose place and the scale stand in the fourth value."""
    whole = packed.view("<i2").astype(np.int64)
    largest, scale = whole[:, 3] & 3, (whole[:, 3] | 3).astype(np.float64)
    three = whole[:, :3] / scale[:, None] * np.sqrt(0.5)
    rest = np.sqrt(np.maximum(0, 1 - (three**2).sum(1)))
    full = np.empty((len(whole), 4))
    row = np.arange(len(whole))
    full[row, largest] = rest
    for part in range(3):
        full[row, (largest + 1 + part) & 3] = three[:, part]
    full *= 32767
    return np.clip(np.trunc(full + np.copysign(0.5, full)), -32768, 32767).astype("<i2")


def _exponential(packed: Bytes, _stride: int) -> NDArray[np.floating]:
    """24 bits of mantissa, 8 of exponent → float32."""
    whole = packed.view("<i4")
    with np.errstate(over="ignore"):
        floats: NDArray[np.floating] = np.ldexp((whole << 8 >> 8).astype(np.float64), whole >> 24).astype("<f4")
    return floats


_FILTERS: dict[str, tuple[tuple[int, ...], Callable[[Bytes, int], NDArray[np.generic]]]] = {
    "OCTAHEDRAL": ((4, 8), _octahedral),
    "QUATERNION": ((8,), _quaternion),
    "EXPONENTIAL": (tuple(range(4, 257, 4)), _exponential),
}

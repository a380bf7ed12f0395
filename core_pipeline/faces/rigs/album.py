"""What lies on a rig's parts: each picture once, all of them together within a bound."""

from __future__ import annotations

from collections.abc import Callable, Hashable

from core_pipeline.faces.rigs.pictures import Picture, halved
from core_pipeline.faces.texture import Texture, Wrap

#: Bytes of all pictures of one rig, unpacked: sixteen of 1024 × 1024, or four of 2048 × 2048.
MAX_BYTES = 64 * 2**20

Key = Hashable
Wraps = tuple[Wrap, Wrap]


class Album:
    """Pictures by key. When they become too many the largest is halved, of several the one that came last."""

    def __init__(self) -> None:
        self._pictures: dict[Key, Picture | None] = {}
        self._used: dict[tuple[Key, Wraps], int] = {}

    def texture(self, key: Key, wrap: Wraps, unpacked: Callable[[], Picture | None]) -> Texture | None:
        """The picture, as it is for now; `unpacked` the first time. None when it cannot be read."""
        if key not in self._pictures:
            self._pictures[key] = unpacked()
            self._fit()
        picture = self._pictures[key]
        return None if picture is None else Texture(picture, wrap)

    def number(self, key: Key, wrap: Wraps) -> int:
        """Where a picture that was read will stand among the `textures`."""
        return self._used.setdefault((key, wrap), len(self._used))

    def textures(self) -> tuple[Texture, ...]:
        """All that have got a number."""
        found = ((self._pictures[key], wrap) for key, wrap in self._used)
        return tuple(Texture(picture, wrap) for picture, wrap in found if picture is not None)

    def _fit(self) -> None:
        while True:
            sizes = {key: picture.nbytes for key, picture in self._pictures.items() if picture is not None}
            if sum(sizes.values()) <= MAX_BYTES:
                return
            largest = max(reversed(sizes), key=sizes.__getitem__)
            picture = self._pictures[largest]
            assert picture is not None
            self._pictures[largest] = halved(picture)

"""The pictures that materials of a folder of .obj poses name, found there and unpacked."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from core_pipeline.errors import UserError
from core_pipeline.faces.rigs.album import Album, Key, Wraps
from core_pipeline.faces.rigs.limits import MAX_FILE
from core_pipeline.faces.rigs.obj_library import ObjMaterial, file_in
from core_pipeline.faces.rigs.picture_alpha import FAINT
from core_pipeline.faces.rigs.pictures import GLTF_FORMATS, Picture, Unpacker
from core_pipeline.faces.texture import Material, Texture
from core_pipeline.files.atomic import read_bytes
from core_pipeline.files.json_text import shown

_FORMATS = (*GLTF_FORMATS, "BMP", "TGA")


class ObjPictures:
    """Each picture of the `library` once; `files` they were read from, and `notes` about those that were not."""

    def __init__(self, folder: Path, library: Mapping[str, ObjMaterial]) -> None:
        self.files: list[Path] = []
        self.notes: list[str] = []
        self._folder, self._library = folder, library
        self._album = Album()
        self._unpacker = Unpacker(self, _FORMATS)

    def fail(self, what: str) -> UserError:
        """The error to raise about the folder."""
        return UserError(f"{self._folder}: {what}")

    def note(self, what: str) -> None:
        """Something odd that is no reason to refuse it; said once."""
        if what not in self.notes:
            self.notes.append(what)

    def texture(self, material: str) -> Texture | None:
        """What lies on a material; None after a note when it cannot be read. UserError when it is far too large."""
        about = self._library.get(material)
        if about is None or not about.picture:
            return None
        key, wrap = _place(about)
        return self._album.texture(key, wrap, lambda: self._whole(about))

    def material(self, name: str) -> Material:
        """How it lies there, once its `texture` was found."""
        about = self._library[name]
        return Material(self._album.number(*_place(about)), FAINT if about.seen else 0.0, bool(about.seen))

    def textures(self) -> tuple[Texture, ...]:
        """Those of all `material` that were asked for."""
        return self._album.textures()

    def _whole(self, about: ObjMaterial) -> Picture | None:
        """The picture; as see-through as the material says, or not at all."""
        picture = self._unpacked(about.picture)
        if picture is None:
            return None
        whole = picture.copy()
        whole[..., 3] = 255
        if about.seen == about.picture:
            return picture
        seen = self._unpacked(about.seen) if about.seen else None
        if seen is not None:
            alpha = seen[..., 3] if seen[..., 3].min() < 255 else seen[..., :3].mean(axis=2).astype(np.uint8)
            row, column = (
                np.arange(side) * other // side for side, other in zip(whole.shape, alpha.shape, strict=False)
            )
            whole[..., 3] = alpha[row[:, None], column]
        return whole

    def _unpacked(self, name: str) -> Picture | None:
        path = file_in(self._folder, name)
        if path is None:
            self.note(f"Picture {shown(name, 60)} is not in the folder: what it covers shows a plain colour.")
            return None
        self.files.append(path)
        try:
            raw = read_bytes(path, MAX_FILE, "picture")
        except UserError:
            raw = b""
        return self._unpacker.unpacked(raw, f"picture {shown(path.name)}")


def _place(about: ObjMaterial) -> tuple[Key, Wraps]:
    return (about.picture, about.seen), ("clamp", "clamp") if about.clamp else ("repeat", "repeat")

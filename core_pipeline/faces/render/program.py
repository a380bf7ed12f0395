"""Shader programs: made once, their uniforms looked up once."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL
from OpenGL.GL import shaders

_SHADERS = Path(__file__).parent / "shaders"


class Program:
    """A linked program. The setters want it in use; a name that the shaders do not have is a KeyError."""

    def __init__(self, vertex: str, fragment: str, *defines: str) -> None:
        # PyOpenGL's compileProgram validates before textures have their units, which some drivers then refuse.
        self._name = int(GL.glCreateProgram())
        for file, kind in ((f"{vertex}.vert", GL.GL_VERTEX_SHADER), (f"{fragment}.frag", GL.GL_FRAGMENT_SHADER)):
            version, rest = (_SHADERS / file).read_text("utf-8").split("\n", 1)
            # not all compilers take more than ASCII, even in comments
            text = "\n".join([version, *(f"#define {name}" for name in defines), "#line 2", rest])
            part = shaders.compileShader(text.encode("ascii", "replace").decode(), kind)
            GL.glAttachShader(self._name, part)
            GL.glDeleteShader(part)  # together with the program
        GL.glLinkProgram(self._name)
        if not GL.glGetProgramiv(self._name, GL.GL_LINK_STATUS):
            log = GL.glGetProgramInfoLog(self._name)
            raise RuntimeError(f"{vertex} and {fragment} do not link: {log!r}")
        self._locations: dict[str, int] = {}
        self._set: dict[str, object] = {}  # as the uniforms are: to set one costs more than to compare it
        for number in range(int(GL.glGetProgramiv(self._name, GL.GL_ACTIVE_UNIFORMS))):
            found, _, _ = GL.glGetActiveUniform(self._name, number)
            name = found.tobytes().decode() if hasattr(found, "tobytes") else bytes(found).decode()
            name = name.rstrip("\0")
            self._locations[name] = int(GL.glGetUniformLocation(self._name, name))

    def use(self) -> None:
        """What is drawn from now on."""
        GL.glUseProgram(self._name)

    def number(self, name: str, value: float) -> None:
        """Set a float."""
        if self._changes(name, value):
            GL.glUniform1f(self._locations[name], value)

    def vector(self, name: str, values: Iterable[float]) -> None:
        """Set a vec2, vec3 or vec4."""
        numbers = tuple(map(float, values))
        if self._changes(name, numbers):
            {2: GL.glUniform2f, 3: GL.glUniform3f, 4: GL.glUniform4f}[len(numbers)](self._locations[name], *numbers)

    def matrix(self, name: str, matrix: NDArray[Any]) -> None:
        """Set a mat3 or mat4 from rows."""
        rows = np.ascontiguousarray(matrix, np.float32)
        if self._changes(name, rows.tobytes()):
            setter = GL.glUniformMatrix3fv if len(rows) == 3 else GL.glUniformMatrix4fv
            setter(self._locations[name], 1, GL.GL_TRUE, rows)

    def texture(self, name: str, unit: int) -> None:
        """Let a sampler read texture unit `unit`."""
        if self._changes(name, unit):
            GL.glUniform1i(self._locations[name], unit)

    def _changes(self, name: str, value: object) -> bool:
        changed = self._set.get(name) != value
        self._set[name] = value
        return changed

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteProgram(self._name)


class Programs:
    """The programs of one context, each made when first used."""

    def __init__(self) -> None:
        self._made: dict[tuple[str, ...], Program] = {}

    def use(self, vertex: str, fragment: str, *defines: str) -> Program:
        """The program of these shader files, in use."""
        key = (vertex, fragment, *defines)
        if key not in self._made:
            self._made[key] = Program(*key)
        self._made[key].use()
        return self._made[key]

    def delete(self) -> None:
        """Free all."""
        for program in self._made.values():
            program.delete()
        self._made.clear()

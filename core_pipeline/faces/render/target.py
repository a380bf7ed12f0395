"""What a picture is drawn into: first what is seen at each pixel, then the light on it.

Most triangles of a face are smaller than the blocks of pixels that a renderer in software works in: with the light
in one go, four of five pixels it computes are thrown away. So light falls once on each pixel, at the end.
"""

from __future__ import annotations

from OpenGL import GL

#: Texture units that the light reads: as many as a target has pictures, behind the shadow map's.
SURFACES, FACINGS, DEPTHS = 1, 2, 3


class Target:
    """Framebuffers of (width, height).

    surfaces  three textures: colours, normals, depths
    backdrop  what is behind all; `shows` is whatever the one who drew it wrote down
    canvas    the picture, and a copy of the depths
    """

    def __init__(self, width: int, height: int) -> None:
        self.size = (width, height)
        self._textures = [int(name) for name in GL.glGenTextures(3)]
        self.surfaces = int(GL.glGenFramebuffers(1))
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self.surfaces)
        for texture, (form, place, layout, kind) in zip(
            self._textures,
            (
                (GL.GL_RGBA8, GL.GL_COLOR_ATTACHMENT0, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE),
                (GL.GL_RGBA16, GL.GL_COLOR_ATTACHMENT1, GL.GL_RGBA, GL.GL_UNSIGNED_SHORT),
                (GL.GL_DEPTH_COMPONENT24, GL.GL_DEPTH_ATTACHMENT, GL.GL_DEPTH_COMPONENT, GL.GL_FLOAT),
            ),
            strict=True,
        ):
            GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
            GL.glTexImage2D(GL.GL_TEXTURE_2D, 0, form, width, height, 0, layout, kind, None)
            for which in (GL.GL_TEXTURE_MIN_FILTER, GL.GL_TEXTURE_MAG_FILTER):
                GL.glTexParameteri(GL.GL_TEXTURE_2D, which, GL.GL_NEAREST)
            GL.glFramebufferTexture2D(GL.GL_FRAMEBUFFER, place, GL.GL_TEXTURE_2D, texture, 0)
        GL.glDrawBuffers(2, [GL.GL_COLOR_ATTACHMENT0, GL.GL_COLOR_ATTACHMENT1])
        self._check()

        self.shows: object = None
        self._buffers: list[int] = []
        colours = (GL.GL_RGBA8, GL.GL_COLOR_ATTACHMENT0)
        self.backdrop = self._made(colours)
        self.canvas = self._made(colours, (GL.GL_DEPTH_COMPONENT24, GL.GL_DEPTH_ATTACHMENT))

    def light(self) -> None:
        """Draw into the canvas from now on, over the backdrop, reading the surfaces.

        The depths are copied, as no shader may read those it is tested against.
        """
        whole = (0, 0, *self.size)
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self.canvas)
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self.backdrop)
        GL.glBlitFramebuffer(*whole, *whole, GL.GL_COLOR_BUFFER_BIT, GL.GL_NEAREST)
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self.surfaces)
        GL.glBlitFramebuffer(*whole, *whole, GL.GL_DEPTH_BUFFER_BIT, GL.GL_NEAREST)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self.canvas)
        for unit, texture in zip((SURFACES, FACINGS, DEPTHS), self._textures, strict=True):
            GL.glActiveTexture(GL.GL_TEXTURE0 + unit)
            GL.glBindTexture(GL.GL_TEXTURE_2D, texture)

    def shrink_into(self, other: Target) -> None:
        """Copy the canvas in half its size into the corner of another: four pixels become one."""
        half = (self.size[0] // 2, self.size[1] // 2)
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self.canvas)
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, other.canvas)
        GL.glBlitFramebuffer(0, 0, *self.size, 0, 0, *half, GL.GL_COLOR_BUFFER_BIT, GL.GL_LINEAR)

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteFramebuffers(3, [self.surfaces, self.backdrop, self.canvas])
        GL.glDeleteTextures(self._textures)
        GL.glDeleteRenderbuffers(len(self._buffers), self._buffers)

    def _made(self, *attachments: tuple[int, int]) -> int:
        """A framebuffer of buffers of these (format, place)."""
        framebuffer = int(GL.glGenFramebuffers(1))
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, framebuffer)
        for form, place in attachments:
            buffer = int(GL.glGenRenderbuffers(1))
            self._buffers.append(buffer)
            GL.glBindRenderbuffer(GL.GL_RENDERBUFFER, buffer)
            GL.glRenderbufferStorage(GL.GL_RENDERBUFFER, form, *self.size)
            GL.glFramebufferRenderbuffer(GL.GL_FRAMEBUFFER, place, GL.GL_RENDERBUFFER, buffer)
        self._check()
        return framebuffer

    def _check(self) -> None:
        if GL.glCheckFramebufferStatus(GL.GL_FRAMEBUFFER) != GL.GL_FRAMEBUFFER_COMPLETE:
            raise RuntimeError("no framebuffer of {} × {}".format(*self.size))

"""Moving pictures with sound: frames piped into ffmpeg, which makes an .mp4 that every player shows (H.264, AAC)."""

from __future__ import annotations

import os
import subprocess
import tempfile
from pathlib import Path
from types import TracebackType
from typing import IO, Self

from core_pipeline.errors import UserError
from core_pipeline.faces.render.renderer import Pixels
from core_pipeline.files.atomic import reason
from core_pipeline.files.json_text import shown
from core_pipeline.speech.utterance import Audio
from core_pipeline.speech.wav import write_wav

# Players take untagged colours for BT.601 or BT.709 by their own rules: ours are converted to BT.709 and say so.
_COLOURS = "range=tv:colorspace=bt709:color_primaries=bt709:color_trc=bt709"
_PICTURE = [
    *("-vf", f"scale=out_color_matrix=bt709:out_range=tv,format=yuv420p,setparams={_COLOURS}"),
    *("-c:v", "libx264", "-preset", "medium", "-crf", "18"),
]
_SOUND = ["-map", "0:v", "-map", "1:a", "-c:a", "aac", "-b:a", "128k"]


def even(size: tuple[int, int]) -> tuple[int, int]:
    """The size, each side rounded up to an even number: colours are stored for every second pixel."""
    return size[0] + size[0] % 2, size[1] + size[1] % 2


class Mp4:
    """A clip being written, in a `with` block; it appears at `path` when the block ends well, and never in part.

    size   (width, height) in pixels, both even
    fps    frames per second, the first at the sound's beginning
    audio  None for a silent clip
    UserError when the place cannot be written to, or ffmpeg is missing or fails.
    """

    def __init__(self, path: Path, size: tuple[int, int], fps: float, audio: Audio | None) -> None:
        self._path = path
        self._size = size
        self._fps = fps
        self._audio = audio

    def __enter__(self) -> Self:
        program = _ffmpeg()
        try:
            self._target = self._path.resolve()  # a link stays a link
            if self._target.exists() and not (self._target.is_file() and os.access(self._target, os.W_OK)):
                raise UserError(f"Cannot write {self._path}: it is a folder or write-protected; choose another name.")
            # On the disk of the clip, so that it can be moved to its place in one stroke.
            self._room = tempfile.TemporaryDirectory(
                dir=self._target.parent, prefix=f".{self._target.name[:40]}.", ignore_cleanup_errors=True
            )
        except (OSError, ValueError, RuntimeError) as error:
            raise UserError(f"Cannot write {self._path}: {reason(error)}.") from error
        try:
            self._process, self._words = self._start(program, Path(self._room.name))
        except BaseException:
            self._room.cleanup()
            raise
        return self

    def add(self, frame: Pixels) -> None:
        """The next frame, (h, w, 4) BGRA."""
        try:
            self._pipe.write(frame.tobytes())
        except OSError as error:
            raise self._failure() from error

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                self._finish()
        finally:
            self._process.kill()
            self._process.wait()
            self._close_pipe()
            self._words.close()
            self._room.cleanup()

    @property
    def _pipe(self) -> IO[bytes]:
        assert self._process.stdin is not None
        return self._process.stdin

    def _start(self, program: str, room: Path) -> tuple[subprocess.Popen[bytes], IO[bytes]]:
        width, height = self._size
        command = [program, "-hide_banner", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "bgr0"]
        command += ["-video_size", f"{width}x{height}", "-framerate", f"{self._fps:.9g}", "-i", "pipe:0"]
        if self._audio is not None:
            command += ["-i", str(self._sound(room, self._audio)), *_SOUND]
        command += [*_PICTURE, "-movflags", "+faststart", "-f", "mp4", str(room / "clip.mp4")]
        words = (room / "ffmpeg.txt").open("w+b")  # a pipe nobody empties would stop it
        try:
            process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=words)
        except OSError as error:
            words.close()
            raise UserError(f"ffmpeg cannot be started ({program}): {reason(error)}.") from error
        return process, words

    def _sound(self, room: Path, audio: Audio) -> Path:
        path = room / "sound.wav"
        try:
            write_wav(path, audio)
        except UserError as error:
            raise UserError(str(error).replace(str(path), str(self._path))) from error
        return path

    def _finish(self) -> None:
        if not self._close_pipe() or self._process.wait() != 0:
            raise self._failure()
        try:
            (Path(self._room.name) / "clip.mp4").replace(self._target)
        except OSError as error:
            raise UserError(f"Cannot write {self._path}: {reason(error)}.") from error

    def _failure(self) -> UserError:
        self._close_pipe()
        code = self._process.wait()
        self._words.seek(0)
        told = self._words.read(20_000).decode("utf-8", "replace").strip().splitlines()
        said = f"ffmpeg said “{shown(told[-1], 200)}”" if told else f"ffmpeg ended with code {code}"
        return UserError(f"Cannot write {self._path}: {said}; see that the disk has room, or render a folder of PNGs.")

    def _close_pipe(self) -> bool:
        """No more frames; whether ffmpeg was still there to take the last of them."""
        try:
            self._pipe.close()
        except OSError:
            return False
        return True


def _ffmpeg() -> str:
    """The program: the one in the package, or the one that IMAGEIO_FFMPEG_EXE names."""
    try:
        import imageio_ffmpeg  # type: ignore[import-untyped]

        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except (ImportError, RuntimeError) as error:
        raise UserError(
            "A clip needs ffmpeg, which is not there: install the package imageio-ffmpeg, or render a folder of PNGs."
        ) from error

"""The program that runs in espeak-ng's own process: text on stdin, sound with marks on stdout.

It is started by espeak.py and never imported by the editor: espeak-ng is GPL-3, has global state and
may crash in C, so it lives and dies here. Nothing but the standard library and espeakng_loader.

    request   length (4 bytes, little endian), JSON {"text", "voice", "rate", "pitch"}
    answer    length (4 bytes), JSON, then 2·"samples" bytes: mono int16, little endian
    greeting  one answer without samples when the library is ready: {"rate"} or {"error"}

In an answer "error" says what went wrong; otherwise "phones" is a list of [mnemonic, sample] and
"words" of [position, length, sample]; positions count characters of the text from 0.
"""

from __future__ import annotations

import ctypes
import json
import os
import signal
import sys
from pathlib import Path
from typing import BinaryIO

SYNCHRONOUS = 2
PHONEME_EVENTS, DONT_EXIT = 0x1, 0x8000
WORD, END, PHONEME = 1, 5, 7
POSITION_CHARACTER, UTF8 = 1, 1
RATE, PITCH = 1, 3


class Name(ctypes.Union):
    """What an event carries: a number, a pointer, or up to 8 bytes of name without a closing zero."""

    _fields_ = (("number", ctypes.c_int), ("pointer", ctypes.c_void_p), ("string", ctypes.c_uint8 * 8))


class Event(ctypes.Structure):
    """espeak_EVENT: 40 bytes on 64-bit machines."""

    _fields_ = (
        ("type", ctypes.c_int),
        ("identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user", ctypes.c_void_p),
        ("name", Name),
    )


Callback = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(Event))


class Voice:
    """The loaded library. OSError when it cannot be loaded, RuntimeError when it finds no data."""

    def __init__(self, library: str, data: str) -> None:
        self._lib = ctypes.CDLL(library)
        # Its buffers hold 160 bytes of path, and on Windows no foreign letters: so stand beside the data.
        folder = Path(data)
        os.chdir(folder.parent)
        self._lib.espeak_Initialize.argtypes = (ctypes.c_int, ctypes.c_int, ctypes.c_char_p, ctypes.c_int)
        self._lib.espeak_SetVoiceByName.argtypes = (ctypes.c_char_p,)
        number, pointer = ctypes.c_uint, ctypes.c_void_p
        self._lib.espeak_Synth.argtypes = (
            *(ctypes.c_char_p, ctypes.c_size_t, number, ctypes.c_int),
            *(number, number, pointer, pointer),
        )
        self.rate = self._lib.espeak_Initialize(SYNCHRONOUS, 0, os.fsencode(folder.name), PHONEME_EVENTS | DONT_EXIT)
        if self.rate <= 0:
            raise RuntimeError(f"it found no data in {data}")
        self._sound = bytearray()
        self._phones: list[tuple[str, int]] = []
        self._words: list[tuple[int, int, int]] = []
        self._callback = Callback(self._collect)  # kept alive as long as the library may call it
        self._lib.espeak_SetSynthCallback(self._callback)

    def speak(self, text: str, voice: str, rate: int, pitch: int) -> tuple[dict[str, object], bytes]:
        """Answer and sound."""
        if self._lib.espeak_SetVoiceByName(voice.encode()) != 0:
            return {"error": f"it has no voice {voice!r}"}, b""
        self._lib.espeak_SetParameter(RATE, rate, 0)
        self._lib.espeak_SetParameter(PITCH, pitch, 0)
        self._sound, self._phones, self._words = bytearray(), [], []
        data = text.encode() + b"\0"
        if self._lib.espeak_Synth(data, len(data), 0, POSITION_CHARACTER, 0, UTF8, None, None) != 0:
            return {"error": "it refused the text"}, b""
        self._lib.espeak_Synchronize()
        answer = {"phones": self._phones, "words": self._words, "samples": len(self._sound) // 2}
        return answer, bytes(self._sound)

    def _collect(self, samples: ctypes._Pointer[ctypes.c_short], count: int, events: ctypes._Pointer[Event]) -> int:
        if samples and count > 0:
            self._sound += ctypes.string_at(samples, 2 * count)
        i = 0
        while events[i].type:
            event = events[i]
            if event.type == PHONEME:
                name = bytes(event.name.string).split(b"\0")[0].decode("utf-8", "replace")
                self._phones.append((name, event.sample))
            elif event.type == WORD:
                self._words.append((event.text_position - 1, event.length, event.sample))
            i += 1
        return 0


def send(pipe: BinaryIO, answer: dict[str, object], sound: bytes = b"") -> None:
    """One answer."""
    head = json.dumps(answer).encode()
    pipe.write(len(head).to_bytes(4, "little") + head + sound)
    pipe.flush()


def locate(library: str, data: str) -> tuple[str, str]:
    """The given paths, or those of the package espeakng_loader."""
    if library and data:
        return library, data
    import espeakng_loader

    return library or espeakng_loader.get_library_path(), data or espeakng_loader.get_data_path()


def main(library: str = "", data: str = "") -> int:
    """Answer requests until stdin closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is for the editor; we end when it closes our stdin
    # The library may print: whatever it says must not end up between the answers.
    requests, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    with answers:
        try:
            voice = Voice(*locate(library, data))
        except (ImportError, OSError, RuntimeError, AttributeError) as error:
            send(answers, {"error": str(error)})
            return 1
        send(answers, {"rate": voice.rate})
        while head := requests.read(4):
            request = json.loads(requests.read(int.from_bytes(head, "little")))
            send(answers, *voice.speak(request["text"], request["voice"], request["rate"], request["pitch"]))
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

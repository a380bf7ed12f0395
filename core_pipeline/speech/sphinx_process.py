"""The program that runs in pocketsphinx's own process: 16 kHz sound with a task on stdin, frames on stdout.

It is started by sphinx.py and never imported by the editor: pocketsphinx holds Python's lock while it
works, may crash in C, and can only be cancelled by ending it.

    request   length (4 bytes, little endian), JSON {"task", "bytes", …}, then that many bytes: mono int16
    answer    length (4 bytes), JSON; "error" says what went wrong
    greeting  one answer when the library is ready

All times are frames of 10 ms; spans are [name, first frame, frames, …].

    unknown   "words"                                → "words" the dictionary does not have
    align     "words", "spoken", "wide", "open"      → "words": [word, first, frames, [[phone, first, frames, score]…]]
    words                                            → "words": [word, first, frames, probability]
    phones                                           → "phones": [phone, first, frames]
    live      "first"                                → "phones": finished ones since the last call, "now"
"""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path
from typing import Any, BinaryIO

#: Frames a live phone must lie back before it counts as known.
LATE = 10
#: Frames after which a live utterance is begun anew at the next pause, and at the latest.
PAUSE_AFTER, LATEST = 500, 2000
#: Frames of silence that count as a pause.
PAUSE = 20

_ALLPHONE = {"lm": None, "allphone_ci": True, "lw": 1.0, "beam": 1e-20, "pbeam": 1e-20}
_WIDE = {"beam": 1e-100, "pbeam": 1e-100, "wbeam": 1e-100}


class Ears:
    """The decoders, each loaded when first needed."""

    def __init__(self) -> None:
        import pocketsphinx

        self._make = pocketsphinx.Decoder
        self._phone_model = str(Path(pocketsphinx.get_model_path()) / "en-us" / "en-us-phone.lm.bin")
        self._kept: dict[str, Any] = {}
        self._live: Live | None = None
        self._grammars = 0

    def answer(self, request: dict[str, Any], sound: bytes) -> dict[str, object]:
        """One task."""
        task = request["task"]
        if task == "unknown":
            decoder = self._decoder("align", **_aligning(False))
            return {"words": [word for word in request["words"] if decoder.lookup_word(word) is None]}
        if task == "align":
            return self._align(request, sound)
        if task == "words":
            decoder = self._decoder("words")
            _hear(decoder, sound)
            return {"words": [[s.word, s.start_frame, _frames(s), float(s.prob)] for s in _segments(decoder)]}
        if task == "phones":
            decoder = self._decoder("phones", allphone=self._phone_model, cmn="batch", **_ALLPHONE)
            _hear(decoder, sound)
            return {"phones": [[s.word, s.start_frame, _frames(s)] for s in _segments(decoder)]}
        if request.get("first") or self._live is None:
            if self._live is not None:
                self._live.end()
            self._live = Live(self._decoder("live", allphone=self._phone_model, cmn="live", **_ALLPHONE))
        return self._live.hear(sound)

    def _decoder(self, kind: str, **settings: object) -> Any:
        if kind not in self._kept:
            self._kept[kind] = self._make(loglevel="FATAL", **settings)
        return self._kept[kind]

    def _align(self, request: dict[str, Any], sound: bytes) -> dict[str, object]:
        words: list[str] = request["words"]
        kind = "wide" if request.get("wide") else "align"
        decoder = self._decoder(kind, **_aligning(kind == "wide"))
        try:
            for word, phones in request.get("spoken", {}).items():
                if decoder.lookup_word(word) is None:  # adding it again would spoil the decoder
                    decoder.add_word(word, phones, False)
            if request.get("open"):
                last = len(words) + 1  # every word may be the last; empty steps there would have no phones to align
                steps = [(i, to, 1.0, word) for i, word in enumerate(words) for to in (i + 1, last)]
                self._grammars += 1
                name = f"open {self._grammars}"  # a name used again finds nothing
                decoder.add_fsg(name, decoder.create_fsg(name, 0, last, steps))
                decoder.activate_search(name)
            else:
                decoder.set_align_text(" ".join(words))
            _hear(decoder, sound)
            if not any(_is_word(s.word) for s in _segments(decoder)):
                self._kept.pop(kind)
                return {"words": []}
            decoder.set_alignment()
            _hear(decoder, sound)
            found = [
                [word.name, word.start, word.duration, [[p.name, p.start, p.duration, p.score] for p in word]]
                for word in decoder.get_alignment()
            ]
        except (RuntimeError, TypeError):  # it lost its way: so it says that the words do not fit the sound
            self._kept.pop(kind)
            return {"words": []}
        return {"words": found}


class Live:
    """One stream of sound; phones come out LATE frames after they have ended, once and in order."""

    def __init__(self, decoder: Any) -> None:
        self._decoder = decoder
        self._first = self._heard = self._told = 0  # frames: start of this utterance, all, all that was told
        decoder.start_utt()

    def end(self) -> None:
        """No more of this stream."""
        self._decoder.end_utt()

    def hear(self, sound: bytes) -> dict[str, object]:
        """A chunk more."""
        self._decoder.process_raw(sound)
        self._heard = self._first + self._decoder.n_frames()
        found: list[list[object]] = []
        name = ""
        for segment in _segments(self._decoder):
            first, last = self._first + segment.start_frame, self._first + segment.end_frame + 1
            if last > self._heard - LATE:
                break
            if last > self._told + 1:  # what was told is not taken back
                first = max(first, self._told)
                found.append([segment.word, first, last - first])
                self._told = last
                name = segment.word
        length = self._heard - self._first
        pause = bool(found) and name == "SIL" and int(str(found[-1][2])) >= PAUSE
        if (length > PAUSE_AFTER and pause) or length > LATEST:
            self._decoder.end_utt()
            self._first = self._heard
            self._decoder.start_utt()
        return {"phones": found, "now": self._heard}


def _aligning(wide: bool) -> dict[str, object]:
    """bestpath makes most alignments fail; cmn over the whole sound is steadier."""
    return {"lm": None, "bestpath": False, "cmn": "batch", **(_WIDE if wide else {})}


def _hear(decoder: Any, sound: bytes) -> None:
    decoder.start_utt()
    decoder.process_raw(sound, full_utt=True)
    decoder.end_utt()


def _segments(decoder: Any) -> list[Any]:
    return list(decoder.seg() or ()) if decoder.hyp() is not None else []


def _frames(segment: Any) -> int:
    return int(segment.end_frame - segment.start_frame + 1)


def _is_word(name: str) -> bool:
    return name[:1] not in "<[(" and name not in ("", "NULL")


def send(pipe: BinaryIO, answer: dict[str, object]) -> None:
    """One answer."""
    head = json.dumps(answer).encode()
    pipe.write(len(head).to_bytes(4, "little") + head)
    pipe.flush()


def main() -> int:
    """Answer requests until stdin closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is for the program that started us
    requests, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    with answers:
        try:
            ears = Ears()
        except (ImportError, OSError, RuntimeError) as error:
            send(answers, {"error": str(error)})
            return 1
        send(answers, {"ready": True})
        while head := requests.read(4):
            request = json.loads(requests.read(int.from_bytes(head, "little")))
            sound = requests.read(request.get("bytes", 0))
            try:
                send(answers, ears.answer(request, sound))
            except (RuntimeError, TypeError, ValueError) as error:
                ears = Ears()
                send(answers, {"error": str(error)})
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Damaged files: each is refused in one sentence or repaired with a report, quickly and in little memory.

A thousand are tried, more with LIPSTITCH_MUTATIONS=10000 in the environment.
"""

import json
import os
import random
import re
import subprocess
import sys
import time
from functools import cache
from pathlib import Path

import pytest

from app import resources
from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.smartbody_read import import_set
from core_pipeline.files.smartbody_script import parse_script
from core_pipeline.files.smartbody_write import script

COUNT = int(os.environ.get("LIPSTITCH_MUTATIONS", "1000"))
ROOT = Path(resources.__file__).parents[1]

#: What a hostile hand would put in place of a token.
TOKENS = [
    "NaN", "-Infinity", "1e999", "-1e308", "1e-400", "9" * 400, "null", "true", "[]", "{}", "[[[]]]", '""', '"\\ud800"',
    '"\\u0000"', '"sil"', '"f-ah"', "-0.0", "0.5", "2", "[0, 1]", '{"curves": {}}', "'x'", "0x10", "{", "]", ",", '"',
    "[" * 5000, '"base": "english"', '"set.json"', '"' + "x" * 100_000 + '"', "\x00", "\ufeff", "😀",
]  # fmt: skip
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|-?\d+(?:\.\d+)?|[{}\[\],:()=.]|null|\w+')
ENCODINGS = ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-32", "latin-1", "cp037"]


def small_set() -> str:
    """The head of our English set and its first ten bigrams, a note, and one bigram put aside."""
    top = json.loads(resources.english_curves().read_text("utf-8"))
    top["bigrams"] = dict(list(top["bigrams"].items())[:10])
    top["bigrams"]["ah-aa"] |= {"note": "jaw", "author": "Ann", "conflicts": {"open": {"theirs": [[0, 1]]}}}
    top["aside"] = {"j-ah": top["bigrams"]["ah-ao"]}
    return curve_set_json.dumps(curve_set_json.parse(json.dumps(top).encode(), "").curve_set)


@cache
def tokens(text: str, pattern: re.Pattern[str]) -> list[re.Match[str]]:
    return list(pattern.finditer(text))


def damaged(text: str, luck: random.Random) -> bytes:
    """The text with something moved, replaced, doubled, cut off, or in another encoding."""
    kind = luck.choices(["bytes", "number", "token", "lines", "end", "encoding"], [25, 20, 35, 10, 5, 5])[0]
    if kind == "bytes":
        data = bytearray(text.encode())
        for _ in range(luck.randint(1, 4)):
            data[luck.randrange(len(data))] = luck.randrange(256)
        return bytes(data)
    if kind == "number":
        token = luck.choice(tokens(text, NUMBER))
        return (text[: token.start()] + f"{luck.uniform(-0.1, 1.1):.4f}" + text[token.end() :]).encode()
    if kind == "token":
        token = luck.choice(tokens(text, TOKEN))
        new = luck.choice([*TOKENS, "", token[0] * 2, f"{token[0]}, {token[0]}"])
        return (text[: token.start()] + new + text[token.end() :]).encode()
    lines = text.splitlines()
    if kind == "lines":
        i, j = luck.randrange(len(lines)), luck.randrange(len(lines))
        lines[i : i + luck.randrange(3)] = lines[j : j + luck.randrange(4)]
        return luck.choice(["\n", "\r\n", "\r", "\u2028"]).join(lines).encode()
    if kind == "end":
        return text.encode()[: luck.randrange(len(text))] + luck.choice([b"", b"}", b"\x00", b"\xff"])
    return text.replace("\n", luck.choice(["\n", "\r\n"])).encode(luck.choice(ENCODINGS), "replace")


def test_damaged_files_are_refused_or_repaired() -> None:
    luck, text = random.Random(2013), small_set()
    refused = repaired = 0
    for _ in range(COUNT):
        data = damaged(text, luck)
        start = time.process_time()
        reading, problems = curve_set_json.examine(data, "set.json")
        if reading is None:
            refused += 1
            assert problems, data
            assert all(line.startswith("set.json") and line.isprintable() for line in problems), data
        else:  # what was read can be written, and read without any further repair
            assert not problems, data
            repaired += bool(reading.repairs)
            again = curve_set_json.dumps(reading.curve_set)
            assert curve_set_json.parse(again.encode(), "set.json").repairs == ()
        assert time.process_time() - start < 2
    assert refused > 0.4 * COUNT
    assert repaired > 0.02 * COUNT
    assert refused + repaired < COUNT  # some damage is none: another number, another word in a note


def outcome(data: bytes) -> tuple[tuple[str, ...], CurveSet | None]:
    """What is said of a script, and the set it gives if any."""
    try:
        done = import_set(parse_script(data, "set.py"))
    except UserError as error:
        return (str(error),), None
    return done.report, done.curve_set


def test_damaged_scripts_are_refused_or_repaired() -> None:
    luck = random.Random(2013)
    text = script(curve_set_json.parse(small_set().encode(), "").curve_set)
    refused = repaired = 0
    for _ in range(COUNT // 5):
        data = damaged(text, luck)
        start = time.process_time()
        told, done = outcome(data)
        refused += done is None
        assert all(line.isprintable() for line in told), data
        if done is not None:
            repaired += bool(told)
            again = curve_set_json.dumps(done)
            assert curve_set_json.parse(again.encode(), "set.json").repairs == ()
        assert time.process_time() - start < 2
    assert refused > 0
    assert repaired > 0.2 * COUNT // 5


#: In a process of its own, whose memory may not grow by more than 500 MB; argv: what makes the bytes.
BOMB = """
import resource, sys, time
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
with open("/proc/self/statm") as file:
    room = int(file.read().split()[0]) * resource.getpagesize() + 500 * 2**20
resource.setrlimit(resource.RLIMIT_AS, (room, room))
for bomb in sys.argv[1:]:
    data = b'{"schema": "lipstitch.CurveSet.1", ' + eval(bomb)
    data = data[: curve_set_json.MAX_BYTES + 1]
    start = time.process_time()
    reading, problems = curve_set_json.examine(data, "set.json")
    assert reading is not None or problems
    assert time.process_time() - start < 2, bomb
    del reading, problems
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads its own size from /proc")
def test_bombs_take_neither_time_nor_memory() -> None:
    bombs = [
        """b'"name": "' + b"n" * 16_000_000 + b'"}'""",
        """b'"x": "' + b"n" * 16_000_000 + "😀".encode() + b'"}'""",
        """b'"x": [' + b"[1.5]," * 399_000 + b"1]}" """,
        """b'"x": [' + b'{"a":{}},' * 49_000 + b"1]}" """,
        """b'"x": {' + b",".join(b'"%d":%d.5' % (i, i) for i in range(700_000)) + b"}}" """,
        """b'"x": [' + b"1.5," * 990_000 + b"1]}" """,
        """b'"x": 1.' + b"1" * 16_000_000 + b"}" """,
        """b'"x": "' + b"\\\\ud83d" * 2_600_000 + b'"}'""",
        """b'"x": ' + b"[" * 16_000_000""",
        """b'"x": ' + b"[" * 400_000""",
        """b'"bigrams": {"f-ah": {"curves": {"open": [' + b"[0.5, 0.5]," * 390_000 + b"[1, 1]]}}}}" """,
        """b'"phonemes": [' + b'"a",' * 990_000 + b'"b"]}'""",
        """b'"bigrams": {' + b",".join(b'"%d-ah": {}' % i for i in range(90_000)) + b"}}" """,
        """b'"aside": {' + b",".join(b'"%d-ah": {}' % i for i in range(90_000)) + b"}}" """,
    ]
    done = subprocess.run(
        [sys.executable, "-c", BOMB, *bombs], cwd=ROOT, capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr[-2000:]

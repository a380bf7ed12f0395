"""A thousand damaged files: each is refused in one sentence or repaired with a report, and quickly."""

import json
import random
import re
import time

from app import resources
from core_pipeline.files import curve_set_json

#: What a hostile hand would put in place of a token.
TOKENS = [
    "NaN", "-Infinity", "1e999", "-1e308", "1e-400", "9" * 400, "null", "true", "[]", "{}", "[[[]]]", '""', '"\\ud800"',
    '"\\u0000"', '"sil"', '"f-ah"', "-0.0", "0.5", "2", "[0, 1]", '{"curves": {}}', "'x'", "0x10", "{", "]", ",", '"',
]  # fmt: skip
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|-?\d+(?:\.\d+)?|[{}\[\],:]|null')


def small_set() -> str:
    """The head of our English set and its first thirty bigrams."""
    top = json.loads(resources.english_curves().read_text("utf-8"))
    top["bigrams"] = dict(list(top["bigrams"].items())[:30])
    return curve_set_json.dumps(curve_set_json.parse(json.dumps(top).encode(), "").curve_set)


def damaged(text: str, luck: random.Random) -> bytes:
    """The text with one number moved, one token replaced, removed or doubled, or one to four bytes changed."""
    if luck.random() < 0.3:
        data = bytearray(text.encode())
        for _ in range(luck.randint(1, 4)):
            data[luck.randrange(len(data))] = luck.randrange(256)
        return bytes(data)
    if luck.random() < 0.3:
        token = luck.choice(list(NUMBER.finditer(text)))
        return (text[: token.start()] + f"{luck.uniform(-0.1, 1.1):.4f}" + text[token.end() :]).encode()
    token = luck.choice(list(TOKEN.finditer(text)))
    new = luck.choice([*TOKENS, "", token[0] * 2, f"{token[0]}, {token[0]}"])
    return (text[: token.start()] + new + text[token.end() :]).encode()


def test_a_thousand_damaged_files_are_refused_or_repaired() -> None:
    luck, text = random.Random(2013), small_set()
    refused = repaired = 0
    for _ in range(1000):
        data = damaged(text, luck)
        start = time.perf_counter()
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
        assert time.perf_counter() - start < 2
    assert refused > 300
    assert repaired > 20
    assert refused + repaired < 1000  # some damage is none: another number, another word in a note

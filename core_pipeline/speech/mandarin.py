"""Mandarin: espeak-ng's voice "sit/cmn" and pinyin → the English phones and one more, ü (22 common phonemes).

espeak gives sound and times. Three syllables it spells as English letters (jiong, qiong, xiong); their
phones come from pinyin, spread over the time they take. Without espeak every syllable does.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence

from ..errors import UserError
from ..phonemes import SILENCE
from ..schedule import Schedule
from .espeak_phones import Mark, Phones, phones_of, table, to_phones
from .sentence import shortened
from .spans import PhoneSpan, to_schedule
from .utterance import Utterance, Word

#: espeak's name of the voice.
VOICE = "sit/cmn"
#: espeak's mark between syllables; no pause.
SYLLABLE_END = "_|"
#: The phone English does not have.
U_UMLAUT = "ü"

#: espeak mnemonic → one or two phones; complete over the 410 syllables that pypinyin knows.
MNEMONICS = table(f"""
b p
p ph
d t
t th
g k
k kh
h X
jh tS; ts.
ch tS;h ts.h
sh S; s.
z ts
s tsh s
r z.
f f
l l
m m
n n
ng N N-
w w
y j
ih i[ i.
iy i
uw u
{U_UMLAUT} y
aa A a
ah o-
ax @
ao o
eh E
er @r
ey ei
ow ou
aw Au
ay ai
uh,ng ong
iy,aa iA
iy,eh iE
y,ao io
y,ow iou
w,aa ua
w,ay uai
w,ax u@
w,ey uei
w,ao uo
{U_UMLAUT},eh yE y&
{U_UMLAUT},ax y@
{U_UMLAUT},ih yi
""")

_INITIALS = table("""
b b
p p
m m
f f
d d
t t
n n
l l
g g
k k
h h
jh j zh
ch q ch
sh x sh
r r
z z
s c s
""")

#: pypinyin's strict finals → phones.
_FINALS = table("""
aa a
ay ai
aa,n an
aa,ng ang
aw ao
ah e
ey ei
ax,n en
ax,ng eng
er er
iy i
iy,aa ia
iy,eh,n ian
iy,aa,ng iang
iy,aw iao
iy,eh ie
ih,n in
ih,ng ing
iy,uh,ng iong
y,ow iou
y,ao io
ao o
uh,ng ong
ow ou
uw u
w,aa ua
w,ay uai
w,aa,n uan
w,aa,ng uang
w,ey uei
w,ax,n uen
w,ax,ng ueng
w,ao uo
ü v
ü,eh,n van
ü,eh ve
ü,n vn
eh ê
ih -i
m m
n n
ng ng
""")

#: Seconds of a syllable and of a pause, in silent speech at 175 words per minute.
_SYLLABLE, _PAUSE, _EDGE = 0.22, 0.25, 0.1


def is_mandarin(text: str) -> bool:
    """Whether a text is written with Chinese characters."""
    return any(is_character(c) for c in text)


def is_character(c: str) -> bool:
    """A Chinese character."""
    return "\u4e00" <= c <= "\u9fff" or "\u3400" <= c <= "\u4dbf"


def syllables(text: str) -> list[tuple[int, str, tuple[str, ...]]]:
    """Each Chinese character's position, itself, and the phones of its pinyin as the context has it."""
    from pypinyin import Style, lazy_pinyin

    found = []
    initials = lazy_pinyin(text, style=Style.INITIALS, strict=True, errors=_each)  # type: ignore[arg-type]
    finals = lazy_pinyin(text, style=Style.FINALS, strict=True, errors=_each)  # type: ignore[arg-type]
    if not len(initials) == len(finals) == len(text):
        return []
    for i, (c, initial, final) in enumerate(zip(text, initials, finals, strict=True)):
        if is_character(c):
            found.append((i, c, phones_of_pinyin(initial, final) or ("n",)))  # 嗯 has no vowel
    return found


def _each(other: str) -> list[str]:
    """What is not Chinese stays, letter by letter."""
    return list(other)


def phones_of_pinyin(initial: str, final: str) -> tuple[str, ...]:
    """("q", "iong") → ch iy uh ng; after a sibilant "i" is a buzz, not iy. () when it is no syllable."""
    plain = "".join(c for c in unicodedata.normalize("NFC", final) if not c.isdigit())
    if plain == "i" and initial in ("zh", "ch", "sh", "r", "z", "c", "s"):
        plain = "-i"
    phones = _FINALS.get(plain.replace("ü", "v"), ())
    return (*_INITIALS.get(initial, ()), *phones) if phones else ()


def to_mandarin(marks: Sequence[Mark], end: float, onsets: Sequence[tuple[int, float]], text: str) -> Phones:
    """espeak's marks → phones; a syllable it spelt in English takes those of its pinyin.

    onsets  where espeak began a word: the character, the second
    """
    spelt = _spelt(marks, end, onsets)
    pinyin = {i: phones for i, _, phones in syllables(text)} if spelt else {}
    replaced = [(start, stop, pinyin[i]) for i, start, stop in spelt if pinyin.get(i)]
    kept: list[Mark] = []
    for name, time in marks:
        inside = next((r for r in replaced if r[0] - 1e-9 <= time < r[1] - 1e-9), None)
        if inside is None:
            kept.append((name, time))
        elif abs(time - inside[0]) < 1e-9 or not kept or kept[-1][1] < inside[0] - 1e-9:
            start, stop, phones = inside
            if not (kept and kept[-1][0].startswith("\0") and kept[-1][1] >= start - 1e-9):
                step = (stop - start) / len(phones)
                kept += [(f"\0{phone}", start + k * step) for k, phone in enumerate(phones)]
    return to_phones(kept, end, find=_find)


def _spelt(marks: Sequence[Mark], end: float, onsets: Sequence[tuple[int, float]]) -> list[tuple[int, float, float]]:
    """Syllables between the switch to English letters and the switch back: character, start, end."""
    found = []
    times = [time for _, time in onsets]
    english = False
    stretches: list[tuple[float, float]] = []
    for name, time in marks:
        if name.startswith("(") and name != "(cmn)" and not english:
            english, start = True, time
        elif name == "(cmn)" and english:
            english = False
            stretches.append((start, time))
    if english:
        stretches.append((start, end))
    for k, (character, time) in enumerate(onsets):
        stop = times[k + 1] if k + 1 < len(times) else end
        for first, last in stretches:
            if first - 1e-9 <= time < last - 1e-9:
                found.append((character, time, min(stop, last)))
    return found


def _find(mnemonic: str) -> tuple[str, ...] | None:
    if mnemonic.startswith("\0"):  # a phone of ours already
        return (mnemonic[1:],)
    name = mnemonic.strip("',")
    if name in MNEMONICS:
        return MNEMONICS[name]
    return phones_of(mnemonic)  # pauses, marks, and English words in between


def silent(text: str, rate: int = 175) -> Utterance:
    """Spoken without a voice: pinyin with equal syllables. UserError when there is no Chinese character."""
    try:
        found = syllables(text)
    except ImportError:
        raise UserError("Mandarin without espeak-ng needs the package pypinyin: install it and try again.") from None
    if not found:
        raise UserError(f"Nothing in “{shortened(text)}” can be spoken: type Chinese characters.")
    spans: list[PhoneSpan] = []
    words = []
    now: float = _EDGE
    last = found[0][0]
    for i, character, phones in found:
        now += _PAUSE * (175 / rate) if i > last + 1 else 0.0
        length = _SYLLABLE * 175 / rate / max(1, len(phones))
        words.append(Word(character, now, now + length * len(phones)))
        for phone in phones:
            spans.append((phone, now, now + length))
            now += length
        last = i
    return Utterance(text, to_schedule(spans, 0.0, now + _EDGE), None, tuple(w for w in words if w.end > w.start))


def words(text: str, onsets: Iterable[tuple[int, float]], schedule: Schedule) -> tuple[Word, ...]:
    """Each word that espeak began, of one or two characters or of other letters, until the next one or a pause."""
    within = [(i, time) for i, time in onsets if 0 <= i < len(text)]
    starts: list[tuple[str, float]] = []
    reached = 0
    for (i, time), stop in zip(within, [*(i for i, _ in within[1:]), len(text)], strict=True):
        latin = re.compile(r"[^\W\u3400-\u9fff]+").match(text, i)
        chinese = re.compile(r"[\u3400-\u9fff]+").match(text, i, max(stop, i + 1))
        if i >= reached:
            starts.append(((latin or chinese or [text[i]])[0], time))
            reached = i + len(starts[-1][0])
    pauses = [float(t) for t, p in zip(schedule.times, schedule.phones, strict=False) if p == SILENCE]
    found: list[Word] = []
    for (word, start), (_, until) in zip(starts, [*starts[1:], ("", schedule.end)], strict=True):
        end = min([until, *(pause for pause in pauses if pause > start)])
        if end > start:
            found.append(Word(word, start, end))
    return tuple(found)

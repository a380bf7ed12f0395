"""Names of phones in other alphabets → ARPAbet, the phones of table 1: ARPAbet's variants, TIMIT, IPA, X-SAMPA.

One name may stand for two of our phones. Names of an alphabet nobody recognises are left to the user.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from ..phonemes import COMMON, SILENCE, TABLE_1

Names = Mapping[str, tuple[str, ...]]


def _table(text: str) -> dict[str, tuple[str, ...]]:
    """Lines "ours: theirs theirs …"; "a,b" is two phones."""
    found: dict[str, tuple[str, ...]] = {}
    for line in text.strip().splitlines():
        ours, _, theirs = line.partition(": ")
        found.update(dict.fromkeys(theirs.split(), tuple(ours.split(","))))
    return found


#: Silence, noise and breath, in any alphabet, lower case.
_SILENT = """
sil sp ssil pau h# # #b #e epi brth br breath _ - -- . .. ... spn sp_s <sil> <s> </s> <eps> <p:> <p> <noise> noise nsn
nse nz vocnoise iver cutoff lau laugh laughter cough ++noise++ ++breath++ unk oov xxx pause silence sil_b sil_s sil_e
h#_ noi h\\# %
"""
SILENCES = frozenset(_SILENT.split())

#: What ARPAbet writers add to table 1: TIMIT's finer phones and closures, other spellings.
_ARPABET = _table("""
h: hh hv
er: axr er0
ax: ax-h
ih: ix
uw: ux
d: dx dcl
t: tcl
b: bcl
p: pcl
g: gcl
k: kcl
n: nx
m: em
ax,n: en
ng: eng
ax,l: el
t: q
aa: o ah_r
""")

#: Closures of TIMIT and the stops they belong to.
CLOSURES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"bcl": ("b",), "dcl": ("d", "jh"), "gcl": ("g",), "pcl": ("p",), "tcl": ("t", "ch"), "kcl": ("k",)}
)

#: English in IPA, as MFA, Praat users and dictionaries write it; length, ties and small letters are stripped before.
_IPA = _table("""
ae: æ a
ah: ʌ ɐ
ax: ə ɘ ᵊ ɜ̆
aa: ɑ ɒ
ao: ɔ
eh: ɛ e
er: ɝ ɚ ɜ ɜ˞ ə˞ əɹ ɜɹ
ih: ɪ ɨ ᵻ
iy: i
uh: ʊ ɵ
uw: u ʉ ɯ
ey: eɪ ej ei ɛɪ
ay: aɪ aj ai ɑɪ ʌɪ
oy: ɔɪ ɔj ɔi oɪ oj
aw: aʊ aw au æʊ ɑʊ
ow: oʊ əʊ ow o əw ou ɔʊ
ih,r: ɪɹ ɪr iɹ
ih,ax: ɪə iə
eh,r: ɛɹ ɛr eɹ
eh,ax: eə ɛə
uh,r: ʊɹ ʊr
uh,ax: ʊə
aa,r: ɑɹ ɑr
ao,r: ɔɹ ɔr
p: p
b: b
t: t ʔ ʈ
d: d ɾ ɖ
k: k c x q
g: g ɡ ɟ
ch: tʃ ʧ tɕ
jh: dʒ ʤ dʑ
f: f ɸ
v: v β ʋ
th: θ
dh: ð
s: s
z: z
sh: ʃ ç ɕ
zh: ʒ ʑ
h: h ɦ
m: m ɱ
n: n ɲ
ng: ŋ
l: l ɫ ʎ ɭ
r: ɹ r ɻ ɾ̆ ʁ
w: w ʍ
y: j
ax,l: əl
ax,n: ən
ax,m: əm
""")

#: English in SAMPA and X-SAMPA.
_SAMPA = _table("""
ae: { a
ah: V 6
ax: @
aa: A Q A: Q:
ao: O O:
eh: E e
er: 3 3: 3` @` 3r @r 3\\ r=
ih: I 1 I_
iy: i i:
uh: U
uw: u u: }
ey: eI EI
ay: aI AI
oy: OI
aw: aU AU
ow: oU @U OU o
ih,ax: I@
eh,ax: e@ E@ e: E:
uh,ax: U@
ih,r: Ir I@r
p: p p_h
b: b
t: t t_h ?
d: d 4
k: k k_h x
g: g
ch: tS t_S tS_h
jh: dZ d_Z
f: f
v: v
th: T
dh: D
s: s
z: z
sh: S C
zh: Z
h: h
m: m F
ax,m: m= @m
n: n
ax,n: n= @n
ng: N
l: l 5 l_e
ax,l: l= @l
r: r r\\ r\\`
w: w W
y: j
""")

#: Alphabet → its names.
ALPHABETS: Mapping[str, Names] = MappingProxyType(
    {
        "ARPAbet": MappingProxyType({**{name: (name,) for name in TABLE_1}, "hh": ("h",), **_ARPABET}),
        "IPA": MappingProxyType(_IPA),
        "X-SAMPA": MappingProxyType(_SAMPA),
    }
)

#: Marks that do not change the lips: length, tie bars, stress, aspiration, palatal and so on.
_IPA_MARKS = re.compile("[ːˑˈˌ‿͜͡.ʰʲʷˠˤⁿˡ˞̩̯̥̬̪̃̈̊̚ʼ'|]")


def plain(name: str, alphabet: str) -> str:
    """The name as the alphabet's table has it: ARPAbet in small letters without stress, IPA without marks."""
    name = name.strip()
    if alphabet == "ARPAbet":
        bare = re.sub(r"_[bies]$", "", name.lower())  # Kaldi marks begin, inside, end, single
        return re.sub(r"(?<=[a-z])[0-9]$", "", bare)
    if alphabet == "IPA":
        name = unicodedata.normalize("NFC", name)
        if name in _IPA:
            return name
        stripped = _IPA_MARKS.sub("", unicodedata.normalize("NFD", name).replace("ç", "ç"))
        return unicodedata.normalize("NFC", stripped)
    return re.sub(r"(?<=.)(_h|_j|_w|_0|_d|_\}|_\^|_~|_t|')$", "", name.strip('"%'))


def is_silence(name: str) -> bool:
    """Whether a label names no sound of speech."""
    bare = name.strip().lower()
    return not bare or bare in SILENCES or re.fullmatch(r"<.*>|\{.+\}|\[.*\]|\(.*\)", bare) is not None


def alphabet_of(names: Iterable[str]) -> str:
    """The alphabet that knows most of the names; ARPAbet when several know as many."""
    distinct = {name for name in names if not is_silence(name)}
    return max(ALPHABETS, key=lambda a: sum(plain(n, a) in ALPHABETS[a] or n in COMMON for n in distinct))


def translated(
    names: Iterable[str], assigned: Mapping[str, str], known: Iterable[str] = ()
) -> tuple[dict[str, tuple[str, ...]], list[str]]:
    """Each distinct name → our phones, and the names nobody knows (they become silence).

    assigned  what the user decided: name → one of our phones, or several with blanks; comes first
    known     phones of the curve set, which stand for themselves
    """
    distinct = list(dict.fromkeys(names))
    alphabet = alphabet_of(distinct)
    table = ALPHABETS[alphabet]
    found: dict[str, tuple[str, ...]] = {}
    unknown: list[str] = []
    own = {*known, *COMMON}
    for name in distinct:
        if name in assigned:
            found[name] = tuple(assigned[name].split())
        elif is_silence(name):
            found[name] = (SILENCE,)
        elif (short := plain(name, alphabet)) in table:
            found[name] = table[short]
        elif name in own:
            found[name] = (name,)
        else:
            found[name] = (SILENCE,)
            unknown.append(name)
    return found, unknown

"""English spelling → phones by simple rules: for words no dictionary lists.

About the rules a child learns first; no stress. It is meant to move a mouth plausibly, not to teach.
"""

from __future__ import annotations

import re

#: A vowel, one consonant and a final e: the vowel says its name.
_NAMES = {"a": "ey", "e": "iy", "i": "ay", "o": "ow", "u": "uw"}


def _lines(text: str) -> dict[str, tuple[str, ...]]:
    rows = (line.split() for line in text.replace("|", "\n").splitlines() if line)
    return {row[0]: tuple(row[1:]) for row in rows}


#: Spelling → phones; the longest that fits is taken.
RULES = _lines("""
tion sh ah n|sion zh ah n|ture ch er|ough ao|augh ao|eigh ey|igh ay|tch ch|dge jh|sch s k|chr k r|ch ch|sh sh
th th|ph f|wh w|gh g|ck k|ng ng|nk ng k|qu k w|kn n|wr r|mb m|ps p s|rh r|sc s k|ss s|ll l|ff f|tt t|pp p|bb b
dd d|gg g|mm m|nn n|rr r|zz z|cc k|air eh r|are eh r|ear ih r|eer ih r|oor ao r|our aw er|oar ao r|ore ao r
ar aa r|er er|ir er|ur er|or ao r|ai ey|ay ey|ee iy|ea iy|ei iy|ey iy|ie iy|eu y uw|ew uw|oa ow|oe ow|oi oy
oy oy|oo uw|ou aw|ow ow|au ao|aw ao|ue uw|ui uw|ce s ah|ci s ih|cy s iy|ge jh ah|gi jh ih|gy jh iy
a ae|b b|c k|d d|e eh|f f|g g|h h|i ih|j jh|k k|l l|m m|n n|o aa|p p|q k|r r|s s|t t|u ah|v v|w w|x k s|y iy|z z
""")
_LONGEST = max(map(len, RULES))

#: How a letter is spelt aloud.
_SPELT = _lines("""
a ey|b b iy|c s iy|d d iy|e iy|f eh f|g jh iy|h ey ch|i ay|j jh ey|k k ey|l eh l|m eh m|n eh n|o ow|p p iy
q k y uw|r aa r|s eh s|t t iy|u y uw|v v iy|w d ah b ah l y uw|x eh k s|y w ay|z z iy
""")

#: The commonest words that no rule would guess, and the parts of numbers.
_WORDS = _lines("""
the dh ah|of ah v|to t uw|a ah|and ae n d|is ih z|was w aa z|are aa r|you y uw|your y ao r|have h ae v|has h ae z
be b iy|he h iy|she sh iy|we w iy|me m iy|they dh ey|this dh ih s|that dh ae t|these dh iy z|there dh eh r|i ay
then dh eh n|than dh ae n|with w ih dh|from f r ah m|one w ah n|two t uw|four f ao r|eight ey t|zero z iy r ow
seven s eh v ah n|ten t eh n|hundred h ah n d r ah d|thousand th aw z ah n d|million m ih l y ah n|do d uw
does d ah z|said s eh d|were w er|what w ah t|who h uw|some s ah m|come k ah m|done d ah n|give g ih v|his h ih z
as ae z|by b ay|my m ay|no n ow|so s ow|go g ow|hello h ah l ow|people p iy p ah l|any eh n iy|says s eh z
don't d ow n t|can't k ae n t|i'm ay m|it's ih t s|could k uh d|would w uh d|should sh uh d|our aw er|or ao r
""")


def sound_out(word: str) -> tuple[str, ...]:
    """Phones of a word written with a…z; a word without vowels is spelt letter by letter. Others give ()."""
    word = word.lower()
    if word in _WORDS:
        return _WORDS[word]
    letters = re.sub("[^a-z]", "", word)
    if not re.search("[aeiouy]", letters):
        return tuple(phone for letter in letters for phone in _SPELT[letter])
    phones: list[str] = []
    i = 0
    while i < len(letters):
        rest = letters[i:]
        if re.fullmatch("[aeiou][bcdfgklmnprstvz]e[sd]?", rest):
            consonant = {"c": "s", "g": "jh"}.get(rest[1], rest[1])
            ending = {"s": ("z",), "d": ("d",)}.get(rest[3:], ())
            return (*phones, _NAMES[rest[0]], consonant, *ending)
        if rest == "e" and phones and i > 1:
            break
        if rest[0] == "y" and i == 0:
            phones.append("y")
            i += 1
            continue
        size = next(n for n in range(_LONGEST, 0, -1) if rest[:n] in RULES)
        phones += RULES[rest[:size]]
        i += size
    return tuple(phones)

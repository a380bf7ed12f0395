"""Mandarin from espeak-ng, the syllables it cannot say from pinyin, and silent speech from pinyin alone."""

import pytest
from pypinyin.pinyin_dict import pinyin_dict

from core_pipeline.phonemes import SILENCE, TABLE_1
from core_pipeline.speech import mandarin
from core_pipeline.speech.espeak import Espeak
from core_pipeline.speech.speaker import Speaker

PHONES = {*TABLE_1, "ü"}


def spoken_phones(voice, text):
    u = Speaker(voice).speak(text, mandarin.VOICE)
    assert u.notes == ()
    return [p for p in u.schedule.phones if p != SILENCE], u


def test_a_sentence_becomes_phones_words_and_sound(voice):
    phones, u = spoken_phones(voice, "你好，世界。我爱女儿。")
    assert phones == ["n", "iy", "h", "aw", "sh", "ih", "jh", "iy", "eh", "w", "ao", "ay", "n", "ü", "er"]
    assert [w.text for w in u.words] == ["你好", "世", "界", "我", "爱女", "儿"]  # as espeak groups them
    assert all(a.end <= b.start + 1e-9 for a, b in zip(u.words, u.words[1:], strict=False))
    assert u.audio is not None
    assert u.schedule.phones.count(SILENCE) == 4  # the ends, the comma, the full stop


@pytest.mark.parametrize(("character", "phones"), [("穷", "ch"), ("熊", "sh"), ("炯", "jh")])
def test_syllables_espeak_spells_in_english_come_from_pinyin(voice, character, phones):
    found, u = spoken_phones(voice, f"我{character}你")
    assert found == ["w", "ao", phones, "iy", "uh", "ng", "n", "iy"]
    assert u.schedule.duration > 0.5


def test_every_syllable_of_mandarin_is_known_to_both(voice):
    characters = {}
    for code in pinyin_dict:
        if mandarin.is_character(chr(code)) and (found := mandarin.syllables(chr(code))):
            characters.setdefault(found[0][2], chr(code))
    assert len(characters) > 350
    assert () not in characters
    text = list(characters.values())
    for i in range(0, len(text), 60):
        phones, _ = spoken_phones(voice, "".join(text[i : i + 60]))
        assert set(phones) <= PHONES
    assert {p for phones in characters for p in phones} <= PHONES


def test_without_a_voice_it_is_silent_and_says_so():
    mute = Speaker(Espeak("/nowhere/lib.so", "/nowhere"))
    u = mute.speak("你好，世界", mandarin.VOICE)
    assert u.audio is None
    assert "There is no sound" in u.notes[0]
    assert [p for p in u.schedule.phones if p != SILENCE] == ["n", "iy", "h", "aw", "sh", "ih", "jh", "iy", "eh"]
    assert [w.text for w in u.words] == list("你好世界")
    assert u.schedule.phones.count(SILENCE) == 3

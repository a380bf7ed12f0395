"""Sound files, written and read."""

import wave

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core_pipeline.errors import UserError
from core_pipeline.speech.utterance import Audio
from core_pipeline.speech.wav import read_wav, to_int16, write_wav


def _write(path, data: bytes, width: int, channels: int = 1, rate: int = 8000):
    with wave.open(str(path), "wb") as wav:
        wav.setnchannels(channels)
        wav.setsampwidth(width)
        wav.setframerate(rate)
        wav.writeframes(data)


def test_what_was_written_is_read(tmp_path):
    x = np.sin(np.linspace(0, 60, 1000)).astype(np.float32)
    write_wav(tmp_path / "a.wav", Audio(x, 22050))
    found = read_wav(tmp_path / "a.wav")
    assert found.rate == 22050
    assert found.samples.dtype == np.float32
    np.testing.assert_allclose(found.samples, x, atol=1 / 32768)


@given(arrays(np.int16, st.integers(0, 50)))
def test_sixteen_bits_survive_the_way_to_float_and_back(samples):
    np.testing.assert_array_equal(to_int16(samples.astype(np.float32) / np.float32(32768)), samples)


def test_loud_samples_are_clipped_not_wrapped():
    np.testing.assert_array_equal(to_int16(np.array([-3, 3], np.float32)), [-32768, 32767])


@pytest.mark.parametrize(
    ("width", "data"),
    [
        (1, bytes([0, 128, 192])),
        (2, np.array([-32768, 0, 16384], "<i2").tobytes()),
        (3, b"\x00\x00\x80" + b"\x00\x00\x00" + b"\x00\x00\x40"),
        (4, np.array([-(2**31), 0, 2**30], "<i4").tobytes()),
    ],
)
def test_every_width_is_read(tmp_path, width, data):
    _write(tmp_path / "a.wav", data, width)
    np.testing.assert_array_equal(read_wav(tmp_path / "a.wav").samples, np.array([-1, 0, 0.5], np.float32))


def test_channels_are_averaged(tmp_path):
    _write(tmp_path / "a.wav", np.array([0, 16384, 16384, 16384], "<i2").tobytes(), 2, channels=2)
    np.testing.assert_array_equal(read_wav(tmp_path / "a.wav").samples, np.array([0.25, 0.5], np.float32))


@pytest.mark.parametrize("content", [b"", b"RIFF", b"not a wav file at all, but long enough to look at"])
def test_what_is_no_wav_is_told(tmp_path, content):
    path = tmp_path / "odd.wav"
    path.write_bytes(content)
    with pytest.raises(UserError, match=r"odd\.wav"):
        read_wav(path)


def test_a_missing_file_and_a_missing_folder_are_told(tmp_path):
    with pytest.raises(UserError, match="cannot be read"):
        read_wav(tmp_path / "missing.wav")
    with pytest.raises(UserError, match="Cannot write"):
        write_wav(tmp_path / "nowhere" / "a.wav", Audio(np.zeros(3, np.float32), 8000))

"""Recordings in every format, and files that are none."""

import numpy as np
import pytest
import soundfile

from core_pipeline.errors import UserError
from core_pipeline.speech.audio_file import LONGEST, read_audio, resampled
from core_pipeline.speech.utterance import Audio

RATE = 16000
TONE = (0.4 * np.sin(2 * np.pi * 440 * np.arange(RATE) / RATE)).astype(np.float32)


@pytest.mark.parametrize(
    ("name", "subtype", "error"),
    [
        ("a.wav", "PCM_U8", 0.01),
        ("a.wav", "PCM_16", 1e-4),
        ("a.wav", "PCM_24", 1e-6),
        ("a.wav", "PCM_32", 1e-6),
        ("a.wav", "FLOAT", 1e-7),
        ("a.wav", "DOUBLE", 1e-7),
        ("a.wav", "ULAW", 0.02),
        ("a.flac", "PCM_16", 1e-4),
        ("a.ogg", "VORBIS", 0.05),
        ("a.mp3", "MPEG_LAYER_III", 0.05),
        ("a.aiff", "PCM_16", 1e-4),
        ("misnamed.mp3", "PCM_16", 1e-4),
    ],
)
def test_every_format_gives_the_same_sound(tmp_path, name, subtype, error):
    path = tmp_path / name
    kind = "WAV" if name == "misnamed.mp3" else None
    soundfile.write(path, TONE, RATE, subtype=subtype, format=kind)
    audio = read_audio(path)
    assert audio.rate == RATE
    assert audio.samples.dtype == np.float32
    assert abs(audio.duration - 1) < 0.1
    size = min(audio.samples.size, TONE.size)
    if "MPEG" not in subtype:  # an mp3 is delayed
        assert np.abs(audio.samples[:size] - TONE[:size]).max() <= error
    assert abs(np.sqrt(np.mean(audio.samples**2)) - 0.283) < 0.03


def test_channels_are_averaged_and_high_rates_lowered(tmp_path):
    path = tmp_path / "a.wav"
    soundfile.write(path, np.column_stack([TONE, -TONE, TONE]), 96000)
    audio = read_audio(path)
    assert audio.rate == 48000
    assert abs(np.abs(audio.samples).max() - 0.4 / 3) < 0.01


def test_floats_beyond_one_and_no_numbers_are_tamed(tmp_path):
    path = tmp_path / "a.wav"
    soundfile.write(path, np.array([0, 4, -2, np.nan, np.inf], np.float32), RATE, subtype="FLOAT")
    samples = read_audio(path).samples
    assert np.abs(samples).max() == 1
    assert samples[1] == 1
    assert samples[2] == -0.5


def test_samples_of_damaged_floats_do_not_overflow(tmp_path):
    path = tmp_path / "a.wav"
    block = np.full((50, 6), 3e38, np.float32)
    block[7] = [np.inf, -np.inf, 0, 0, 0, 0]
    soundfile.write(path, block, RATE, subtype="FLOAT")
    samples = read_audio(path).samples
    assert samples.max() == 1
    assert samples[7] == 0


def test_the_sound_of_a_video_is_read(tmp_path):
    import av

    path = tmp_path / "a.m4a"
    with av.open(str(path), "w") as out:
        stream = out.add_stream("aac", rate=RATE, layout="stereo")
        frame = av.AudioFrame.from_ndarray(np.vstack([TONE, TONE]), format="fltp", layout="stereo")
        frame.sample_rate = RATE
        out.mux([*stream.encode(frame), *stream.encode(None)])
    audio = read_audio(path)
    assert audio.rate == RATE
    assert abs(audio.duration - 1) < 0.15
    assert abs(np.sqrt(np.mean(audio.samples[2000:14000] ** 2)) - 0.283) < 0.03


@pytest.mark.parametrize("name", ["a.wav", "a.mp3", "a.mp4", "a.flac", "a.xyz"])
@pytest.mark.parametrize("data", [b"", b"RIFF\xff\xff\xff\xffWAVEfmt ", b"hello " * 500, bytes(5000), b"\xff\xfb" * 40])
def test_what_is_no_recording_is_one_sentence(tmp_path, name, data):
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(UserError) as told:
        read_audio(path)
    assert name in str(told.value)
    assert "\n" not in str(told.value)


def test_missing_folders_and_empty_sounds_are_refused(tmp_path):
    with pytest.raises(UserError, match="Cannot read"):
        read_audio(tmp_path / "none.wav")
    with pytest.raises(UserError, match="folder"):
        read_audio(tmp_path)
    soundfile.write(tmp_path / "e.wav", np.zeros(0, np.float32), RATE)
    with pytest.raises(UserError, match="no sound"):
        read_audio(tmp_path / "e.wav")


def test_a_truncated_file_gives_what_it_holds(tmp_path):
    path = tmp_path / "a.wav"
    soundfile.write(path, TONE, RATE)
    path.write_bytes(path.read_bytes()[:16044])
    assert 0.4 < read_audio(path).duration < 0.6


def test_what_is_too_long_is_refused_without_being_kept(tmp_path):
    path = tmp_path / "a.flac"  # digital silence of an hour and a bit is small
    with soundfile.SoundFile(path, "w", 4000, 1) as file:
        for _ in range(61):
            file.write(np.zeros(4000 * 60, np.float32))
    with pytest.raises(UserError, match=f"longer than {LONGEST / 60:.0f} minutes"):
        read_audio(path)


@pytest.mark.parametrize("rate", [8000, 22050, 44100, 48000, 11025, 37123])
def test_resampling_keeps_length_and_pitch(rate):
    tone = np.sin(2 * np.pi * 440 * np.arange(rate) / rate).astype(np.float32)
    low = resampled(Audio(tone, rate), 16000)
    assert abs(low.duration - 1) < 0.002
    spectrum = np.abs(np.fft.rfft(low.samples))
    assert abs(np.argmax(spectrum) / low.duration - 440) < 2

"""A folder of clips: what belongs together is found, what cannot be used is said."""

from pathlib import Path

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.mapping_json import load_presets
from core_pipeline.files import schedule_json, weights_files
from core_pipeline.learning.bigram_curves import learn_bigrams
from core_pipeline.learning.corpus import Clip, Corpus
from core_pipeline.learning.corpus_folder import Reader
from core_pipeline.schedule import Schedule
from core_pipeline.weights import Weights
from tests.helpers.captures import live_link
from tests.helpers.corpora import baked, english

ROOT = Path(__file__).resolve().parents[3]
PRESETS = load_presets(ROOT / "assets" / "retarget")


def text_grid(schedule: Schedule, tier: str = "phones", names=str.upper) -> str:
    """A TextGrid of one tier of words and one of phones, as the Montreal aligner writes it."""
    spans = list(zip(schedule.phones, schedule.times[:-1], schedule.times[1:], strict=True))
    head = (
        f'File type = "ooTextFile"\nObject class = "TextGrid"\n\nxmin = {schedule.start}\nxmax = {schedule.end}\n'
        "tiers? <exists>\nsize = 2\nitem []:\n"
    )

    def block(number: int, name: str, rows: list) -> str:
        top = f'    item [{number}]:\n        class = "IntervalTier"\n        name = "{name}"\n'
        top += (
            f"        xmin = {schedule.start}\n        xmax = {schedule.end}\n        intervals: size = {len(rows)}\n"
        )
        return top + "".join(
            f'        intervals [{i}]:\n            xmin = {a}\n            xmax = {b}\n            text = "{p}"\n'
            for i, (p, a, b) in enumerate(rows, 1)
        )

    words = [("everything", schedule.start, schedule.end)]
    phones = [("" if p == "sil" else names(p), a, b) for p, a, b in spans]
    return head + block(1, "words", words) + block(2, tier, phones)


@pytest.fixture
def folder(tmp_path) -> Path:
    """One clip of each kind."""
    for i, clip in enumerate(baked()[:3]):
        weights_files.save(clip.weights, tmp_path / f"say{i}{'.csv' if i % 2 else '.json'}")
        if i:
            (tmp_path / f"say{i}.TextGrid").write_text(text_grid(clip.schedule), "utf-8")
        else:
            schedule_json.save(clip.schedule, tmp_path / "say0.schedule.json")
    data, _ = live_link(3, 60)
    (tmp_path / "MySlate_1_iPhone.csv").write_bytes(data)
    schedule = Schedule(["sil", "hh", "ah", "sil"], [0, 0.5, 1, 2, 3])
    (tmp_path / "MySlate_1.TextGrid").write_text(text_grid(schedule, "Ann - phones"), "utf-8")
    return tmp_path


def test_everything_that_belongs_together_is_found(folder):
    corpus = Reader(english(), PRESETS).read(folder)
    assert [clip.name for clip in corpus] == ["MySlate_1_iPhone.csv", "say0.json", "say1.csv", "say2.json"]
    assert corpus.clips[0].schedule.phones == ("sil", "h", "ah", "sil")
    for clip, original in zip(corpus.clips[1:], baked(), strict=False):
        mapped = original.schedule.mapped(english().phonemes, english().phoneme_map)
        assert clip.schedule.phones == mapped.phones
        assert clip.weights.frames == pytest.approx(original.weights.frames, abs=1e-5)
    assert learn_bigrams(corpus).found


def test_a_take_that_is_there_raw_and_calibrated_is_taken_once(folder):
    take = folder / "MySlate_1_iPhone.csv"
    (folder / "MySlate_1_iPhone_raw.csv").write_bytes(take.read_bytes())
    (folder / "MySlate_1_iPhone_neutral.csv").write_bytes(take.read_bytes())
    names = [clip.name for clip in Reader(english(), PRESETS).read(folder)]
    assert [name for name in names if name.startswith("MySlate")] == ["MySlate_1_iPhone.csv"]


class TestKeyShapes:
    """Appendix A: markers in millimetres, and the shapes an artist picked from them."""

    COLUMNS = "lip_x,lip_y,jaw_y,jaw_z"

    @pytest.fixture
    def markers(self, tmp_path) -> Path:
        clip = baked()[0]
        rng = np.random.default_rng(3)
        neutral = rng.uniform(20, 90, 4)
        shapes = {pose: neutral + rng.normal(0, 6, 4) for pose in ("open", "W", "wide")}
        basis = np.array([shapes[pose] - neutral for pose in shapes])
        weights = clip.weights.frames[:, [english().poses.index(pose) for pose in shapes]]
        points = neutral + weights @ basis
        rows = [f"neutral,{','.join(f'{v:.6f}' for v in neutral)}"]
        rows += [f"{pose},{','.join(f'{v:.6f}' for v in shape)}" for pose, shape in shapes.items()]
        (tmp_path / "key_shapes.csv").write_text("\n".join([f"pose,{self.COLUMNS}", *rows]), "utf-8")
        lines = [f"{i / 60:.6f},{','.join(f'{v:.6f}' for v in row)}" for i, row in enumerate(points)]
        (tmp_path / "take.csv").write_text("\n".join([f"time,{self.COLUMNS}", *lines]), "utf-8")
        schedule_json.save(clip.schedule, tmp_path / "take.schedule.json")
        return tmp_path

    def test_points_become_poses(self, markers):
        corpus = Reader(english()).read(markers)
        for pose in ("open", "W", "wide"):
            p = english().poses.index(pose)
            made, truth = corpus.clips[0].weights.frames[:, p], baked()[0].weights.frames[:, p]
            assert made == pytest.approx(truth, abs=2e-3)
        assert corpus.clips[0].residual < 0.01
        assert "tBack" in corpus.blind
        assert "has no key shape" in corpus.notes[0]

    @pytest.mark.parametrize(
        ("old", "new", "sentence"),
        [
            ("neutral,", "rest,", "has no row neutral"),
            ("open,", "open,1,", "row 3"),
            ("open,", "open,x", "row 3"),
            ("lip_y", "lip_x", "names a column twice"),
            ("W,", "open,", "row 4"),
        ],
    )
    def test_what_is_wrong_with_them_is_said(self, markers, old, new, sentence):
        path = markers / "key_shapes.csv"
        path.write_text(path.read_text("utf-8").replace(old, new, 1), "utf-8")
        with pytest.raises(UserError, match=sentence):
            Reader(english()).read(markers)


def test_what_cannot_be_used_is_left_out_and_said(folder):
    (folder / "say1.TextGrid").unlink()
    (folder / "say0.json").write_text("{")
    (folder / "broken.csv").write_bytes(b"Timecode,JawOpen\nx")
    corpus = Reader(english(), PRESETS).read(folder)
    assert [clip.name for clip in corpus] == ["MySlate_1_iPhone.csv", "say2.json"]
    told = "\n".join(corpus.notes)
    assert "say1.csv is left out: it has no labels; put say1.TextGrid" in told
    assert "say0.json is left out: " in told
    assert "broken.csv is left out: " in told


def test_recordings_are_aligned_where_something_can(folder):
    (folder / "say2.TextGrid").unlink()
    (folder / "say2.wav").write_bytes(b"sound")
    (folder / "say2.txt").write_text("Hello there.")
    asked = []

    def align(sound: Path, text: str) -> Schedule:
        asked.append((sound.name, text))
        return baked()[2].schedule

    corpus = Reader(english(), PRESETS, align).read(folder)
    assert asked == [("say2.wav", "Hello there.")]
    assert len(corpus) == 4
    (folder / "say2.txt").write_bytes("Hello there.".encode("utf-16"))  # as Notepad's "Unicode"
    Reader(english(), PRESETS, align).read(folder)
    assert asked[1] == asked[0]
    (folder / "say2.txt").write_bytes(b"RIFF\0\0" * 99 + b"x" * 9000)
    assert "say2.txt is no transcript" in "\n".join(Reader(english(), PRESETS, align).read(folder).notes)
    assert "say2.wav cannot be aligned here" in "\n".join(Reader(english(), PRESETS).read(folder).notes)


def test_labels_longer_than_the_animation(tmp_path):
    clip = baked()[0]
    half = Weights(clip.weights.poses, 60.0, 0.0, clip.weights.frames[:60])
    weights_files.save(half, tmp_path / "a.json")
    schedule_json.save(clip.schedule, tmp_path / "a.schedule.json")
    corpus = Reader(english()).read(tmp_path)
    assert "longer than the animation" in corpus.notes[0]
    heard = {pair for found in [learn_bigrams(corpus)] for pair in found.found}
    assert heard < set(corpus.clips[0].schedule.pairs())


def test_labels_of_something_else_are_refused(tmp_path):
    clip = baked()[0]
    weights_files.save(Weights(clip.weights.poses, 60.0, 500.0, clip.weights.frames), tmp_path / "a.json")
    schedule_json.save(clip.schedule, tmp_path / "a.schedule.json")
    with pytest.raises(UserError, match="do not overlap; give both the same beginning"):
        Reader(english()).read(tmp_path)


def test_poses_the_set_lacks_are_said(tmp_path):
    weights = Weights(("open", "brow"), 60.0, 0.0, np.zeros((60, 2), np.float32))
    weights_files.save(weights, tmp_path / "a.json")
    schedule_json.save(Schedule(["aa", "b"], [0, 0.5, 1]), tmp_path / "a.schedule.json")
    corpus = Reader(english()).read(tmp_path)
    assert corpus.poses == english().poses
    assert any("brow is no pose" in note for note in corpus.notes)
    assert any("wide is not in it" in note for note in corpus.notes)


@pytest.mark.parametrize("make", [lambda p: p / "nowhere", lambda p: p])
def test_no_corpus_at_all(tmp_path, make):
    with pytest.raises(UserError, match=r"is not a folder|holds no animation"):
        Reader(english()).read(make(tmp_path))


def test_clips_of_different_poses_are_not_mixed():
    clips = [
        Clip.of(name, Schedule(["aa"], [0, 1]), Weights((pose,), 60.0, 0.0, np.zeros((61, 1), np.float32)))
        for name, pose in (("a", "open"), ("b", "jaw"))
    ]
    with pytest.raises(UserError, match=r"a and b have different poses \(jaw, open"):
        Corpus.of(clips)

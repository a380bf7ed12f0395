"""Models as files: nothing changes on the way, and no file does harm."""

import io
import json
import pickle
import zipfile
from functools import cache

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.files import model_npz, npz
from core_pipeline.methods import animpho_fit, dam_fit, visemes
from core_pipeline.methods.dam_fit import DamOptions
from tests.helpers.corpora import baked, corpus, schedules
from tests.helpers.refusals import told


@cache
def models() -> dict[str, model_npz.Model]:
    some = corpus(baked()[:12])
    return {
        "dam": dam_fit.fit(some, DamOptions(rounds=2)),
        "cohen-massaro": dam_fit.fit_cohen_massaro(some, DamOptions(degree=0, modes=1, rounds=2)),
        "animpho": animpho_fit.fit(some),
        "visemes": visemes.fit(some),
    }


@pytest.mark.parametrize("name", ["dam", "cohen-massaro", "animpho", "visemes"])
class TestRoundTrip:
    def test_the_bytes_are_equal(self, name, tmp_path):
        path = tmp_path / "model.npz"
        model_npz.save(models()[name], path, {"clips": 12})
        read = model_npz.read(path)
        assert read.about == {"clips": 12}
        assert model_npz.dumps(read.model, read.about) == path.read_bytes()

    def test_the_weights_are_equal(self, name):
        model = models()[name]
        again = model_npz.parse(model_npz.dumps(model), "m").model
        for schedule in schedules()[45:]:
            a, b = (m.synthesize(schedule, model.poses, 60).frames for m in (model, again))
            assert np.array_equal(a, b)

    @pytest.mark.parametrize("cut", [0, 1, 30, 400, -1, -20])
    def test_a_cut_file_is_refused(self, name, cut):
        with pytest.raises(UserError, match=r"^m is no model of ours|^m.*(damaged|cut off|is not)"):
            model_npz.parse(model_npz.dumps(models()[name])[:cut], "m")


def test_other_poses_and_phones_are_refused_by_name():
    model = models()["dam"]
    model_npz.check(model, model.poses[:3], ("ah", "bmp"))
    with pytest.raises(UserError, match="does not know jaw, brow"):
        model_npz.check(model, ("open", "jaw", "brow"), ("ah",))
    with pytest.raises(UserError, match="does not know ü, y2"):
        model_npz.check(model, ("open",), ("ah", "ü", "y2"))


def changed(name: str, **arrays) -> bytes:
    """A model's file with some arrays replaced; None removes one."""
    held = npz.unpack(model_npz.dumps(models()[name]), "m")
    held.update(arrays)
    return npz.pack({key: array for key, array in held.items() if array is not None})


def header(name: str, **fields) -> np.ndarray:
    top = json.loads(npz.unpack(model_npz.dumps(models()[name]), "m")["header"].tobytes())
    return np.frombuffer(json.dumps({**top, **fields}).encode(), np.uint8)


NAN = np.full((23, 9), np.nan)
HOSTILE = {
    "no header": lambda: changed("visemes", header=None),
    "header of floats": lambda: changed("visemes", header=np.zeros(4)),
    "header of nonsense": lambda: changed("visemes", header=np.frombuffer(b"{]", np.uint8)),
    "another schema": lambda: changed("visemes", header=header("visemes", schema="lipstitch.Model.9")),
    "unknown kind": lambda: changed("visemes", header=header("visemes", kind="oracle")),
    "kind is a list": lambda: changed("visemes", header=header("visemes", kind=[1])),
    "no poses": lambda: changed("visemes", header=header("visemes", poses=[])),
    "a pose twice": lambda: changed("visemes", header=header("visemes", poses=["open"] * 9)),
    "a pose too few": lambda: changed("visemes", header=header("visemes", poses=["open"])),
    "huge names": lambda: changed("visemes", header=header("visemes", poses=["x" * 10**6] * 9)),
    "NaN": lambda: changed("visemes", shapes=NAN),
    "single precision": lambda: changed("visemes", shapes=np.zeros((23, 9), np.float32)),
    "another shape": lambda: changed("visemes", shapes=np.zeros((23, 8))),
    "no shapes": lambda: changed("visemes", shapes=None),
    "gigantic": lambda: changed("visemes", shapes=np.full((23, 9), 1e300)),
    "states that fall": lambda: changed("dam", first=np.arange(24)[::-1].astype(np.int64)),
    "states without end": lambda: changed("dam", first=np.full(24, 2**62)),
    "sigma of 0": lambda: changed("dam", sigma=npz.unpack(model_npz.dumps(models()["dam"]), "m")["sigma"] * 0),
    "modes of nobody": lambda: changed("dam", modes=np.full((5, 5), 999, np.int64)),
    "a degree of 40": lambda: changed("dam", coefficients=np.zeros((int(models()["dam"].first[-1]), 41, 9))),
    "no AnimPho": lambda: changed("animpho", centres=np.zeros((0, 5, 9)), follows=np.zeros((0, 0), bool)),
    "a phone without": lambda: changed("animpho", labels=np.zeros_like(models()["animpho"].labels)),
    "unknown selection": lambda: changed("animpho", header=header("animpho", selection="best")),
    "complex numbers": lambda: changed("visemes", shapes=np.zeros((23, 9), complex)),
    "texts": lambda: changed("visemes", shapes=np.array([["a"]])),
}


@pytest.mark.parametrize("how", HOSTILE)
def test_hostile_models_are_refused_in_a_sentence(how):
    with pytest.raises(UserError) as refused:
        model_npz.parse(HOSTILE[how](), "m.npz")
    assert str(refused.value).startswith("m.npz")
    assert len(str(refused.value)) < 400
    assert "\n" not in str(refused.value)


def zipped(**members: bytes) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members.items():
            archive.writestr(f"{name}.npy", data)
    return out.getvalue()


def npy(text: str, data: bytes = b"") -> bytes:
    line = text.encode() + b" " * 20 + b"\n"
    return b"\x93NUMPY\x01\x00" + len(line).to_bytes(2, "little") + line + data


class Mine:
    def __reduce__(self):
        return (print, ("you have been had",))


@pytest.mark.parametrize(
    "data",
    [
        zipped(header=npy("{'descr': '|O', 'fortran_order': False, 'shape': (1,)}", pickle.dumps(Mine()))),
        zipped(header=npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000,)}")),
        zipped(header=npy("{'descr': '<f8', 'fortran_order': False, 'shape': (-1, -8)}", b"\0" * 64)),
        zipped(header=npy("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 2)}", b"\0" * 32)),
        zipped(header=npy("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (1,)}", b"\0" * 8)),
        zipped(header=npy("__import__('os')")),
        zipped(header=b"\x93NUMPY\x09\x00"),
        zipped(header=b""),
        zipped(**{f"a{i}": npy("{'descr': '<f8', 'fortran_order': False, 'shape': (0,)}") for i in range(100)}),
        b"PK\x03\x04" + b"\0" * 100,
        b"",
        pickle.dumps(Mine()),
    ],
)
def test_hostile_archives_are_refused(data, capsys):
    with pytest.raises(UserError, match=r"^m"):
        model_npz.parse(data, "m")
    assert "had" not in capsys.readouterr().out


def test_a_bomb_is_not_unpacked():
    """300 MB of zeros in 300 kB."""
    bomb = io.BytesIO()
    with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("header.npy", "w") as member:
        for _ in range(300):
            member.write(bytes(2**20))
    with pytest.raises(UserError, match="unpack to more than a model takes"):
        model_npz.parse(bomb.getvalue(), "m")


@example(at=[0, 1914, 1914], to=[0, 0, 1])
@given(at=st.lists(st.integers(0, 5000), min_size=1, max_size=3), to=st.lists(st.integers(0, 255), min_size=3))
def test_no_flipped_byte_is_a_traceback(at, to):
    raw = bytearray(model_npz.dumps(models()["visemes"]))
    for place, value in zip(at, to, strict=False):
        raw[place % len(raw)] = value
    assert (told(lambda: model_npz.parse(bytes(raw), "m")) or "m").startswith("m")


def test_the_first_words_of_a_header_are_read_as_they_are():
    read = model_npz.parse(changed("animpho", header=header("animpho", selection="viterbi")), "m")
    assert read.model.title == "AnimPho (viterbi)"

"""`lipstitch contact-sheet`: every pose twice, with its name, in a picture of the promised size."""

import numpy as np
import pytest
from PIL import Image

from app.cli import main
from app.command_line.contact_sheet import sheet
from app.command_line.posed import poses_of
from app.resources import face_folder
from app.rigs import open_rig
from core_pipeline.poses import FACEFX, TONGUE_OPEN
from tests.helpers.rigs import NAMES, as_glb, head


def test_every_pose_of_the_crab_is_drawn_from_two_sides(tmp_path, capsys):
    out = tmp_path / "crab.png"
    assert main(["contact-sheet", "crab", "--out", str(out), "--size", "96x80"]) == 0
    assert capsys.readouterr() == (f"12 poses of Crab in {out}\n", "")
    with Image.open(out) as picture:
        assert picture.size == (20 + 3 * 194 + 2 * 18 + 20, 72 + 4 * (80 + 30 + 18) + 20 - 18)
        page = np.asarray(picture.convert("RGB"), int)
    pairs = [
        [page[y : y + 80, x + side : x + side + 96] for side in (0, 98)]
        for y in range(72, 72 + 4 * 128, 128)
        for x in range(20, 600, 212)
    ]
    for front, side in pairs:
        assert np.abs(front - side).mean() > 8, "from another side"
        assert (front[..., 0] > front[..., 2] + 100).mean() > 0.1, "the crab is there, and it is red"
    for view in (0, 1):
        seen = [pair[view].tobytes() for pair in pairs]
        assert len(set(seen)) == 12, "no two poses look alike"
    for row in range(4):
        label = page[72 + row * 128 + 80 : 72 + row * 128 + 110]
        assert (label.min(axis=-1) > 180).sum() > 60, "names are written under the pictures"


def test_all_our_characters_on_one_page(tmp_path, capsys):
    out = tmp_path / "all.png"
    assert main(["contact-sheet", "all", "--out", str(out), "--size", "64x64"]) == 0
    assert capsys.readouterr() == (f"5 faces in {out}\n", "")
    with Image.open(out) as picture:
        assert picture.size == (10 * 68 - 4, 5 * 90)
        page = np.asarray(picture.convert("RGB"), int)
    for row in range(5):
        cells = {page[90 * row : 90 * row + 64, 68 * x : 68 * x + 64].tobytes() for x in range(10)}
        assert len(cells) == 10, "no two poses look alike, those of the tongue neither"
        label = page[90 * row + 64 : 90 * row + 90]
        assert (label.min(axis=-1) > 120).sum() > 60


def test_portraits_of_all(tmp_path):
    out = tmp_path / "faces.png"
    assert main(["contact-sheet", "all", "--portraits", "--out", str(out), "--size", "80x64"]) == 0
    with Image.open(out) as picture:
        assert picture.size == (5 * 80, 64)
        page = np.asarray(picture.convert("RGB"), int)
    assert (page[:, -80:, 0] > page[:, -80:, 2] + 100).mean() > 0.1, "the crab comes last"


def test_what_is_shown_of_a_face():
    face = open_rig(face_folder("toon")).face
    shown = {pose: (note, mix) for pose, note, mix in poses_of(face, FACEFX, idle=True)}
    assert list(shown) == ["neutral", *FACEFX, "blink", "browUp"]
    assert shown["neutral"][1] == {}
    assert shown["open"] == ("jaw wide, corners drop slightly", {"open": 1.0})
    assert shown["tRoof"] == (
        "tongue tip on the roof of the mouth; with open 0.3", {"open": TONGUE_OPEN, "tRoof": 1.0}
    )  # fmt: skip
    assert [pose for pose, _, _ in poses_of(face, FACEFX, idle=False)] == ["neutral", *FACEFX]


def test_a_pose_this_face_cannot_make_is_said_and_shown_at_rest(tmp_path):
    rig = as_glb(head(["jawOpen", *(name for name in NAMES["arkit52"] if name != "jawOpen")]), tmp_path / "head.glb")
    face = open_rig(rig).face
    missing = {pose: mix for pose, note, mix in poses_of(face, FACEFX, idle=False) if note.startswith("not available")}
    assert missing == {"tBack": {}, "tRoof": {}}
    tongue = next(mix for pose, _, mix in poses_of(face, FACEFX, idle=False) if pose == "tTeeth")
    assert tongue["jawOpen"] == pytest.approx(TONGUE_OPEN * face.mix("open")["jawOpen"])


def test_long_names_stay_under_their_own_pictures():
    ball = head(["jawOpen"])
    page = np.asarray(sheet(ball, [("name " * 40, "note", {}), ("b", "words " * 40, {})], (64, 64)), int)
    gap = page[72 + 64 :, 20 + 130 : 20 + 130 + 18]
    assert (gap == page[0, 0]).all()
    assert (page[72 + 64 :, :150].max(axis=-1) > 180).sum() > 30


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["toon", "--out", "sheet.jpg"], "name the picture .png"),
        (["toon", "--out", "sheet.png", "--portraits"], "write contact-sheet all --portraits"),
        (["toon", "--out", "sheet.png", "--size", "8192x8192"], "12 poses that large are no picture any more"),
        (["nobody", "--out", "sheet.png"], "There is no face “nobody”"),
        (["toon", "--out", "sheet.png", "--curves", "none.json"], "Cannot read none.json"),
        (["toon", "--out", "nowhere/sheet.png", "--size", "64x64"], "Cannot write nowhere/sheet.png"),
    ],
)
def test_what_cannot_be_drawn_is_said(options, told, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["contact-sheet", *options]) == 2
    err = capsys.readouterr().err
    assert told in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_sheet_takes_the_looks_of_clips(tmp_path):
    out = tmp_path / "sheet.png"
    assert main(["contact-sheet", "toon", "--out", str(out), "--size", "64x64", "--background", "green"]) == 0
    colours = Image.open(out).convert("RGB").getcolors(1 << 20)
    assert max(count for count, colour in colours if colour == (0, 177, 64)) > 20_000

"""Pictures as pixels: small enough, of the right colours, and never more of them than a bound."""

import io
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from core_pipeline.errors import UserError
from core_pipeline.faces.rigs import album
from core_pipeline.faces.rigs.album import Album
from core_pipeline.faces.rigs.pictures import SIDE, Unpacker, halved
from tests.helpers.pictures import png

REPEAT, CLAMP = ("repeat", "repeat"), ("clamp", "clamp")


class Rig:
    def __init__(self):
        self.notes = []

    def fail(self, what):
        return UserError(f"rig: {what}")

    def note(self, what):
        self.notes.append(what)


def unpacked(raw):
    rig = Rig()
    picture = Unpacker(rig).unpacked(raw, "image 0")
    assert rig.notes == []
    return picture


def as_png(image, **more):
    out = io.BytesIO()
    image.save(out, "PNG", compress_level=1, **more)
    return out.getvalue()


@pytest.mark.parametrize(
    ("size", "kept"), [((3, 5), (3, 5)), ((SIDE, SIDE), (SIDE, SIDE)), ((2 * SIDE, SIDE // 2), (SIDE, SIDE // 4))]
)
@pytest.mark.parametrize("mode", ["RGB", "RGBA", "P", "L", "LA"])
def test_pictures_of_every_kind_keep_their_colour_and_shape(size, kept, mode):
    grey = mode.startswith("L")
    colour = (120, 120, 120) if grey else (200, 30, 40)
    image = Image.new("RGBA", size, (*colour, 255)).convert(mode)
    picture = unpacked(as_png(image))
    assert picture.shape == (kept[1], kept[0], 4)
    assert picture.dtype == np.uint8
    np.testing.assert_allclose(picture[0, 0], (*colour, 255), atol=3 if mode == "P" else 0)
    assert np.ptp(picture, axis=(0, 1)).max() == 0


def test_made_smaller_it_keeps_the_colours_of_what_is_see_through():
    """Painters fill the gaps between strands with the colour of hair, so that edges do not darken."""
    hair = Image.new("RGBA", (2 * SIDE, 2), (90, 60, 30, 0))
    hair.putpixel((0, 0), (90, 60, 30, 255))
    picture = unpacked(as_png(hair))
    assert (picture[..., :3] == (90, 60, 30)).all()
    assert picture[0, 0, 3] == 64
    assert not picture[0, 1:, 3].any()


def test_a_palette_with_one_clear_colour():
    image = Image.new("P", (2, 1))
    image.putpalette([10, 20, 30, 40, 50, 60])
    image.putpixel((1, 0), 1)
    assert unpacked(as_png(image, transparency=1)).tolist() == [[[10, 20, 30, 255], [40, 50, 60, 0]]]


def test_a_palette_made_smaller_mixes_colours_not_their_numbers():
    image = Image.new("P", (2 * SIDE, 2))
    image.putpalette([0, 0, 0, 0, 0, 0, 200, 100, 50])
    image.paste(2, (0, 0, 2 * SIDE, 1))
    np.testing.assert_allclose(unpacked(as_png(image))[0, 0], (100, 50, 25, 255), atol=1)


@given(st.integers(1, 9), st.integers(1, 9), st.integers(0, 99))
def test_halving_gives_means(height, width, seed):
    picture = np.random.default_rng(seed).integers(0, 256, (height, width, 4)).astype(np.uint8)
    small = halved(picture)
    assert small.shape == (max(height // 2, 1), max(width // 2, 1), 4)
    assert small.dtype == np.uint8
    for (row, column, channel), value in np.ndenumerate(small):
        mean = picture[2 * row : 2 * row + 2, 2 * column : 2 * column + 2, channel].mean()
        assert value == math.floor(mean + 0.5)


def test_all_pictures_together_announce_no_more_than_a_bound():
    unpacker = Unpacker(Rig(), most=100)
    for number in range(4):
        assert unpacker.unpacked(png(np.zeros((5, 5, 3))), f"image {number}").shape == (5, 5, 4)
    with pytest.raises(UserError, match="too many pixels, taken together"):
        unpacker.unpacked(png(np.zeros((1, 1, 3))), "image 4")


# --- the album


def plain(side, value=0):
    return np.full((side, side, 4), value, np.uint8)


sides = st.lists(st.sampled_from([1, 2, 4, 8, 16]), max_size=12)


@given(sides)
def test_pictures_fit_whatever_they_were(sides):
    most = 4 * 16 * 16
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(album, "MAX_BYTES", most)
        made = Album()
        for number, side in enumerate(sides):
            made.texture(number, REPEAT, lambda side=side, number=number: plain(side, number))
            made.number(number, REPEAT)
            assert sum(texture.picture.nbytes for texture in made.textures()) <= most
    found = made.textures()
    assert [texture.picture[0, 0, 0] for texture in found] == list(range(len(sides)))
    if sum(side * side * 4 for side in sides) <= most:
        assert [texture.picture.shape[0] for texture in found] == sides, "none is made smaller without need"


def test_of_the_largest_the_last_is_halved(monkeypatch):
    monkeypatch.setattr(album, "MAX_BYTES", 4 * (64 + 64 + 4))
    made = Album()
    for number, side in enumerate((8, 2, 8, 4)):
        made.texture(number, REPEAT, lambda side=side: plain(side))
        made.number(number, REPEAT)
    assert [texture.picture.shape[0] for texture in made.textures()] == [8, 2, 4, 4]


def test_a_picture_is_asked_for_once_and_numbered_when_used():
    made, asked = Album(), []

    def unpack(key, picture):
        asked.append(key)
        return picture

    for wrap in (REPEAT, CLAMP, REPEAT):
        assert made.texture("a", wrap, lambda: unpack("a", plain(2))).wrap == wrap
        assert made.texture("b", wrap, lambda: unpack("b", None)) is None
        assert made.texture("c", wrap, lambda: unpack("c", plain(4))) is not None
    assert asked == ["a", "b", "c"]
    assert [made.number("c", CLAMP), made.number("a", CLAMP), made.number("c", CLAMP)] == [0, 1, 0]
    assert [(texture.picture.shape[0], texture.wrap) for texture in made.textures()] == [(4, CLAMP), (2, CLAMP)]

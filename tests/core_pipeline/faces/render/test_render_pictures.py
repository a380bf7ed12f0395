"""Pictures on a face: where their pixels come to lie, how they go on beyond their edges, what they leave out."""

from dataclasses import replace

import numpy as np
import pytest

from core_pipeline.faces.looks import Background, Look
from core_pipeline.faces.render.renderer import FaceRenderer
from core_pipeline.faces.texture import Material, Texture
from core_pipeline.faces.view import View
from tests.helpers.ball import ball

BALL = ball()
VIEW = View.of(BALL.camera)
REST = np.zeros(2, np.float32)
SIZE = (96, 96)
BLACK = Look(Background((0, 0, 0), (0, 0, 0), 0))
WHITE = (1.0, 1.0, 1.0, 0.0)

RED, GREEN, BLUE, CLEAR = (200, 10, 10, 255), (10, 200, 10, 255), (10, 10, 200, 255), (200, 10, 10, 0)


def plate(*pictures, material=None, reach=1.0, wrap=("clamp", "clamp"), side=0.9, behind=None):
    """A square facing +z under a picture of (rows of) colours, `reach` of it across; perhaps a plain one behind."""
    corner = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], np.float32) * side
    squares = [corner] if behind is None else [corner, corner - np.float32([0, 0, 0.3])]
    positions = np.concatenate(squares)
    count = len(positions)
    colours = np.tile(np.float32(WHITE), (count, 1))
    if behind is not None:
        colours[4:] = behind
    picture = np.kron(np.array(pictures, np.uint8), np.ones((16, 16, 1), np.uint8))
    return replace(
        BALL,
        positions=positions,
        normals=np.tile(np.float32([0, 0, 1]), (count, 1)),
        triangles=np.concatenate([[(0, 1, 2), (0, 2, 3)] + 4 * np.uint32(i) for i in range(count // 4)]).astype(
            np.uint32
        ),
        colours=colours,
        deltas=np.zeros((2, count, 3), np.float32),
        normal_deltas=np.zeros((2, count, 3), np.float32),
        parts={"front": (0, 2)} if behind is None else {"front": (0, 2), "behind": (2, 2)},
        textures=(Texture(picture, wrap),),
        materials={"front": material or Material(0)},
        texcoords=np.float32(reach) * np.tile(np.float32([(0, 1), (1, 1), (1, 0), (0, 0)]), (count // 4, 1)),
    )


def drawn(face, full_quality=False, view=VIEW):
    renderer = FaceRenderer(face)
    pixels = renderer.frame(REST, view, SIZE, full_quality, BLACK)[..., 2::-1].astype(int)
    renderer.close()
    return pixels


def name(rgb):
    """Which channel leads; "black" for none."""
    return "black" if rgb.max() < 25 else ("red", "green", "blue")[int(rgb.argmax())]


QUARTERS = {"upper left": (32, 32), "upper right": (32, 64), "lower left": (64, 32), "lower right": (64, 64)}


def seen(pixels):
    return [name(pixels[spot]) for spot in QUARTERS.values()]


@pytest.mark.parametrize("full_quality", [False, True])
def test_the_first_row_of_a_picture_is_its_top_and_v_goes_down(full_quality):
    pixels = drawn(plate([RED, GREEN], [BLUE, RED]), full_quality)
    assert seen(pixels) == ["red", "green", "blue", "red"]


@pytest.mark.parametrize(("wrap", "far", "farther"), [("clamp", 1, 1), ("repeat", 0, 1), ("mirror", 1, 0)])
def test_beyond_its_edges_it_goes_on_as_its_texture_says(wrap, far, farther):
    """Twice the picture in each direction: the spots lie at 0.3, 1.2 and 1.9 of it."""
    face = plate([RED, GREEN], [BLUE, RED], reach=2.0, wrap=(wrap, wrap))
    pixels = drawn(face)
    assert [name(pixels[24, column]) for column in (24, 56, 78)] == [
        "red",
        *(("red", "green")[i] for i in (far, farther)),
    ]
    assert [name(pixels[row, 24]) for row in (24, 56, 78)] == ["red", *(("red", "blue")[i] for i in (far, farther))]


def test_vertex_colours_multiply_it():
    face = plate([(255, 255, 255, 255)])
    face.colours[:, :3] = (0.02, 0.6, 0.02)
    assert name(drawn(face)[48, 48]) == "green"


def test_a_picture_of_one_grey_looks_as_the_same_grey_in_the_vertices():
    linear = ((128 / 255 + 0.055) / 1.055) ** 2.4
    plain = plate([(255, 255, 255, 255)])
    plain.colours[:, :3] = linear
    assert np.abs(drawn(plate([(128, 128, 128, 255)])) - drawn(plain)).max() <= 2


@pytest.mark.parametrize("full_quality", [False, True])
def test_below_the_cutoff_one_sees_through(full_quality):
    holes = plate([RED, CLEAR], material=Material(0, cutoff=0.5), behind=(0.02, 0.02, 0.6, 0))
    assert seen(drawn(holes, full_quality)) == ["red", "blue", "red", "blue"]
    opaque = plate([RED, CLEAR], behind=(0.02, 0.02, 0.6, 0))
    assert seen(drawn(opaque, full_quality)) == ["red"] * 4, "an opaque part has no holes, whatever its alpha"


def test_soft_alpha_fades_at_rest():
    """A quarter, a half, three quarters there: each lets more of the blue behind through than the next."""
    blues = []
    for alpha in (0, 77, 128, 179, 255):
        face = plate([(200, 10, 10, alpha)], material=Material(0, 0.4, soft=True), behind=(0.02, 0.02, 0.6, 0))
        blues.append(drawn(face, True)[40:56, 40:56].mean(axis=(0, 1))[2])
    assert (np.diff(blues) < -10).all()


def test_what_has_holes_casts_no_shadow():
    face = plate([RED], side=0.2, behind=(0.3, 0.3, 0.3, 0))
    face.positions[4:] *= np.float32([4.5, 4.5, 1])
    lacy = replace(face, materials={"front": Material(0, 0.5)})
    wall = [drawn(each)[..., 2] for each in (face, lacy)]  # what is blue is not the red plate
    shaded, free = (blue[52:70, 52:70][blue[52:70, 52:70] > 40].min() for blue in wall)
    assert shaded < free - 30


def test_from_afar_a_fine_print_becomes_its_mean_and_does_not_flicker():
    rows = np.where((np.indices((64, 64)).sum(0) % 2)[..., None], (255, 255, 255, 255), (0, 0, 0, 255))
    checks = plate([RED])
    checks = replace(
        checks, textures=(Texture(rows.astype(np.uint8), ("repeat", "repeat")),), texcoords=checks.texcoords * 40
    )
    inner = drawn(checks)[30:66, 30:66]
    assert np.ptp(inner.reshape(-1, 3), axis=0).max() < 60


def test_a_picture_goes_with_its_face_and_comes_back():
    face, other = plate([GREEN]), plate([BLUE])
    renderer = FaceRenderer(face)
    names = []
    for which in (face, other, BALL, face):
        renderer.face = which
        names.append(name(renderer.frame(REST, VIEW, SIZE, False, BLACK)[48, 48, 2::-1].astype(int)))
    renderer.close()
    assert names[:2] == ["green", "blue"]
    assert names[3] == "green"


def test_black_where_nothing_is_does_not_darken_the_edge():
    """A picture of clear black with a light middle: between the two nothing is darker than the middle itself."""
    face = plate([(0, 0, 0, 0)], material=Material(0, 0.3))
    spot = np.zeros((8, 8, 4), np.uint8)
    spot[2:6, 2:6] = (200, 200, 200, 255)
    pixels = drawn(replace(face, textures=(Texture(spot, ("clamp", "clamp")),)))[..., 1]
    assert pixels[pixels > 8].min() > 0.9 * pixels.max()

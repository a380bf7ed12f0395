"""What a see-through picture leaves of a triangle: what it has at 45 places all over it, or a little more."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core_pipeline.faces.rigs import picture_alpha
from core_pipeline.faces.rigs.picture_alpha import highest_alpha, wrapped
from core_pipeline.faces.texture import Texture
from tests.helpers.pictures import pixel, sampled

WRAPS = ("repeat", "clamp", "mirror")
TRIANGLE = np.array([[0, 1, 2]], np.uint32)


def dotted(height, width, seed, dots):
    chance = np.random.default_rng(seed)
    picture = np.zeros((height, width, 4), np.uint8)
    picture[chance.integers(height, size=dots), chance.integers(width, size=dots), 3] = chance.integers(1, 256, dots)
    return picture


def on(triangle, steps):
    """Points all over a triangle (3, 2)."""
    a, b = np.meshgrid(np.linspace(0, 1, steps), np.linspace(0, 1, steps))
    a, b = a[a + b <= 1], b[a + b <= 1]
    return np.stack([1 - a - b, a, b], -1) @ triangle


triangles = st.lists(st.tuples(*[st.floats(-2, 2, width=32)] * 2), min_size=3, max_size=3)


@given(
    triangles,
    st.tuples(st.integers(1, 40), st.integers(1, 40)),
    st.integers(0, 99),
    st.tuples(*[st.sampled_from(WRAPS)] * 2),
)
def test_nothing_is_missed_at_any_of_45_places_of_a_triangle(corners, size, seed, wrap):
    """A pixel whose corner alone is touched between two of them may be: nobody would see it."""
    texture = Texture(dotted(*size, seed, 3), wrap)
    places = np.float32(corners)
    found = highest_alpha(texture, places, TRIANGLE)[0]
    points = on(places.astype(float), 9)
    off_edges = np.abs(points * size[::-1] - np.round(points * size[::-1])).min(axis=1) > 1e-5
    assume(off_edges.any())
    assert found >= sampled(texture, points[off_edges])[:, 3].max() - 1e-6


@given(triangles, st.integers(0, 99))
def test_and_little_is_found_beside_it(corners, seed):
    side = 64
    places = np.float32(corners) * 0.3 + 0.5
    texture = Texture(dotted(side, side, seed, 3), ("clamp", "clamp"))
    longest = np.abs(places - np.roll(places, 1, axis=0)).max() * side
    beside = max(longest / 4, 1) + 1
    on_picture = np.clip(places * side, 0, side - 1)  # beyond its edges there is more of the edge
    low, high = on_picture.min(0) - beside, on_picture.max(0) + beside
    rows, columns = np.nonzero(texture.picture[..., 3])
    clipped = np.clip([low, high], 0, side - 1)
    near = (
        (columns >= clipped[0, 0] - 1)
        & (columns <= clipped[1, 0])
        & (rows >= clipped[0, 1] - 1)
        & (rows <= clipped[1, 1])
    )
    most = texture.picture[rows[near], columns[near], 3].max(initial=0) / 255
    assert highest_alpha(texture, places, TRIANGLE)[0] <= most + 1e-6


def test_a_small_triangle_sees_its_own_pixels_alone():
    picture = np.zeros((8, 8, 4), np.uint8)
    picture[3, 5, 3] = 200
    inside, beside = np.float32([(0.64, 0.39), (0.74, 0.39), (0.64, 0.49)]), np.float32([(0, 0), (0.6, 0), (0, 0.3)])
    texture = Texture(picture)
    assert highest_alpha(texture, inside, TRIANGLE)[0] == pytest.approx(200 / 255)
    assert highest_alpha(texture, beside, TRIANGLE)[0] == 0


@given(st.floats(-5, 5), st.sampled_from(WRAPS), st.integers(1, 9))
def test_wrapping_falls_on_the_pixel_that_counting_finds(value, wrap, side):
    value = round(value, 3) + 0.0001  # off the edges between pixels
    at = int(wrapped(np.array([value]), wrap)[0] * side)
    assert min(at, side - 1) == pixel(value, wrap, side)


def test_many_triangles_are_looked_at_in_turns(monkeypatch):
    texture = Texture(dotted(16, 16, 1, 40))
    places = np.random.default_rng(2).uniform(-1, 2, (300, 2)).astype(np.float32)
    corners = np.arange(300, dtype=np.uint32).reshape(-1, 3)
    whole = highest_alpha(texture, places, corners)
    monkeypatch.setattr(picture_alpha, "_TOGETHER", 7)
    np.testing.assert_array_equal(highest_alpha(texture, places, corners), whole)
    assert highest_alpha(texture, places, corners[:0]).shape == (0,)

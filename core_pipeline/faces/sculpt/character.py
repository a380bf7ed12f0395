"""What makes one character another: all the numbers of a head, its mouth's poses and its colours.

Lengths are in head radii (+y up, +z to the front), angles in degrees, colours as a painter picks them (sRGB, 0…1).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from core_pipeline.faces.face import Camera
from core_pipeline.faces.sculpt.sdf import Blob, Point

Pair = tuple[float, float]


@dataclass(frozen=True)
class Mouth:
    """The lips at rest, and what lies behind them; `rim` is how high each lip is at least, also at the corners.

    taper  how much thinner than their middle the lips are towards the corners: 1 is an ellipse
    inset  0…1: how far the inside of the corners is drawn in; on a strongly curved face it would come out beside them
    """

    height: float = -0.42
    half_width: float = 0.36
    smile: float = 0.05
    upper: float = 0.07
    lower: float = 0.09
    upper_depth: float = 0.042
    lower_depth: float = 0.05
    lap: float = 0.02
    bow: float = 1.0
    rim: float = 0.026
    taper: float = 1.05
    corner_jaw: float = 0.36
    hinge: Point = (0.0, -0.10, -0.05)
    bag: tuple[float, float, float] = (0.40, 0.24, 0.62)
    inset: float = 0.0


@dataclass(frozen=True)
class Dentition:
    """Two rows of teeth on a horseshoe: half width, depth; and the heights that matter relative to the lips' line.

    sink  how much lower the edges of the lower row lie at its sides
    """

    half_width: float = 0.30
    depth: float = 0.42
    behind_lips: float = 0.115
    edge: float = -0.03
    upper_height: float = 0.14
    lower_height: float = 0.12
    bite: float = 0.012
    thickness: float = 0.034
    sink: float = 0.06
    per_side: int = 6


@dataclass(frozen=True)
class TongueBend:
    """The tongue's middle line as four Bézier points (y, z), relative to the middle of the mouth."""

    line: tuple[Pair, Pair, Pair, Pair]
    tip_width: float = 1.0


@dataclass(frozen=True)
class MouthPose:
    """What a pose does to the mouth; everything 0 is the neutral face.

    jaw                opens, degrees
    width              corners outwards, in half widths
    raise_upper        middle of the upper lip up; drop_lower: of the lower lip down
    corners            up; forward: middle of the lips out; corner_forward likewise
    roll_upper/lower   degrees, positive flares outwards, negative curls in
    thick              more (+) or less (−) visible lip, fraction
    rounded            0…1 towards a ring of lip `ring` thick round a hole of half sizes `hole`
    slide              upper lip down and forward over the lower: presses without running into it
    tuck               (up, back) of the lower lip alone
    upper_teeth, lower_teeth  (up, forward): where no one can see it they make room for the lips
    cheeks             lifted
    flat               0…1: the slope on which the lips meet laid flat, so that the lower lip hides no teeth
    """

    jaw: float = 0.0
    width: float = 0.0
    raise_upper: float = 0.0
    drop_lower: float = 0.0
    corners: float = 0.0
    forward: float = 0.0
    corner_forward: float = 0.0
    roll_upper: float = 0.0
    roll_lower: float = 0.0
    thick: float = 0.0
    thick_lower: float = 0.0
    rounded: float = 0.0
    hole: Pair = (0.06, 0.06)
    ring: float = 0.08
    slide: float = 0.0
    tuck: Pair = (0.0, 0.0)
    upper_teeth: Pair = (0.0, 0.0)
    lower_teeth: Pair = (0.0, 0.0)
    cheeks: float = 0.0
    flat: float = 0.0
    tongue: TongueBend | None = None


@dataclass(frozen=True)
class Eyes:
    """Right eye; the left one is its mirror image. Lid heights, half width and lash length in eye radii.

    skew     of the upper and lower lid: + has its peak nearer to the temple, − nearer to the nose
    pointed  shape of the corners: 1 is an ellipse's, more is narrower
    spread   how much farther than to the sides the rings of the mesh round a narrow eye reach up and down
    ease     0…1 how much less the skin round the corners follows a blink
    crease   how deep the fold above the upper lid is drawn, 0…1
    shut     where a blink's lids meet: 0 at the lower lid's edge, 1 at the upper one's
    streaks  how much the iris' colour changes round the pupil, 0…1
    lashes   single lashes on each upper lid
    """

    centre: Point = (0.325, 0.17, 0.62)
    radius: float = 0.27
    half_width: float = 0.83
    upper: float = 0.66
    lower: float = 0.56
    slant: float = 0.04
    yaw: float = 9.0
    gaze: Pair = (3.0, -1.0)
    iris: float = 31.0
    pupil: float = 16.0
    iris_colour: Point = (0.20, 0.45, 0.60)
    lash: float = 1.0
    skew: Pair = (0.0, 0.0)
    pointed: float = 1.1
    spread: float = 0.0
    ease: float = 0.0
    crease: float = 0.0
    shut: float = 0.36
    lashes: int = 0
    lash_length: float = 0.3
    streaks: float = 0.0


@dataclass(frozen=True)
class Brows:
    """(x, height above the eye's centre, half thickness) along the right brow, from nose to temple.

    hairs  so many single ones on a painted ground, instead of one solid piece
    """

    line: tuple[tuple[float, float, float], ...] = (
        (0.12, 0.395, 0.030),
        (0.22, 0.455, 0.044),
        (0.34, 0.475, 0.042),
        (0.46, 0.435, 0.032),
        (0.55, 0.365, 0.010),
    )
    lift: float = 0.09
    hairs: int = 0


@dataclass(frozen=True)
class Lock:
    """A strand of hair: points on the head as (azimuth from the front, angle from the crown, height over the scalp)."""

    path: tuple[tuple[float, float, float], ...]
    width: float
    thickness: float


@dataclass(frozen=True)
class Sheet:
    """A layer of hair between guide strands: each is a line of points in space from root to tip, all equally many.

    The guides go from the face to the back of the head. `height` is the least distance from the scalp, `thickness`
    of the layer, `clumps` how many strands it shows: their number times the columns of each, and one, are `columns`.
    `ragged` is how much their tips differ (part of their length), `wave` how far they swing to the sides and `waves`
    how often. `edge` is the part of its width on which it thins out at either side (0 where the sides meet),
    `relief` how deep the clumps are parted (0…1), `streaks` how much single strands differ in lightness.
    """

    guides: tuple[tuple[Point, ...], ...]
    thickness: float = 0.06
    height: float = 0.03
    clumps: float = 7.0
    ragged: float = 0.08
    wave: float = 0.0
    waves: float = 1.6
    edge: float = 0.10
    relief: float = 0.55
    streaks: float = 0.10
    columns: int = 28
    rows: int = 18
    mirrored: bool = True


@dataclass(frozen=True)
class Hair:
    """hairline: (azimuth from the front, angle from the crown); thickness over the scalp at front, top and back.

    resolution  columns and rows of the cap; sheets and locks lie on it
    """

    hairline: tuple[Pair, ...]
    crown: Point = (0.0, 0.84, -0.40)
    front: float = 0.17
    top: float = 0.13
    back: float = 0.10
    quiff: float = 0.16
    clumps: int = 11
    twist: float = 1.2
    locks: tuple[Lock, ...] = ()
    sheets: tuple[Sheet, ...] = ()
    gloss: float = 0.45
    resolution: tuple[int, int] = (76, 15)


@dataclass(frozen=True)
class Ears:
    """Where they sit, half width and half height, and how far they stand off."""

    centre: Point = (0.86, 0.02, -0.06)
    size: Pair = (0.15, 0.22)
    stand_off: float = 32.0


@dataclass(frozen=True)
class Body:
    """Neck and shirt below the head."""

    neck: float = 0.33
    middle: float = -0.16
    collar: float = -1.20


@dataclass(frozen=True)
class Palette:
    """Colours of the parts; `stubble` 0…1 is the shadow of a beard, in the colour of the brows.

    variation  0…1 how much skin and lips change from place to place
    """

    skin: Point = (0.93, 0.69, 0.56)
    blush: Point = (0.93, 0.45, 0.40)
    lid: Point = (0.86, 0.58, 0.46)
    lip: Point = (0.80, 0.41, 0.38)
    inner_lip: Point = (0.55, 0.20, 0.20)
    throat: Point = (0.10, 0.015, 0.025)
    teeth: Point = (0.97, 0.96, 0.92)
    gums: Point = (0.78, 0.36, 0.38)
    tongue: Point = (0.88, 0.42, 0.44)
    hair: Point = (0.35, 0.19, 0.09)
    hair_light: Point = (0.52, 0.31, 0.15)
    brow: Point = (0.27, 0.14, 0.07)
    lash: Point = (0.20, 0.10, 0.07)
    shirt: Point = (0.16, 0.50, 0.56)
    shirt_trim: Point = (0.95, 0.90, 0.80)
    stubble: float = 0.0
    variation: float = 0.0


@dataclass(frozen=True)
class Character:
    """One face of ours: `poses` become its blendshapes, beside blink and browUp.

    middle    from where the clay is cast into skin; nose: its tip, which the mesh is finer round
    nostrils  the right one, drawn dark
    density   of the skin's mesh: 2 halves the distance between vertices
    sky       0…1 how much of the shade that hair, brow and chin throw is baked into the colours
    """

    name: str
    title: str
    clay: tuple[Blob, ...]
    poses: Mapping[str, MouthPose]
    hair: Hair
    rest_tongue: TongueBend
    mouth: Mouth = Mouth()
    teeth: Dentition = Dentition()
    eyes: Eyes = Eyes()
    brows: Brows = Brows()
    ears: Ears | None = Ears()
    body: Body = Body()
    palette: Palette = Palette()
    camera: Camera = field(default_factory=Camera)
    middle: Point = (0.0, -0.12, 0.05)
    nose: Point = (0.0, -0.10, 0.97)
    nostrils: Point | None = None
    lip_columns: int = 80
    density: float = 1.0
    sky: float = 0.0
    pose_map: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

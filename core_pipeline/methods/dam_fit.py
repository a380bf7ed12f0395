"""Learning dominated animemes (Chen et al., section V): modes, then E and M steps for each pose.

corpus ─→ modes of every phone ─→ ╭ E: animemes, tied linear least squares (equations 4 to 7)  ╮ ≤ 12 rounds
                                  ╰ M: dominances, Gauss–Newton on log σ (equations 8 and 9)   ╯
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..learning.corpus import Corpus
from ..one_thread import one_thread
from .cluster import affinity_propagation, k_means, merged
from .dam import Dam
from .dominance import Reach, joined, reach_of
from .em import Control, Fit, Shared
from .method import Array, Progress, no_progress
from .modes import ModeTable
from .segments import NOTHING_SEEN, Segments, segments_of
from .visemes import filled_in

Ints = NDArray[np.intp]

#: Frames a second that a fit looks at; a phone of 50 ms still has three.
FIT_FPS = 60.0
#: … and how many in all; of a longer corpus it looks at every second, third, … (a frame takes a kilobyte).
FIT_FRAMES = 250_000
#: Occurrences from which affinity propagation looks at some only: it takes their square in memory.
MOST_POINTS = 600


@dataclass(frozen=True)
class DamOptions:
    """degree    M: 4, or 0 for Cohen and Massaro's model (ValueError outside 0…8)
    modes     the most of one phone
    smallest  a mode of fewer occurrences is joined to another
    ridge     of the linear fit; None: 1e-3, more for a corpus of few phones
    rounds    of E and M at most
    still     a fit ends when the error falls by less than this share in a round
    clusters  "kmeans" or "affinity" (propagation, as the paper has it; slower)
    """

    degree: int = 4
    modes: int = 4
    smallest: int = 12
    ridge: float | None = None
    rounds: int = 12
    still: float = 1e-4
    clusters: str = "kmeans"

    def __post_init__(self) -> None:
        if not 0 <= self.degree <= 8 or self.modes < 1 or self.clusters not in ("kmeans", "affinity"):
            raise ValueError("degree 0 to 8, at least one mode, clusters kmeans or affinity")


COHEN_MASSARO = DamOptions(degree=0, modes=1)


def fit(corpus: Corpus, options: DamOptions | None = None, progress: Progress = no_progress) -> Dam:
    """Learn a model. UserError when no phone of the corpus was seen; whatever `progress` raises ends the fit."""
    with one_thread():
        return _fit(corpus, options or DamOptions(), progress)


def _fit(corpus: Corpus, options: DamOptions, progress: Progress) -> Dam:
    progress(0.0, "modes")
    segments = segments_of(corpus)
    if not segments.phone.size:
        raise UserError(NOTHING_SEEN)
    phones = corpus.phones
    mode = _modes(segments, len(phones), options)
    of_phone = np.array([mode[segments.phone == p].max(initial=0) + 1 for p in range(len(phones))])
    first = np.concatenate(([0], of_phone.cumsum()))
    reach, target = _frames(corpus, segments, first, mode, options.degree)
    if not len(target):
        raise UserError(NOTHING_SEEN)
    shared = Shared.of(reach, int(first[-1]), normalised=options.degree == 0)
    ridge = options.ridge if options.ridge is not None else _ridge(segments.phone.size)
    fits = []
    for p, pose in enumerate(corpus.poses):
        control = Control(shared, target[:, p], ridge)

        def told(share: float, p: int = p, pose: str = pose) -> None:
            progress((p + share) / len(corpus.poses), pose)

        fits.append(control.learn(options.rounds, options.still, told))
    progress(1.0, "done")
    rows = zip(segments.before.tolist(), segments.phone.tolist(), segments.after.tolist(), mode.tolist(), strict=True)
    return _model(corpus, first, fits, np.bincount(first[segments.phone] + mode, minlength=first[-1]), list(rows))


def fit_cohen_massaro(corpus: Corpus, options: DamOptions | None = None, progress: Progress = no_progress) -> Dam:
    """Cohen and Massaro's model: one number for each phone and pose, normalised dominances."""
    return fit(corpus, options or COHEN_MASSARO, progress)


def _ridge(phones: int) -> float:
    """1e-3; up to 0.3 where there are too few phones to hold 5 coefficients of each."""
    return 1e-3 if phones >= 50 else float(np.interp(phones, [10, 50], [0.3, 0.1]))


def _modes(segments: Segments, phones: int, options: DamOptions) -> Ints:
    """(n,) the mode of every segment, counted from 0 within its phone."""
    mode = np.zeros(segments.phone.size, np.intp)
    points = segments.motion.reshape(len(segments.motion), -1)
    for phone in range(phones):
        mine = (segments.phone == phone).nonzero()[0]
        most = min(options.modes, mine.size // options.smallest)
        if most < 2:
            continue
        if options.clusters == "affinity":
            some = mine[:: -(-mine.size // MOST_POINTS)]
            found = affinity_propagation(points[some])
            centres = np.array([points[some][found == c].mean(0) for c in range(found.max() + 1)])
            labels = ((points[mine][:, None] - centres) ** 2).sum(-1).argmin(1).astype(np.intp)
            labels = merged(points[mine], labels, max(options.smallest, mine.size // (2 * options.modes)))
        else:
            labels = merged(points[mine], k_means(points[mine], most), options.smallest)
        mode[mine] = labels
    return mode


def _frames(corpus: Corpus, segments: Segments, first: Ints, mode: Ints, degree: int) -> tuple[Reach, Array]:
    """The frames to fit, and their weights (f, poses). A phone that was not seen counts as its first mode."""
    number = {phone: i for i, phone in enumerate(corpus.phones)}
    reaches, targets = [], []
    thin = -(-sum(len(clip.weights.frames) for clip in corpus) // FIT_FRAMES)
    for c, clip in enumerate(corpus):
        if not len(clip.schedule):
            continue
        states = first[[number[phone] for phone in clip.schedule.phones]]
        mine = segments.clip == c
        states[segments.index[mine]] += mode[mine]
        use = clip.usable().nonzero()[0]
        every = max(1, round(clip.weights.fps / FIT_FPS), thin)
        use = use[::every]
        reaches.append(reach_of(clip.schedule, states, clip.frame_times[use], degree))
        targets.append(clip.weights.frames[use].astype(np.float64))
    return joined(reaches), np.concatenate(targets)


def _model(corpus: Corpus, first: Ints, fits: list[Fit], seen: Ints, rows: list[tuple[int, int, int, int]]) -> Dam:
    """The fits of all poses together; phones that were never seen get the mean of their class, or of all."""
    coefficients = np.stack([fit.coefficients for fit in fits], axis=-1)
    log_sigma = np.stack([fit.log_sigma for fit in fits], axis=-1)
    both = np.concatenate([coefficients, log_sigma[:, None]], axis=1) * seen[:, None, None]
    owner = np.repeat(np.arange(len(corpus.phones)), np.diff(first))
    total = np.zeros((len(corpus.phones), *both.shape[1:]))
    np.add.at(total, owner, both)
    count = np.bincount(owner, weights=seen, minlength=len(corpus.phones)).astype(np.float64)
    stand_in = filled_in(total, count, corpus.phones)
    made = np.concatenate([coefficients, log_sigma[:, None]], axis=1)
    unseen = count[owner] == 0
    made[unseen] = stand_in[owner[unseen]]
    made = np.concatenate([made, stand_in[-1:]])
    return Dam(
        corpus.poses,
        corpus.phones,
        corpus.phoneme_map,
        np.append(first, first[-1] + 1),
        np.ascontiguousarray(made[:, :-1]),
        np.exp(made[:, -1]),
        ModeTable.of(rows),
        np.array([fit.error for fit in fits]),
    )

"""Learning AnimPhos: segments, k-means, and who followed whom (Wei and Deng, "Clustering")."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import UserError
from ..learning.corpus import Corpus
from .animpho import AnimPho
from .animpho_select import SELECTIONS
from .cluster import k_means, means
from .method import Progress, class_of, no_progress
from .segments import NOTHING_SEEN, SAMPLES, segments_of

#: More AnimPhos than this would make the tables too large.
MOST = 3000


@dataclass(frozen=True)
class AnimPhoOptions:
    """share      AnimPhos by segments (the paper leaves m open; a quarter gives its 3.45 ways out of each)
    selection  one of SELECTIONS (ValueError otherwise)
    seed       of k-means
    """

    share: float = 0.25
    selection: str = "priority"
    seed: int = 0

    def __post_init__(self) -> None:
        if self.selection not in SELECTIONS or not 0 < self.share <= 1:
            raise ValueError(f"a share of 0…1 and a selection of {', '.join(SELECTIONS)}")


def fit(corpus: Corpus, options: AnimPhoOptions | None = None, progress: Progress = no_progress) -> AnimPho:
    """Learn a model. UserError when no phone of the corpus was seen; whatever `progress` raises ends the fit."""
    options = options or AnimPhoOptions()
    progress(0.0, "segments")
    segments = segments_of(corpus)
    n = segments.phone.size
    if not n:
        raise UserError(NOTHING_SEEN)
    progress(0.2, "clusters")
    points = segments.motion.reshape(n, -1)
    cluster = k_means(points, min(MOST, max(1, round(n * options.share))), options.seed)
    centres = means(points, cluster).reshape(-1, SAMPLES, len(corpus.poses))
    progress(0.9, "transitions")
    m, phones = len(centres), corpus.phones
    follows = np.zeros((m, m), bool)
    second = segments.follows.nonzero()[0]
    follows[cluster[second - 1], cluster[second]] = True
    labels = np.zeros((len(phones) + 1, m), bool)
    labels[segments.phone, cluster] = True
    labels[-1] = True
    classes = np.array([class_of(phone) for phone in phones])
    for p in np.flatnonzero(labels[:-1].sum(1) == 0):
        labels[p] = labels[:-1][classes == classes[p]].any(0)
        if not labels[p].any():
            labels[p] = True
    progress(1.0, "done")
    return AnimPho(corpus.poses, phones, corpus.phoneme_map, centres, follows, labels, options.selection)

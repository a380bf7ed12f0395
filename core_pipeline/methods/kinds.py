"""The methods by name: what can be learned, with which options, and how each reports itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ..learning.bigram_curves import learn_bigrams
from ..learning.corpus import Corpus
from . import animpho_fit, dam_fit, visemes
from .animpho import AnimPho
from .animpho_fit import AnimPhoOptions
from .bigram import BigramMethod
from .dam import Dam
from .dam_fit import DamOptions
from .method import Progress
from .visemes import Visemes

Learned = Dam | AnimPho | Visemes | BigramMethod


@dataclass(frozen=True)
class Kind:
    """A method that can be learned: fit(corpus, clusters, selection, progress); what does not apply is idle."""

    title: str
    fit: Callable[[Corpus, str, str, Progress], Learned]


def _bigrams(corpus: Corpus, _clusters: str, _selection: str, progress: Progress) -> BigramMethod:
    return BigramMethod(learn_bigrams(corpus, progress=progress).curve_set("Learned"))


def _dam(corpus: Corpus, clusters: str, _selection: str, progress: Progress) -> Dam:
    return dam_fit.fit(corpus, DamOptions(clusters=clusters), progress)


def _cohen_massaro(corpus: Corpus, _clusters: str, _selection: str, progress: Progress) -> Dam:
    return dam_fit.fit_cohen_massaro(corpus, progress=progress)


def _animpho(corpus: Corpus, _clusters: str, selection: str, progress: Progress) -> AnimPho:
    return animpho_fit.fit(corpus, AnimPhoOptions(selection=selection), progress)


def _visemes(corpus: Corpus, _clusters: str, _selection: str, progress: Progress) -> Visemes:
    return visemes.fit(corpus, progress=progress)


KINDS: Mapping[str, Kind] = {
    "bigrams": Kind("bigram curves (Xu et al., section 5.1)", _bigrams),
    "dam": Kind("dominated animemes (Chen et al.)", _dam),
    "cohen-massaro": Kind("Cohen and Massaro's dominances", _cohen_massaro),
    "animpho": Kind("AnimPhos (Wei and Deng)", _animpho),
    "visemes": Kind("viseme interpolation", _visemes),
}

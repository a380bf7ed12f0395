"""`lipstitch fit`: a corpus → a model or a curve set, with a report. Nothing is written until all is learned."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TYPE_CHECKING

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.json_text import shown

from .. import resources
from ..workers.aligner import aligner
from .corpus import spoken
from .progress import Progress
from .steps import tell

if TYPE_CHECKING:
    from core_pipeline.learning.corpus import Corpus
    from core_pipeline.methods.kinds import Learned

#: Notes on clips that are told; a corpus of thousands may have as many.
MOST_NOTES = 30
_STEPS = 100


def fit(options: argparse.Namespace) -> int:
    """Learn, write, report."""
    from core_pipeline.learning.corpus import Corpus
    from core_pipeline.methods.compare import held_out_error
    from core_pipeline.methods.kinds import KINDS

    ending = ".json" if options.method == "bigrams" else ".npz"
    if options.out.suffix.lower() != ending:
        what = "a learned set" if ending == ".json" else "a model"
        raise UserError(f"{options.out} should end in {ending}: that is what {what} is saved as.")
    if options.hold_out < 0 or options.hold_out == 1:
        raise UserError("--hold-out 1 would keep every clip: choose 2 or more, such as 5 for every fifth.")
    like = curve_set_json.read(options.curves or resources.english_curves()).curve_set
    corpus = read_corpus(options.corpus, like, options.voice)
    kept = corpus.clips[options.hold_out - 1 :: options.hold_out] if options.hold_out else ()
    if kept:
        rest = [clip for clip in corpus.clips if clip not in kept]
        corpus = Corpus.of(rest, corpus.phonemes, corpus.phoneme_map, corpus.notes)
    kind = KINDS[options.method]
    began = time.perf_counter()
    with Progress(_STEPS, "%") as progress:
        learned = kind.fit(
            corpus,
            options.clusters,
            options.selection,
            lambda share, what: progress.step(round(share * _STEPS), f"%: {what}"),
        )
    seconds = time.perf_counter() - began
    about = {
        "clips": len(corpus),
        "seconds": round(corpus.seconds, 2),
        "phones": sum(len(clip.schedule) for clip in corpus),
        "error": round(held_out_error(learned, corpus.clips), 5),
    }
    if kept:
        about |= {"held_out_clips": len(kept), "held_out_error": round(held_out_error(_filled(learned), kept), 5)}
    _save(learned, options.out, about, like)
    for line in _report(learned, corpus, about, seconds, kind.title):
        print(line)
    print(options.out)
    return 0


def read_corpus(path: Path, like: CurveSet, voice: str) -> Corpus:
    """A folder of clips, or a text of which every sentence is spoken and baked with the curves of `like`."""
    from core_pipeline.faces.mapping_json import load_presets
    from core_pipeline.learning.corpus import Clip, Corpus
    from core_pipeline.learning.corpus_folder import Reader
    from core_pipeline.methods.bigram import BigramMethod

    if path.is_file():
        method = BigramMethod(like)
        clips = [Clip.of(text, s, method.synthesize(s, like.poses, 60)) for text, s in spoken(path, voice)]
        return Corpus.of(clips, like.phonemes, like.phoneme_map)
    with Progress(_STEPS, "%") as progress, aligner(voice) as align:
        corpus = Reader(like, load_presets(resources.retarget_presets()), align).read(
            path, lambda share, name: progress.step(round(share * _STEPS), f"%: {name}")
        )
    for note in corpus.notes[:MOST_NOTES]:
        tell(shown(note, 500))
    if len(corpus.notes) > MOST_NOTES:
        tell(f"{len(corpus.notes) - MOST_NOTES} more notes on other clips.")
    return corpus


def _filled(learned: Learned) -> Learned:
    """Bigrams with suggestions where nothing was heard, as they would be used; others as they are."""
    from dataclasses import replace

    from core_pipeline.methods.bigram import BigramMethod
    from core_pipeline.suggest import fill

    if not isinstance(learned, BigramMethod):
        return learned
    found = learned.curve_set
    return BigramMethod(replace(found, bigrams={**fill(found), **found.bigrams}))


def _save(learned: Learned, path: Path, about: dict[str, float], like: CurveSet) -> None:
    from dataclasses import replace

    from core_pipeline.files import model_npz
    from core_pipeline.methods.bigram import BigramMethod

    if isinstance(learned, BigramMethod):
        told = f"Learned from {about['clips']} clips, {about['phones']} phones"
        made = replace(learned.curve_set, language=like.language, settings=like.settings, provenance=told)
        curve_set_json.save(made, path)
    else:
        model_npz.save(learned, path, about)


def _report(learned: Learned, corpus: Corpus, about: dict[str, float], seconds: float, title: str) -> list[str]:
    from core_pipeline.methods.animpho import AnimPho
    from core_pipeline.methods.bigram import BigramMethod
    from core_pipeline.phonemes import SILENCE, pair_name

    aside = f", {about['held_out_error']:.4f} on {about['held_out_clips']} kept aside" if len(about) > 4 else ""
    clips = "1 clip" if len(corpus) == 1 else f"{len(corpus)} clips"
    size = f"{clips}, {corpus.seconds:.1f} s, {about['phones']} phones, {len(corpus.poses)} poses"
    lines = [
        f"{title[0].upper()}{title[1:]} from {size}, in {seconds:.2f} s.",
        f"RMSE {about['error']:.4f} on these clips{aside}.",
    ]
    residuals = [clip.residual for clip in corpus if clip.residual]
    if residuals:
        lines.append(f"The poses leave {sum(residuals) / len(residuals):.0%} of the captured motion unexplained.")
    silent = [phone for phone in corpus.phonemes if phone not in corpus.counts()]
    if silent:
        lines.append(f"Never heard: {' '.join(silent)}.")
    if isinstance(learned, AnimPho):
        rate = learned.missing_rate([clip.schedule for clip in corpus])
        lines.append(f"{len(learned.centres)} AnimPhos; {rate:.0%} of these clips' transitions are misses.")
    if isinstance(learned, BigramMethod):
        found = learned.curve_set.bigrams
        missing = learned.curve_set.missing()
        lines.append(f"{sum(SILENCE not in p for p in found)} of {len(corpus.phonemes) ** 2} bigrams were heard.")
        rare = [p for p, b in found.items() if SILENCE not in p and b.extra["learned"]["occurrences"] < 3]
        lines.append(f"{len(rare)} of them once or twice; {len(missing)} never: `lipstitch suggest` fills those.")
        worst = sorted(found, key=lambda p: -found[p].extra["learned"]["residual"])[:8]
        told = ", ".join(f"{pair_name(p)} {found[p].extra['learned']['residual']:.3f}" for p in worst)
        lines.append(f"Largest residuals: {told}.")
    return lines

"""`lipstitch stats`: the paper's table 2 and figure 2 of any text; and `build-frequencies`, of our own corpus."""

from __future__ import annotations

import argparse
import json

from core_pipeline.curve_set import CurveSet
from core_pipeline.files import curve_set_json, frequencies_json
from core_pipeline.phonemes import COMMON, TABLE_1, Pair, pair_name
from core_pipeline.statistics import PAPER_COVER, PAPER_FIRST, PAPER_NEVER, TABLE_2, Frequencies, progress

from .. import resources
from .corpus import spoken

#: Shares of running speech for which the number of pairs is told, figure 2 read off.
COVERS = (0.5, 0.75, 0.9, 0.95, PAPER_COVER)


def stats(options: argparse.Namespace) -> int:
    """Print how often each pair of a text is said."""
    curve_set = curve_set_json.load(options.curves) if options.curves else None
    phonemes = COMMON if curve_set is None else curve_set.phonemes
    phoneme_map = TABLE_1 if curve_set is None else curve_set.phoneme_map
    schedules = (schedule for _, schedule in spoken(options.file, options.voice))
    said = Frequencies.of(schedules, phonemes, phoneme_map)
    if options.json:
        print(json.dumps(_record(said, curve_set), ensure_ascii=False))
    else:
        for line in [*_table(said), *_curve(said), *_cover(said, curve_set)]:
            print(line)
    return 0


def build_frequencies(_: argparse.Namespace) -> int:
    """Speak and count our corpus, and write its table."""
    folder = resources.corpus()
    schedules = (schedule for _, schedule in spoken(folder / "utterances.txt", "en-us"))
    path = folder / "frequencies.json"
    frequencies_json.save(Frequencies.of(schedules, COMMON, TABLE_1), path)
    print(path)
    return 0


def _table(said: Frequencies) -> list[str]:
    lines = [
        f"{said.total} pairs in {said.utterances} sentences; {len(said.counts)} of {said.possible} different ones.",
        "",
        "       this text              table 2 of the paper",
    ]
    theirs: list[tuple[Pair, float]] = list(TABLE_2.items())
    for rank, (other, percent) in enumerate(theirs):
        ours = said.top()[rank] if rank < len(said.counts) else None
        left = "" if ours is None else f"{pair_name(ours):10}{100 * said.shares[ours]:6.2f} %"
        mark = "*" if ours in TABLE_2 else " "
        lines.append(f"{rank + 1:4} {mark} {left:20}    {pair_name(other):10}{percent:6.2f} %")
    return [*lines, f"     * {said.shared_with_paper()} of these {len(TABLE_2)} are in the paper's table."]


def _curve(said: Frequencies) -> list[str]:
    covers = ", ".join(f"{said.first(cover)} cover {100 * cover:g} %" for cover in COVERS)
    return [
        "",
        f"Of the most frequent pairs {covers}. Never said: {said.never}.",
        f"(The paper: {PAPER_FIRST} cover {100 * PAPER_COVER:g} %; never said: {PAPER_NEVER}.)",
    ]


def _cover(said: Frequencies, curve_set: CurveSet | None) -> list[str]:
    if curve_set is None:
        return []
    now = progress(curve_set, said)
    drawn = f"{now.drawn} of {now.possible} bigrams drawn, {100 * now.speech:.1f} % of this text"
    return [f"{curve_set.name}: {drawn}; {now.approved} approved, {100 * now.approved_speech:.1f} %."]


def _record(said: Frequencies, curve_set: CurveSet | None) -> dict[str, object]:
    record: dict[str, object] = {
        "sentences": said.utterances,
        "total": said.total,
        "possible": said.possible,
        "never": said.never,
        "pairs": [
            {"pair": pair_name(pair), "count": said.counts[pair], "share": round(share, 6)}
            for pair, share in said.shares.items()
        ],
        "cumulative": [round(float(share), 6) for share in said.cumulative],
        "table2": [{"pair": pair_name(pair), "share": round(percent / 100, 4)} for pair, percent in TABLE_2.items()],
        "shared_with_table2": said.shared_with_paper(),
    }
    if curve_set is not None:
        now = progress(curve_set, said)
        record |= {"drawn": now.drawn, "covered": now.speech, "approved": now.approved}
    return record

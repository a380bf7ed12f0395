"""All five stages as JSON, for looking at them elsewhere and for comparing implementations."""

from __future__ import annotations

import json
from pathlib import Path

from ..phonemes import pair_name
from ..pipeline import STAGES, Stages
from ..tracks import Array
from .atomic import write_atomically

SCHEMA = "lipstitch.Stages.1"


def save(stages: Stages, path: Path | str) -> None:
    """Write the stages atomically; UserError when that fails."""
    write_atomically(path, dumps(stages))


def dumps(stages: Stages) -> str:
    """One red curve a line, then per stage one pose a line; seconds and weights to nine decimals."""
    red = ",\n".join(
        "    "
        + json.dumps(
            {"index": c.index, "bigram": pair_name(c.bigram), "pose": c.pose, "t": _list(c.t), "v": _list(c.v)}
        )
        for c in stages.red
    )
    parts = [
        f'  "schema": "{SCHEMA}"',
        f'  "poses": {json.dumps(list(stages.poses), ensure_ascii=False)}',
        f'  "red": [\n{red}\n  ]',
    ]
    for colour in STAGES:
        tracks = stages.stage(colour)
        rows = ",\n".join(
            f"    {json.dumps(pose, ensure_ascii=False)}: "
            + json.dumps({"t": _list(tracks[pose].t), "v": _list(tracks[pose].v)})
            for pose in tracks
        )
        parts.append(f'  "{colour}": {{\n{rows}\n  }}')
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _list(values: Array) -> list[float]:
    return [round(x, 9) for x in values.tolist()]

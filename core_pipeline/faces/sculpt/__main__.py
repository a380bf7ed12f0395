"""`python -m core_pipeline.faces.sculpt [folder [name …]]` writes our characters (default: all, into assets/faces)."""

from __future__ import annotations

import sys
from pathlib import Path

from core_pipeline.errors import UserError
from core_pipeline.faces.sculpt import build_all


def main(arguments: list[str]) -> int:
    """One line per character; exit code 2 when the folder cannot be written or a name is unknown."""
    folder = Path(arguments[0]) if arguments else Path("assets/faces")
    try:
        build_all(folder, lambda done, of, title: print(f"[{done}/{of}] {title}", flush=True), arguments[1:])
    except UserError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

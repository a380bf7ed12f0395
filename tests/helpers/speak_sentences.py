"""Rewrites the schedules in tests/data/sentences.json: python -m tests.helpers.speak_sentences"""

import json
from pathlib import Path

from core_pipeline.speech.espeak import Espeak
from core_pipeline.speech.sentence import clean

SENTENCES = Path(__file__).parents[1] / "data" / "sentences.json"


def rewrite(path: Path = SENTENCES) -> None:
    """Speak every text in the file again and store its phones (ARPAbet) and times (seconds)."""
    espeak = Espeak()
    rows = []
    for row in json.loads(path.read_text("utf-8")):
        schedule = espeak.speak(clean(row["text"])).schedule
        times = [round(float(t), 4) for t in schedule.times]
        rows.append(json.dumps({"text": row["text"], "phones": schedule.phones, "times": times}, ensure_ascii=False))
    espeak.close()
    path.write_text("[\n" + ",\n".join(rows) + "\n]\n", "utf-8")


if __name__ == "__main__":
    rewrite()

"""The journal: line by line what was done, whole after a crash in the midst of a line, small for a gesture."""

import json
import os
import random
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app import resources
from app.document import Document
from app.keeping import journal
from app.keeping.autosave import Autosave, left_behind
from app.keeping.journal import Kept
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.phone_sets import added
from core_pipeline.settings import Settings
from tests.helpers import strategies as ours

ROOT = Path(resources.__file__).parents[1]
F_AH = ("f", "ah")
HILL = Curve.of([(0, 0), (0.5, 0.9), (1, 0.25)])

#: Edits until it is killed, and says each gesture when its line is on disk. argv: the journal's folder.
SESSION = """
import sys
from pathlib import Path
from PySide6.QtCore import QCoreApplication
from app.document import Document
from app.keeping.autosave import Autosave
from core_pipeline.curve_set import CurveSet
from core_pipeline.curves import Curve

app = QCoreApplication([])
document = Document(CurveSet(name="Mine"))
autosave = Autosave(document, Path(sys.argv[1]))
count = 0

def go_on():
    global count
    print(count, flush=True)
    count += 1
    document.edit_curves(("f", "ah"), {"open": Curve.of([(0, count / 10000)])}, "Move key")
    autosave.write()

autosave.saved.connect(go_on)
go_on()
app.exec()
"""


def same(a: CurveSet, b: CurveSet) -> bool:
    return curve_set_json.dumps(a) == curve_set_json.dumps(b)


@settings(max_examples=30)
@given(ours.curve_sets(), st.lists(ours.curve_sets(), max_size=4), st.booleans())
def test_what_is_written_line_by_line_is_read(
    tmp_path_factory: pytest.TempPathFactory, first: CurveSet, later: list[CurveSet], fast: bool
) -> None:
    file = tmp_path_factory.mktemp("journal") / "1.journal"
    journal.begin(file, Kept(first, Path("mine.json"), "abc"))
    now = first
    for other in later:
        pairs = {*now.bigrams, *other.bigrams}
        for pair in pairs:
            now = now.with_bigram(pair, other.bigrams.get(pair))
        now = now.with_settings(Settings.smartbody()) if fast else now
        journal.add(file, now, pairs)
    kept = journal.read(file)
    assert same(kept.curve_set, now)
    assert (kept.path, kept.digest) == (Path("mine.json"), "abc")


def test_a_journal_cut_anywhere_gives_a_state_that_was(tmp_path: Path) -> None:
    file = tmp_path / "1.journal"
    states = [CurveSet(name="Mine")]
    journal.begin(file, Kept(states[0], None, ""))
    for i in range(5):
        states.append(states[-1].with_bigram(F_AH, Bigram({"open": Curve.of([(0, i / 10)])})))
        journal.add(file, states[-1], [F_AH])
    data = file.read_bytes()
    head = data.index(b"\n") + 1
    luck = random.Random(2013)
    for end in [head, len(data), *(luck.randrange(head, len(data)) for _ in range(20))]:
        file.write_bytes(data[:end])
        whole = data[:end].count(b"\n") - 1
        assert same(journal.read(file).curve_set, states[whole])


def test_a_layer_keeps_its_base_and_goes_back_to_it(tmp_path: Path) -> None:
    english = curve_set_json.load(resources.english_curves())
    hero = CurveSet(name="Hero").on_base("english", english)
    file = tmp_path / "1.journal"
    journal.begin(file, Kept(hero, None, ""))
    edited = hero.with_bigram(F_AH, Bigram({"open": HILL})).with_bigram(("ah", "d"), Bigram({"W": HILL}))
    journal.add(file, edited, [F_AH, ("ah", "d")])
    assert same(journal.read(file).curve_set, edited)
    journal.add(file, edited.with_bigram(F_AH, None), [F_AH])
    read = journal.read(file).curve_set
    assert set(read.own) == {("ah", "d")}
    assert read.settings is None


def test_work_on_a_base_that_has_gone_is_not_lost(tmp_path: Path) -> None:
    low = tmp_path / "low.json"
    curve_set_json.save(CurveSet(name="Low", bigrams={("ah", "d"): Bigram({"W": HILL})}), low)
    hero = CurveSet(name="Hero").on_base("low.json", curve_set_json.load(low)).with_bigram(F_AH, Bigram({"open": HILL}))
    file = tmp_path / "1.journal"
    journal.begin(file, Kept(hero, tmp_path / "hero.json", ""))
    assert journal.read(file).curve_set.layer_of(("ah", "d")) == "Low"
    low.unlink()
    alone = journal.read(file).curve_set
    assert alone.base is None
    assert set(alone.bigrams) == {F_AH}
    file.write_text(file.read_text().replace("Hero", "x" * 300).replace("low.json", ""))
    with pytest.raises(UserError):
        journal.read(file)


def test_a_gesture_is_a_small_line(tmp_path: Path) -> None:
    english = curve_set_json.load(resources.english_curves())
    file = tmp_path / "1.journal"
    journal.begin(file, Kept(english, None, ""))
    before = file.stat().st_size
    journal.add(file, english.with_bigram(F_AH, Bigram({"open": HILL})), [F_AH])
    assert file.stat().st_size - before < 3000


def test_another_phoneme_set_begins_it_anew(tmp_path: Path, qtbot: object) -> None:
    document = Document(CurveSet(name="Mine"))
    autosave = Autosave(document, tmp_path)
    document.edit_curves(F_AH, {"open": HILL}, "Move key")
    document.change_set(added(document.curve_set, "ü", like="ih"), "Add ü")
    autosave.write()
    autosave.finish()
    read = journal.read(autosave.journal).curve_set
    assert "ü" in read.phonemes
    assert read.bigrams[F_AH].curves["open"].same_as(HILL)
    document.undo_stack.undo()
    autosave.write()
    autosave.finish()
    assert "ü" not in journal.read(autosave.journal).curve_set.phonemes


@pytest.mark.parametrize("data", [b"", b"\n", b"{}\n", b'{"schema": "lipstitch.Journal.1"}\n', b"\xff\n"])
def test_what_is_no_journal_is_refused(tmp_path: Path, data: bytes) -> None:
    file = tmp_path / "1.journal"
    file.write_bytes(data)
    with pytest.raises(UserError, match="is no journal of Lipstitch"):
        journal.read(file)


def test_a_damaged_line_costs_nothing_of_what_came_before(tmp_path: Path) -> None:
    file, drawn = tmp_path / "1.journal", CurveSet().with_bigram(F_AH, Bigram({"open": HILL}, "draft"))
    journal.begin(file, Kept(CurveSet(), None, ""))
    journal.add(file, drawn, [F_AH])
    whole = file.read_bytes()
    for bad in ({"set": "{", "gone": []}, {"set": '{"name": "\ud800"}', "gone": []}):
        file.write_bytes(whole + json.dumps(bad).encode() + b"\n")
        assert journal.read(file).curve_set.bigrams[F_AH].curves["open"].same_as(HILL)


@pytest.mark.parametrize("text", ["{", "[[" * 9000, '{"name": "\ud800"}', '{"base": 3'])
def test_a_journal_whose_set_is_damaged_is_refused(tmp_path: Path, text: str) -> None:
    file = tmp_path / "1.journal"
    file.write_text(json.dumps({"schema": journal.SCHEMA, "set": text}) + "\n")
    with pytest.raises(UserError, match=r"1\.journal"):
        journal.read(file)


@pytest.mark.skipif(os.name != "posix", reason="SIGKILL is a signal of POSIX systems")
def test_killed_at_any_moment_at_most_the_gesture_at_hand_is_lost(tmp_path: Path) -> None:
    for lines in (1, 12):
        folder = tmp_path / str(lines)
        with subprocess.Popen(
            [sys.executable, "-c", SESSION, folder],
            env={**os.environ, "PYTHONPATH": str(ROOT)}, stdout=subprocess.PIPE, text=True,
        ) as session:  # fmt: skip
            assert session.stdout is not None
            for _ in range(lines + 1):
                said = int(session.stdout.readline())
            session.send_signal(signal.SIGKILL)
            said = max([said, *map(int, session.stdout.read().split())])
        (recovery,) = left_behind(folder)
        count = round(recovery.kept.curve_set.bigrams[F_AH].curves["open"].v[0] * 10000)
        assert said <= count <= said + 1


def test_a_full_disk_leaves_whole_lines(tmp_path: Path) -> None:
    """With a file size limit, as a full disk gives: the line that does not fit is taken back and told."""
    done = subprocess.run(
        [sys.executable, "-c", FULL, tmp_path / "1.journal"],
        env={**os.environ, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert re.search("disk is full|larger than is allowed", told["refusal"])
    kept = journal.read(tmp_path / "1.journal").curve_set
    assert kept.bigrams[F_AH].curves["open"].v[0] == pytest.approx(told["last"])
    assert (tmp_path / "1.journal").read_bytes().endswith(b"\n")


FULL = """
import json, resource, signal, sys
from pathlib import Path
from app.keeping import journal
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError

file = Path(sys.argv[1])
curve_set, last = CurveSet(name="Mine"), None
journal.begin(file, journal.Kept(curve_set, None, ""))
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
for i in range(100):
    curve_set = curve_set.with_bigram(("f", "ah"), Bigram({"open": Curve.of([(0, i / 100)])}))
    try:
        journal.add(file, curve_set, [("f", "ah")])
    except UserError as error:
        print(json.dumps({"refusal": str(error), "last": last}))
        break
    last = i / 100
"""

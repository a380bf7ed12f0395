"""`batch`: many lines, some of them bad; interrupted and gone on with; on a pool and on a cluster of two workers."""

import csv
import json
import os
import pty
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from app.cli import main
from core_pipeline.files import manifest_csv
from core_pipeline.speech.speaker import speak
from core_pipeline.speech.wav import write_wav
from tests.helpers.outcome import outcome

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A manifest of five lines, two of which cannot work."""
    at = tmp_path_factory.mktemp("batch")
    write_wav(at / "fish.wav", speak("Fat cats often find fish.").audio)
    (at / "fish.txt").write_text("Fat cats often find fish.")
    (at / "hello.lab").write_text("0 2000000 sil\n2000000 3000000 hh\n3000000 5000000 ah0\n")
    (at / "manifest.csv").write_text(
        "name,text,audio,transcript,labels,comment\n"
        'one,"Hello there, you.",,,,x\n'
        ",,fish.wav,fish.txt,,\n"
        ",,,,hello.lab,\n"
        "gone,,gone.wav,Hello,,\n"
        "both,Hello,fish.wav,,,\n"
    )
    return at


def test_every_line_is_baked_and_failures_are_one_table(folder, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["batch", str(folder / "manifest.csv"), "--out", str(out), "--workers", "2", "--textgrids"]) == 1
    said = capsys.readouterr()
    assert "3 of 5 lines baked" in said.out
    assert "2 failed" in said.out
    assert "batch-failures.csv" in said.err
    assert sorted(p.name for p in out.glob("*.json")) == ["fish.json", "hello.json", "one.json"]
    assert len(list(out.glob("*.TextGrid"))) == 3
    assert len(json.loads((out / "fish.json").read_text())["frames"]) > 100
    with (out / "batch-failures.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [(row["line"], row["name"]) for row in rows] == [("5", "gone"), ("6", "both")]
    assert "gone.wav" in rows[0]["problem"]

    before = {p: p.stat().st_mtime_ns for p in out.glob("*.json")}
    (out / "one.json").unlink()  # what is missing or changed is done again, the rest is not
    assert main(["batch", str(folder / "manifest.csv"), "--out", str(out), "--workers", "1", "--textgrids"]) == 1
    assert "1 of 5 lines baked" in capsys.readouterr().out
    after = {p: p.stat().st_mtime_ns for p in out.glob("*.json")}
    assert [p.name for p in before if before[p] != after[p]] == ["one.json"]


def test_an_interrupted_run_goes_on_where_it_stopped(tmp_path, capsys):
    manifest = tmp_path / "m.csv"
    manifest.write_text("name,text\n" + "".join(f"n{i:03d},Sentence number {i} of many.\n" for i in range(400)))
    out = tmp_path / "out"
    command = [sys.executable, "-m", "app", "batch", str(manifest), "--out", str(out), "--workers", "1"]
    terminal, end = pty.openpty()  # where there is a bar to watch
    running = subprocess.Popen(command, cwd=ROOT, stderr=end, stdout=subprocess.DEVNULL)
    os.close(end)
    said = b""
    while b"  5 of 400 lines" not in said:
        said += os.read(terminal, 1000)
    running.send_signal(signal.SIGINT)
    assert running.wait(60) == 130
    os.set_blocking(terminal, False)
    said += rest_of(terminal)
    os.close(terminal)
    assert b"Traceback" not in said
    journal = out / "batch-done.jsonl"
    done = journal.read_text().count("\n")
    assert 5 <= done < 400
    short = "".join(manifest.read_text().splitlines(keepends=True)[: done + 4])
    manifest.write_text(short)  # as many lines as were done, and a few more
    assert main(["batch", str(manifest), "--out", str(out), "--workers", "1"]) == 0
    said = capsys.readouterr().out
    assert f"{done} were done before" in said
    assert f"3 of {done + 3} lines baked" in said
    assert not (out / "batch-failures.csv").exists()


def rest_of(terminal):
    """What is left in it; at its end Linux says EIO."""
    try:
        return os.read(terminal, 100_000)
    except OSError:
        return b""


def test_a_cluster_of_two_workers_does_the_same(folder, tmp_path, capsys):
    from distributed import LocalCluster

    settings = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with LocalCluster(**settings) as cluster:
        address = cluster.scheduler_address
        code = main(["batch", str(folder / "manifest.csv"), "--out", str(tmp_path), "--dask", address])
    assert code == 1
    assert "3 of 5 lines baked" in capsys.readouterr().out
    assert len(list(tmp_path.glob("*.json"))) == 3


def test_no_cluster_is_one_sentence(folder, tmp_path, capsys):
    manifest = str(folder / "manifest.csv")
    assert main(["batch", manifest, "--out", str(tmp_path), "--dask", "nonsense://there"]) == 2
    assert "No Dask scheduler answers" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "first line"),
        ("name,text\n", "no lines"),
        ("a,b\n1,2\n", "first line"),
        ("name,text\nx,hi\nX,ho\n", "both named"),
        ("\0\1\2\3" * 99 + "x" * 999, "no manifest (it is not text)"),
        ("name;text\nx;hi\n", ""),
        ("\ufeffName,Text\r\n../x,hi\r\n", ""),
    ],
)
def test_a_manifest_is_read_or_refused_in_one_sentence(tmp_path, text, says):
    path = tmp_path / "m.csv"
    path.write_bytes(text.encode())
    found, refusal = outcome(lambda: manifest_csv.load(path))
    assert says in refusal
    if found:
        assert found[0].cells["text"] == "hi"
        assert "/" not in found[0].name


def test_a_damaged_journal_only_costs_work_done_twice(tmp_path, capsys):
    manifest, out = tmp_path / "m.csv", tmp_path / "out"
    manifest.write_text("name,text\na,Hello\n")
    out.mkdir()
    (out / "batch-done.jsonl").write_bytes(b"[" * 100_000 + b'\n\xff\n["a"]\n3\nnull\n{"a": 1, "b": 2}\n["a", []]\n')
    command = ["batch", str(manifest), "--out", str(out), "--workers", "1"]
    assert main(command) == 0
    assert "1 of 1 lines baked" in capsys.readouterr().out
    assert main(command) == 0
    assert "1 were done before" in capsys.readouterr().out

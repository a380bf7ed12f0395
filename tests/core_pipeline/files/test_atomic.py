"""Writing is all or nothing: whatever happens, the old file is whole, and no other is left behind."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from core_pipeline.errors import UserError
from core_pipeline.files.atomic import read_bytes, write_atomically

OLD = "the old file\n"
posix = pytest.mark.skipif(os.name != "posix", reason="links, modes and limits of POSIX systems")

#: Writes 100 kB over argv[1] in a process that may write 4 kB only, and says what happened.
ON_A_FULL_DISK = """
import resource, sys
from core_pipeline.errors import UserError
from core_pipeline.files.atomic import write_atomically
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
try:
    write_atomically(sys.argv[1], "x" * 100_000)
except UserError as error:
    print(error)
"""

#: Overwrites argv[1] as somebody who is not root.
AS_A_STRANGER = """
import os, sys
from core_pipeline.errors import UserError
from core_pipeline.files.atomic import write_atomically
if os.geteuid() == 0:
    os.setegid(65534)
    os.seteuid(65534)
try:
    write_atomically(sys.argv[1], "new")
except UserError as error:
    print(error)
"""


def run(code: str, path: Path) -> str:
    return subprocess.run([sys.executable, "-c", code, path], capture_output=True, text=True, check=True).stdout


@pytest.fixture
def old(tmp_path: Path) -> Path:
    path = tmp_path / "set.json"
    path.write_text(OLD)
    return path


def only(path: Path) -> bool:
    """Whether the file is alone in its folder: no temporary one beside it."""
    return [p.name for p in path.parent.iterdir()] == [path.name]


def test_a_file_is_written_and_read(old: Path) -> None:
    write_atomically(old, "Zoë\n")
    assert old.read_bytes() == "Zoë\n".encode()
    write_atomically(str(old), b"\x00\xff")
    assert read_bytes(old, 2, "test") == b"\x00\xff"
    assert only(old)


def test_one_byte_too_many_is_too_many(old: Path) -> None:
    assert read_bytes(old, len(OLD), "test") == OLD.encode()
    with pytest.raises(UserError, match="too large for a test: choose another"):
        read_bytes(old, len(OLD) - 1, "test")


@posix
def test_a_full_disk_leaves_the_old_file(old: Path) -> None:
    assert "larger than is allowed there; choose another place. Nothing was changed there." in run(ON_A_FULL_DISK, old)
    assert old.read_text() == OLD
    assert only(old)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a disk that is always full")
def test_no_space_left_says_so(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="the disk is full; free some space"):
        write_atomically("/dev/full", OLD)
    assert Path("/dev/full").is_char_device()


@posix
def test_a_device_or_a_pipe_is_never_replaced(tmp_path: Path) -> None:
    write_atomically("/dev/null", OLD)
    assert Path("/dev/null").is_char_device()
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE, text=True) as reader:
        write_atomically(pipe, OLD)
        assert reader.communicate(timeout=10)[0] == OLD
    assert pipe.is_fifo()


@posix
def test_a_named_pipe_is_not_waited_for_and_what_a_shell_pipes_is_read(tmp_path: Path) -> None:
    pipe = tmp_path / "set.json"
    os.mkfifo(pipe)
    with pytest.raises(UserError, match=r"set\.json: it is a pipe, not a file"):
        read_bytes(pipe, 100, "curve set")
    source, sink = os.pipe()
    with os.fdopen(sink, "wb") as writer:
        writer.write(b"{}")
    try:
        assert read_bytes(f"/dev/fd/{source}", 100, "curve set") == b"{}"
    finally:
        os.close(source)


@posix
def test_a_read_only_file_or_folder_is_left_alone(tmp_path: Path) -> None:
    tmp_path.chmod(0o777)
    for folder in tmp_path.parents[:3]:  # pytest's own folders are private
        if folder.stat().st_uid == os.getuid() and not folder.stat().st_mode & 0o001:
            folder.chmod(folder.stat().st_mode | 0o011)
    file = tmp_path / "set.json"
    file.write_text(OLD)
    file.chmod(0o444)
    told = "the file is read-only; make it writable (check it out) or choose another place"
    assert told in run(AS_A_STRANGER, file)
    assert file.read_text() == OLD
    file.chmod(0o666)
    tmp_path.chmod(0o555)
    assert "you have no permission there" in run(AS_A_STRANGER, file)
    assert file.read_text() == OLD
    tmp_path.chmod(0o755)
    assert only(file)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("missing/set.json", "there is no such file or folder"),
        ("set.json/below.json", "part of the path is a file"),
        ("", "it is a folder; name a file"),
        ("n" * 300, "the name is too long"),
        ("a\0b.json", "no possible path"),
    ],
)
def test_what_cannot_be_written_says_why_and_leaves_nothing(old: Path, name: str, told: str) -> None:
    with pytest.raises(UserError, match=told) as caught:
        write_atomically(os.path.join(old.parent, name), "new")  # noqa: PTH118 - Path would normalise
    assert "Nothing was changed there." in str(caught.value)
    assert old.read_text() == OLD
    assert only(old)


@posix
def test_a_read_only_file_system_says_so() -> None:
    with pytest.raises(UserError, match=r"Cannot write /proc/set\.json"):
        write_atomically("/proc/set.json", "new")


@posix
def test_a_link_stays_a_link(old: Path) -> None:
    link = old.with_name("link.json")
    link.symlink_to(old.name)
    write_atomically(link, "new")
    assert link.is_symlink()
    assert old.read_text() == "new"


@posix
def test_a_link_to_itself_is_refused(tmp_path: Path) -> None:
    link = tmp_path / "a.json"
    link.symlink_to("a.json")
    with pytest.raises(UserError, match="Cannot write"):
        write_atomically(link, "new")
    with pytest.raises(UserError, match="leads to itself"):
        read_bytes(link, 10, "test")


@posix
def test_permissions_stay_and_new_files_get_the_usual_ones(old: Path) -> None:
    old.chmod(0o640)
    write_atomically(old, "new")
    assert old.stat().st_mode & 0o777 == 0o640
    mask = os.umask(0o027)
    try:
        write_atomically(old.with_name("fresh.json"), "new")
    finally:
        os.umask(mask)
    assert old.with_name("fresh.json").stat().st_mode & 0o777 == 0o640


def test_the_longest_names_can_be_saved(tmp_path: Path) -> None:
    path = tmp_path / ("普" * 80 + ".json")  # 245 bytes
    write_atomically(path, "new")
    assert path.read_text() == "new"

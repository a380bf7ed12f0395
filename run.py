#!/usr/bin/env python3
"""Lipstitch from a clean checkout, with nothing but Python.

    python3 run.py                     opens the editor
    python3 run.py bake "…" --out F    any command of lipstitch (python3 run.py --help)
    python3 run.py test [pytest args]  everything CI runs

Looks for the system libraries Qt and OpenGL need, installs them where it may (Debian and its kin, as
root or with sudo) or prints the command that does; makes .venv, installs the packages of
pyproject.toml into it, and stamps it so that the next start takes no time.
"""

from __future__ import annotations

import ctypes
import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
STAMP = VENV / ".lipstitch-stamp"

# shared library → Debian package
NEEDED = {
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libglib-2.0.so.0": "libglib2.0-0",
    "libgthread-2.0.so.0": "libglib2.0-0",
    "libfontconfig.so.1": "libfontconfig1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libxkbcommon.so.0": "libxkbcommon0",
}
FOR_A_WINDOW = {
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-shape.so.0": "libxcb-shape0",
}
FOR_SOUND = {"libportaudio.so.2": "libportaudio2"}


def main(arguments: list[str]) -> int:
    """Prepare what is missing, then run; the exit code is that of what was run."""
    if sys.version_info < (3, 11):
        print(f"Lipstitch needs Python 3.11 or newer; this is {sys.version.split()[0]}.", file=sys.stderr)
        return 2
    testing = arguments[:1] == ["test"]
    try:
        install_system_libraries()
        install_packages(testing)
    except subprocess.CalledProcessError as error:
        command = " ".join(map(str, error.cmd))
        print(f"This step failed, its own words are above:\n  {command}\nMend that and start again.", file=sys.stderr)
        return 2
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))}
    if not testing:
        return subprocess.call([PYTHON, "-m", "app", *arguments], env=environment)
    environment.setdefault("QT_QPA_PLATFORM", "offscreen")
    if len(arguments) > 1:
        return subprocess.call([PYTHON, "-m", "pytest", *arguments[1:]], cwd=ROOT, env=environment)
    return run_all_checks(environment)


def run_all_checks(environment: dict[str, str]) -> int:
    """Style, types, then the tests; all run even when an early one fails."""
    failed = []
    for title, command in {
        "style": ["ruff", "check", "."],
        "format": ["ruff", "format", "--check", "."],
        "types": ["mypy"],
        "tests": ["pytest", "-n", "auto", "--dist", "loadfile"],  # a file stays in one process
    }.items():
        print(f"── {title}", flush=True)
        if subprocess.call([PYTHON, "-m", *command], cwd=ROOT, env=environment):
            failed.append(title)
    if failed:
        print(f"Failed: {', '.join(failed)}.", flush=True)
    return 1 if failed else 0


def install_system_libraries() -> None:
    """On Linux: install missing Debian packages, or print the command that does and exit with 2."""
    if not sys.platform.startswith("linux"):
        return
    has_display = bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    must = missing(NEEDED | (FOR_A_WINDOW if has_display else {}))
    if importlib.util.find_spec("ensurepip") is None:
        must.append("python3-venv")
    wish = [] if STAMP.exists() else missing(FOR_SOUND)  # without it the editor plays silently and says so
    packages = must + wish
    if not packages:
        return
    prefix = apt_prefix()
    command = ["apt-get", "install", "-y", "--no-install-recommends", *packages]
    if prefix is None:
        if must:
            print(
                f"System libraries are missing. Run this, then start again:\n  sudo {' '.join(command)}",
                file=sys.stderr,
            )
            raise SystemExit(2)
        return
    print(f"Installing system libraries: {' '.join(packages)}", flush=True)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    subprocess.run([*prefix, "apt-get", "update", "-q"], check=bool(must), stdout=subprocess.DEVNULL)
    subprocess.run([*prefix, *command], check=bool(must), stdout=subprocess.DEVNULL, env=environment)


def missing(libraries: dict[str, str]) -> list[str]:
    """Debian packages of the libraries that cannot be loaded."""
    packages = []
    for library, package in libraries.items():
        try:
            ctypes.CDLL(library)
        except OSError:
            packages.append(package)
    return list(dict.fromkeys(packages))


def apt_prefix() -> list[str] | None:
    """What to put before apt-get: nothing for root, sudo on a terminal; None where we may not install."""
    if not shutil.which("apt-get"):
        return None
    if os.geteuid() == 0:
        return []
    return ["sudo"] if shutil.which("sudo") and sys.stdin.isatty() else None


def install_packages(testing: bool) -> None:
    """Make .venv and install the packages of pyproject.toml, unless the stamp says it was done."""
    key = hashlib.sha256((ROOT / "pyproject.toml").read_bytes() + sys.version.encode()).hexdigest()
    stamp = STAMP.read_text().split() if STAMP.exists() and PYTHON.exists() else []
    if stamp[:1] == [key] and (not testing or "test" in stamp):
        return
    print("Setting up .venv (once; about a minute) …", flush=True)
    if stamp[:1] != [key]:
        subprocess.run([sys.executable, "-m", "venv", "--clear", VENV], check=True)
    target = f"{ROOT}[test]" if testing else str(ROOT)
    pip = [PYTHON, "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
    subprocess.run([*pip, "--editable", target], check=True)
    STAMP.write_text(f"{key} test" if testing else key)


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)

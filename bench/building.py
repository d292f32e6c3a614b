"""What bench/run and bench/report.py share: building with progress, the peers' sources, and what the machine is."""

from __future__ import annotations

import importlib.util
import json
import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "bench"
PEERS = ROOT / "bench" / "peers"
RESULTS = ROOT / "docs" / "results"


def say(message: str) -> None:
    print(message, file=sys.stderr, flush=True)


def fail(message: str) -> None:
    sys.exit(f"{Path(sys.argv[0]).name}: {message}")


def use_python_with_matplotlib() -> None:
    """Goes on in the project's own environment if this Python cannot draw."""
    if importlib.util.find_spec("matplotlib") is not None:
        return
    own = ROOT / ".venv" / "bin" / "python"
    if not own.exists() or Path(sys.prefix) == own.parent.parent:
        fail("the pictures need matplotlib: scripts/setup brings it, or: pip install matplotlib")
    os.execv(own, [str(own), *sys.argv])


def build_step(what: str, command: list[str], log: Path, env: dict[str, str] | None = None) -> None:
    """Runs a build command; tells its last line as it goes, and the end of its output if it fails."""
    say(f"… {what}")
    with log.open("w", encoding="utf-8") as out, subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=env
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            out.write(line)
            if sys.stderr.isatty():
                width = shutil.get_terminal_size().columns - 1
                print("\r\033[K" + line.strip()[:width], end="", file=sys.stderr, flush=True)
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    if process.returncode != 0:
        end = "\n".join(log.read_text(encoding="utf-8").splitlines()[-30:])
        fail(f"{what} failed:\n{end}\n(all of it: {log})")


def box2d_sources() -> Path:
    command = ["cargo", "metadata", "--locked", "--format-version", "1", "--manifest-path", str(PEERS / "Cargo.toml")]
    found = subprocess.run(command, capture_output=True, text=True)
    if found.returncode != 0:
        fail("cargo metadata failed:\n" + found.stderr)
    for package in json.loads(found.stdout)["packages"]:
        if package["name"] == "boxdd-sys":
            return Path(package["manifest_path"]).parent / "third-party" / "box2d"
    fail("the crate boxdd-sys is not in bench/peers/Cargo.lock")
    raise AssertionError


def cpu_facts() -> dict[str, Any]:
    facts: dict[str, Any] = {"model": platform.processor() or platform.machine(), "flags": []}
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                facts["model"] = value.strip()
            if key.strip() == "flags":
                facts["flags"] = value.split()
    except OSError:
        pass
    return facts


def first_line(command: list[str]) -> str:
    try:
        lines = subprocess.run(command, capture_output=True, text=True, cwd=ROOT).stdout.splitlines()
    except OSError:
        return "unknown"
    return lines[0] if lines else ""


def about_machine() -> dict[str, Any]:
    flags = cpu_facts()["flags"]
    return {
        "processor": cpu_facts()["model"],
        "processors": os.cpu_count(),
        "simd": [flag for flag in ("sse2", "avx2", "avx512f") if flag in flags],
        "system": f"{platform.system()} {platform.release()}",
        "c++": first_line(["c++", "--version"]),
        "cargo": first_line(["cargo", "--version"]),
        "commit": first_line(["git", "rev-parse", "--short", "HEAD"]),
        "uncommitted changes": bool(first_line(["git", "status", "--porcelain", "--", "server", "bench"])),
        "load at start": os.getloadavg()[0],
    }

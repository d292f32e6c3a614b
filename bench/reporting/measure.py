"""Builds the programs that measure, and runs them point by point."""

from __future__ import annotations

import json
import math
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from building import BUILD, PEERS, ROOT, box2d_sources, build_step, say

from reporting.plan import Point, Stage

Record = dict[str, Any]

RECTANGLES_MAX = 100_000
FRAME_MS = 1000 / 60


@dataclass(frozen=True)
class Effort:
    runs: int  # of a point, the least counts
    budget_s: float  # of processor time, after which no further run begins
    timeout_s: float  # of a point
    steps: int  # with rectangles


QUICK = Effort(runs=3, budget_s=0.1, timeout_s=10, steps=160)
FULL = Effort(runs=20, budget_s=3, timeout_s=600, steps=480)


def build(jobs: int) -> dict[str, Path]:
    """Engine → its program. Those whose libraries are missing are left out."""
    BUILD.mkdir(parents=True, exist_ok=True)
    target = ROOT / "build" / "bench-peers"
    cargo = ["cargo", "build", "--release", "--locked", "--lib", "--jobs", str(jobs)]
    cargo += ["--manifest-path", str(PEERS / "Cargo.toml"), "--target-dir", str(target)]
    build_step("building Rapier (some minutes the first time)", cargo, BUILD / "cargo.log")
    configure = ["cmake", "-S", str(ROOT), "-B", str(BUILD), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
    configure += ["-DURTO_BUILD_BENCH=ON", "-DURTO_BUILD_SERVER=OFF", "-DURTO_BUILD_TESTS=OFF"]
    configure += [f"-DURTO_BOX2D={box2d_sources()}", f"-DURTO_RAPIER_LIBRARY={target / 'release' / 'libpeers_c.a'}"]
    build_step("configuring Urto and its peers", configure, BUILD / "configure.log")
    engines = ["urto", "box2d_v3", "box2d_v2", "rapier", "chipmunk"]
    targets = [f"accuracy_{engine}" for engine in engines]
    compile_all = ["cmake", "--build", str(BUILD), "--parallel", str(jobs), "--target", *targets]
    build_step("building Urto and its peers (a few minutes the first time)", compile_all, BUILD / "build.log")
    programs = {engine: BUILD / "bench" / f"accuracy_{engine}" for engine in engines}
    programs["urto"] = BUILD / "tests" / "accuracy" / "accuracy_urto"
    return {engine: program for engine, program in programs.items() if program.exists()}


def _run(command: Sequence[str], timeout_s: float) -> Record:
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout_s)
    except subprocess.TimeoutExpired:
        return {"failed": f"took more than {timeout_s:g} s"}
    if done.returncode != 0:
        return {"failed": (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]}
    record: Record = json.loads(done.stdout.splitlines()[-1])  # Chipmunk greets first
    return record


def cases(programs: dict[str, Path]) -> list[Record]:
    listing = subprocess.run([str(programs["urto"]), "--list"], capture_output=True, text=True, check=True).stdout
    return [json.loads(line) for line in listing.splitlines()]


# ---- notes: a report that was interrupted goes on where it was, as long as the programs are the same ----

NOTES = BUILD / "points.jsonl"


def _key(record: Record) -> tuple[str, str, str]:
    return record["engine"], record["case"], record["method"]


def _noted(effort: Effort) -> dict[tuple[str, str, str], Record]:
    if not NOTES.exists():
        return {}
    lines = [json.loads(line) for line in NOTES.read_text(encoding="utf-8").splitlines()]
    return {_key(line["record"]): line["record"] for line in lines if line["effort"] == repr(effort)}


def _note(record: Record, effort: Effort) -> None:
    with NOTES.open("a", encoding="utf-8") as file:
        file.write(json.dumps({"effort": repr(effort), "record": record}) + "\n")


def forget_notes_older_than(programs: dict[str, Path]) -> None:
    if NOTES.exists() and any(program.stat().st_mtime > NOTES.stat().st_mtime for program in programs.values()):
        NOTES.unlink()


def measure_all(programs: dict[str, Path], points: Sequence[Point], effort: Effort) -> list[Record]:
    records, start, told = [], time.monotonic(), 0.0
    known = _noted(effort)
    for number, point in enumerate(points, 1):
        record: Record = {"engine": point.engine, "case": point.case, "method": point.method, "curve": point.curve}
        if _key(record) in known:
            record |= {key: value for key, value in known[_key(record)].items() if key != "curve"}
        elif point.engine in programs:
            command = [str(programs[point.engine]), point.case, point.method]
            command += ["--runs", str(effort.runs), "--budget", str(effort.budget_s)]
            record |= _run(command, effort.timeout_s)
        else:
            record["failed"] = "not built"
        if _key(record) not in known:
            _note(record, effort)
        records.append(record)
        elapsed = time.monotonic() - start
        if elapsed - told > 5 or number == len(points):
            told = elapsed
            left = elapsed / number * (len(points) - number)
            say(f"[{number}/{len(points)}, {elapsed:.0f} s, about {left:.0f} s left] {point.case} {point.engine}")
    return records


# ---- rectangles ----


def _step_ms(program: Path, count: int, stage: Stage, effort: Effort) -> Record:
    command = [str(program), "--rectangles", str(count), stage.method, "--steps", str(effort.steps)]
    command += ["--simd", stage.simd] if stage.simd else []
    command += ["--threads", str(stage.threads)] if stage.threads > 1 else []
    best: Record = {"failed": "never ran"}
    for _ in range(2):
        record = _run(command, 120)
        if "failed" in record:
            return record
        if "failed" in best or record["step_ms"] < best["step_ms"]:
            best = record
    return best


def count_rectangles(program: Path, stage: Stage, effort: Effort) -> Record:
    """Doubles the count until a step no longer fits in a frame, and interpolates on logarithmic scales."""
    curve: list[Record] = []
    count = 25
    while count <= RECTANGLES_MAX:
        record = _step_ms(program, count, stage, effort)
        if "failed" in record:
            break
        curve.append(record)
        say(f"{stage.name}: {count} rectangles, {record['step_ms']:.3f} ms a step")
        if record["step_ms"] > FRAME_MS:
            break
        count *= 2
    return {"stage": stage.name, "method": stage.method, "simd": stage.simd, "curve": curve, "fits": _fits(curve)}


def _fits(curve: Sequence[Record]) -> int | None:
    for low, high in zip(curve, curve[1:]):
        if low["step_ms"] <= FRAME_MS < high["step_ms"]:
            exponent = math.log(FRAME_MS / low["step_ms"]) / math.log(high["step_ms"] / low["step_ms"])
            return round(low["rectangles"] * (high["rectangles"] / low["rectangles"]) ** exponent)
    return None


# ---- features ----


def features(program: Path, quick: bool) -> list[Record]:
    command = [str(program), "--features", "--runs", "5" if quick else "20", "--steps", "100"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]

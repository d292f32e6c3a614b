"""Builds the programs that measure, and runs them point by point."""

from __future__ import annotations

import json
import math
import os
import subprocess
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from building import BUILD, PEERS, ROOT, box2d_sources, build_step, say

from reporting.notes import Notes
from reporting.plan import Point, Stage

Record = dict[str, Any]

EXIT = "exit status"
RECTANGLES_MAX = 100_000
FRAME_MS = 1000 / 60


@dataclass(frozen=True)
class Effort:
    runs: int  # of a point, the least counts
    budget_s: float  # of processor time, after which no further run begins
    timeout_s: float  # of a point that a diagram shows the time of
    long_timeout_s: float  # of one that only has an error
    steps: int  # with rectangles


QUICK = Effort(runs=3, budget_s=0.1, timeout_s=10, long_timeout_s=10, steps=160)
FULL = Effort(runs=20, budget_s=0.1, timeout_s=60, long_timeout_s=300, steps=240)


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


def _run(command: Sequence[str], timeout_s: float) -> list[Record]:
    """The lines of JSON that a program prints; what Chipmunk greets with is none."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout_s)
    except subprocess.TimeoutExpired:
        return [{"failed": f"took more than {timeout_s:g} s"}]
    if done.returncode != 0:
        words = (done.stderr.strip().splitlines() or [""])[-1]
        return [{"failed": f"{EXIT} {done.returncode} {words}".strip()}]
    return [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]


class Bench:
    """The programs, and what they have already told."""

    def __init__(self, programs: dict[str, Path], notes: Notes) -> None:
        self.programs = programs
        self.notes = notes

    def run(self, engine: str, arguments: Sequence[str], timeout_s: float) -> list[Record]:
        key = [*arguments, f"within {timeout_s:g} s"]
        known = self.notes.get(engine, key)
        if known is not None:
            return known
        lines = _run([str(self.programs[engine]), *arguments], timeout_s)
        if not any(line.get("failed", "").startswith(EXIT) for line in lines):  # a report that is stopped stops them
            self.notes.add(engine, key, lines)
        return lines

    def cases(self) -> list[Record]:
        command = [str(self.programs["urto"]), "--list"]
        listing = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        return [json.loads(line) for line in listing.splitlines()]

    def point(self, point: Point, effort: Effort) -> Record:
        record: Record = {"engine": point.engine, "case": point.case, "method": point.method, "curve": point.curve}
        if point.engine not in self.programs:
            return record | {"failed": "not built"}
        runs = effort.runs if point.timed else 1
        arguments = [point.case, point.method, "--runs", str(runs), "--budget", str(effort.budget_s)]
        timeout_s = effort.timeout_s if point.timed else effort.long_timeout_s
        record |= self.run(point.engine, arguments, timeout_s)[-1]
        if not point.timed or record.get("cpu_s_per_s") is None:  # others ran beside it, or it simulated nothing
            record.pop("cpu_s_per_s", None)
        return record


NOTES = BUILD / "notes.jsonl"

# ---- points ----


def spread(count: int) -> list[int]:
    """0 … count − 1 in an order whose every beginning is spread over the whole: by multiples of the golden section.

    So the time that is left can be told from the time that has passed, and what disturbs the machine for a while does
    not fall on one case alone.
    """
    return sorted(range(count), key=lambda i: (i * 0.6180339887498949) % 1)


class Progress:
    def __init__(self, what: str, count: int) -> None:
        self._what, self._count, self._done = what, count, 0
        self._start = time.monotonic()
        self._told = 0.0

    def step(self, name: str) -> None:
        self._done += 1
        elapsed = time.monotonic() - self._start
        if elapsed - self._told > 5 or self._done == self._count:
            self._told = elapsed
            left = elapsed / self._done * (self._count - self._done)
            say(f"{self._what} [{self._done}/{self._count}, {elapsed:.0f} s, about {left:.0f} s left] {name}")


def measure_all(bench: Bench, points: Sequence[Point], effort: Effort) -> list[Record]:
    """What is timed runs alone; of the rest as many at once as there are processors."""
    records: dict[int, Record] = {}
    untimed = [i for i in spread(len(points)) if not points[i].timed]
    untimed.sort(key=lambda i: not points[i].long)  # the longest first, or one processor waits for them in the end
    progress = Progress("errors", len(untimed))
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        waiting = {pool.submit(bench.point, points[i], effort): i for i in untimed}
        try:
            for future in as_completed(waiting):
                i = waiting[future]
                records[i] = future.result()
                progress.step(f"{points[i].case} {points[i].engine}")
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    timed = [i for i in spread(len(points)) if points[i].timed]
    progress = Progress("points", len(timed))
    for i in timed:
        records[i] = bench.point(points[i], effort)
        progress.step(f"{points[i].case} {points[i].engine}")
    return [records[i] for i in range(len(points))]


# ---- rectangles ----


def _step_ms(bench: Bench, count: int, stage: Stage, effort: Effort) -> Record:
    command = ["--rectangles", str(count), stage.method, "--steps", str(effort.steps)]
    command += ["--simd", stage.simd] if stage.simd else []
    command += ["--threads", str(stage.threads)] if stage.threads > 1 else []
    return bench.run("urto", command, 120)[-1]


def count_rectangles(bench: Bench, stage: Stage, effort: Effort) -> Record:
    """Doubles the count until a step no longer fits in a frame, and interpolates on logarithmic scales."""
    curve: list[Record] = []
    count = 25
    while count <= RECTANGLES_MAX:
        record = _step_ms(bench, count, stage, effort)
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


def features(bench: Bench, quick: bool) -> list[Record]:
    return bench.run("urto", ["--features", "--runs", "5" if quick else "20", "--steps", "100"], 600)

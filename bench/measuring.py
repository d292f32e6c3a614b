"""Running every scene in every engine, in turn, round after round, and what comes of it."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from building import say
from engines import Engine, Report, run_once, widest

QUICK_SHARE = 3  # --quick runs one step in so many: smash has its impact in the first third


@dataclass
class Outcome:
    """What an engine did in a scene on so many threads: a report a round, or why there is none."""

    scene: str
    engine: str
    threads: int
    reports: list[Report] = field(default_factory=list)
    missing: str | None = None


@dataclass(frozen=True)
class Plan:
    engines: Sequence[Engine]
    scene_files: dict[str, Path]
    threads: Sequence[int]
    rounds: int
    minutes: float  # no round begins that would probably end later
    quick: bool


def steps_of(scene_file: Path, quick: bool) -> int:
    """Zero: as many as the scene says."""
    with scene_file.open(encoding="utf-8") as file:
        return max(1, int(file.readline().split()[2]) // QUICK_SHARE) if quick else 0


def run_all(plan: Plan) -> list[Outcome]:
    """Interleaved: a slow minute of the machine meets all engines."""
    outcomes = []
    by_name = {engine.name: engine for engine in plan.engines}
    for scene in plan.scene_files:
        for threads in plan.threads:  # what several threads gain does not hang on the width
            names = by_name if threads == 1 else widest(by_name)
            outcomes += [Outcome(scene, name, threads) for name in names]
    start = time.monotonic()
    for number in range(1, plan.rounds + 1):
        for done, outcome in enumerate(outcomes, 1):
            if outcome.missing is not None:
                continue
            _run(outcome, by_name[outcome.engine], plan)
            elapsed = time.monotonic() - start
            say(f"[round {number}/{plan.rounds}, {done}/{len(outcomes)}, {elapsed:.0f} s] {_told(outcome)}")
        per_round = (time.monotonic() - start) / number
        if number < plan.rounds and per_round * (number + 1) > 60 * plan.minutes:
            say(f"No further round: it would end after {per_round * (number + 1) / 60:.0f} minutes.")
            break
    return outcomes


def _run(outcome: Outcome, engine: Engine, plan: Plan) -> None:
    if engine.threads_max is not None and outcome.threads > engine.threads_max:
        outcome.missing = f"not yet: more than {engine.threads_max} thread"
        return
    scene_file = plan.scene_files[outcome.scene]
    report, outcome.missing = run_once(engine, scene_file, outcome.threads, steps_of(scene_file, plan.quick))
    if report is not None:
        outcome.reports.append(report)


def _told(outcome: Outcome) -> str:
    what = f"{outcome.scene} {outcome.engine}" + (f" on {outcome.threads} threads" if outcome.threads > 1 else "")
    if outcome.missing is not None:
        return f"{what}: {outcome.missing}"
    report = outcome.reports[-1]
    return f"{what}: {report['mean_ms']:.3f} ms (processor {report['cpu_ms']:.3f})"


def differing_hashes(outcomes: Sequence[Outcome]) -> list[str]:
    """Engines whose final state differed between rounds; Urto's may not differ between widths and threads either."""
    hashes: dict[tuple[str, str, int], set[str]] = {}
    for outcome in outcomes:
        is_urto = outcome.engine.startswith("urto")
        key = ("urto", outcome.scene, 0) if is_urto else (outcome.engine, outcome.scene, outcome.threads)
        hashes.setdefault(key, set()).update(report["hash"] for report in outcome.reports)
    return [f"{engine} in {scene}" for (engine, scene, _), found in hashes.items() if len(found) > 1]


def summary(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    """The best round counts: whatever else ran on the machine only ever adds. `ms` is processor time on one thread,
    which a busy machine disturbs least, and the wall clock on several; `wall_ms` is for the gain of threads."""
    rows = []
    for outcome in outcomes:
        row: dict[str, Any] = {"scene": outcome.scene, "engine": outcome.engine, "threads": outcome.threads}
        if outcome.reports:
            key = "cpu_ms" if outcome.threads == 1 else "mean_ms"
            best = min(outcome.reports, key=lambda report: report[key])
            row |= best | {"engine": outcome.engine, "ms": best[key]}
            row |= {"wall_ms": min(report["mean_ms"] for report in outcome.reports)}
            row |= {"rounds": [report[key] for report in outcome.reports]}
        else:
            row["missing"] = outcome.missing
        rows.append(row)
    return rows

"""Measures the hard cases of tests/accuracy in Urto and its peers, and writes docs/results/. scripts/report runs it."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

from building import ROOT, about_machine, fail, say  # noqa: E402
from reporting import diagrams, equal_cost, measure, pages, plan  # noqa: E402
from reporting.notes import Notes  # noqa: E402

Record = dict[str, Any]

# Chosen to show every kind of method in minutes: --quick draws the curves of these rows alone.
QUICK_CURVES = {1, 3, 4, 7, 8, 12, 13, 15, 16, 20, 23, 25, 29}


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer points and curves: under a quarter of an hour")
    parser.add_argument("--row", default="", help="numbers with commas between them: these rows alone")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "results")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="of the build")
    return parser.parse_args()


class Parts:
    """How long each part of a report took."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        start = time.monotonic()
        yield
        self.seconds[name] = self.seconds.get(name, 0.0) + time.monotonic() - start
        say(f"== {name} took {self.seconds[name]:.0f} s")

    def __str__(self) -> str:
        return ", ".join(f"{name} {seconds:.0f} s" for name, seconds in self.seconds.items())


def measure_cases(bench: measure.Bench, cases: Sequence[Record], quick: bool) -> list[Record]:
    points = []
    for case in cases:
        curves = not quick or case["row"] in QUICK_CURVES
        points += plan.points_of(case, plan.QUICK if quick else plan.FULL, curves)
    return measure.measure_all(bench, points, measure.QUICK if quick else measure.FULL)


def measure_stages(bench: measure.Bench, quick: bool) -> tuple[list[Record], list[Record]]:
    effort = measure.QUICK if quick else measure.FULL
    stages = [measure.count_rectangles(bench, stage, effort) for stage in plan.STAGES]
    points = [
        plan.Point("urto", case, method, "")  # its time is not shown
        for case in plan.STAGE_CASES
        for method in dict.fromkeys(stage.method for stage in plan.STAGES)
    ]
    return stages, measure.measure_all(bench, points, effort)


def by_case(records: Sequence[Record]) -> dict[str, list[Record]]:
    found: dict[str, list[Record]] = {}
    for record in records:
        found.setdefault(record["case"], []).append(record)
    return found


# ---- the whole ----


def level_ratios(cases: Sequence[Record], results: dict[str, list[Record]]) -> dict[str, list[float]]:
    """Engine → error over the default profile's level, case by case, but for those that it lacks something for."""
    ratios: dict[str, list[float]] = {}
    for case in cases:
        level = case["levels"].get(plan.DEFAULT)
        if level is None:
            continue
        for engine, label in {"urto": "default", **plan.PEERS}.items():
            record = pages.find(results.get(case["case"], []), engine, plan.DEFAULT)
            if record is None or "lacks" in record:
                continue
            error = record.get("error")
            ratio = float("inf") if error is None else (error / level if level > 0 else float(error > 0) * 1e9)
            ratios.setdefault(label, []).append(ratio)
    return ratios


def whole_points(cases: Sequence[Record], results: dict[str, list[Record]]) -> list[tuple[str, float, float]]:
    """Of each method that was measured in all cases with curves: levels missed in % and the mean cost."""
    levels = {case["case"]: case["levels"][plan.DEFAULT] for case in cases if plan.DEFAULT in case["levels"]}
    found: dict[tuple[str, str, str], list[tuple[bool, float]]] = {}
    for name, level in levels.items():
        for record in results.get(name, []):
            if record["curve"] and "cpu_s_per_s" in record:
                error = record["error"]
                met = error is not None and error <= level
                key = (record["curve"], record["engine"], record["method"])
                found.setdefault(key, []).append((met, record["cpu_s_per_s"]))
    if not found:
        return []
    most = max(len(values) for values in found.values())
    points = []
    for (curve, _, _), values in found.items():
        if len(values) >= 0.8 * most:
            missed = 100 * sum(not met for met, _ in values) / len(values)
            points.append((curve, missed, pages.geometric_mean([seconds for _, seconds in values])))
    return points


# ---- writing ----


def draw_all(
    out: Path, cases: Sequence[Record], results: dict[str, list[Record]]
) -> tuple[list[int], dict[str, float]]:
    drawn, orders = [], {}
    for row in dict.fromkeys(case["row"] for case in cases):
        of_row = [
            case
            for case in cases
            if case["row"] == row and len({record["curve"] for record in results[case["case"]] if record["curve"]}) > 6
        ]
        if of_row:
            diagrams.draw_row(out / "diagrams" / f"row_{row:02}.svg", of_row, results)
            drawn.append(row)
    if "orbit" in results:
        orders = diagrams.draw_order(out / "diagrams" / "order.svg", results["orbit"], plan.INTEGRATORS)
    diagrams.draw_profile(out / "diagrams" / "profile.svg", level_ratios(cases, results))
    points = whole_points(cases, results)
    if points:
        diagrams.draw_whole(out / "diagrams" / "whole.svg", points)
    return drawn, orders


def accuracy_page(
    cases: Sequence[Record], results: dict[str, list[Record]], drawn: Sequence[int], orders: dict[str, float]
) -> list[str]:
    met = {profile: pages.met_count(cases, results, profile) for profile in (plan.DEFAULT, plan.PRECISE)}
    lines = [
        "# Accuracy beside other engines",
        "",
        "Every hard case ([what they are](../accuracy.md)) in Urto's profiles and in the peers at the same time step "
        "and sub-steps. ✓ and ✗ stand before the level; – marks what an engine lacks. The peers' figures are for float "
        "but for Chipmunk's, which computes in double; its library is Debian's, which has assertions on and is slower "
        "for it. Chipmunk has no continuous collision.",
        "",
        f"Levels that Urto meets: default {met[plan.DEFAULT][0]} of {met[plan.DEFAULT][1]}, "
        f"precise {met[plan.PRECISE][0]} of {met[plan.PRECISE][1]}.",
        "",
        *pages.table_of_cases(cases, results),
        "",
        "## The laws of the integrators",
        "",
        *pages.table_of_laws(cases, results),
        "",
        "Fitted on Kepler's orbit: " + ", ".join(f"{label} {order:.2f}" for label, order in orders.items()) + ".",
        "",
        "![Order of the integrators](diagrams/order.svg)",
        "",
        *equal_cost.section(cases, results),
        "## The whole",
        "",
        "![Share of the cases within a factor of the level](diagrams/profile.svg)",
        "",
        "![Levels missed against cost](diagrams/whole.svg)",
        "",
        "## Error against time, row by row",
        "",
        "Left and down is better. Dotted lines are levels; crosses at the right edge are runs that ended in no number; "
        f"errors of zero are drawn at {diagrams.ERROR_MIN:g}. Time is the processor's, the least of several runs.",
        "",
    ]
    return lines + [f"![Row {row}](diagrams/row_{row:02}.svg)\n" for row in drawn]


def rectangles_page(stages: Sequence[Record], errors: dict[str, list[Record]]) -> list[str]:
    return [
        "# How many rectangles run at 60 Hz",
        "",
        "The question of the thesis that Urto began with, for its method and for each step towards Urto's. Rectangles "
        "fall into a box and bounce, none sleeps; the figure is where the mean step takes a sixtieth of a second of "
        "one processor, or of several where the method says so. Urto's implementation of the thesis's method always "
        "looks at bounds first. The errors are "
        "those of [the hard cases](../accuracy.md) by the same method.",
        "",
        *pages.rectangles_page(stages, errors),
        "",
        "![Time of a step against rectangles](diagrams/rectangles.svg)",
        "",
    ]


def features_page(features: Sequence[Record]) -> list[str]:
    return [
        "# What a scene leaves out",
        "",
        "Mean milliseconds of processor time a step, of the same scene without a feature and with it on but idle: "
        "something far away needs it. The bits of all else are the same in both (`tests/accuracy/features_test.cpp`).",
        "",
        *pages.features_table(features),
        "",
    ]


def write_pages(out: Path, data: Record, about: list[str]) -> None:
    cases, results = data["cases"], by_case(data["points"])
    drawn, orders = draw_all(out, cases, results)
    page = accuracy_page(cases, results, drawn, orders) + about
    (out / "accuracy.md").write_text("\n".join(page) + "\n", encoding="utf-8")
    if data["rectangles"]:
        diagrams.draw_rectangles(out / "diagrams" / "rectangles.svg", data["rectangles"], measure.FRAME_MS)
        page = rectangles_page(data["rectangles"], by_case(data["rectangles_errors"])) + about
        (out / "rectangles.md").write_text("\n".join(page) + "\n", encoding="utf-8")
    if data["features"]:
        page = features_page(data["features"]) + about
        (out / "features.md").write_text("\n".join(page) + "\n", encoding="utf-8")
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace('},{"engine"', '},\n{"engine"')
    (out / "accuracy.json").write_text(text + "\n", encoding="utf-8")


def when_made(started: str, took_s: float, notes: Notes) -> str:
    words = f"{started}, in {took_s / 60:.0f} minutes"
    before = time.time() - took_s - notes.used_since
    if before < 60:
        return words
    since = datetime.fromtimestamp(notes.used_since, timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    return f"{words} after runs that were stopped and went on from what the programs had measured since {since}"


def main() -> None:
    arguments = parse_arguments()
    start, started = time.monotonic(), datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    machine, parts = about_machine(), Parts()
    with parts.part("building"):
        programs = measure.build(arguments.jobs)
    notes = Notes(measure.NOTES, programs)
    bench = measure.Bench(programs, notes)
    rows = {int(row) for row in arguments.row.split(",") if row}
    cases = [case for case in bench.cases() if not rows or case["row"] in rows]
    if arguments.quick:
        cases = [case for case in cases if not case["long"]]
    if not cases:
        fail("no case has such a row")
    with parts.part("cases"):
        records = measure_cases(bench, cases, arguments.quick)
    stages: list[Record] = []
    stage_errors: list[Record] = []
    features: list[Record] = []
    if not rows:
        with parts.part("rectangles"):
            stages, stage_errors = measure_stages(bench, arguments.quick)
        with parts.part("features"):
            features = measure.features(bench, arguments.quick)
    machine["load at end"] = os.getloadavg()[0]
    took = time.monotonic() - start
    versions = {record["engine"]: record["version"] for record in records if "version" in record}
    about = pages.about(machine, versions, when_made(started, took, notes), arguments.quick)
    data = {"started": started, "quick": arguments.quick, "machine": machine, "versions": versions, "cases": cases}
    data |= {"took_s": parts.seconds, "features": features}
    data |= {"points": records, "rectangles": stages, "rectangles_errors": stage_errors}
    with parts.part("drawing"):
        write_pages(arguments.out, data, about)
    if not rows:
        notes.forget()  # the next report is a new one
    say(f"Finished in {(time.monotonic() - start) / 60:.1f} min ({parts}): {arguments.out / 'accuracy.md'}")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)

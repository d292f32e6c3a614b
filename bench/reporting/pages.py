"""The report's pages as Markdown."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from reporting.plan import DEFAULT, PEERS, PRECISE, STAGE_CASES

Record = dict[str, Any]
Results = dict[str, list[Record]]  # by case


def number(value: float | None) -> str:
    if value is None:
        return "∞"
    return "0" if value == 0 else f"{value:.3g}"


def find(records: Sequence[Record], engine: str, method: str) -> Record | None:
    return next((record for record in records if record["engine"] == engine and record["method"] == method), None)


def _cell(record: Record | None, level: float | None = None) -> str:
    if record is None:
        return ""
    if "lacks" in record:
        return "–"
    if "failed" in record:
        words = "too long" if "took" in record["failed"] else "failed"
        return words if level is None else f"{words} ✗ {number(level)}"
    text = number(record["error"])
    if level is None:
        return text
    met = record["error"] is not None and record["error"] <= level
    return f"{text} {'✓' if met else '✗'} {number(level)}"


def pipes(head: Sequence[str], lines: Sequence[Sequence[str]]) -> list[str]:
    return ["| " + " | ".join(row) + " |" for row in [head, ["---"] + ["---:"] * (len(head) - 1), *lines]]


def _urto_line(case: Record, records: Sequence[Record], profile: str) -> str:
    return _cell(find(records, "urto", profile), case["levels"].get(profile))


def _integrators(case: Record, records: Sequence[Record]) -> list[str]:
    lines = []
    for profile, level in case["levels"].items():
        if profile not in (DEFAULT, PRECISE):
            cell = _cell(find(records, "urto", profile), level)
            lines.append([f"{case['row']}", f"`{case['case']}`", profile.replace("_", " "), cell])
    return ["| " + " | ".join(line) + " |" for line in lines]


def met_count(cases: Sequence[Record], results: Results, profile: str) -> tuple[int, int]:
    met = total = 0
    for case in cases:
        level = case["levels"].get(profile)
        record = find(results.get(case["case"], []), "urto", profile)
        if level is None or record is None:
            continue
        total += 1
        met += record.get("error") is not None and record["error"] <= level
    return met, total


def table_of_cases(cases: Sequence[Record], results: Results) -> list[str]:
    head = ["row", "case", "what", "unit", "Urto default", "Urto precise", *PEERS.values()]
    lines = []
    for case in cases:
        records = results.get(case["case"], [])
        if not records or not (set(case["levels"]) & {DEFAULT, PRECISE} or not case["levels"]):
            continue
        peers = [_cell(find(records, peer, DEFAULT)) for peer in PEERS]
        own = [_urto_line(case, records, DEFAULT), _urto_line(case, records, PRECISE)]
        what = f"{case['title']}: {case['metric']}"
        lines.append([str(case["row"]), f"`{case['case']}`", what, case["unit"], *own, *peers])
    return pipes(head, lines)


def table_of_laws(cases: Sequence[Record], results: Results) -> list[str]:
    rows = [line for case in cases for line in _integrators(case, results.get(case["case"], []))]
    return ["| row | case | integrator | error ✓ level |", "| --- | --- | --- | ---: |", *rows]


def about(machine: Record, versions: dict[str, str], when: str, quick: bool) -> list[str]:
    """`when`: it was made, and for how long, in words."""
    return [
        f"Made by `scripts/report{' --quick' if quick else ''}`, {when}, at commit "
        f"{machine['commit']}{' with changes' if machine['uncommitted changes'] else ''}. {machine['processor']}, "
        f"{machine['processors']} processors, {', '.join(machine['simd']) or 'no x86 SIMD'}; {machine['system']}; "
        f"{machine['c++']}; {machine['cargo']}. Load average {machine['load at start']:.1f} at the start and "
        f"{machine['load at end']:.1f} at the end. "
        + ", ".join(f"{PEERS.get(engine, 'Urto')} {version}" for engine, version in versions.items())
        + ".",
    ]


def geometric_mean(values: Sequence[float]) -> float:
    return math.exp(sum(math.log(value) for value in values) / len(values))


def rectangles_page(stages: Sequence[Record], errors: Results) -> list[str]:
    head = ["method", "rectangles at 60 Hz", "deepest overlap at 200, mm", *(f"`{case}`" for case in STAGE_CASES)]
    lines = []
    for stage in stages:
        most = max((record["rectangles"] for record in stage["curve"]), default=0)
        fits = str(stage["fits"]) if stage["fits"] else f"over {most}"
        at_200 = next((record for record in stage["curve"] if record["rectangles"] == 200), None)
        overlap = f"{1e3 * at_200['overlap']:.1f}" if at_200 and at_200["overlap"] is not None else ""
        cells = [_cell(find(errors.get(case, []), "urto", stage["method"])) for case in STAGE_CASES]
        lines.append([stage["stage"], fits, overlap, *cells])
    return pipes(head, lines)


def features_table(features: Sequence[Record]) -> list[str]:
    lines = []
    for record in features:
        saved = 100 * (1 - record["without_ms"] / record["idle_ms"])
        numbers = [f"{record['without_ms']:.4f}", f"{record['idle_ms']:.4f}", f"{saved:+.1f} %"]
        lines.append([record["feature"], record["scene"], *numbers])
    return pipes(["feature", "scene", "left out, ms", "on and idle, ms", "saved"], lines)

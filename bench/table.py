"""The results of bench/run as tables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bars

Result = dict[str, Any]
Row = dict[str, Any]

BUSY_LOAD = 2.2  # two threads of the benchmark, and a little


def _engines(rows: Sequence[Row], threads: int) -> list[str]:
    return list(dict.fromkeys(row["engine"] for row in rows if row["threads"] == threads))


def _row(rows: Sequence[Row], scene: str, engine: str, threads: int) -> Row:
    key = (scene, engine, threads)
    return next((row for row in rows if (row["scene"], row["engine"], row["threads"]) == key), {})


def _ms(row: Row) -> str:
    return f"{row['ms']:.3f}" if "ms" in row else row.get("missing", "").split(":")[0]


def _caption(result: Result, threads: int) -> str:
    many = "one thread, processor time" if threads == 1 else f"{threads} threads, wall clock"
    quick = ", shortened scenes (--quick)" if result["quick"] else ""
    return f"Mean ms a step, {many}, best of {result['rounds']} interleaved rounds{quick}"


def times(result: Result, threads: int) -> tuple[list[str], list[list[str]]]:
    rows: list[Row] = result["rows"]
    engines = _engines(rows, threads)
    head = ["scene", "bodies", "touching", *engines]
    lines = []
    for scene in bars.scenes_of(rows):
        ran: Row = next((row for row in rows if row["scene"] == scene and "ms" in row), {})
        counts = [str(ran.get("bodies", "")), str(ran.get("touching", ""))]
        lines.append([scene, *counts, *(_ms(_row(rows, scene, engine, threads)) for engine in engines)])
    return head, lines


def ratios(result: Result) -> tuple[list[str], list[list[str]]]:
    """Urto's time over each peer's, at the peer's best, by each of Urto's widths."""
    rows: list[Row] = result["rows"]
    widths = [name for name in ("urto", "urto-avx2") if name in _engines(rows, 1)]
    head = ["scene", *(f"{width} / {peer}" for peer in ("Box2D", "Rapier") for width in widths)]
    lines = []
    for scene in bars.scenes_of(rows):
        best = bars.peers_at_best(rows, scene)
        line = [scene]
        for peer in ("Box2D", "Rapier"):
            for width in widths:
                own = bars.time_of(rows, scene, width)
                share = own / best[peer] if own and peer in best else None
                line.append("" if share is None else f"{share:.2f}{_mark(scene, peer, share)}")
        lines.append(line)
    return head, lines


def _mark(scene: str, peer: str, share: float) -> str:
    if scene in bars.OUTRIGHT:
        return "" if peer == "Box2D" else " ✓" if share < 1 else " ✗"
    return " ✓" if share <= bars.SHARE_MAX else " ✗"


def gains(result: Result, threads: int) -> tuple[list[str], list[list[str]]]:
    rows: list[Row] = result["rows"]
    engines = _engines(rows, threads)
    lines = []
    for scene in bars.scenes_of(rows):
        line = [scene]
        for engine in engines:
            gain = bars.gain_of(rows, scene, engine, threads)
            mark = ""
            if gain and engine == "urto" and threads == 2 and bars.has_much_to_share(rows, scene):
                mark = " ✓" if gain >= bars.GAIN_MIN else " ✗"
            line.append(f"{gain:.2f}{mark}" if gain else "")
        lines.append(line)
    return ["scene", *engines], lines


def aligned(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    widths = [max(len(row[column]) for row in [head, *lines]) for column in range(len(head))]
    rows = [
        "  ".join(cell.rjust(width) if i else cell.ljust(width) for i, (cell, width) in enumerate(zip(row, widths)))
        for row in [head, *lines]
    ]
    return "\n".join(rows)


def pipes(head: Sequence[str], lines: Sequence[Sequence[str]]) -> list[str]:
    return ["| " + " | ".join(row) + " |" for row in [head, ["---"] + ["---:"] * (len(head) - 1), *lines]]


def text_table(result: Result) -> str:
    parts = []
    for threads in result["threads"]:
        parts.append(_caption(result, threads) + "\n" + aligned(*times(result, threads)))
        if threads > 1:
            parts.append(f"Gain of {threads} threads\n" + aligned(*gains(result, threads)))
    if 1 in result["threads"]:
        parts.append("Urto's time over the peers' at their best\n" + aligned(*ratios(result)))
    return "\n\n".join([*parts, "\n".join(verdict_lines(result))])


def verdict_lines(result: Result) -> list[str]:
    """A line for each bar: how many meet it, and by name those that do not."""
    lines = []
    found = bars.verdicts(result["rows"])
    for bar in dict.fromkeys(verdict.bar for verdict in found):
        of_bar = [verdict for verdict in found if verdict.bar == bar]
        missed = [f"{verdict.subject} {verdict.figure:.2f}" for verdict in of_bar if not verdict.met]
        rest = "; not met: " + ", ".join(missed) if missed else ""
        lines.append(f"{bar[0].upper()}{bar[1:]}: met {len(of_bar) - len(missed)} of {len(of_bar)}{rest}.")
    hashes = result["differing hashes"]
    same = "in all rounds, at all widths and on all threads"
    lines.append(f"Urto's final state {same}: " + ("the same." if not hashes else "NOT the same: " + ", ".join(hashes)))
    return lines


def about(result: Result) -> list[str]:
    """Where and when the figures were taken."""
    machine = result["machine"]
    busy = max(machine["load at start"], machine["load at end"]) > BUSY_LOAD
    warning = "**The machine was busy with other things: figures of several threads say nothing.**"
    return ([warning, ""] if busy else []) + [
        f"Made by `{result['command']}`, {result['started']}, in {result['minutes']:.0f} minutes, at commit "
        f"{machine['commit']}{' with changes' if machine['uncommitted changes'] else ''}. {machine['processor']}, "
        f"{machine['processors']} processors, {', '.join(machine['simd']) or 'no x86 SIMD'}; {machine['system']}; "
        f"{machine['c++']}; {machine['cargo']}. Load average {machine['load at start']:.1f} at the start and "
        f"{machine['load at end']:.1f} at the end (one program of the benchmark at a time makes 1.0 of it)."
    ]


def versions(result: Result) -> str:
    found = {row["engine"]: row["version"] for row in result["rows"] if "version" in row}
    simd = next((row["simd"] for row in result["rows"] if row["engine"] == "urto" and "simd" in row), "")
    text = ", ".join(f"{engine} {version}" for engine, version in found.items())
    return text + (f"; urto's best width here is {simd}" if simd else "") + "."


def markdown(result: Result) -> str:
    lines = [
        "# Speed beside other engines",
        "",
        "[bench/README.md](../../bench/README.md) says what is compared and how. ✓ and ✗ say whether a bar is met: at "
        f"most {bars.SHARE_MAX:g} of each peer's time, in joint_grid less than Rapier's, and {bars.GAIN_MIN:g} times "
        f"the speed by a second thread where a step takes more than {bars.SHARED_MS_MIN:g} ms.",
        "",
        *(f"- {line}" for line in verdict_lines(result)),
        "",
        "![Urto's time over its peers'](diagrams/speed.svg)",
    ]
    if 1 in result["threads"]:
        lines += ["", "## Urto's time over the peers'", ""]
        lines += ["Each peer at its best: Box2D with AVX2, Rapier in the faster of its builds.", ""]
        lines += pipes(*ratios(result))
    for threads in result["threads"]:
        lines += ["", "## On one thread" if threads == 1 else f"## On {threads} threads", ""]
        lines += [_caption(result, threads) + ".", "", *pipes(*times(result, threads))]
        if threads > 1:
            lines += ["", f"Times as fast on {threads} threads as on one, by the wall clock:", ""]
            lines += pipes(*gains(result, threads))
    lines += ["", "## Where Urto's time goes", "", "Mean ms a step by phase, one thread, best width.", ""]
    lines += phases(result) + ["", *about(result), versions(result)]
    return "\n".join(lines) + "\n"


def phases(result: Result) -> list[str]:
    own = [row for row in result["rows"] if (row["engine"], row["threads"]) == ("urto", 1) and "phases_ms" in row]
    if not own:
        return []
    names = list(own[0]["phases_ms"])
    lines = [[row["scene"], *(f"{row['phases_ms'][name]:.3f}" for name in names)] for row in own]
    return pipes(["scene", *names], lines)

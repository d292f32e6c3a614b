"""What bench/scaling makes of its figures: exponents, tables, and whether the aims are met."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from table import about, aligned, pipes, versions

Record = dict[str, Any]
Result = dict[str, Any]

BYTES_AIM = 1000  # a body, all in


def slope(points: Sequence[tuple[float, float]]) -> float:
    """The least-squares slope of log y over log x."""
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    mean_x, mean_y = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mean_x) * (y - mean_y) for x, y in zip(xs, ys)) / sum((x - mean_x) ** 2 for x in xs)


def of(records: Sequence[Record], engine: str, kind: str) -> list[Record]:
    found = [record for record in records if (record["engine"], record["kind"]) == (engine, kind)]
    return sorted(found, key=lambda record: record["count"])


def fitted_exponent(records: Sequence[Record], engine: str, kind: str) -> float | None:
    """p where the time of a step grows as n^p."""
    points = [(record["count"], record["cpu_ms"]) for record in of(records, engine, kind)]
    return slope(points) if len(points) > 1 else None


def exponent_of_n_log_n(records: Sequence[Record]) -> float:
    """What fits n log n best over the same sizes, so that the two can be compared."""
    counts = sorted({record["count"] for record in records})
    return slope([(count, count * math.log(count)) for count in counts])


def engines_of(records: Sequence[Record]) -> list[str]:
    return list(dict.fromkeys(record["engine"] for record in records))


def kinds_of(records: Sequence[Record]) -> list[str]:
    return list(dict.fromkeys(record["kind"] for record in records))


def microseconds(record: Record) -> float:
    return 1e3 * record["cpu_ms"] / record["count"]


def bytes_of(record: Record) -> float:
    return max(record["heap_built"], record["heap_stepped"]) / record["count"]


def table_of(records: Sequence[Record], kind: str) -> tuple[list[str], list[list[str]]]:
    engines = engines_of(records)
    head = [kind, "touching", *(f"{engine}, µs a body" for engine in engines), *(f"{each}, bytes" for each in engines)]
    lines = []
    for count in sorted({record["count"] for record in records}):
        at = {record["engine"]: record for record in records if (record["kind"], record["count"]) == (kind, count)}
        touching = str(at["urto"]["touching"]) if "urto" in at else ""
        times = [f"{microseconds(at[engine]):.3f}" if engine in at else "" for engine in engines]
        sizes = [f"{bytes_of(at[engine]):.0f}" if engine in at else "" for engine in engines]
        lines.append([str(count), touching, *times, *sizes])
    return head, lines


def verdict_lines(result: Result) -> list[str]:
    records = result["rows"]
    limit = exponent_of_n_log_n(records)
    lines = []
    for kind in kinds_of(records):
        exponents = {engine: fitted_exponent(records, engine, kind) for engine in engines_of(records)}
        fits = ", ".join(f"{engine} {value:.3f}" for engine, value in exponents.items() if value is not None)
        own = exponents.get("urto")
        met = "" if own is None else " Met." if own <= limit else " Not met."
        lines.append(
            f"A {kind}: the time of a step grows as n to the power {fits}; n log n would be {limit:.3f} over these "
            f"sizes, which is the most it may be.{met}"
        )
    for kind in kinds_of(records):
        own_records = of(records, "urto", kind)
        if own_records:
            most = max(bytes_of(record) for record in own_records if record["count"] >= BYTES_AIM)
            met = "met" if most <= BYTES_AIM else "not met"
            lines.append(
                f"Memory in a {kind}, all in, from 1000 bodies on: up to {most:.0f} bytes a body; the aim of "
                f"{BYTES_AIM} is {met}."
            )
    return lines


def text_table(result: Result) -> str:
    tables = [aligned(*table_of(result["rows"], kind)) for kind in kinds_of(result["rows"])]
    return "\n\n".join([*tables, *verdict_lines(result)])


def markdown(result: Result) -> str:
    lines = [
        "# From a hundred bodies to a hundred thousand",
        "",
        "A pile of boxes at rest that may not sleep, and a gas of elastic discs that fill a fifth of a box "
        "(`bench/crowds.py`); one thread, processor time, "
        f"the best of {result['rounds']} interleaved rounds. Bytes are those in use on the heap at the end, over what "
        "was in use before the world was made: bodies, shapes, contacts, broad phase, what the step keeps for itself.",
        "",
        *(f"- {line}" for line in verdict_lines(result)),
        "",
        "![Time and memory per body](diagrams/scaling.svg)",
    ]
    for kind in kinds_of(result["rows"]):
        lines += ["", f"## The {kind}", "", *pipes(*table_of(result["rows"], kind))]
    return "\n".join([*lines, "", *about(result), versions(result)]) + "\n"

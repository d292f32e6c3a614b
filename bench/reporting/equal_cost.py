"""Where a peer is ahead: whether Urto has a point that errs no more and costs no more, for each of a peer's points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from reporting.pages import Results, number, pipes
from reporting.plan import DEFAULT, PEERS

Record = dict[str, Any]

COST_SLACK = 1.25  # times of one point spread by that much on a shared machine
ERROR_ZERO = 1e-12  # what is smaller is rounding, and counts as none


@dataclass
class Ahead:
    """A peer's points of a case that no point of Urto reaches."""

    case: Record
    peer: str
    points: list[Record]
    of: int  # that the peer has

    @property
    def example(self) -> Record:
        return next((point for point in self.points if point["method"] == DEFAULT), self.points[0])


def _error(record: Record) -> float:
    error = record["error"]
    return float("inf") if error is None else float(error) if error > ERROR_ZERO else 0.0


def _timed(records: Sequence[Record], engine: str) -> list[Record]:
    return [record for record in records if record["engine"] == engine and "cpu_s_per_s" in record]


def best_at(own: Sequence[Record], cost: float) -> float | None:
    """The least error among what costs no more. None if nothing does."""
    return min((_error(record) for record in own if record["cpu_s_per_s"] <= cost * COST_SLACK), default=None)


def compare(cases: Sequence[Record], results: Results) -> tuple[int, list[Ahead]]:
    """How many points the peers have, and where they are ahead."""
    total, ahead = 0, []
    for case in cases:
        records = results.get(case["case"], [])
        own = _timed(records, "urto")
        for peer in PEERS:
            points = _timed(records, peer) if own else []
            total += len(points)
            missed = []
            for point in points:
                best = best_at(own, point["cpu_s_per_s"])
                if _error(point) < float("inf") and (best is None or best > _error(point)):
                    missed.append(point)
            if missed:
                ahead.append(Ahead(case, peer, missed, len(points)))
    return total, ahead


def section(cases: Sequence[Record], results: Results) -> list[str]:
    total, ahead = compare(cases, results)
    missed = sum(len(each.points) for each in ahead)
    lines = []
    for each in ahead:
        point = each.example
        own = best_at(_timed(results[each.case["case"]], "urto"), point["cpu_s_per_s"])
        cells = [str(each.case["row"]), f"`{each.case['case']}`", PEERS[each.peer]]
        cells += [f"{len(each.points)} of {each.of}", point["method"]]
        cells += [number(point["error"]), number(point["cpu_s_per_s"])]
        beside = number(None if own == float("inf") else own) if own is not None else "nothing as cheap"
        lines.append([*cells, beside])
    head = ["row", "case", "peer", "points ahead", "one of them", "its error", "its cost, s/s", "Urto's error at that"]
    return [
        "## At equal cost",
        "",
        f"For {total - missed} of the {total} points on the peers' curves Urto has one, of whatever setting, that errs "
        f"no more and costs no more (times within {100 * (COST_SLACK - 1):.0f} % are equal, and errors below "
        f"{ERROR_ZERO:g} are none). Where a peer is ahead:",
        "",
        *pipes(head, lines),
        "",
    ]

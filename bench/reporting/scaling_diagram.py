"""The picture of bench/scaling: time per body, and memory per body, against the number of bodies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import growth

from reporting.diagrams import plt, save_figure
from reporting.speed_diagram import COLORS

Record = dict[str, Any]


def draw_scaling(path: Path, records: Sequence[Record]) -> None:
    kinds = growth.kinds_of(records)
    figure, grid = plt.subplots(2, len(kinds), figsize=(6 * len(kinds), 8), squeeze=False, layout="constrained")
    for column, kind in enumerate(kinds):
        times, sizes = grid[0][column], grid[1][column]
        for engine in growth.engines_of(records):
            own = growth.of(records, engine, kind)
            counts = [record["count"] for record in own]
            exponent = growth.fitted_exponent(records, engine, kind)
            label = f"{engine}: n^{exponent:.2f}" if exponent is not None else engine
            look = {"marker": "o", "markersize": 4, "color": COLORS.get(engine)}
            times.loglog(counts, [growth.microseconds(record) for record in own], label=label, **look)
            sizes.loglog(counts, [growth.bytes_of(record) for record in own], label=engine, **look)
        _draw_n_log_n(times, growth.of(records, "urto", kind))
        sizes.axhline(growth.BYTES_AIM, color="black", linewidth=0.8, linestyle="--", label="the aim")
        times.set_title(f"{kind}: a step grows as n to the power …", fontsize=10)
        times.set_ylabel("processor time of a step per body [µs]")
        sizes.set_ylabel("memory per body [bytes]")
        for axes in (times, sizes):
            axes.set_xlabel("bodies")
            axes.grid(True, which="both", alpha=0.2)
            axes.legend(fontsize=8)
    save_figure(figure, path)


def _draw_n_log_n(axes: Any, own: Sequence[Record]) -> None:
    """Through Urto's least size."""
    if not own:
        return
    counts = [record["count"] for record in own]
    scale = growth.microseconds(own[0]) / math.log(counts[0])
    axes.loglog(counts, [scale * math.log(count) for count in counts], "k--", linewidth=0.8, label="n log n")

"""The picture of bench/run: each engine's time over Box2D's, scene by scene, and what a second thread gains."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bars

from reporting.diagrams import plt, save_figure

Row = dict[str, Any]

COLORS = {
    "urto": "#d62728",
    "urto-avx2": "#ff9896",
    "box2d-sse2": "#aec7e8",
    "box2d-avx2": "#1f77b4",
    "box2d-neon": "#1f77b4",
    "rapier": "#98df8a",
    "rapier-avx2": "#2ca02c",
}
BAR_HEIGHT = 0.8  # of all bars of a scene


def draw_speed(path: Path, rows: Sequence[Row]) -> None:
    scenes = bars.scenes_of(rows)
    several = max(row["threads"] for row in rows)
    panels = 2 if several > 1 and any(row["threads"] == 1 for row in rows) else 1
    size = (7 * panels + 1, 0.75 * len(scenes) + 1.8)
    figure, grid = plt.subplots(1, panels, figsize=size, squeeze=False, layout="constrained")
    engines = list(dict.fromkeys(row["engine"] for row in rows))
    base = {scene: bars.peers_at_best(rows, scene).get("Box2D") for scene in scenes}

    def share(scene: str, engine: str) -> float | None:
        own, peer = bars.time_of(rows, scene, engine), base[scene]
        return own / peer if own and peer else None

    _bars(grid[0][0], scenes, engines, share)
    grid[0][0].axvline(bars.SHARE_MAX, color="black", linewidth=0.8, linestyle="--")
    grid[0][0].set_xlabel("time of a step on one thread over that of Box2D with AVX2 (dashed: the bar)")
    if panels == 2:
        _bars(grid[0][1], scenes, engines, lambda scene, engine: bars.gain_of(rows, scene, engine, several))
        grid[0][1].axvline(bars.GAIN_MIN, color="black", linewidth=0.8, linestyle="--")
        grid[0][1].set_xlabel(f"times as fast on {several} threads as on one (dashed: the bar for two)")
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right upper", fontsize=8)
    save_figure(figure, path)


def _bars(axes: Any, scenes: Sequence[str], engines: Sequence[str], value_of: Any) -> None:
    shown = [engine for engine in engines if any(value_of(scene, engine) for scene in scenes)]
    height = BAR_HEIGHT / max(1, len(shown))
    for number, engine in enumerate(shown):
        places = [row + (number - (len(shown) - 1) / 2) * height for row in range(len(scenes))]
        values = [value_of(scene, engine) or 0 for scene in scenes]
        axes.barh(places, values, height, label=engine, color=COLORS.get(engine))
    axes.set_yticks(range(len(scenes)), scenes)
    axes.invert_yaxis()
    axes.grid(True, axis="x", alpha=0.3)

"""The pictures: error against processor time, order in h, rectangles against time."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "urto"  # the same picture from the same figures
matplotlib.rcParams["svg.fonttype"] = "none"
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402

Record = dict[str, Any]

ERROR_MIN = 1e-17  # errors of zero are drawn here, at the left edge
PANEL_INCHES = (5.2, 3.9)
COLUMNS = 3

_STYLES: dict[str, tuple[str, str]] = {
    "default": ("#d62728", "*"),
    "soft step, float": ("#d62728", "o"),
    "soft step, double": ("#ff9896", "o"),
    "precise": ("#9467bd", "D"),
    "thesis": ("#8c564b", "s"),
    "GJK in place of SAT": ("#e377c2", "P"),
    "without continuous collision": ("#f7b6d2", "X"),
    "Box2D v3": ("#1f77b4", "^"),
    "Box2D 2.4": ("#17becf", "v"),
    "Rapier": ("#2ca02c", "<"),
    "Chipmunk": ("#bcbd22", ">"),
    "explicit Euler, double": ("#7f7f7f", "o"),
    "semi-implicit Euler, double": ("#d62728", "o"),
    "Verlet, double": ("#ff7f0e", "o"),
    "Runge-Kutta 4, double": ("#e377c2", "o"),
    "default (float)": ("#d62728", "*"),
}


def _style(curve: str) -> dict[str, Any]:
    color, marker = _STYLES.get(curve.split(":")[0], ("#000000", "."))
    dashed = curve.endswith(": h") and "soft step" in curve
    return {"color": color, "marker": marker, "linestyle": "--" if dashed else "-", "markersize": 5, "linewidth": 1}


def _curves(records: Iterable[Record]) -> dict[str, list[Record]]:
    curves: dict[str, list[Record]] = {}
    for record in records:
        if record["curve"] and "cpu_s_per_s" in record:
            curves.setdefault(record["curve"], []).append(record)
    return curves


def _draw_case(axes: Axes, case: Record, records: Sequence[Record]) -> None:
    """A run whose error is no number is drawn at the right edge as a cross."""
    finite = [record["error"] for record in records if record.get("error")]
    worst = 10 * max([*finite, *case["levels"].values(), 1e-12])
    for curve, points in _curves(records).items():
        points = sorted(points, key=lambda record: record["cpu_s_per_s"])
        good = [record for record in points if record["error"] is not None]
        failed = [record for record in points if record["error"] is None]
        x = [max(record["error"], ERROR_MIN) for record in good]
        axes.plot(x, [record["cpu_s_per_s"] for record in good], label=curve, **_style(curve))
        if failed:
            color = _style(curve)["color"]
            axes.plot([worst] * len(failed), [r["cpu_s_per_s"] for r in failed], "x", color=color, markersize=8)
    for profile, level in case["levels"].items():
        if profile in ("default", "precise"):
            color = _style(profile)["color"]
            axes.axvline(max(level, ERROR_MIN), color=color, alpha=0.5, linestyle=":")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title(case["case"], fontsize=9)
    axes.set_xlabel(f"{case['metric']} [{case['unit']}]" if case["unit"] else case["metric"], fontsize=8)
    axes.set_ylabel("processor seconds a simulated second", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.grid(True, which="major", alpha=0.3)


def save_figure(figure: Any, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def draw_row(path: Path, cases: Sequence[Record], records: dict[str, list[Record]]) -> None:
    """The work-precision diagrams of a row's cases: left and down is better. Dotted: the levels."""
    columns = min(COLUMNS, len(cases))
    rows = math.ceil(len(cases) / columns)
    size = (PANEL_INCHES[0] * columns + 2.6, PANEL_INCHES[1] * rows)
    figure, grid = plt.subplots(rows, columns, figsize=size, squeeze=False, layout="constrained")
    labels: dict[str, Any] = {}
    for number, axes in enumerate(grid.flat):
        if number >= len(cases):
            axes.set_visible(False)
            continue
        _draw_case(axes, cases[number], records[cases[number]["case"]])
        labels |= {label: handle for handle, label in zip(*axes.get_legend_handles_labels())}
    figure.legend(labels.values(), labels.keys(), loc="outside right upper", fontsize=7)
    save_figure(figure, path)


def fitted_order(points: Sequence[tuple[float, float]]) -> float:
    """The least-squares slope of log error over log h."""
    xs, ys = [math.log(h) for h, _ in points], [math.log(error) for _, error in points]
    mean_x, mean_y = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mean_x) * (y - mean_y) for x, y in zip(xs, ys)) / sum((x - mean_x) ** 2 for x in xs)


ROUNDING = 1e-10  # m; errors below say nothing of an order


def draw_order(path: Path, records: Sequence[Record], labels: dict[str, str]) -> dict[str, float]:
    """Error against h of each integrator on Kepler's orbit; what is fitted to the finer half."""
    figure, axes = plt.subplots(figsize=(6.5, 4.5), layout="constrained")
    orders = {}
    for integrator, label in labels.items():
        points = []
        for record in records:
            if record["method"].startswith(f"{integrator},step_scale=") and record.get("error"):
                points.append((float(record["method"].split("=")[1]) / 60, record["error"]))
        points.sort()
        fit = [point for point in points if point[1] > ROUNDING][: max(2, len(points) // 2)]
        if len(fit) < 2:
            continue
        orders[label] = fitted_order(fit)
        axes.loglog(*zip(*points), **_style(f"{label}, double"), label=f"{label}: order {orders[label]:.2f}")
    axes.set_xlabel("h [s]")
    axes.set_ylabel("position error at 0.37 of the period [m]")
    axes.set_title("Kepler's orbit of eccentricity 0.3: the order of the integrators", fontsize=10)
    axes.grid(True, alpha=0.3)
    axes.legend(fontsize=8)
    save_figure(figure, path)
    return orders


def draw_rectangles(path: Path, stages: Sequence[Record], frame_ms: float) -> None:
    figure, axes = plt.subplots(figsize=(8.5, 5), layout="constrained")
    for number, stage in enumerate(stages):
        points = [(record["rectangles"], record["step_ms"]) for record in stage["curve"]]
        if points:
            style = "--" if "thesis" in stage["method"] else "-"
            look = {"marker": "o", "markersize": 4, "linestyle": style, "color": f"C{number}"}
            axes.loglog(*zip(*points), label=stage["stage"], **look)
    axes.axhline(frame_ms, color="black", linewidth=0.8)
    axes.text(25, frame_ms * 1.1, "a frame at 60 Hz", fontsize=8)
    axes.set_xlabel("rectangles")
    axes.set_ylabel("milliseconds a step, of the processor but for several threads")
    axes.grid(True, which="both", alpha=0.2)
    axes.legend(fontsize=8)
    save_figure(figure, path)


def draw_profile(path: Path, ratios: dict[str, list[float]]) -> None:
    """Which share of the cases each engine computes within τ times the level (as Dolan and Moré draw such profiles)."""
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    edges = [10 ** (exponent / 4) for exponent in range(-16, 25)]
    for engine, values in ratios.items():
        shares = [100 * sum(value <= edge for value in values) / len(values) for edge in edges]
        axes.step(edges, shares, where="post", label=engine, color=_style(engine)["color"])
    axes.axvline(1, color="black", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_xlabel("error over the default profile's level")
    axes.set_ylabel("share of the cases [%]")
    axes.grid(True, alpha=0.3)
    axes.legend(fontsize=8)
    save_figure(figure, path)


def draw_whole(path: Path, points: Sequence[tuple[str, float, float]]) -> None:
    """Each method over all cases: curve, share of the levels missed in %, mean cost."""
    figure, axes = plt.subplots(figsize=(7.5, 5), layout="constrained")
    curves: dict[str, list[tuple[float, float]]] = {}
    for curve, missed, cost in points:
        curves.setdefault(curve, []).append((missed, cost))
    for curve, pairs in curves.items():
        axes.plot(*zip(*sorted(pairs, key=lambda pair: pair[1])), label=curve, **_style(curve))
    axes.set_yscale("log")
    axes.set_xlabel("levels of the default profile that are missed [%]")
    axes.set_ylabel("processor seconds a simulated second, geometric mean")
    axes.grid(True, alpha=0.3)
    axes.legend(fontsize=8)
    save_figure(figure, path)

"""Which methods each case is measured by: the curves of its diagram, and the points along them."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

Case = dict[str, Any]  # a line of accuracy_urto --list

PEERS = {"box2d_v3": "Box2D v3", "box2d_v2": "Box2D 2.4", "rapier": "Rapier", "chipmunk": "Chipmunk"}
INTEGRATORS = {
    "explicit_euler": "explicit Euler",
    "semi_implicit_euler": "semi-implicit Euler",
    "verlet": "Verlet",
    "runge_kutta_4": "Runge-Kutta 4",
}
# Peers' figures that the table of the defaults shows.
DEFAULT = "default"
PRECISE = "precise"


@dataclass(frozen=True)
class Point:
    """One measurement: an engine computes a case by a method. `curve` is the line of the diagram that it lies on."""

    engine: str
    case: str
    method: str
    curve: str
    row: int = 0
    long: bool = False

    @property
    def timed(self) -> bool:
        """Whether a diagram shows its time. What only has an error may run beside others."""
        return bool(self.curve) and not self.long


@dataclass(frozen=True)
class Sweeps:
    sub_steps: Sequence[int]
    scales: Sequence[float]  # of the time step
    thesis: Sequence[int]  # sub-iterations
    peer_sub_steps: Sequence[int]


QUICK = Sweeps(sub_steps=(1, 4, 16), scales=(2, 0.25), thesis=(15, 60), peer_sub_steps=(1, 16))
FULL = Sweeps(
    sub_steps=(1, 2, 4, 8, 16, 32),
    scales=(4, 2, 0.5, 0.25, 0.125),
    thesis=(4, 15, 60),
    peer_sub_steps=(1, 2, 8, 16, 32),
)
FLIGHT_SCALES = (4, 2, 1, 0.5, 0.25, 0.125, 0.0625, 0.03125)


def _flight(case: Case, sweeps: Sweeps) -> Iterator[tuple[str, str, str]]:
    for scale in FLIGHT_SCALES:
        for integrator, label in INTEGRATORS.items():
            yield "urto", f"{integrator},step_scale={scale}", f"{label}, double: h"
        yield "urto", f"{DEFAULT},step_scale={scale}", "default (float): h"
        yield "urto", f"{PRECISE},step_scale={scale}", "precise: h"
        for peer, label in PEERS.items():
            yield peer, f"{DEFAULT},step_scale={scale}", f"{label}: h"


def _contact(case: Case, sweeps: Sweeps) -> Iterator[tuple[str, str, str]]:
    for count in sweeps.sub_steps:
        yield "urto", f"{DEFAULT},sub_steps={count}", "soft step, float: sub-steps"
        yield "urto", f"{DEFAULT},precision=double,sub_steps={count}", "soft step, double: sub-steps"
    for scale in sweeps.scales:
        yield "urto", f"{DEFAULT},step_scale={scale}", "soft step, float: h"
        yield "urto", f"{PRECISE},step_scale={scale}", "precise: h"
    for count in sweeps.thesis:
        yield "urto", f"{DEFAULT},solver=thesis,sub_steps={count}", "thesis: sub-iterations"
    yield "urto", f"{DEFAULT},narrow_phase=gjk", "GJK in place of SAT"
    yield "urto", f"{DEFAULT},continuous=off", "without continuous collision"
    for peer, label in PEERS.items():
        for count in sweeps.peer_sub_steps:  # 4 is the default
            yield peer, f"{DEFAULT},sub_steps={count}", f"{label}: sub-steps"


# Laws and orders compare an integrator with itself: they have levels, and no curves.
WITHOUT_CURVES = ("_law", "_order", "time_reversal")


def points_of(case: Case, sweeps: Sweeps, curves: bool) -> list[Point]:
    """The points of a case, each once. Those of its levels and the defaults of all engines come first."""
    found: dict[tuple[str, str], Point] = {}

    def add(engine: str, method: str, curve: str) -> None:
        known = found.get((engine, method))
        if known is None or not known.curve:
            found[(engine, method)] = Point(engine, case["case"], method, curve, case["row"], case["long"])

    # A long case has no time for what it has no level for, but for the default, which the peers are compared with.
    for profile in dict.fromkeys([*case["levels"], DEFAULT, *([] if case["long"] else [PRECISE])]):
        add("urto", profile, {DEFAULT: "default", PRECISE: "precise: h"}.get(profile, ""))
    if not case["case"].endswith(WITHOUT_CURVES):
        for peer, label in PEERS.items():
            add(peer, DEFAULT, f"{label}: sub-steps" if case["curves"] == "solvers" else f"{label}: h")
        if curves and not case["long"]:
            for engine, method, curve in (_flight if case["curves"] == "integrators" else _contact)(case, sweeps):
                add(engine, method, curve)
    return list(found.values())


# ---- the thesis's question ----


@dataclass(frozen=True)
class Stage:
    """A step from the thesis's method towards Urto's default."""

    name: str
    method: str
    simd: str = ""
    threads: int = 1  # several are measured by the wall clock


_THESIS = f"{DEFAULT},solver=thesis,sub_steps=60,continuous=off"
STAGES = (
    Stage("thesis: all pairs, bounds first, 60 sub-iterations", f"{_THESIS},broad_phase=brute_force"),
    Stage("the same with the quadtree", f"{_THESIS},broad_phase=quadtree"),
    Stage("the same with the BVH", f"{_THESIS},broad_phase=bvh"),
    Stage("soft step of 4 sub-steps, all pairs, scalar", f"{DEFAULT},broad_phase=brute_force,continuous=off", "SCALAR"),
    Stage("the same with the quadtree, scalar", f"{DEFAULT},broad_phase=quadtree,continuous=off", "SCALAR"),
    Stage("the same with the BVH, scalar", f"{DEFAULT},broad_phase=bvh,continuous=off", "SCALAR"),
    Stage("the same with the machine's best SIMD", f"{DEFAULT},broad_phase=bvh,continuous=off"),
    Stage("Urto's default: continuous collision too", DEFAULT),
    *(
        Stage(f"the same on {threads} threads, by the wall clock", DEFAULT, threads=threads)
        for threads in (2, 4, 8)
        if threads <= (os.cpu_count() or 1)
    ),
)
# Cases that tell the error of a stage.
STAGE_CASES = ("stack_sinks_10", "elastic_apex_box", "stop_distance_5", "mass_ratio_1e2")

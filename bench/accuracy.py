"""Cases with a known answer: what each engine's error is at its defaults, dt 1/60 and 4 sub-steps.

Each case is a scene (scenes.py says how such a file looks) and a function from the final states of its bodies to
figures. A body's state is (x, y, angle, velocity x, velocity y, spin).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from scenes import Scene

State = Sequence[float]
G = 10.0  # m/s²
STEPS = 600  # 10 s


@dataclass
class Case:
    scene: Scene
    figures: Callable[[list[State]], dict[str, float]]


def _ground(scene: Scene, friction: float = 0.6) -> None:
    scene.body("static", (0.0, -1.0))
    scene.box((200.0, 1.0), friction=friction)


def stack(count: int) -> Case:
    """Unit boxes on each other: how far the top one sinks, how far the worst one goes sideways."""
    scene = Scene(f"stack_{count}", STEPS)
    _ground(scene)
    for row in range(count):
        scene.body("dynamic", (0.0, row + 0.5))
        scene.box((0.5, 0.5))

    def figures(states: list[State]) -> dict[str, float]:
        return {"top sinks, m": count - 0.5 - states[-1][1], "sideways, m": max(abs(state[0]) for state in states[1:])}

    return Case(scene, figures)


def mass_ratio(ratio: float) -> Case:
    """A heavy unit box on a light one of 0.4 m: how far the heavy one sinks."""
    scene = Scene(f"mass_ratio_{ratio:g}", STEPS)
    _ground(scene)
    scene.body("dynamic", (0.0, 0.2))
    scene.box((0.2, 0.2))
    scene.body("dynamic", (0.0, 0.9))
    scene.box((0.5, 0.5), density=ratio * 0.16)
    return Case(scene, lambda states: {"sinks, m": 0.9 - states[2][1]})


def slope(degrees_beyond: float) -> Case:
    """A box on a slope near the angle of friction, atan 0.5: beyond it slides ½ g (sin θ − μ cos θ) t² in 5 s."""
    friction, seconds = 0.5, 5.0
    angle = math.atan(friction) + math.radians(degrees_beyond)
    along, out = (math.cos(angle), -math.sin(angle)), (math.sin(angle), math.cos(angle))
    scene = Scene(f"slope_{degrees_beyond:+g}", round(seconds * 60), sleep=False)
    scene.body("static", (-out[0], -out[1]), angle=-angle)
    scene.box((50.0, 1.0), friction=friction)
    scene.body("dynamic", (0.5 * out[0], 0.5 * out[1]), angle=-angle)
    scene.box((0.5, 0.5), friction=friction)
    exact = max(0.0, 0.5 * G * (math.sin(angle) - friction * math.cos(angle)) * seconds**2)

    def figures(states: list[State]) -> dict[str, float]:
        slid = states[1][0] * along[0] + states[1][1] * along[1]
        return {"distance, %": 100.0 * (slid / exact - 1.0)} if exact > 0 else {"creep, m": slid}

    return Case(scene, figures)


def bounce() -> Case:
    """A box of restitution 1 falls 5 m and bounces for 10 s: the share of its energy that is left."""
    scene = Scene("bounce", STEPS, sleep=False)
    scene.body("static", (0.0, -1.0))
    scene.box((200.0, 1.0), restitution=1.0)
    scene.body("dynamic", (0.0, 5.5))
    scene.box((0.5, 0.5), restitution=1.0)

    def figures(states: list[State]) -> dict[str, float]:
        _, y, _, vx, vy, spin = states[1]
        energy = 0.5 * (vx * vx + vy * vy) + 0.5 * spin * spin / 6.0 + G * (y - 0.5)
        return {"energy left": energy / (G * 5.0)}

    return Case(scene, figures)


def ballistic() -> Case:
    """A box thrown up: its height after 10 s against y + v t − ½ g t²."""
    scene = Scene("ballistic", STEPS, sleep=False)
    scene.body("dynamic", (0.0, 0.0), velocity=(3.0, 50.0))
    scene.box((0.5, 0.5))
    return Case(scene, lambda states: {"height, m": states[0][1] - (50.0 * 10.0 - 0.5 * G * 100.0)})


def spin() -> Case:
    """A free box that turns at 20 rad/s: its angle after 10 s."""
    scene = Scene("spin", STEPS, gravity=(0.0, 0.0), sleep=False)
    scene.body("dynamic", (0.0, 0.0), spin=20.0)
    scene.box((0.5, 0.5))
    return Case(scene, lambda states: {"angle, rad": math.remainder(states[0][2] - 200.0, 2.0 * math.pi)})


BULLETS = 256


def bullets() -> Case:
    """Boxes of 0.1 m fly at each other at ±200 m/s, from distances that put them at every phase of a step."""
    scene = Scene("bullets", 30, gravity=(0.0, 0.0), sleep=False)
    for shot in range(BULLETS):
        shift = 10.0 + (shot + 0.5) / BULLETS * 200.0 / 60.0
        for side in (-1.0, 1.0):
            scene.body("dynamic", (side * shift, 5.0 * shot), velocity=(-side * 200.0, 0.0))
            scene.box((0.05, 0.05))

    def figures(states: list[State]) -> dict[str, float]:
        return {"pass through, of 256": sum(states[2 * shot][0] > states[2 * shot + 1][0] for shot in range(BULLETS))}

    return Case(scene, figures)


def fast_box_at_wall() -> Case:
    """The same boxes at a dynamic wall of 0.1 m, a hundred times as heavy."""
    scene = Scene("fast_box_at_wall", 30, gravity=(0.0, 0.0), sleep=False)
    for shot in range(BULLETS):
        shift = 10.0 + (shot + 0.5) / BULLETS * 200.0 / 60.0
        scene.body("dynamic", (-shift, 5.0 * shot), velocity=(200.0, 0.0))
        scene.box((0.05, 0.05))
        scene.body("dynamic", (0.0, 5.0 * shot))
        scene.box((0.05, 2.0), density=5.0)

    def figures(states: list[State]) -> dict[str, float]:
        return {"pass through, of 256": sum(states[2 * shot][0] > states[2 * shot + 1][0] for shot in range(BULLETS))}

    return Case(scene, figures)


def cases() -> dict[str, Case]:
    made = [stack(20), stack(100), mass_ratio(100), mass_ratio(1000), bullets(), fast_box_at_wall()]
    made += [slope(0.5), slope(-0.5), bounce(), ballistic(), spin()]
    return {case.scene.name: case for case in made}

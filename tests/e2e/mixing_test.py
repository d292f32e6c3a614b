"""Each rule of mixing friction and restitution arrives in a served room: what slides and bounces is measured.

A box that slides on a level floor slows down by μ g, so that it comes to rest after v² / (2 μ g); a ball that is
dropped from h rises to e² h. The two coefficients of a pair are far apart, so that no rule can pass for another.
"""

from __future__ import annotations

import math

import pytest
import urto
from conftest import TIMEOUT_S, Start

GRAVITY = 10.0  # m/s²
FLOOR, BODY = 0.1, 0.6  # coefficients of friction
STATIC_RESTITUTION, BALL_RESTITUTION = 0.9, 0.4

RULES = {
    "GEOMETRIC_MEAN": lambda a, b: math.sqrt(a * b),
    "MAXIMUM": max,
    "MINIMUM": min,
    "AVERAGE": lambda a, b: (a + b) / 2,
}
UNNAMED = {"friction": "GEOMETRIC_MEAN", "restitution": "MAXIMUM"}


def _scene(field: str, rule: str | None) -> str:
    mixing = f"{field}_mixing: MIXING_{rule}" if rule else ""
    return f"""
name: "mixing"
world {{ precision: PRECISION_DOUBLE gravity {{ y: {-GRAVITY} }} time_step: 0.00390625 sleeping: false {mixing} }}
"""


@pytest.mark.parametrize("rule", [*RULES, None])
def test_a_slide_ends_where_the_rule_says(start: Start, rule: str | None) -> None:
    urtod = start(_scene("friction", rule), "--paused")
    mu = RULES[rule or UNNAMED["friction"]](FLOOR, BODY)
    speed = 3.0
    with urto.connect(urtod.endpoint, timeout=TIMEOUT_S) as room:
        room.spawn(urto.Box(width=60, height=1, position=(0, -0.5), type="static", friction=FLOOR))
        # Flat, so that friction below its centre does not tip it.
        box = room.spawn(urto.Box(width=1, height=0.2, position=(0, 0.1), friction=BODY, velocity=(speed, 0)))
        frame = room.step(256 * 4)
        assert frame[box].velocity[0] == pytest.approx(0, abs=1e-6)
        # The soft contact carries its first load late by a tick or two: 1 % of the longest way.
        assert frame[box].position[0] == pytest.approx(speed**2 / (2 * mu * GRAVITY), rel=0.02)


@pytest.mark.parametrize("rule", [*RULES, None])
def test_a_bounce_is_as_high_as_the_rule_says(start: Start, rule: str | None) -> None:
    urtod = start(_scene("restitution", rule), "--paused")
    e = RULES[rule or UNNAMED["restitution"]](STATIC_RESTITUTION, BALL_RESTITUTION)
    height = 2.0
    with urto.connect(urtod.endpoint, timeout=TIMEOUT_S) as room:
        room.spawn(urto.Box(width=10, height=1, position=(0, -0.5), type="static", restitution=STATIC_RESTITUTION))
        ball = room.spawn(urto.Circle(radius=0.25, position=(0, height + 0.25), restitution=BALL_RESTITUTION))
        fall = math.sqrt(2 * height / GRAVITY)
        room.step(math.floor(256 * fall) - 2)
        highest = 0.0
        for _ in range(256):
            state = room.step()[ball]
            if highest > 0 and state.velocity[1] <= 0:
                break
            if state.velocity[1] > 0:
                highest = state.position[1] - 0.25
        # A tick at 256 Hz near the ground is g h, 0.04 m/s of 6.3 m/s.
        assert highest == pytest.approx(e**2 * height, rel=0.03)


def test_no_two_rules_agree_on_these_coefficients() -> None:
    for a, b, margin in ((FLOOR, BODY, 1.1), (STATIC_RESTITUTION, BALL_RESTITUTION, 1.05)):
        values = sorted(rule(a, b) for rule in RULES.values())
        assert all(second / first > margin for first, second in zip(values, values[1:], strict=False))

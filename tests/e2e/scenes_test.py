"""Every scene of tests/scenes/ is one that urtod takes, and does over a served room what docs/scenes.md says of it.

The rooms are paused and stepped, so that no result depends on how fast a machine is.
"""

import math
import re
import subprocess

import numpy as np
import pytest
import urto
from conftest import ROOT, URTOD

SCENES = sorted((ROOT / "tests/scenes").glob("*.txtpb"))
TIMEOUT_SECONDS = 120


def check(scene):
    command = [URTOD, "--check", "--scene", scene]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=TIMEOUT_SECONDS)


@pytest.fixture(name="room_of")
def fixture_room_of(start):
    """room_of(scene) is a paused room with that scene."""

    def open_room(scene):
        return urto.connect(start(scene, "--paused").endpoint, timeout=TIMEOUT_SECONDS)

    return open_room


def bodies_of(room):
    return {body.name: body.id for body in room.bodies()}


def place(frame, body):
    return frame[body].position


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_urtod_accepts_the_scene(path):
    result = check(path)
    assert result.returncode == 0, result.stderr


def test_urtod_refuses_what_is_not_a_scene(tmp_path):
    file = tmp_path / "broken.txtpb"
    file.write_text('name: "broken"\nbodies { position { x: 0 y: z } }\n', encoding="utf-8")
    result = check(file)
    assert result.returncode != 0
    assert "broken.txtpb" in result.stderr


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_every_body_stays_finite_and_near_for_ten_seconds(room_of, path):
    text = path.read_text(encoding="utf-8")
    lower_x, lower_y, upper_x, upper_y = map(
        float,
        re.search(
            r"^view \{ lower \{ x: (\S+) y: (\S+) \} upper \{ x: (\S+) y: (\S+) \} \}", text, re.MULTILINE
        ).groups(),
    )
    with room_of(path.stem) as room:
        frame = room.step(600)
    columns = np.column_stack([frame.position, frame.velocity, frame.angle, frame.angular_velocity])
    assert np.isfinite(columns).all()
    # Thrown out of the picture by more than its own size: nothing here should be.
    width, height = upper_x - lower_x, upper_y - lower_y
    low, high = np.array([lower_x - width, lower_y - height]), np.array([upper_x + width, upper_y + height])
    outside = ~((frame.position >= low) & (frame.position <= high)).all(axis=1)
    assert frame.ids[outside].tolist() == []


@pytest.mark.parametrize("scene", ["pyramid", "stack_10", "stack_20", "arch"])
def test_what_is_built_stands(room_of, scene):
    with room_of(scene) as room:
        before = room.frame().position.copy()
        after = room.step(1200)
    # Aside by less than a tenth of a block; down by what the contacts below give way, millimetres each.
    moved = after.position - before
    assert np.abs(moved[:, 0]).max() < 0.1
    assert (np.abs(moved[:, 1]) < 0.01 + 0.01 * np.maximum(before[:, 1], 0)).all()


@pytest.mark.parametrize("scene", ["pyramid", "stack_20", "pile"])
def test_what_rests_falls_asleep(room_of, scene):
    with room_of(scene) as room:
        frame = room.step(1800)
    assert not frame.awake.any()


def test_on_the_slope_three_slide_and_three_stay(room_of):
    with room_of("slope") as room:
        names = bodies_of(room)
        before = room.frame()
        after = room.step(120)
        way = {
            name: math.dist(place(before, names[name]), place(after, names[name]))
            for name in names
            if "friction" in name
        }
    assert {name for name, metres in way.items() if metres > 0.3} == {"friction_010", "friction_020", "friction_030"}
    assert all(metres < 0.02 for name, metres in way.items() if name > "friction_035"), way


def test_the_last_ball_of_the_cradle_takes_the_speed_of_the_first(room_of):
    with room_of("cradle") as room:
        names = bodies_of(room)
        frame = room.step(66)  # the first arrives after 3 m at 3 m/s: 60 ticks
    speeds = [frame[names[f"ball_{index}"]].velocity[0] for index in range(1, 6)]
    assert speeds == pytest.approx([0, 0, 0, 0, 3], abs=0.03)


def test_every_domino_falls(room_of):
    with room_of("dominoes") as room:
        names = bodies_of(room)
        frame = room.step(900)
    standing = [name for name, body in names.items() if name.startswith("domino") and abs(frame[body].angle) < 0.3]
    assert standing == []


def test_a_planet_comes_round(room_of):
    """Kepler's third law: the period of a circle of radius a around an attractor of strength k is 2π √(a³/k)."""
    with room_of("orbit") as room:
        names = bodies_of(room)
        before = place(room.frame(), names["earth"])
        period = 2 * math.pi * math.sqrt(4.0**3 / 60.0)
        after = place(room.step(round(60 * period)), names["earth"])
    # The period is no whole number of ticks: up to half a tick of the way at √(60/4) m/s is missing.
    assert math.dist(before, after) < 0.5 / 60 * math.sqrt(60 / 4) + 1e-3


def test_integrators_differ_as_they_should(room_of):
    energies = {}
    for scene in ("integrators", "integrators_explicit_euler", "integrators_verlet", "integrators_runge_kutta_4"):
        with room_of(scene) as room:
            start = room.energy()
            room.step(400)
            energies[scene.removeprefix("integrators").lstrip("_")] = room.energy() / start
    # 20 s at ωh = 0.1 and below. Explicit Euler: 1 + (ωh)² a step; semi-implicit: within ωh/2; Verlet: (ωh)²/4.
    assert energies["explicit_euler"] > 1.5
    assert energies[""] == pytest.approx(1, abs=0.06)
    assert energies["verlet"] == pytest.approx(1, abs=0.003)
    assert energies["runge_kutta_4"] == pytest.approx(1, abs=1e-4)

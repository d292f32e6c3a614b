#!/usr/bin/env python3
"""Writes the repetitive scenes of this folder. Needs nothing but Python's standard library.

usage: generate.py [--check] [DIRECTORY]

Without --check it writes one NAME.txtpb per scene into DIRECTORY (default: this folder). With it, it writes nothing
and exits with 1 if a file there differs from what it would write.

The same input gives the same bytes on every machine: random numbers come from random.Random(seed).random() alone,
whose sequence Python guarantees, and every number is rounded to six decimals.

platformer.txtpb is written by hand and is not touched.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent))

from scene_parts import (  # noqa: E402
    AMBER,
    CORAL,
    CREAM,
    Enum,
    Message,
    NAVY,
    OLIVE,
    PALETTE,
    ROSE,
    SAND,
    SEA,
    SLATE,
    STEEL,
    TEAL,
    blend,
    body,
    box,
    capsule,
    chain,
    circle,
    frame,
    gradient,
    ground,
    joint,
    lines,
    number,
    polygon,
    scene,
    vector,
)

__all__ = ["generate", "main", "number"]

HEADER = "# Written by generate.py: change that, not this file.\n"


# ---- the scenes ----


def pyramid(rows: int = 20) -> Message:
    gap = 0.05  # m, between the boxes of a row: they carry each other by their corners alone, as bricks do
    bodies = [ground(60)]
    for row in range(rows):
        count = rows - row
        color = gradient((NAVY, TEAL, SAND, AMBER, CORAL), row / (rows - 1))
        for column in range(count):
            x = (column - (count - 1) / 2) * (1 + gap)
            bodies.append(body(box(1, 1), x, row + 0.5, name=f"box_{row + 1}_{column + 1}", color=color))
    count = rows * (rows + 1) // 2
    return scene(
        "pyramid",
        f"A pyramid of {rows} rows, {count} boxes of one metre. It stands and falls asleep.",
        (-21, -1.5, 21, 22),
        bodies,
    )


def stack(count: int) -> Message:
    bodies = [ground(20)]
    for index in range(count):
        color = gradient((SEA, SAND, CORAL), index / (count - 1))
        bodies.append(body(box(1, 1), 0, index + 0.5, name=f"box_{index + 1}", color=color))
    half = max(8.0, 0.5 * count)
    return scene(
        f"stack_{count}",
        f"A stack of {count} boxes of one metre. It stands and falls asleep.",
        (-half, -1.5, half, count + 2),
        bodies,
    )


def bouncing(count: int) -> Message:
    """Rectangles on a jittered grid, so that none overlaps another at the start."""
    dice = random.Random(count)
    columns = math.ceil(math.sqrt(count * 16 / 9))
    rows = math.ceil(count / columns)
    pitch = 2.0
    width, height = columns * pitch + 2, rows * pitch + 3
    bodies = frame(width, height, friction=0.2, restitution=0.9)
    for index in range(count):
        row, column = divmod(index, columns)
        x = (column - (columns - 1) / 2) * pitch + 0.3 * (2 * dice.random() - 1)
        y = 1.5 + (row + 0.5) * pitch + 0.3 * (2 * dice.random() - 1)
        size = (0.5 + 0.6 * dice.random(), 0.4 + 0.4 * dice.random())
        angle = math.pi * (2 * dice.random() - 1)
        velocity = (6 * (2 * dice.random() - 1), 6 * (2 * dice.random() - 1))
        spin = 4 * (2 * dice.random() - 1)
        bodies.append(
            body(
                box(*size, friction=0.2, restitution=0.9),
                x,
                y,
                name=f"rectangle_{index + 1}",
                angle=angle,
                velocity=velocity,
                angular_velocity=spin,
                color=PALETTE[index % len(PALETTE)],
            )
        )
    description = f"{count} rectangles with restitution 0.9 thrown about in a closed box (seed {count})."
    return scene(f"bouncing_{count}", description, (-width / 2 - 1, -1, width / 2 + 1, height + 1), bodies)


def thesis() -> Message:
    base = bouncing(12)
    for each in base["bodies"]:
        for shape in each["shapes"]:
            shape["friction"] = 0.0
    description = (
        "Twelve bouncing rectangles as the thesis that Urto grew from ran them: its solver with 60 sub-iterations "
        "of a step of 0.01 s, the lesser restitution of the two, no friction; over a quadtree."
    )
    world: Message = {
        "time_step": 0.01,
        "sub_steps": 60,
        "solver": Enum("SOLVER_THESIS"),
        "integrator": Enum("INTEGRATOR_SEMI_IMPLICIT_EULER"),
        "broad_phase": Enum("BROAD_PHASE_QUADTREE"),
        "sleeping": False,
        "continuous": False,
        "restitution_mixing": Enum("MIXING_MINIMUM"),
        "restitution_threshold": 0.0,
    }
    return scene("thesis", description, (-7, -1, 7, 10), base["bodies"], world)


# The outline of a car from its rear bumper along the bottom to the front and back over the roof; concave where the
# windscreen meets the bonnet. Metres, the origin between the wheels at the height of the axles.
CAR_OUTLINE = [
    (-1.9, -0.1),
    (1.9, -0.1),
    (2.0, 0.35),
    (1.0, 0.5),
    (0.45, 1.05),
    (-0.95, 1.05),
    (-1.45, 0.5),
    (-2.0, 0.42),
]


def car(name: str, x: float, speed: float, color: int, y: float = 0.36) -> Message:
    """A car that slides on two smooth wheels; a negative speed turns it to face left. y: of the axles."""
    side = 1.0 if speed >= 0 else -1.0
    shapes = [polygon([(side * px, py) for px, py in CAR_OUTLINE], density=300.0, friction=0.4, restitution=0.2)]
    shapes += [circle(0.36, (px, 0.0), density=200.0, friction=0.02, restitution=0.1) for px in (-1.2, 1.2)]
    return body(shapes, x, y, name=name, tags=("car",), velocity=(speed, 0), color=color)


def cars() -> Message:
    bodies = [ground(90, friction=0.5)]
    bodies += [
        car("red", -22, 16, CORAL),
        car("blue", 8, -12, SEA),
        car("yellow", -33, 20, SAND),
        car("green", 32, -17, OLIVE),
    ]
    # A wall of crates that the last car goes through, and a ramp that throws the first ones into the air.
    for row in range(5):
        for column in range(2):
            bodies.append(
                body(
                    box(0.9, 0.9, density=60.0),
                    14 + column * 0.95,
                    0.45 + row * 0.9,
                    name=f"crate_{row + 1}_{column + 1}",
                    tags=("crate",),
                    color=blend(AMBER, CREAM, row / 4),
                )
            )
    ramp = polygon([(0, 0), (6, 0), (6, 1.6)], friction=0.1)
    bodies.append(body(ramp, -9, 0, name="ramp", kind="STATIC", color=STEEL))
    bodies.append(body(box(1, 4), 44, 2, name="wall_right", kind="STATIC", color=SLATE))
    bodies.append(body(box(1, 4), -44, 2, name="wall_left", kind="STATIC", color=SLATE))
    description = (
        "Four cars, each a concave chassis and two smooth wheels in one body, meet at a ramp and a wall of crates."
    )
    return scene("cars", description, (-35, -2, 35, 14), bodies)


def regular(sides: int, radius: float) -> list[tuple[float, float]]:
    return [
        (radius * math.cos(2 * math.pi * k / sides), radius * math.sin(2 * math.pi * k / sides)) for k in range(sides)
    ]


def star(points: int, outer: float, inner: float) -> list[tuple[float, float]]:
    turn = math.pi / points
    return [
        ((outer if k % 2 == 0 else inner) * math.cos(k * turn), (outer if k % 2 == 0 else inner) * math.sin(k * turn))
        for k in range(2 * points)
    ]


def pile(count: int = 200) -> Message:
    dice = random.Random(7)
    bodies = [
        body(box(18, 1), 0, -0.5, name="floor", kind="STATIC", color=SLATE),
        body(box(1, 9, angle=0.25), -9.6, 4, name="wall_left", kind="STATIC", color=SLATE),
        body(box(1, 9, angle=-0.25), 9.6, 4, name="wall_right", kind="STATIC", color=SLATE),
    ]
    columns, pitch = 12, 1.3
    letter_l = [(-0.45, -0.5), (0.45, -0.5), (0.45, -0.1), (-0.05, -0.1), (-0.05, 0.5), (-0.45, 0.5)]
    for index in range(count):
        row, column = divmod(index, columns)
        x = (column - (columns - 1) / 2) * pitch + 0.1 * (2 * dice.random() - 1)
        y = 3 + row * pitch + 0.1 * (2 * dice.random() - 1)
        size = 0.6 + 0.4 * dice.random()
        angle = math.pi * (2 * dice.random() - 1)
        kind = (index + row) % 5
        if kind == 0:
            shape = box(size, 0.55 * size + 0.2 * dice.random())
        elif kind == 1:
            shape = circle(0.5 * size)
        elif kind == 2:
            shape = polygon(regular(3 + int(6 * dice.random()), 0.55 * size))
        elif kind == 3:
            shape = polygon([(size * px, size * py) for px, py in letter_l])
        else:
            shape = polygon(star(5, 0.6 * size, 0.3 * size))
        names = ("box", "disc", "polygon", "letter", "star")
        bodies.append(
            body(
                shape,
                x,
                y,
                name=f"{names[kind]}_{index + 1}",
                tags=(names[kind],),
                angle=angle,
                color=(SEA, SAND, TEAL, ROSE, CORAL)[kind],
            )
        )
    return scene(
        "pile",
        f"{count} boxes, discs, regular polygons, letters L and stars fall into a bin and come to rest.",
        (-24, -1.5, 24, 25.5),
        bodies,
    )


def dominoes(count: int = 30) -> Message:
    bodies = [ground(24)]
    for side, name in ((-1, "stop_left"), (1, "stop_right")):
        bodies.append(body(box(0.3, 0.6), side * 11.85, 0.3, name=name, kind="STATIC", color=SLATE))
    pitch = 0.45
    for index in range(count):
        x = (index - (count - 1) / 2) * pitch
        color = gradient((CORAL, SAND, TEAL, SEA), index / (count - 1))
        bodies.append(body(box(0.14, 1.1, density=5.0, friction=0.5), x, 0.55, name=f"domino_{index + 1}", color=color))
    start = -(count - 1) / 2 * pitch
    bodies.append(body(circle(0.18, density=20.0), start - 0.8, 0.95, name="ball", velocity=(4, 0), color=CREAM))
    world: Message = {"hit_events": {"speed_min": 1.0}}
    description = f"{count} dominoes; a thrown ball pushes the first. Each blow above 1 m/s is an event."
    return scene("dominoes", description, (-12.5, -1.5, 12.5, 8), bodies, world)


def cradle() -> Message:
    radius, gap, count, reach = 0.5, 0.001, 5, 4.5
    pitch = 2 * radius + gap
    half = (count - 1) / 2 * pitch
    bodies = [
        body(box(2 * (half + reach) + 2, 0.5, friction=0.0), 0, -0.25, name="rail", kind="STATIC", color=SLATE),
        body(
            box(0.5, 1.6, friction=0.0, restitution=1.0),
            -(half + reach) - 0.25,
            0.8,
            name="stop_left",
            kind="STATIC",
            color=STEEL,
        ),
        body(
            box(0.5, 1.6, friction=0.0, restitution=1.0),
            half + reach + 0.25,
            0.8,
            name="stop_right",
            kind="STATIC",
            color=STEEL,
        ),
    ]
    for index in range(count):
        first = index == 0
        x = -half + index * pitch - (3.0 if first else 0.0)
        bodies.append(
            body(
                circle(radius, friction=0.0, restitution=1.0),
                x,
                radius,
                name=f"ball_{index + 1}",
                velocity=(3, 0) if first else None,
                color=CORAL if first else gradient((SAND, TEAL), (index - 1) / 3),
            )
        )
    # The blows follow one another within a hundredth of a second. The thesis's solver deals with one contact at a time,
    # at each of its sub-iterations, and so with one blow after the other; the default solver shares them out.
    world: Message = {
        "precision": Enum("PRECISION_DOUBLE"),
        "solver": Enum("SOLVER_THESIS"),
        "sub_steps": 64,
        "restitution_mixing": Enum("MIXING_MINIMUM"),
        "restitution_threshold": 0.0,
    }
    description = (
        "Five balls with gaps of 1 mm on a rail without friction, restitution 1: what the first brings, the last takes "
        "away, and the stops send it back."
    )
    return scene("cradle", description, (-8, -1.5, 8, 7.5), bodies, world)


def slope() -> Message:
    degrees = 20.0
    incline = math.radians(degrees)
    along = (math.cos(incline), math.sin(incline))
    length = 24.0
    world: Message = {"friction_mixing": Enum("MIXING_MINIMUM")}
    top = (0.25 * -along[1], 0.25 * along[0])  # from the middle of the plank to the middle of its upper face
    bodies = [
        body(
            box(length, 0.5, friction=1.0),
            0 - top[0],
            4.5 - top[1],
            name="incline",
            kind="STATIC",
            angle=incline,
            color=SLATE,
        ),
        body(box(14, 1, friction=1.0), -17.6, -0.3, name="floor", kind="STATIC", color=SLATE),
    ]
    # tan 20° = 0.364: of these, the boxes with 0.1, 0.2 and 0.3 slide. They start below the others, and free of them.
    for index, friction in enumerate((0.1, 0.2, 0.3, 0.4, 0.5, 0.6)):
        place = -7.0 + 3.2 * index
        x = place * along[0] - 0.5 * along[1]
        y = 4.5 + place * along[1] + 0.5 * along[0]
        bodies.append(
            body(
                box(1.4, 1, friction=friction),
                x,
                y,
                name=f"friction_{round(100 * friction):03d}",
                angle=incline,
                color=gradient((CORAL, SAND, TEAL), index / 5),
            )
        )
    return scene(
        "slope",
        "Boxes with friction 0.1 to 0.6 on an incline of 20 degrees, whose tangent is 0.364: three slide, three stay.",
        (-20, -2, 16, 18),
        bodies,
        world,
    )


def precise() -> Message:
    """What iterations over contacts do not reach: heavy on light, and bounces that lose what they should."""
    bodies = [ground(24, friction=0.6)]
    for index, (exponent, color) in enumerate(((2, SEA), (4, AMBER), (6, CORAL))):
        x = 3.0 * index - 8
        bodies.append(body(box(1, 1), x, 0.5, name=f"light_{exponent}", color=CREAM, mass=1.0))
        bodies.append(body(box(2, 1), x, 1.5, name=f"heavy_{exponent}", color=color, mass=10.0**exponent))
    for index, (restitution, color) in enumerate(((1.0, TEAL), (0.8, OLIVE), (0.5, ROSE))):
        shape = circle(0.5, friction=0.0, restitution=restitution)
        bodies.append(body(shape, 2.0 + 3 * index, 5.5, name=f"ball_{round(10 * restitution)}", color=color))
    description = (
        "Boxes with a top 100, 10 000 and 1 000 000 times as heavy, and balls with restitution 1, 0.8 and 0.5 that "
        "fall 5 m; by the precise solver."
    )
    world: Message = {
        "precision": Enum("PRECISION_DOUBLE"),
        "solver": Enum("SOLVER_PRECISE"),
        "restitution_threshold": 0.001,
    }
    return scene("precise", description, (-11, -1.5, 11, 8), bodies, world)


def arch(count: int = 11) -> Message:
    mean, thickness = 5.0, 1.0  # m; thickness/mean = 0.2, a semicircle falls below 0.1075 (Milankovitch)
    inner, outer = mean - thickness / 2, mean + thickness / 2
    bodies = [ground(24, friction=1.0)]
    half = math.pi / count / 2
    for index in range(count):
        turn = math.pi - (2 * index + 1) * half  # from the left springer to the right one
        x, y = mean * math.cos(turn), mean * math.sin(turn)
        corners = [
            (radius * math.cos(turn + side) - x, radius * math.sin(turn + side) - y)
            for radius, side in ((inner, half), (inner, -half), (outer, -half), (outer, half))
        ]
        key = abs(index - (count - 1) / 2) / ((count - 1) / 2)
        name = "keystone" if index == (count - 1) // 2 else f"voussoir_{index + 1}"
        bodies.append(
            body(
                polygon(corners, density=2.0, friction=1.0), x, y, name=name, color=gradient((CORAL, SAND, CREAM), key)
            )
        )
    return scene(
        "arch",
        f"A semicircular arch of {count} voussoirs, friction 1, thickness a fifth of its mean radius. It stands.",
        (-12, -1.5, 12, 9),
        bodies,
    )


def terrain(rows: int = 4, columns: int = 9) -> Message:
    """A chain of hills between two slopes, an island of stone in the air, and what is round falling onto them."""
    hills = [(x / 2, 1.2 * math.sin(x / 4) + 0.4 * math.sin(x / 1.7)) for x in range(40, -41, -1)]
    valley = [(26.0, 12.0), *hills, (-26.0, 12.0)]  # from right to left: the front is above
    island = [(-3.0, 7.0), (3.0, 7.0), (2.0, 8.0), (-2.0, 8.0)]  # counter-clockwise: the front is outside
    bodies = [
        body(chain(valley, friction=0.5), 0, 0, name="valley", kind="STATIC", color=SLATE),
        body(chain(island, loop=True, friction=0.5), 0, 0, name="island", kind="STATIC", color=STEEL),
    ]
    rng = random.Random(7)
    triangle = [(-0.35, -0.3), (0.35, -0.3), (0.0, 0.4)]
    for index in range(rows * columns):
        x = 2.2 * (index % columns - (columns - 1) / 2) + rng.random() - 0.5
        y = 10.0 + 1.6 * (index // columns)
        turn = 2 * math.pi * rng.random()
        made = (
            capsule((-0.4, 0.0), (0.4, 0.0), 0.3),
            {"box": {"width": 0.7, "height": 0.4, "radius": 0.15}},
            {"polygon": {"vertices": [vector(*each) for each in triangle], "radius": 0.2}},
            circle(0.4),
        )[index % 4]
        bodies.append(body(made, x, y, angle=turn, color=PALETTE[index % len(PALETTE)]))
    return scene(
        "terrain",
        f"{rows * columns} capsules, rounded boxes, rounded triangles and discs fall onto an island and into a valley, "
        "both of them chains of segments.",
        (-22, -3, 22, 18),
        bodies,
    )


def bridge(planks: int = 24) -> Message:
    """Two towers, planks hinged in a row between them; crates lie on it, and a ball falls that is too much."""
    length, height = 1.0, 6.0
    half = planks * length / 2
    bodies = [ground(60)]
    for side, name in ((-1, "tower_left"), (1, "tower_right")):
        bodies.append(body(box(2, height), side * (half + 1), height / 2, name=name, kind="STATIC", color=SLATE))
    for index in range(planks):
        x = (index - (planks - 1) / 2) * length
        color = gradient((TEAL, SAND, TEAL), index / (planks - 1))
        bodies.append(body(box(0.96, 0.2, density=2.0), x, height - 0.1, name=f"plank_{index + 1}", color=color))
    for index in range(4):
        bodies.append(body(box(0.8, 0.8), (index - 1.5) * 3, height + 1, name=f"crate_{index + 1}", color=AMBER))
    bodies.append(body(circle(0.9, density=40.0), 2.5, height + 55, name="ball", color=CORAL))
    names = ["tower_left", *(f"plank_{index + 1}" for index in range(planks)), "tower_right"]
    ends = {"tower_left": (1, height / 2 - 0.1), "tower_right": (-1, height / 2 - 0.1)}
    joints = [
        joint(
            "revolute", a, b, ends.get(a, (length / 2, 0)), ends.get(b, (-length / 2, 0)),
            name=f"hinge_{index + 1}", break_force=4000.0,
        )
        for index, (a, b) in enumerate(zip(names, names[1:]))
    ]  # fmt: skip
    return scene(
        "bridge",
        f"A bridge of {planks} hinged planks under four crates; after three seconds a heavy ball breaks it.",
        (-16, -1.5, 16, 14),
        bodies,
        joints=joints,
    )


def machines() -> Message:
    """One of each kind of joint at work: a car, a lift, a windmill, a swinging chain, a spring, a flag."""
    bodies = [ground(60)]
    joints: list[Message] = []

    def add(kind: str, a: str, b: str, *anchors: tuple[float, float], **more: Any) -> None:
        joints.append(joint(kind, a, b, *anchors, **more))

    motor = {"speed": -8.0, "bound": 60.0}
    bodies.append(body(box(3, 0.6), -20, 1.0, name="car", color=TEAL))
    for side, name in ((-1, "wheel_rear"), (1, "wheel_front")):
        bodies.append(body(circle(0.5, friction=0.9), -20 + side, 0.5, name=name, color=NAVY))
        drive = {"motor": motor} if side < 0 else {}
        add("revolute", "car", name, (side, -0.5), (0, 0), name=f"axle_{name[6:]}", geometry=drive)
    bodies.append(body(box(0.4, 8), -4, 4, name="lift_shaft", kind="STATIC", color=SLATE))
    bodies.append(body(box(2.4, 0.4), -2.5, 1, name="lift", color=SAND))
    bodies.append(body(box(0.8, 0.8), -2.5, 1.7, name="load", color=CORAL))
    rail = {
        "axis": vector(0, 1), "limits": {"lower": 0.0, "upper": 5.0}, "motor": {"speed": 1.5, "bound": 60.0},
    }  # fmt: skip
    add("prismatic", "lift_shaft", "lift", (1.5, -3), (0, 0), name="lift_rail", geometry=rail)
    bodies.append(body(box(0.5, 7), 4, 3.5, name="mill", kind="STATIC", color=SLATE))
    sails = [box(0.4, 5), box(5, 0.4)]
    bodies.append(body(sails, 4, 7, name="sails", color=OLIVE))
    turning = {"motor": {"speed": 1.0, "bound": 200.0}}
    add("revolute", "mill", "sails", (0, 3.5), (0, 0), name="mill_axle", geometry=turning)
    bodies.append(body(box(6, 0.4), 12, 11, name="beam", kind="STATIC", color=SLATE))
    before, at = "beam", (-2.0, 0.0)
    for index in range(8):
        name = f"link_{index + 1}"
        bodies.append(body(box(0.8, 0.16), 10.4 + 0.8 * index, 11, name=name, color=STEEL))
        add("revolute", before, name, at, (-0.4, 0), name=f"chain_{index + 1}")
        before, at = name, (0.4, 0.0)
    bodies.append(body(circle(0.4, density=4.0), 12, 8, name="bob", color=ROSE))
    hanging = {"length": 2.0, "spring": {"hertz": 0.8, "damping_ratio": 0.02}}
    add("distance", "beam", "bob", (0, 0), (0, 0), name="spring", geometry=hanging)
    bodies.append(body(box(3, 0.1), 15.3, 10, name="flag", color=AMBER))
    waving = {"angular": {"hertz": 1.5, "damping_ratio": 0.1}}
    add("weld", "beam", "flag", (2, -1), (-1.3, 0), name="flag_pole", geometry=waving)
    return scene(
        "machines",
        "A car with a driven wheel, a lift, a windmill, a chain, a spring and a flag: joints at work.",
        (-24, -1.5, 24, 14),
        bodies,
        joints=joints,
    )


def tumbler(count: int = 300) -> Message:
    radius, thickness, panels = 7.0, 0.4, 20
    walls: list[Message] = []
    width = 2 * (radius + thickness) * math.tan(math.pi / panels)
    for index in range(panels):
        turn = 2 * math.pi * index / panels
        place = radius + thickness / 2
        walls.append(box(thickness, width, (place * math.cos(turn), place * math.sin(turn)), turn))
    for index in range(4):
        turn = math.pi / 2 * index + math.pi / panels
        place = radius - 0.6
        walls.append(box(1.2, 0.25, (place * math.cos(turn), place * math.sin(turn)), turn))
    bodies = [body(walls, 0, 0, name="drum", kind="KINEMATIC", angular_velocity=math.radians(25), color=STEEL)]
    columns, pitch = 20, 0.46
    rows = math.ceil(count / columns)
    for index in range(count):
        row, column = divmod(index, columns)
        x = (column - (columns - 1) / 2) * pitch
        y = (row - (rows - 1) / 2) * pitch
        bodies.append(
            body(box(0.4, 0.4), x, y, name=f"box_{index + 1}", color=gradient((TEAL, SAND, CORAL), row / (rows - 1)))
        )
    return scene(
        "tumbler",
        f"A kinematic drum, one body of {panels} panels and 4 paddles, turns {count} boxes at 25 degrees a second.",
        (-14, -8.2, 14, 8.2),
        bodies,
    )


def orbit() -> Message:
    strength = 60.0  # m³/s²
    free = {"mask": 0}  # nothing here touches: the bodies fly through each other
    bodies = [body(circle(0.9, **free), 0, 0, name="sun", kind="STATIC", color=SAND)]
    # name, semi-major axis in m, eccentricity, direction of the perihelion in degrees, radius in m, colour
    planets = (
        ("mercury", 1.9, 0.2, 30, 0.12, STEEL),
        ("venus", 2.9, 0.0, 100, 0.2, AMBER),
        ("earth", 4.0, 0.0, 200, 0.22, SEA),
        ("mars", 5.3, 0.1, 310, 0.17, CORAL),
        ("jupiter", 9.0, 0.05, 60, 0.5, CREAM),
        ("comet", 7.0, 0.75, 145, 0.1, TEAL),
    )
    for name, axis, eccentricity, degrees, radius, color in planets:
        turn = math.radians(degrees)
        distance = axis * (1 - eccentricity)
        speed = math.sqrt(strength / axis * (1 + eccentricity) / (1 - eccentricity))  # at the perihelion (vis-viva)
        bodies.append(
            body(
                circle(radius, **free),
                distance * math.cos(turn),
                distance * math.sin(turn),
                name=name,
                velocity=(-speed * math.sin(turn), speed * math.cos(turn)),
                color=color,
            )
        )
    dice = random.Random(11)
    for index in range(60):
        turn = 2 * math.pi * (index + 0.8 * dice.random()) / 60
        distance = 6.7 + 0.7 * dice.random()
        speed = math.sqrt(strength / distance)
        size = 0.16 + 0.16 * dice.random()
        bodies.append(
            body(
                box(size, 0.6 * size, **free),
                distance * math.cos(turn),
                distance * math.sin(turn),
                name=f"rock_{index + 1}",
                angle=turn,
                velocity=(-speed * math.sin(turn), speed * math.cos(turn)),
                angular_velocity=3 * (2 * dice.random() - 1),
                color=ROSE,
            )
        )
    world: Message = {
        "precision": Enum("PRECISION_DOUBLE"),
        "gravity": vector(0, 0),
        "sub_steps": 1,
        "integrator": Enum("INTEGRATOR_RUNGE_KUTTA_4"),
        "sleeping": False,
        "continuous": False,
    }
    return scene(
        "orbit",
        "Planets, a comet and a belt of rocks around a point attractor, in double precision with Runge-Kutta 4.",
        (-18, -10.5, 18, 10.5),
        bodies,
        world,
        [{"point_attractor": {"center": vector(0, 0), "strength": strength, "softening": 0.0}}],
    )


def integrators(integrator: str = "SEMI_IMPLICIT_EULER") -> Message:
    words, effect = {
        "SEMI_IMPLICIT_EULER": ("semi-implicit Euler", "the energy swings about its value and stays bounded"),
        "EXPLICIT_EULER": ("explicit Euler", "the energy grows and the bodies spiral outwards"),
        "VERLET": ("Verlet", "the energy swings about its value and stays bounded"),
        "RUNGE_KUTTA_4": ("Runge-Kutta 4", "the energy falls so slowly that no eye sees it"),
    }[integrator]
    name = "integrators" if integrator == "SEMI_IMPLICIT_EULER" else f"integrators_{integrator.lower()}"
    bodies = [body(box(0.3, 0.3, mask=0), 0, 0, name="anchor", kind="STATIC", angle=math.pi / 4, color=SLATE)]
    # Around a spring of 4 N/m: angular frequency 2/√m. Round, flat and straight ellipses.
    for index, (mass, shape_of_orbit) in enumerate(((1.0, 1.0), (2.0, 0.6), (4.0, 0.3), (8.0, 0.0))):
        reach = 2.0 + index
        speed = 2 / math.sqrt(mass) * reach * shape_of_orbit
        turn = math.pi / 2 * index
        bodies.append(
            body(
                circle(0.3 + 0.08 * index, mask=0),
                reach * math.cos(turn),
                reach * math.sin(turn),
                name=f"mass_{round(mass)}",
                velocity=(-speed * math.sin(turn), speed * math.cos(turn)),
                mass=mass,
                color=(CORAL, SAND, TEAL, SEA)[index],
            )
        )
    world: Message = {
        "precision": Enum("PRECISION_DOUBLE"),
        "gravity": vector(0, 0),
        "time_step": 0.05,
        "sub_steps": 1,
        "integrator": Enum(f"INTEGRATOR_{integrator}"),
        "sleeping": False,
        "continuous": False,
    }
    return scene(
        name,
        f"Four masses on a spring to the origin with {words} at the coarse step of 0.05 s: {effect}.",
        (-14, -8, 14, 8),
        bodies,
        world,
        [{"spring": {"center": vector(0, 0), "stiffness": 4.0, "damping": 0.0}}],
    )


SCENES: tuple[Callable[[], Message], ...] = (
    pyramid,
    lambda: stack(10),
    lambda: stack(20),
    lambda: stack(50),
    lambda: bouncing(12),
    lambda: bouncing(30),
    lambda: bouncing(70),
    thesis,
    cars,
    pile,
    dominoes,
    cradle,
    slope,
    precise,
    arch,
    terrain,
    bridge,
    machines,
    tumbler,
    orbit,
    integrators,
    lambda: integrators("EXPLICIT_EULER"),
    lambda: integrators("VERLET"),
    lambda: integrators("RUNGE_KUTTA_4"),
)


def generate() -> dict[str, str]:
    """Every scene's file name and text."""
    made = [make() for make in SCENES]
    return {f"{each['name']}.txtpb": HEADER + "\n".join(lines(each)) + "\n" for each in made}


def main(arguments: list[str]) -> int:
    check = "--check" in arguments
    rest = [each for each in arguments if each != "--check"]
    folder = Path(rest[0]) if rest else Path(__file__).resolve().parent
    differing = []
    for name, text in generate().items():
        path = folder / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            differing.append(name)
            if not check:
                path.write_text(text, encoding="utf-8")
    for name in differing:
        print(f"{'differs' if check else 'written'}: {name}")
    return 1 if check and differing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Scenes of any size, beside those of scenes.py: a pile, a gas, and sleepers beside a drum that never rests."""

from __future__ import annotations

import math
import random

from scenes import Scene

SEED = 7
SIDE = 0.5  # of a box and across a disc, m
GAP = 0.05  # between boxes of a pile before it falls, of their side
ROWS_MAX = 25  # of a pile
WALL = 1.0  # half the thickness, m


def _walls(scene: Scene, half_width: float, height: float, *, closed: bool = False, restitution: float = 0.0) -> None:
    """A floor at y = 0, walls at ± half_width, and a lid where asked for."""
    for y in [-WALL, height + WALL] if closed else [-WALL]:
        scene.body("static", (0.0, y))
        scene.box((half_width + 2 * WALL, WALL), restitution=restitution)
    for side in (-1.0, 1.0):
        scene.body("static", (side * (half_width + WALL), height / 2))
        scene.box((WALL, height / 2), restitution=restitution)


def pile(count: int, steps: int = 600) -> Scene:
    """Boxes in a bin, laid like bricks with small gaps, so that each comes to lie on two. They are at most ROWS_MAX
    high, or the lowest would be pressed together and a body of a large pile would touch more than one of a small pile.
    They come to rest within two seconds; none may sleep."""
    scene = Scene(f"pile_{count}", steps, sleep=False)
    chance = random.Random(SEED)
    rows = min(ROWS_MAX, math.ceil(math.sqrt(count / 2)))
    columns = math.ceil(count / rows)
    pitch = SIDE * (1 + GAP)
    half_width = 0.5 * pitch * (columns + 0.6)
    _walls(scene, half_width, pitch * (rows + 2))
    for number in range(count):
        row, column = divmod(number, columns)
        shift = (0.25 if row % 2 else -0.25) * pitch + chance.uniform(-0.4, 0.4) * GAP * SIDE
        scene.body("dynamic", ((column - 0.5 * (columns - 1)) * pitch + shift, (row + 0.6) * pitch))
        scene.box((SIDE / 2, SIDE / 2))
    return scene


def gas(count: int, steps: int = 600) -> Scene:
    """Discs without friction or loss in a closed box that they fill to a fifth, at up to 5 m/s along each axis."""
    scene = Scene(f"gas_{count}", steps, gravity=(0.0, 0.0), sleep=False)
    chance = random.Random(SEED)
    columns = math.ceil(math.sqrt(count))
    _walls(scene, columns / 2, float(columns), closed=True, restitution=1.0)
    for number in range(count):
        row, column = divmod(number, columns)
        velocity = (chance.uniform(-5.0, 5.0), chance.uniform(-5.0, 5.0))
        scene.body("dynamic", (column - 0.5 * (columns - 1), row + 0.5), velocity=velocity)
        scene.circle(SIDE / 2, friction=0.0, restitution=1.0)
    return scene


STACK = 10  # boxes in each of the sleepers' stacks


def sleepers(awake: int, asleep: int, steps: int = 300) -> Scene:
    """A turning drum in which so many boxes never rest, and so many in stacks on a floor beside it, asleep from the
    start. The drum's bodies come first, so that they move in the same way with and without the stacks."""
    scene = Scene(f"sleepers_{awake}_{asleep}", steps)
    columns = math.ceil(math.sqrt(awake))
    pitch = SIDE * 1.1
    half = 0.5 * columns * pitch * 1.25
    scene.body("kinematic", (0.0, 0.0), spin=math.radians(40.0))
    for side in (1.0, -1.0):
        scene.box((WALL, half + 2 * WALL), (side * (half + WALL), 0.0))
        scene.box((half + 2 * WALL, WALL), (0.0, side * (half + WALL)))
    for number in range(awake):
        row, column = divmod(number, columns)
        scene.body("dynamic", ((column - 0.5 * (columns - 1)) * pitch, (row - 0.5 * (columns - 1)) * pitch))
        scene.box((SIDE / 2, SIDE / 2))
    if asleep > 0:
        floor_from = 4 * half
        width = asleep / STACK * 2 * SIDE
        scene.body("static", (floor_from + width / 2, -WALL))
        scene.box((width / 2 + WALL, WALL))
        for number in range(asleep):
            stack, row = divmod(number, STACK)
            scene.body("dynamic", (floor_from + stack * 2 * SIDE, (row + 0.5) * SIDE), awake=False)
            scene.box((SIDE / 2, SIDE / 2))
    return scene

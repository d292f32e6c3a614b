"""The scenes of the benchmark, written once: every engine loads the same file.

A scene file is text, one item a line:

    scene NAME STEPS GRAVITY_X GRAVITY_Y SLEEP          SLEEP is 0 or 1
    needs FEATURE…                                      joints, capsules, segments, filters: what an engine must have
    body TYPE X Y ANGLE VX VY W AWAKE                   static, kinematic or dynamic; metres, radians, seconds
    box HALF_WIDTH HALF_HEIGHT X Y DENSITY FRICTION RESTITUTION           of the body above, in its frame
    circle RADIUS X Y DENSITY FRICTION RESTITUTION
    capsule X1 Y1 X2 Y2 RADIUS DENSITY FRICTION RESTITUTION
    rounded_box HALF_WIDTH HALF_HEIGHT ROUNDING DENSITY FRICTION RESTITUTION
    polygon DENSITY FRICTION RESTITUTION X1 Y1 X2 Y2 …                    convex, counter-clockwise
    loop FRICTION X1 Y1 X2 Y2 …                         a closed chain of segments
    apart                                               shapes of the body above do not meet others that are apart
    revolute A B AX AY BX BY MOTOR_SPEED MOTOR_TORQUE   A, B: bodies by number, from 0; torque 0: no motor
    sway BODY AMPLITUDE RATE                            before each step its velocity leads to x = AMPLITUDE sin(RATE t)

They are the scenes of Box2D's own benchmark (shared/benchmarks.c of its repository, MIT licence), rebuilt here from
their measures, with two changes that apply to every engine alike: static segments under pyramids are thin boxes, and
static bodies of many shapes are many bodies.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Sequence
from pathlib import Path

GRAVITY = (0.0, -10.0)
FRICTION = 0.6
SEGMENT_HALF_HEIGHT = 0.25  # of the thin boxes in place of segments, m

Point = tuple[float, float]


class Scene:
    """Collects the lines of a scene file."""

    def __init__(self, name: str, steps: int, gravity: Point = GRAVITY, sleep: bool = True) -> None:
        self.name = name
        self._head = ["scene", name, steps, *gravity, int(sleep)]
        self._needs: set[str] = set()
        self._lines: list[str] = []
        self._bodies = 0

    def _add(self, *words: object) -> None:
        self._lines.append(" ".join(_text(word) for word in words))

    def body(
        self,
        kind: str,
        position: Point = (0.0, 0.0),
        *,
        angle: float = 0.0,
        velocity: Point = (0.0, 0.0),
        spin: float = 0.0,
        awake: bool = True,
    ) -> int:
        self._add("body", kind, *position, angle, *velocity, spin, int(awake))
        self._bodies += 1
        return self._bodies - 1

    def box(
        self,
        half: Point,
        center: Point = (0.0, 0.0),
        *,
        density: float = 1.0,
        friction: float = FRICTION,
        restitution: float = 0.0,
    ) -> None:
        self._add("box", *half, *center, density, friction, restitution)

    def circle(
        self, radius: float, *, density: float = 1.0, friction: float = FRICTION, restitution: float = 0.0
    ) -> None:
        self._add("circle", radius, 0.0, 0.0, density, friction, restitution)

    def capsule(
        self, a: Point, b: Point, radius: float, *, density: float, friction: float, restitution: float
    ) -> None:
        self._needs.add("capsules")
        self._add("capsule", *a, *b, radius, density, friction, restitution)

    def rounded_box(self, half: Point, rounding: float, *, friction: float) -> None:
        self._needs.add("capsules")
        self._add("rounded_box", *half, rounding, 1.0, friction, 0.0)

    def polygon(self, points: Sequence[Point], *, density: float = 1.0, friction: float = FRICTION) -> None:
        corners = _counter_clockwise(points)
        self._add("polygon", density, friction, 0.0, *(value for corner in corners for value in corner))

    def loop(self, points: Sequence[Point], *, friction: float) -> None:
        self._needs.add("segments")
        self._add("loop", friction, *(value for point in points for value in point))

    def apart(self) -> None:
        self._add("apart")

    def revolute(self, a: int, b: int, at_a: Point, at_b: Point, *, speed: float = 0.0, torque: float = 0.0) -> None:
        self._needs.add("joints")
        self._add("revolute", a, b, *at_a, *at_b, speed, torque)

    def sway(self, body: int, amplitude: float, rate: float) -> None:
        self._add("sway", body, amplitude, rate)

    def write(self, folder: Path) -> Path:
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{self.name}.txt"
        path.write_text(self.text(), encoding="utf-8")
        return path

    def text(self) -> str:
        head = [" ".join(_text(word) for word in self._head)]
        if self._needs:
            head.append("needs " + " ".join(sorted(self._needs)))
        return "\n".join(head + self._lines) + "\n"


def _text(word: object) -> str:
    return repr(word) if isinstance(word, float) else str(word)


def _counter_clockwise(points: Sequence[Point]) -> list[Point]:
    middle_x = sum(x for x, _ in points) / len(points)
    middle_y = sum(y for _, y in points) / len(points)
    return sorted(points, key=lambda point: math.atan2(point[1] - middle_y, point[0] - middle_x))


def _pyramid(scene: Scene, rows: int, left: float, base: float) -> None:
    for row in range(rows):
        for column in range(row, rows):
            scene.body("dynamic", ((row + 1) * 0.5 + (column - row) + left, row + 0.5 + base))
            scene.box((0.5, 0.5))


def large_pyramid() -> Scene:
    scene = Scene("large_pyramid", 500, sleep=False)
    scene.body("static", (0.0, -1.0))
    scene.box((100.0, 1.0))
    _pyramid(scene, 100, -50.0, 0.0)
    return scene


def many_pyramids() -> Scene:
    scene = Scene("many_pyramids", 200, sleep=False)
    for row in range(20):
        scene.body("static", (0.0, 11.0 * row - SEGMENT_HALF_HEIGHT))
        scene.box((110.0, SEGMENT_HALF_HEIGHT))
    for row in range(20):
        for column in range(20):
            _pyramid(scene, 10, -110.0 + 11.0 * column + 0.5, 11.0 * row)
    return scene


def smash() -> Scene:
    scene = Scene("smash", 300, gravity=(0.0, 0.0))
    scene.body("dynamic", (-20.0, 0.0), velocity=(40.0, 0.0))
    scene.box((4.0, 4.0), density=8.0)
    for column in range(120):
        for row in range(80):
            scene.body("dynamic", (0.4 * column + 30.0, 0.4 * (row - 40)), awake=False)
            scene.box((0.2, 0.2))
    return scene


def tumbler() -> Scene:
    scene = Scene("tumbler", 750)
    ground = scene.body("static")
    drum = scene.body("dynamic", (0.0, 10.0))
    for side in (1.0, -1.0):
        scene.box((0.5, 10.0), (10.0 * side, 0.0), density=50.0)
        scene.box((10.0, 0.5), (0.0, 10.0 * side), density=50.0)
    scene.revolute(ground, drum, (0.0, 10.0), (0.0, 0.0), speed=math.radians(25.0), torque=1e8)
    for row in range(45):
        for column in range(45):
            scene.body("dynamic", (-9.0 + 0.4 * column, 1.0 + 0.4 * row))
            scene.box((0.125, 0.125))
    return scene


def washer() -> Scene:
    scene = Scene("washer", 500)
    scene.body("kinematic", (0.0, 10.0), velocity=(0.001, -0.002), spin=math.radians(25.0))

    def at(radius: float, angle: float) -> Point:
        return radius * math.cos(angle), radius * math.sin(angle)

    wedge = math.radians(10.0)
    for part in range(36):
        low, high = part * wedge, (part + 1) * wedge
        wide_low, wide_high = low - 0.1 * wedge, high + 0.1 * wedge
        scene.polygon([at(16.0, wide_low), at(18.0, wide_low), at(18.0, wide_high), at(16.0, wide_high)])
        if part % 9 == 0:
            scene.polygon([at(14.0, low), at(16.0, low), at(16.0, high), at(14.0, high)])
    for row in range(90):
        for column in range(90):
            scene.body("dynamic", (-9.9 + 0.21 * column, 0.1 + 0.21 * row))
            scene.box((0.1, 0.1))
    return scene


def _bin(scene: Scene, half_width: int, height: int) -> None:
    for x in range(-half_width, half_width + 1):
        scene.body("static", (float(x), 0.0))
        scene.box((0.55, 0.5))
    for side in (-half_width, half_width):
        for y in range(1, height + 1):
            scene.body("static", (float(side), float(y)))
            scene.box((0.5, 0.55))


def junkyard() -> Scene:
    scene = Scene("junkyard", 800)
    _bin(scene, 80, 50)
    turn = math.pi * (math.sqrt(5.0) - 1.0)
    corners = [(0.25 * math.cos(turn * i), 0.25 * math.sin(turn * i)) for i in range(5)]
    side = -0.1
    for column in range(200):
        for row in range(40):
            scene.body("dynamic", (0.375 * (2 * column - 200) + side, row + 15.0))
            scene.polygon(corners)
            side = -side
    pusher = scene.body("kinematic")
    scene.box((2.0, 4.0), (0.0, 4.0))
    scene.sway(pusher, 60.0, 0.2)
    return scene


def compounds() -> Scene:
    scene = Scene("compounds", 500)
    _bin(scene, 40, 100)
    scene.body("static", (0.0, -80.0 - SEGMENT_HALF_HEIGHT))
    scene.box((800.0, SEGMENT_HALF_HEIGHT))
    side = 0.25
    for column in range(20):
        for row in range(150):
            scene.body("dynamic", (2.0 * column - 19.0 + side, 2.25 * row + 5.575))
            scene.polygon([(-1.0, 0.0), (0.5, 1.0), (0.0, 2.0)], friction=0.5)
            scene.polygon([(1.0, 0.0), (-0.5, 1.0), (0.0, 2.0)], friction=0.5)
            side = -side
    return scene


def spinner() -> Scene:
    scene = Scene("spinner", 500)
    ground = scene.body("static")
    turns = [-2.0 * math.pi * i / 360 for i in range(360)]
    scene.loop([(40.0 * math.cos(turn), 40.0 * math.sin(turn) + 32.0) for turn in turns], friction=0.1)
    paddle = scene.body("dynamic", (0.0, 12.0))
    scene.rounded_box((0.4, 20.0), 0.2, friction=0.0)
    scene.revolute(ground, paddle, (0.0, 12.0), (0.0, 0.0), speed=5.0, torque=3e38)
    x, y = -23.0, 2.0
    for i in range(6076):
        scene.body("dynamic", (x, y))
        if i % 3 == 0:
            scene.capsule((-0.25, 0.0), (0.25, 0.0), 0.25, density=0.25, friction=0.1, restitution=0.1)
        elif i % 3 == 1:
            scene.circle(0.35, density=0.25, friction=0.1, restitution=0.1)
        else:
            scene.box((0.35, 0.35), density=0.25, friction=0.1, restitution=0.1)
        x += 0.5
        if x >= 23.0:
            x, y = -23.0, y + 0.5
    return scene


def joint_grid() -> Scene:
    scene = Scene("joint_grid", 500, sleep=False)
    count = 100
    for column in range(count):
        for row in range(count):
            held = row == 0 and abs(column - count // 2) <= 3
            disc = scene.body("static" if held else "dynamic", (float(column), float(-row)))
            scene.circle(0.4)
            scene.apart()
            if row > 0:
                scene.revolute(disc - 1, disc, (0.0, -0.5), (0.0, 0.5))
            if column > 0:
                scene.revolute(disc - count, disc, (0.5, 0.0), (-0.5, 0.0))
    return scene


SCENES: dict[str, Callable[[], Scene]] = {
    make.__name__: make
    for make in (large_pyramid, many_pyramids, tumbler, smash, washer, spinner, junkyard, compounds, joint_grid)
}


def write_scenes(folder: Path, names: Sequence[str]) -> dict[str, Path]:
    return {name: SCENES[name]().write(folder) for name in names}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Writes the scene files of the benchmark.")
    parser.add_argument("folder", type=Path)
    for scene_path in write_scenes(parser.parse_args().folder, list(SCENES)).values():
        print(scene_path)

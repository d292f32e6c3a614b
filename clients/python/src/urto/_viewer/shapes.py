"""The shapes of a room as columns, and where they are in a frame."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from urto._bodies import BodyInfo, Box, Capsule, Chain, Circle, Polygon, Shape, Vector, to_vector
from urto._frame import Frame
from urto._joints import JointInfo
from urto._viewer.joint_lines import JointLines
from urto._viewer.palette import Color, body_color
from urto._viewer.outline import capsule_outline, rounded_outline
from urto._viewer.triangulate import triangulate

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

LAYERS = ("static", "bodies", "sensors")
"""Drawn in this order."""

VIEW_MARGIN = 0.06
"""Of the view's size, left free around the bodies."""

WALL_RATIO_MAX = 20.0
"""If the static bodies cover that many times the area of the others, the view frames the others only."""


class Poses:
    """Where every body is: static ones as the state said, the others as the last frame says."""

    def __init__(self, bodies: Sequence[BodyInfo]) -> None:
        self.ids = np.array([body.id for body in bodies], dtype=np.uint64)
        self.position: Floats = np.array([body.position for body in bodies], dtype=np.float64).reshape(-1, 2)
        self.angle: Floats = np.array([body.angle for body in bodies], dtype=np.float64)
        self.velocity: Floats = np.array([body.velocity for body in bodies], dtype=np.float64).reshape(-1, 2)

    def update(self, frame: Frame) -> bool:
        """Takes over a frame. False if it holds a body that is not known here."""
        rows = np.searchsorted(self.ids, frame.ids)
        if len(frame.ids) and (rows[-1] >= len(self.ids) or not np.array_equal(self.ids[rows], frame.ids)):
            return False
        self.position[rows] = frame.position
        self.angle[rows] = frame.angle
        self.velocity[rows] = frame.velocity
        return True

    def to_world(self, rows: Ints, local: Floats) -> Floats:
        """(n, 2) points of the bodies in `rows`, body frame → world frame."""
        cosine, sine = np.cos(self.angle[rows]), np.sin(self.angle[rows])
        world = np.empty_like(local)
        world[:, 0] = self.position[rows, 0] + cosine * local[:, 0] - sine * local[:, 1]
        world[:, 1] = self.position[rows, 1] + sine * local[:, 0] + cosine * local[:, 1]
        return world


@dataclass
class Boxes:
    """n rectangles: rows in the poses, centre and angle in the body, half sizes (n, 2), colours (n, 3)."""

    rows: Ints
    center: Floats
    angle: Floats
    half_size: Floats
    color: npt.NDArray[np.uint8]

    def corners(self, poses: Poses) -> Floats:
        """(n, 4, 2) m, world frame."""
        center = poses.to_world(self.rows, self.center)
        angle = poses.angle[self.rows] + self.angle
        cosine, sine = np.cos(angle), np.sin(angle)
        across = np.stack([cosine, sine], 1) * self.half_size[:, :1]
        up = np.stack([-sine, cosine], 1) * self.half_size[:, 1:]
        return np.stack([center - across - up, center + across - up, center + across + up, center - across + up], 1)


@dataclass
class Discs:
    """n discs: rows in the poses, centre in the body, radius (n,), colours (n, 3)."""

    rows: Ints
    center: Floats
    radius: Floats
    color: npt.NDArray[np.uint8]


@dataclass
class Polygons:
    """p polygons with v vertices in all, of t triangles: rows and vertices per vertex, colours per vertex."""

    rows: Ints
    vertex: Floats
    color: npt.NDArray[np.uint8]
    triangle: npt.NDArray[np.uint32]
    start: list[int]  # of each polygon in the vertices, and the end


@dataclass
class Lines:
    """Chains with v vertices in all: rows, vertices and colours per vertex. A loop's first vertex is its last too."""

    rows: Ints
    vertex: Floats
    color: npt.NDArray[np.uint8]
    start: list[int]  # of each chain in the vertices, and the end


@dataclass
class _Columns:
    box: list[tuple[int, float, float, float, float, float, Color]] = field(default_factory=list)
    disc: list[tuple[int, float, float, float, Color]] = field(default_factory=list)
    vertex: list[tuple[int, float, float, Color]] = field(default_factory=list)
    triangle: list[tuple[int, int, int]] = field(default_factory=list)
    start: list[int] = field(default_factory=lambda: [0])
    line_vertex: list[tuple[int, float, float, Color]] = field(default_factory=list)
    line_start: list[int] = field(default_factory=lambda: [0])

    def add(self, row: int, shape: Shape, color: Color) -> None:
        x, y = to_vector("position", shape.position)
        if isinstance(shape, Box) and shape.radius > 0:
            self._add_polygon(row, rounded_outline(_box_corners(shape, x, y), shape.radius), color)
        elif isinstance(shape, Box):
            self.box.append((row, x, y, shape.angle, shape.width / 2, shape.height / 2, color))
        elif isinstance(shape, Circle):
            self.disc.append((row, x, y, shape.radius, color))
        elif isinstance(shape, Polygon):
            points = [to_vector("vertex", vertex) for vertex in shape.vertices]
            self._add_polygon(row, rounded_outline(points, shape.radius) if shape.radius > 0 else points, color)
        elif isinstance(shape, Capsule):
            outline = capsule_outline(to_vector("a", shape.a), to_vector("b", shape.b), shape.radius)
            self._add_polygon(row, outline, color)
        elif isinstance(shape, Chain):
            points = [to_vector("vertex", vertex) for vertex in shape.vertices]
            points += points[:1] if shape.loop else []
            self.line_vertex.extend((row, point_x, point_y, color) for point_x, point_y in points)
            self.line_start.append(len(self.line_vertex))

    def _add_polygon(self, row: int, points: list[Vector], color: Color) -> None:
        first = len(self.vertex)
        self.triangle.extend((first + a, first + b, first + c) for a, b, c in triangulate(points))
        self.vertex.extend((row, point_x, point_y, color) for point_x, point_y in points)
        self.start.append(len(self.vertex))


def _box_corners(shape: Box, x: float, y: float) -> list[Vector]:
    cosine, sine = math.cos(shape.angle), math.sin(shape.angle)
    half_x, half_y = shape.width / 2, shape.height / 2
    corners = [(-half_x, -half_y), (half_x, -half_y), (half_x, half_y), (-half_x, half_y)]
    return [(x + cosine * u - sine * v, y + sine * u + cosine * v) for u, v in corners]


class Layer:
    """The shapes that are drawn alike."""

    def __init__(self, columns: _Columns) -> None:
        boxes = np.array([entry[:6] for entry in columns.box], dtype=np.float64).reshape(-1, 6)
        self.boxes = Boxes(
            _rows(entry[0] for entry in columns.box), boxes[:, 1:3], boxes[:, 3], boxes[:, 4:6],
            _colors(entry[6] for entry in columns.box),
        )  # fmt: skip
        discs = np.array([entry[:4] for entry in columns.disc], dtype=np.float64).reshape(-1, 4)
        self.discs = Discs(
            _rows(entry[0] for entry in columns.disc), discs[:, 1:3], discs[:, 3],
            _colors(entry[4] for entry in columns.disc),
        )  # fmt: skip
        vertices = np.array([entry[:3] for entry in columns.vertex], dtype=np.float64).reshape(-1, 3)
        self.polygons = Polygons(
            _rows(entry[0] for entry in columns.vertex), vertices[:, 1:3],
            _colors(entry[3] for entry in columns.vertex),
            np.array(columns.triangle, dtype=np.uint32).reshape(-1, 3), columns.start,
        )  # fmt: skip
        lines = np.array([entry[:3] for entry in columns.line_vertex], dtype=np.float64).reshape(-1, 3)
        self.lines = Lines(
            _rows(entry[0] for entry in columns.line_vertex), lines[:, 1:3],
            _colors(entry[3] for entry in columns.line_vertex), columns.line_start,
        )  # fmt: skip


def _rows(rows: Iterable[int]) -> Ints:
    return np.array(list(rows), dtype=np.int64)


def _colors(colors: Iterable[Color]) -> npt.NDArray[np.uint8]:
    return np.array(list(colors), dtype=np.uint8).reshape(-1, 3)


class ShapeSet:
    """All shapes of one layout of a room."""

    def __init__(self, bodies: Sequence[BodyInfo], joints: Sequence[JointInfo] = ()) -> None:
        self.bodies = tuple(bodies)
        self.poses = Poses(bodies)
        self.joints = JointLines(joints, self.poses.ids)
        columns = {layer: _Columns() for layer in LAYERS}
        for row, info in enumerate(bodies):
            solid = "static" if info.body.type == "static" else "bodies"
            color = body_color(info)
            for shape in info.body.shapes:
                columns["sensors" if shape.sensor else solid].add(row, shape, color)
        self.layers = {layer: Layer(each) for layer, each in columns.items()}

    def joint_ends(self) -> Floats:
        """(n, 2, 2) m, world frame: where the anchors of each joint are."""
        return self.joints.ends(self.poses.position, self.poses.angle)

    def bounds(self) -> tuple[float, float, float, float]:
        """Left, lower, right, upper in m of what a viewer should frame, without a margin."""
        static = self._layer_bounds("static")
        moving = self._layer_bounds("bodies") or self._layer_bounds("sensors")
        if moving is None or static is None:
            return moving or static or (-5.0, -5.0, 5.0, 5.0)
        both = _union(static, moving)
        # A single body at a point has no area to compare with: give it that of a 10 m square.
        if _area(both) > WALL_RATIO_MAX * max(_area(moving), 100.0):
            return moving
        return both

    def _layer_bounds(self, name: str) -> tuple[float, float, float, float] | None:
        layer = self.layers[name]
        points = [
            layer.boxes.corners(self.poses).reshape(-1, 2),
            self.poses.to_world(layer.polygons.rows, layer.polygons.vertex),
            self.poses.to_world(layer.lines.rows, layer.lines.vertex),
        ]
        centers = self.poses.to_world(layer.discs.rows, layer.discs.center)
        points += [centers - layer.discs.radius[:, None], centers + layer.discs.radius[:, None]]
        everything = np.concatenate(points)
        if len(everything) == 0:
            return None
        low, high = everything.min(axis=0), everything.max(axis=0)
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])


def _union(
    a: tuple[float, float, float, float], b: tuple[float, float, float, float]
) -> tuple[float, float, float, float]:
    return min(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), max(a[3], b[3])


def _area(bounds: tuple[float, float, float, float]) -> float:
    return (bounds[2] - bounds[0]) * (bounds[3] - bounds[1])


def with_margin(bounds: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    """The bounds grown by VIEW_MARGIN on each side, at least 1 m wide and high."""
    left, lower, right, upper = bounds
    if not all(math.isfinite(value) for value in bounds):
        return -5.0, -5.0, 5.0, 5.0
    margin = VIEW_MARGIN * max(right - left, upper - lower)
    grow_x, grow_y = (max(margin, (1.0 - size) / 2) for size in (right - left, upper - lower))
    return left - grow_x, lower - grow_y, right + grow_x, upper + grow_y

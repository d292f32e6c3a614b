"""A picture of a room at one moment, drawn with Pillow: needs neither a screen nor a graphics driver."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from urto._frame import Contacts
from urto._viewer.feelers import Felt
from urto._viewer.hits import RecentHits
from urto._viewer.palette import BACKGROUND, CONTACT, FEELER, GRID, HIT, JOINT, TEXT, VELOCITY, Color, darker
from urto._viewer.shapes import LAYERS, Layer, ShapeSet, with_margin

SUPERSAMPLING = 3
"""Drawn that many times larger and scaled down, which smooths the edges."""

WIDTH_PX = 1600
ASPECTS = (0.4, 0.75)
"""Height over width of the picture stays between these."""

GRID_LINES_MAX = 40
"""Lines across the width; their distance is the next larger of 1, 2, 5, 10, … m."""

VELOCITY_SECONDS = 0.25
"""Arrows of velocity reach where the body would be after that long."""


class _Canvas:
    def __init__(self, bounds: tuple[float, float, float, float]) -> None:
        left, lower, right, upper = bounds
        ratio = min(max((upper - lower) / (right - left), ASPECTS[0]), ASPECTS[1])
        self.width, self.height = WIDTH_PX * SUPERSAMPLING, round(WIDTH_PX * ratio) * SUPERSAMPLING
        self.scale = min(self.width / (right - left), self.height / (upper - lower))  # px per m
        self.left = (left + right) / 2 - self.width / self.scale / 2
        self.lower = (lower + upper) / 2 - self.height / self.scale / 2
        self.image = Image.new("RGB", (self.width, self.height), BACKGROUND)
        self.draw = ImageDraw.Draw(self.image)
        self.font = ImageFont.load_default(size=17 * SUPERSAMPLING)

    def px(self, x: float, y: float) -> tuple[float, float]:
        return (x - self.left) * self.scale, self.height - (y - self.lower) * self.scale

    def grid(self) -> float:
        span = self.width / self.scale
        step = _round_up(span / GRID_LINES_MAX)
        for start, count, vertical in (
            (self.left, math.ceil(span / step) + 1, True),
            (self.lower, math.ceil(self.height / self.scale / step) + 1, False),
        ):
            first = math.floor(start / step) * step
            for index in range(count):
                at = first + index * step
                line = (
                    [(self.px(at, 0)[0], 0), (self.px(at, 0)[0], self.height)]
                    if vertical
                    else [(0, self.px(0, at)[1]), (self.width, self.px(0, at)[1])]
                )
                self.draw.line(line, fill=GRID, width=SUPERSAMPLING)
        return step

    def polygon(self, points: list[tuple[float, float]], color: Color, line: float, filled: bool) -> None:
        pixels = [self.px(x, y) for x, y in points]
        if filled:
            self.draw.polygon(pixels, fill=color)
        self.draw.line([*pixels, pixels[0]], fill=darker(color, 0.55), width=round(line), joint="curve")

    def disc(self, x: float, y: float, radius: float, angle: float, color: Color, line: float, filled: bool) -> None:
        center_x, center_y = self.px(x, y)
        r = radius * self.scale
        edge = darker(color, 0.55)
        box = (center_x - r, center_y - r, center_x + r, center_y + r)
        self.draw.ellipse(box, fill=color if filled else None, outline=edge, width=round(line))
        tip = center_x + 0.92 * r * math.cos(angle), center_y - 0.92 * r * math.sin(angle)
        self.draw.line([(center_x, center_y), tip], fill=edge, width=round(line))


def _round_up(value: float) -> float:
    power = 10.0 ** math.floor(math.log10(value))
    return next(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= value * 0.999)


def draw_picture(
    shapes: ShapeSet,
    path: Path,
    *,
    bounds: tuple[float, float, float, float] | None = None,
    caption: str = "",
    velocities: bool = False,
    contacts: Contacts | None = None,
    hits: RecentHits | None = None,
    felt: Felt | None = None,
) -> None:
    """Writes a PNG of the shapes where their poses are.

    Args:
        shapes: what is drawn.
        path: of the PNG file.
        bounds: left, lower, right, upper in m; None: around the bodies.
        caption: a line at the lower left.
        velocities: draw an arrow on every moving body.
        contacts: draw their points and normals.
        hits: draw a disc for each, by its speed.
        felt: draw what a body would meet.
    """
    canvas = _Canvas(bounds or with_margin(shapes.bounds()))
    step = canvas.grid()
    for name in LAYERS:
        _draw_layer(canvas, shapes, shapes.layers[name], filled=name != "sensors")
    _draw_joints(canvas, shapes)
    if velocities:
        _draw_velocities(canvas, shapes)
    if contacts is not None:
        for (x, y), normal in zip(contacts.point.tolist(), contacts.normal.tolist(), strict=True):
            center_x, center_y = canvas.px(x, y)
            r = 3.0 * SUPERSAMPLING
            tip = center_x + normal[0] * 5 * r, center_y - normal[1] * 5 * r
            canvas.draw.line([(center_x, center_y), tip], fill=CONTACT, width=SUPERSAMPLING)
            canvas.draw.ellipse((center_x - r, center_y - r, center_x + r, center_y + r), fill=CONTACT)
    if felt is not None:
        _draw_felt(canvas, felt)
    if hits is not None:
        for (x, y), radius in zip(hits.points.tolist(), hits.radii(canvas.width / canvas.scale).tolist(), strict=True):
            center_x, center_y = canvas.px(x, y)
            r = radius * canvas.scale
            canvas.draw.ellipse((center_x - r, center_y - r, center_x + r, center_y + r), fill=HIT)
    text = f"{caption} · " if caption else ""
    margin = 12 * SUPERSAMPLING
    canvas.draw.text(
        (margin, canvas.height - margin), f"{text}grid {step:g} m", fill=TEXT, font=canvas.font, anchor="ls"
    )
    size = canvas.width // SUPERSAMPLING, canvas.height // SUPERSAMPLING
    canvas.image.resize(size, Image.Resampling.LANCZOS).save(path, optimize=True)


def _draw_felt(canvas: _Canvas, felt: Felt) -> None:
    origin = canvas.px(*felt.origin)
    r = felt.radius * canvas.scale
    for (x, y), met in zip(felt.ends.tolist(), felt.met.tolist(), strict=True):
        end_x, end_y = canvas.px(x, y)
        canvas.draw.line([origin, (end_x, end_y)], fill=FEELER, width=SUPERSAMPLING)
        if met:
            canvas.draw.ellipse((end_x - r, end_y - r, end_x + r, end_y + r), fill=FEELER)
    if felt.nearest is not None:
        canvas.draw.line([canvas.px(x, y) for x, y in felt.nearest.tolist()], fill=HIT, width=3 * SUPERSAMPLING)


def _draw_joints(canvas: _Canvas, shapes: ShapeSet) -> None:
    r = 1.5 * SUPERSAMPLING
    for ends in shapes.joint_ends().tolist():
        pixels = [canvas.px(x, y) for x, y in ends]
        canvas.draw.line(pixels, fill=JOINT, width=SUPERSAMPLING)
        for x, y in pixels:
            canvas.draw.ellipse((x - r, y - r, x + r, y + r), fill=JOINT)


def _draw_layer(canvas: _Canvas, shapes: ShapeSet, layer: Layer, filled: bool) -> None:
    poses = shapes.poses
    thin = 1.5 * SUPERSAMPLING
    for corners, color in zip(layer.boxes.corners(poses).tolist(), layer.boxes.color.tolist(), strict=True):
        canvas.polygon(corners, tuple(color), thin, filled)
    vertices = poses.to_world(layer.polygons.rows, layer.polygons.vertex).tolist()
    for start, end in zip(layer.polygons.start, layer.polygons.start[1:], strict=False):
        canvas.polygon(vertices[start:end], tuple(layer.polygons.color[start].tolist()), thin, filled)
    points = poses.to_world(layer.lines.rows, layer.lines.vertex).tolist()
    for start, end in zip(layer.lines.start, layer.lines.start[1:], strict=False):
        pixels = [canvas.px(x, y) for x, y in points[start:end]]
        canvas.draw.line(pixels, fill=tuple(layer.lines.color[start].tolist()), width=2 * SUPERSAMPLING, joint="curve")
    centers = poses.to_world(layer.discs.rows, layer.discs.center).tolist()
    angles = poses.angle[layer.discs.rows].tolist()
    radii, colors = layer.discs.radius.tolist(), layer.discs.color.tolist()
    for (x, y), angle, radius, color in zip(centers, angles, radii, colors, strict=True):
        canvas.disc(x, y, radius, angle, tuple(color), thin, filled)


def _draw_velocities(canvas: _Canvas, shapes: ShapeSet) -> None:
    moving = np.hypot(shapes.poses.velocity[:, 0], shapes.poses.velocity[:, 1]) > 1e-3
    ends = shapes.poses.position + shapes.poses.velocity * VELOCITY_SECONDS
    for (x, y), (end_x, end_y) in zip(
        shapes.poses.position[moving].tolist(), ends[moving].tolist(), strict=True
    ):
        start, end = canvas.px(x, y), canvas.px(end_x, end_y)
        canvas.draw.line([start, end], fill=VELOCITY, width=2 * SUPERSAMPLING)
        r = 2.5 * SUPERSAMPLING
        canvas.draw.ellipse((end[0] - r, end[1] - r, end[0] + r, end[1] + r), fill=VELOCITY)

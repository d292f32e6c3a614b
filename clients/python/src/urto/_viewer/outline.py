"""Outlines of round shapes as polygons."""

from __future__ import annotations

import math

from urto._bodies import Vector

ARC_STEP = math.pi / 12
"""rad, the most that one edge of an arc spans."""


def capsule_outline(a: Vector, b: Vector, radius: float) -> list[Vector]:
    """Counter-clockwise outline of all points within `radius` of a segment."""
    return rounded_outline([a, b], radius)


def rounded_outline(vertices: list[Vector], radius: float) -> list[Vector]:
    """Counter-clockwise outline of a convex polygon (or segment) grown by `radius`."""
    if sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(vertices, vertices[1:] + vertices[:1], strict=True)) < 0:
        vertices = vertices[::-1]
    count = len(vertices)
    # The direction of each edge's outward normal.
    normal = [
        math.atan2(vertices[i][0] - vertices[(i + 1) % count][0], vertices[(i + 1) % count][1] - vertices[i][1])
        for i in range(count)
    ]
    outline = []
    for index, (x, y) in enumerate(vertices):
        start = normal[index - 1]
        turn = (normal[index] - start) % (2 * math.pi)
        steps = max(1, math.ceil(turn / ARC_STEP))
        for step in range(steps + 1):
            angle = start + turn * step / steps
            outline.append((x + radius * math.cos(angle), y + radius * math.sin(angle)))
    return outline

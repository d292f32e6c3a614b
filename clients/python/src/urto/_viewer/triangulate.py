"""Triangles of a simple polygon, by clipping ears (O'Rourke, Computational Geometry in C, 1.4; here with the
vertices in a list, so cubic in their number, of which a body's polygon has at most 64)."""

from __future__ import annotations

from collections.abc import Sequence

Point = tuple[float, float]


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _inside(point: Point, a: Point, b: Point, c: Point) -> bool:
    return _turn(a, b, point) >= 0 and _turn(b, c, point) >= 0 and _turn(c, a, point) >= 0


def signed_area(vertices: Sequence[Point]) -> float:
    """m², positive if the vertices go counter-clockwise."""
    return 0.5 * sum(
        x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(vertices, [*vertices[1:], vertices[0]], strict=True)
    )


def triangulate(vertices: Sequence[Point]) -> list[tuple[int, int, int]]:
    """Index triples, counter-clockwise, that cover a simple polygon of either winding."""
    left = list(range(len(vertices)))
    if signed_area(vertices) < 0:
        left.reverse()
    triangles = []
    while len(left) > 3:
        for position in range(len(left)):
            before, here, after = left[position - 1], left[position], left[(position + 1) % len(left)]
            corner = vertices[before], vertices[here], vertices[after]
            if _turn(*corner) <= 0:
                continue
            if any(_inside(vertices[other], *corner) for other in left if other not in (before, here, after)):
                continue
            triangles.append((before, here, after))
            del left[position]
            break
        else:  # only vertices on one line are left, or rounding hides the last ear: fan what remains
            triangles.extend((left[0], left[index], left[index + 1]) for index in range(1, len(left) - 1))
            return triangles
    triangles.append((left[0], left[1], left[2]))
    return triangles

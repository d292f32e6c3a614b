"""Queries with a shape through a served room, against figures computed by hand."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import pytest
import urto
from conftest import TIMEOUT_S, WEIGHTLESS, Start

URTO = Path(sys.executable).with_name("urto")
FLOAT = WEIGHTLESS.replace("PRECISION_DOUBLE", "PRECISION_FLOAT")


def _connect(endpoint: str) -> urto.Room:
    return urto.connect(endpoint, user="tester", timeout=TIMEOUT_S)


@pytest.mark.parametrize("scene", [WEIGHTLESS, FLOAT], ids=["double", "float"])
def test_a_shape_is_cast_past_what_it_does_not_see(start: Start, scene: str) -> None:
    urtod = start(scene, "--paused")
    with _connect(urtod.endpoint) as room:
        box = room.spawn(urto.Box(width=2, height=2, position=(5, 0)))
        ball = room.spawn(urto.Circle(radius=1, position=(10, 1.2), category=2))
        coin = room.spawn(urto.Box(width=1, height=1, position=(2, 0), sensor=True, type="static"))
        wall = room.spawn(urto.Chain(vertices=[(0, 3), (0, -3)], position=(14, 0), type="static"))
        room.step()
        disc = urto.Circle(radius=0.8, position=(0, 0))
        hits = room.query_cast(disc, (20, 0))
        assert [hit.body for hit in hits] == [box, ball, wall]
        assert not hits.truncated
        # The box's side is at 4; the ball's centre is 1.2 above the way and 1.8 from the disc's when they touch.
        expected = [4 - 0.8, 10 - math.sqrt(1.8**2 - 1.2**2), 14 - 0.8]
        assert [hit.distance for hit in hits] == pytest.approx(expected, abs=1e-6)
        assert [hit.fraction for hit in hits] == pytest.approx([each / 20 for each in expected], abs=1e-7)
        assert hits[0].point == pytest.approx((4, 0), abs=1e-6)
        assert hits[0].normal == pytest.approx((-1, 0), abs=1e-6)
        assert hits[1].normal == pytest.approx((-math.sqrt(5) / 3, -2 / 3), abs=1e-6)
        assert [hit.body for hit in room.query_cast(disc, (20, 0), mask=2)] == [ball]
        first = room.query_cast(disc, (20, 0), count_max=1)
        assert ([hit.body for hit in first], first.truncated) == ([box], True)
        (inside,) = room.query_cast(urto.Box(width=1, height=1, position=(5, 0), angle=1), (0, 9))
        assert (inside.body, inside.fraction, inside.normal) == (box, 0, (0, 0))
        assert coin.info().body.shapes[0].sensor


def test_overlaps_are_those_of_the_shapes(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")
    with _connect(urtod.endpoint) as room:
        disc = room.spawn(urto.Circle(radius=1, position=(0, 0)))
        rounded = room.spawn(urto.Box(width=1, height=1, radius=0.5, position=(5, 0)))
        assert [hit.body for hit in room.query_overlap(urto.Box(width=1, height=1, position=(1.2, 1.2)))] == [disc]
        # The corner (0.75, 0.75) of this one is 1.06 from the middle, though the bounds of the disc hold it.
        assert room.query_overlap(urto.Box(width=0.5, height=0.5, position=(1, 1))) == []
        assert [hit.body for hit in room.query_overlap((5.9, 0))] == [rounded]
        assert room.query_overlap((5.9, 0.9)) == []  # its corner is round
        both = room.query_overlap(urto.Capsule(a=(0, 0), b=(5, 0), radius=0.1))
        assert [hit.body for hit in both] == [disc, rounded]
        few = room.query_overlap(urto.Capsule(a=(0, 0), b=(5, 0), radius=0.1), count_max=1)
        assert ([hit.body for hit in few], few.truncated) == ([disc], True)


def test_closest_points_lie_on_both_shapes(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")
    with _connect(urtod.endpoint) as room:
        box = room.spawn(urto.Box(width=2, height=2, position=(0, 0)))
        ball = room.spawn(urto.Circle(radius=1, position=(6, 0)))
        triangle = urto.Polygon(vertices=[(0, 0), (1, -0.5), (1, 0.5)], position=(2, 0.25))
        near, far = room.query_closest(triangle, distance_max=10)
        assert (near.body, far.body) == (box, ball)
        assert near.distance == pytest.approx(1)
        assert near.point == pytest.approx((1, 0.25))
        assert near.query_point == pytest.approx((2, 0.25))
        assert near.normal == pytest.approx((1, 0))
        assert far.distance == pytest.approx(2)
        assert [hit.body for hit in room.query_closest(triangle, distance_max=1.5)] == [box]
        (deep,) = room.query_closest((0.75, 0.25), distance_max=0)
        assert (deep.body, deep.distance) == (box, pytest.approx(-0.25))
        assert deep.point == pytest.approx((1, 0.25))
        assert deep.normal == pytest.approx((1, 0))


def test_the_viewer_shows_what_a_body_would_meet(start: Start, tmp_path: Path) -> None:
    pytest.importorskip("rerun")
    from rerun.chunk import RrdReader

    urtod = start("platformer")
    command = [URTO, "view", "--endpoint", urtod.endpoint, "--save", tmp_path, "--ticks", "30", "--feel", "player"]
    subprocess.run(command, check=True, capture_output=True, timeout=TIMEOUT_S * 4)
    ways, discs = [], []
    for chunk in RrdReader(tmp_path / "room.rrd").store().stream().to_chunks():
        batch = chunk.to_record_batch()
        if str(chunk.entity_path) == "/room/camera/feelers" and "LineStrips2D:strips" in batch.schema.names:
            ways += batch.column("LineStrips2D:strips").to_pylist()
        if str(chunk.entity_path) == "/room/camera/felt" and "Points2D:positions" in batch.schema.names:
            discs += batch.column("Points2D:positions").to_pylist()
    assert {len(each) for each in ways} == {32}
    assert 0 < max(len(each) for each in discs) <= 32
    missing = [URTO, "view", "--endpoint", urtod.endpoint, "--save", tmp_path, "--ticks", "1", "--feel", "nobody"]
    refused = subprocess.run(missing, capture_output=True, text=True, timeout=TIMEOUT_S * 4, check=False)
    assert refused.returncode == 4
    assert "nobody" in refused.stderr


def test_what_makes_no_shape_is_refused_by_name(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")
    with _connect(urtod.endpoint) as room:
        with pytest.raises(urto.InvalidValue) as refused:
            room.query_cast(urto.Circle(radius=0), (1, 0))
        assert refused.value.field == "query.cast.shape.circle.radius"
        with pytest.raises(urto.DegenerateShape):
            room.query_overlap(urto.Polygon(vertices=[(0, 0), (1, 0), (2, 0)]))
        concave = urto.Polygon(vertices=[(0, 0), (2, 0), (2, 2), (1, 0.5)])
        with pytest.raises(urto.InvalidValue, match="convex"):
            room.query_closest(concave, distance_max=1)
        with pytest.raises(urto.InvalidValue, match="count_max"):
            room.query_overlap((0, 0), count_max=5000)

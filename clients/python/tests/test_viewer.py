"""The viewer: what it logs, read back with Rerun's own reader, and the picture it draws."""

from __future__ import annotations

import os
import signal
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

rr = pytest.importorskip("rerun")
Image = pytest.importorskip("PIL.Image")

import urto
from support.fake_room import GRAVITY_Y, TIME_STEP, FakeRoom, Running
from urto._proto.v1 import scene_pb2, snapshot_pb2
from urto._viewer import outputs
from urto._viewer.feelers import FEELERS, REACH
from urto._viewer.hits import HIT_SIZE, HIT_SIZE_MAX, HIT_TICKS
from urto._viewer.palette import BACKGROUND, FEELER, HIT, STATIC
from urto._viewer.shapes import ShapeSet
from urto._viewer.triangulate import signed_area, triangulate
from urto._viewer.view import ViewOptions, _Outputs, _View, view


def _furnish(room: urto.Room) -> None:
    room.spawn(
        [
            urto.Box(width=20, height=1, position=(0, -0.5), type="static"),
            urto.Box(width=1, height=2, position=(-3, 6), angle=0.3, color=0xFF0000),
            urto.Circle(radius=0.5, position=(0, 6), velocity=(1, 2), angular_velocity=1),
            urto.Polygon(vertices=[(0, 0), (2, 0), (2, 1), (1, 0.2)], position=(3, 6)),
            urto.Circle(radius=1, position=(5, 1), type="static", sensor=True),
        ]
    )


def _chunks(recording: Path) -> list[tuple[str, Any]]:
    """Entity and record batch of every chunk, read by Rerun's own reader."""
    from rerun.chunk import RrdReader

    stream = RrdReader(recording).store().stream()
    return [(str(chunk.entity_path), chunk.to_record_batch()) for chunk in stream.to_chunks()]


def _values(recording: Path, entity: str, column: str) -> list[tuple[int, Any]]:
    """(tick, value) of a column that changes in time."""
    found = []
    for path, batch in _chunks(recording):
        if path == entity and column in batch.schema.names and "tick" in batch.schema.names:
            ticks, values = batch.column("tick").to_pylist(), batch.column(column).to_pylist()
            found += [(tick, value) for tick, value in zip(ticks, values, strict=True) if value is not None]
    return sorted(found, key=lambda row: row[0])


def test_a_saved_view_holds_what_the_room_did(room: urto.Room, fake: FakeRoom, tmp_path: Path) -> None:
    _furnish(room)
    said: list[str] = []
    with Running(fake):
        options = ViewOptions(save=tmp_path / "out", ticks=200, rate_hz=1000, velocities=True, contacts=True)
        view(room, options, said.append)
    recording = tmp_path / "out" / "room.rrd"
    subprocess.run([outputs.rerun_program(), "rrd", "verify", str(recording)], check=True, capture_output=True)
    sizes = _values(recording, "/room/bodies/boxes", "Boxes3D:half_sizes")
    assert np.allclose(sizes[0][1][0][:2], [0.5, 1.0])
    assert _values(recording, "/room/bodies/boxes", "body_id")[0][1] == [2]
    # Free fall by semi-implicit Euler from y = 6: y = 6 + g dt² n (n + 1) / 2 after n ticks.
    last, centers = _values(recording, "/room/bodies/boxes", "Boxes3D:centers")[-1]
    assert last >= 200
    assert centers[0][1] == pytest.approx(6 + GRAVITY_Y * TIME_STEP**2 * last * (last + 1) / 2, rel=1e-5)
    entities = {entity for entity, _ in _chunks(recording)}
    for entity in (
        "/room/static/boxes",
        "/room/bodies/edges", "/room/bodies/discs", "/room/bodies/spokes", "/room/bodies/polygons",
        "/room/sensors/discs", "/room/camera", "/room/camera/velocities", "/room/camera/contacts",
        "/room/camera/normals",
    ):  # fmt: skip
        assert entity in entities, entity
    assert len(_values(recording, "/plots/members/count", "Scalars:scalars")) > 1
    assert any("sim_time" in batch.schema.names for entity, batch in _chunks(recording) if entity.startswith("/plots"))
    assert any("MemberJoined" in text[0] for _, text in _values(recording, "/events", "TextLog:text"))
    assert [line.split()[0] for line in said] == ["recording", said[1].split()[0]]
    assert "room.png" in said[1]


def test_a_reset_begins_a_recording_of_its_own(room: urto.Room, tmp_path: Path) -> None:
    _furnish(room)
    options = ViewOptions(save=tmp_path)
    shown = _View(room, options, _Outputs(options, print))
    shown.begin()
    shown.show(room.step(5))
    room.reset()
    room.spawn(urto.Box(width=3, height=3))
    shown.show(room.step(2))
    shown.end_recording()
    first = _values(tmp_path / "room.rrd", "/room/bodies/boxes", "Boxes3D:centers")
    second = _values(tmp_path / "room-2.rrd", "/room/bodies/boxes", "Boxes3D:half_sizes")
    assert [tick for tick, _ in first if tick > 0] == [5]
    assert second[0][0] == 2
    assert np.allclose(second[0][1][0][:2], [1.5, 1.5])


def test_what_is_despawned_is_gone_from_the_next_layout(room: urto.Room, tmp_path: Path) -> None:
    _furnish(room)
    options = ViewOptions(save=tmp_path)
    shown = _View(room, options, _Outputs(options, print))
    shown.begin()
    room.step(3)
    for body in room.bodies():
        if body.body.type == "dynamic":
            room.body(body.id).despawn()
    shown.show(room.step(2))
    shown.end_recording()
    for entity, column in (
        ("boxes", "Boxes3D:half_sizes"), ("discs", "Ellipsoids3D:half_sizes"), ("polygons", "Mesh3D:vertex_positions"),
    ):  # fmt: skip
        values = _values(tmp_path / "room.rrd", f"/room/bodies/{entity}", column)
        counts = [(tick, len(value)) for tick, value in values]
        assert counts[0][1] > 0
        assert counts[-1] == (5, 0), entity


def test_hits_are_discs_by_their_speed_for_a_while(room: urto.Room, fake: FakeRoom, tmp_path: Path) -> None:
    room.spawn(urto.Box(width=20, height=10, type="static", color=0))
    options = ViewOptions(save=tmp_path)
    shown = _View(room, options, _Outputs(options, print))
    shown.begin()
    shown.show(room.step(1))
    vector = scene_pb2.Vector
    for x, speed in ((0.0, 2.0), (3.0, 8.0), (-3.0, 1e6)):
        hit = snapshot_pb2.ContactHit(
            body_a=1, body_b=2, point=vector(x=x, y=1), normal=vector(y=1), approach_speed=speed
        )
        fake.emit(contact_hit=hit)
    while len(shown._hits) < 3:
        shown.show_events()
    shown.draw(tmp_path / "room.png")
    width = shown._log._right - shown._log._left
    assert shown._hits.points.tolist() == [[0, 1], [3, 1], [-3, 1]]
    expected = [width * HIT_SIZE * 2, width * HIT_SIZE * 8, width * HIT_SIZE_MAX]
    assert shown._hits.radii(width).tolist() == pytest.approx(expected)
    shown.show(room.step(HIT_TICKS))
    assert len(shown._hits) == 0
    shown.end_recording()
    discs = _values(tmp_path / "room.rrd", "/room/camera/hits", "Points2D:radii")
    assert discs[-2][1] == pytest.approx(expected, rel=1e-6)
    assert discs[-1][1] == []
    picture = Image.open(tmp_path / "room.png")
    assert HIT in {color for _, color in picture.getcolors(maxcolors=picture.width * picture.height)}


def test_feelers_reach_to_what_is_met(room: urto.Room, tmp_path: Path) -> None:
    room.spawn([urto.Circle(radius=1, name="player", color=0), urto.Circle(radius=1, position=(6, 0), color=0)])
    shown = _View(room, ViewOptions(save=tmp_path, feel="player"), _Outputs(ViewOptions(save=tmp_path), print))
    shown.begin()
    shown.draw(tmp_path / "room.png")
    shown.end_recording()
    felt = shown._felt
    assert felt is not None
    width = shown._log._right - shown._log._left
    # The room of this test says that everything is met halfway; the body itself does not count.
    assert felt.ends.shape == (FEELERS, 2)
    assert np.hypot(*felt.ends.T) == pytest.approx(REACH * width / 2)
    assert felt.met.all()
    assert felt.nearest is not None
    assert felt.nearest.tolist() == [[0, 0], [6, 0]]
    strips = _values(tmp_path / "room.rrd", "/room/camera/feelers", "LineStrips2D:strips")
    assert len(strips[-1][1]) == FEELERS
    assert len(_values(tmp_path / "room.rrd", "/room/camera/nearest", "LineStrips2D:strips")[-1][1]) == 1
    picture = Image.open(tmp_path / "room.png")
    assert FEELER in {color for _, color in picture.getcolors(maxcolors=picture.width * picture.height)}


def test_feelers_of_nobody_are_refused_and_of_one_who_is_gone_end(room: urto.Room, tmp_path: Path) -> None:
    options = ViewOptions(save=tmp_path, feel="player")
    with pytest.raises(urto.UnknownBody):
        _View(room, options, _Outputs(options, print)).begin()
    room.spawn(urto.Circle(radius=1, name="player"))
    shown = _View(room, options, _Outputs(options, print))
    shown.begin()
    assert shown._felt is not None
    assert not shown._felt.met.any()
    assert shown._felt.nearest is None
    room.reset()
    room.spawn(urto.Box(width=3, height=3))
    shown.show(room.step(2))
    assert shown._felt is None
    shown.end_recording()


def test_round_shapes_and_chains_are_drawn(room: urto.Room, tmp_path: Path) -> None:
    room.spawn(
        [
            urto.Chain(vertices=[(5, 0), (-5, 0)], type="static"),
            urto.Chain(vertices=[(8, 0), (9, 0), (9, 1)], loop=True, type="static"),
            urto.Capsule(a=(-1, 0), b=(1, 0), radius=0.5, position=(0, 3)),
            urto.Box(width=2, height=1, radius=0.25, position=(4, 3)),
        ]
    )
    layers = ShapeSet(room.bodies()).layers
    outline = layers["bodies"].polygons
    capsule, rounded = (outline.vertex[start:end] for start, end in zip(outline.start, outline.start[1:], strict=False))
    assert np.allclose([capsule.min(axis=0), capsule.max(axis=0)], [[-1.5, -0.5], [1.5, 0.5]], atol=0.01)
    assert np.allclose([rounded.min(axis=0), rounded.max(axis=0)], [[-1.25, -0.75], [1.25, 0.75]], atol=0.01)
    assert layers["static"].lines.start == [0, 2, 6]  # a loop ends where it begins
    options = ViewOptions(save=tmp_path)
    shown = _View(room, options, _Outputs(options, print))
    shown.begin()
    shown.show(room.step(2))
    shown.end_recording()
    strips = _values(tmp_path / "room.rrd", "/room/static/lines", "LineStrips3D:strips")
    assert [len(strip) for strip in strips[0][1]] == [2, 4]


def test_the_picture_shows_bodies_where_they_are(room: urto.Room, fake: FakeRoom, tmp_path: Path) -> None:
    room.spawn(
        [
            urto.Box(width=16, height=2, position=(0, -1), type="static"),
            urto.Box(width=2, height=2, position=(-4, 1), color=0x00FF00),
            urto.Circle(radius=1, position=(4, 1), color=0x0000FF),
        ]
    )
    from urto._viewer.drawing import draw_picture

    shapes = ShapeSet(room.bodies())
    draw_picture(shapes, tmp_path / "room.png", bounds=(-8, -4, 8, 5))
    picture = Image.open(tmp_path / "room.png")
    width, height = picture.size
    assert (width, height) == (1600, 900)

    def color_at(x: float, y: float) -> tuple[int, int, int]:
        return picture.getpixel((round((x + 8) * 100), round((5 - y) * 100)))

    assert color_at(-4, 1.3) == (0, 255, 0)
    assert color_at(4, 1.5) == (0, 0, 255)
    assert color_at(4.9, 1.9) != (0, 0, 255)
    assert color_at(0.3, -0.7) == STATIC
    assert color_at(0.3, 3.3) == BACKGROUND


def test_a_paused_room_is_shown_too(room: urto.Room, fake: FakeRoom, tmp_path: Path) -> None:
    _furnish(room)

    def say(line: str) -> None:
        if line.startswith("recording"):
            fake.emit(room_paused={"user": "anna"})

    view(room, ViewOptions(save=tmp_path, seconds=0.6), say)
    assert any("RoomPaused" in text[0] for _, text in _values(tmp_path / "room.rrd", "/events", "TextLog:text"))
    assert _values(tmp_path / "room.rrd", "/room/bodies/boxes", "Boxes3D:centers")
    assert (tmp_path / "room.png").stat().st_size > 0


def test_without_a_display_the_error_says_what_to_do(room: urto.Room, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    with pytest.raises(outputs.ViewerError, match="--save DIR, --web, or --connect URL"):
        view(room, ViewOptions(), print)


def test_a_viewer_that_breaks_down_is_an_error(
    room: urto.Room, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    broken = tmp_path / "rerun"
    broken.write_text("#!/bin/sh\necho 'no graphics here' >&2\nexit 3\n")
    broken.chmod(0o755)
    monkeypatch.setattr(outputs, "rerun_program", lambda: str(broken))
    with pytest.raises(outputs.ViewerError, match="no graphics here"):
        view(room, ViewOptions(web=True), print)
    with pytest.raises(outputs.ViewerError, match="mesa-vulkan-drivers libvulkan1"):
        view(room, ViewOptions(save=tmp_path / "out", seconds=0.01, screenshot=True), print)
    assert (tmp_path / "out" / "room.png").exists()


def test_a_web_view_whose_server_is_killed_says_so(room: urto.Room, fake: FakeRoom) -> None:
    def kill(line: str) -> None:
        assert line.startswith("open in a browser")
        (process,) = started
        os.killpg(process._process.pid, signal.SIGKILL)

    started: list[outputs.ViewerProcess] = []
    original = outputs.ViewerProcess.__init__

    def remember(self: outputs.ViewerProcess, *arguments: str, **ports: int) -> None:
        original(self, *arguments, **ports)
        started.append(self)

    with pytest.MonkeyPatch.context() as patch, Running(fake):
        patch.setattr(outputs.ViewerProcess, "__init__", remember)
        with pytest.raises(outputs.ViewerError, match="ended with an error"):
            view(room, ViewOptions(web=True), kill)


def test_no_viewer_at_the_url_is_told_at_once(room: urto.Room) -> None:
    with pytest.raises(outputs.ViewerError, match="no Rerun viewer listens at"):
        view(room, ViewOptions(connect="rerun+http://127.0.0.1:1/proxy"), print)


@pytest.mark.parametrize(
    "vertices",
    [
        [(0, 0), (1, 0), (0, 1)],
        [(0, 1), (1, 0), (0, 0)],
        [(0, 0), (4, 0), (4, 4), (2, 1), (0, 4)],
        [(0, 0), (1, 0), (2, 0), (2, 1), (0, 1)],
        [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)],
    ],
)
def test_triangles_cover_the_polygon(vertices: list[tuple[float, float]]) -> None:
    triangles = triangulate(vertices)
    areas = [signed_area([vertices[a], vertices[b], vertices[c]]) for a, b, c in triangles]
    assert len(triangles) == len(vertices) - 2
    assert min(areas) >= 0
    assert sum(areas) == pytest.approx(abs(signed_area(vertices)))

"""urtod and the Python client: what is asked happens as computed by hand."""

from __future__ import annotations

import asyncio
import itertools
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
import urto
from conftest import EMPTY, GRAVITY_Y, TIME_STEP, TIMEOUT_S, WEIGHTLESS, Start


def _connect(endpoint: str, user: str = "tester") -> urto.Room:
    return urto.connect(endpoint, user=user, timeout=TIMEOUT_S)


def _wait_for(room: urto.Room, kind: type[urto.Event], **fields: object) -> urto.Event:  # type: ignore[valid-type]
    for event in room.events(timeout=TIMEOUT_S):
        if isinstance(event, kind) and all(getattr(event, name) == value for name, value in fields.items()):
            return event
    pytest.fail(f"no {kind.__name__} with {fields}")


def test_free_fall_and_an_impulse_are_as_computed(start: Start) -> None:
    urtod = start(EMPTY, "--paused")
    with _connect(urtod.endpoint) as room:
        body = room.spawn(urto.Box(width=1, height=2, position=(0, 5), mass=2))
        assert body.apply_impulse((6, 0)) == 0
        frame = room.step(64)
        assert (frame.tick, frame.sim_time, frame.full) == (64, 1.0, True)
        # Semi-implicit Euler: after n steps v = g dt n and y = y0 + g dt² n (n + 1) / 2.
        assert frame[body].velocity == pytest.approx((3, GRAVITY_Y), abs=1e-12)
        assert frame[body].position == pytest.approx((3, 5 + GRAVITY_Y * TIME_STEP**2 * 64 * 65 / 2), abs=1e-12)
        info = body.info()
        # A rectangle's inertia is m (w² + h²) / 12.
        assert (info.mass, info.inertia) == pytest.approx((2, 2 * (1 + 4) / 12))
        assert info.position == frame[body].position


def test_an_impulse_beside_the_centre_turns_the_body(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")
    with _connect(urtod.endpoint) as room:
        body = room.spawn(urto.Box(width=2, height=1, position=(3, 4), mass=2))
        body.apply_impulse((0, 1), point=(4, 4))
        frame = room.step()
        # Δω = r × p / I with r = (1, 0) and I = 2 (4 + 1) / 12; Δv = p / m.
        assert frame[body].angular_velocity == pytest.approx(1 / (10 / 12))
        assert frame[body].velocity == pytest.approx((0, 0.5))


def test_a_force_acts_for_its_time(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")
    with _connect(urtod.endpoint) as room:
        body = room.spawn(urto.Circle(radius=0.5, mass=2))
        body.apply_force((4, 0), duration=10 * TIME_STEP)
        assert room.step(10)[body].velocity == pytest.approx((10 * TIME_STEP * 4 / 2, 0))
        assert room.step(10)[body].velocity == pytest.approx((10 * TIME_STEP * 4 / 2, 0))


def test_a_running_room_moves_by_itself_and_stands_still_when_paused(start: Start) -> None:
    urtod = start(WEIGHTLESS)
    with _connect(urtod.endpoint) as room:
        body = room.spawn(urto.Circle(radius=0.5))
        pushed = body.set_velocity((2, 1))
        for frame in itertools.islice((frame for frame in room.frames() if frame.tick > pushed), 10):
            elapsed = (frame.tick - pushed) * TIME_STEP
            assert frame[body].position == pytest.approx((2 * elapsed, elapsed), abs=1e-12)
        tick = room.pause()
        assert room.info().paused
        assert room.frame().tick == room.frame().tick == tick
        assert room.resume() == tick
        _wait_for(room, urto.RoomResumed)
        assert next(room.frames()).tick >= tick


def test_a_slow_reader_gets_the_newest_frame_and_knows_what_it_missed(start: Start) -> None:
    urtod = start(WEIGHTLESS)
    with _connect(urtod.endpoint) as room:
        room.spawn(urto.Circle(radius=0.5))
        frames = room.frames()
        first = next(frames)
        while room.info().tick < first.tick + 100:  # busy with something else
            pass
        second = next(frames)
        assert second.tick >= first.tick + 50  # the newest or nearly so; without the ring it would be the next one
        assert frames.missed == second.tick - first.tick - 1


def test_a_batch_is_done_at_one_tick_or_not_at_all(start: Start) -> None:
    urtod = start(WEIGHTLESS)
    with _connect(urtod.endpoint) as room:
        with room.batch() as batch:
            ball = batch.spawn(urto.Circle(radius=1, position=(0, 0)))
            crate = batch.spawn(urto.Box(width=1, height=1, position=(9, 0), name="crate"))
            batch.set_velocity(ball, (1, 0))
            batch.apply_impulse(crate, (0, 1))
        frame = next(frame for frame in room.frames() if ball in frame and frame.tick > (batch.tick or 0))
        elapsed = (frame.tick - batch.tick) * TIME_STEP
        assert frame[ball].position == pytest.approx((elapsed, 0), abs=1e-12)
        assert frame[crate].position == pytest.approx((9, elapsed), abs=1e-12)
        with pytest.raises(urto.UnknownBody) as caught, room.batch() as batch:
            batch.spawn(urto.Circle(radius=1, position=(20, 0)))
            batch.despawn(crate)
            batch.apply_impulse("nobody", (1, 0))
        assert (caught.value.index, caught.value.value) == (2, "nobody")
        assert [info.id for info in room.bodies()] == [ball.id, crate.id]


@pytest.mark.parametrize(
    ("body", "error", "field"),
    [
        (urto.Box(width=-1, height=1), urto.InvalidValue, "spawn.body.shapes[0].box.width"),
        (urto.Circle(radius=float("nan")), urto.InvalidValue, "spawn.body.shapes[0].circle.radius"),
        (urto.Circle(radius=1, restitution=2), urto.InvalidValue, "spawn.body.shapes[0].restitution"),
        (urto.Polygon(vertices=[(0, 0), (1, 1), (2, 2)]), urto.DegenerateShape, "spawn.body.shapes[0].polygon"),
        (urto.Polygon(vertices=[(0, 0), (1, 1), (1, 0), (0, 1)]), urto.DegenerateShape, "spawn.body.shapes[0].polygon"),
        (urto.Circle(radius=1, name="taken"), urto.DuplicateName, "spawn.body.name"),
        (urto.Circle(radius=1, name="x" * 65), urto.InvalidValue, "spawn.body.name"),
        (urto.Circle(radius=1, type="static", mass=1), urto.WrongBodyType, "spawn.body.mass"),
        (urto.Body(shapes=[]), urto.UrtoError, "spawn.body.shapes"),
    ],
)
def test_what_cannot_be_spawned_is_rejected_with_its_field(
    start: Start, body: urto.Spawnable, error: type[urto.Rejected], field: str
) -> None:
    urtod = start(EMPTY, "--paused")
    with _connect(urtod.endpoint) as room:
        room.spawn(urto.Circle(radius=1, name="taken"))
        before = room.state_hash()
        with pytest.raises(error) as caught:
            room.spawn(body)
        assert isinstance(caught.value, urto.Rejected)
        assert caught.value.field.startswith(field)
        assert (len(room.bodies()), room.state_hash()) == (1, before)


def test_what_does_not_go_with_the_body_or_the_room_is_rejected(start: Start) -> None:
    urtod = start(EMPTY)
    with _connect(urtod.endpoint) as room:
        wall = room.spawn(urto.Box(width=1, height=1, type="static"))
        with pytest.raises(urto.WrongBodyType):
            wall.apply_impulse((1, 0))
        with pytest.raises(urto.NotPaused):
            room.step()
        with pytest.raises(urto.InvalidValue):
            room.set_time_scale(0)
        wall.despawn()
        with pytest.raises(urto.UnknownBody):
            wall.info()


def test_who_may_control_time_is_a_setting(start: Start) -> None:
    urtod = start(EMPTY, "--control", "owners", "--owner", "anna")
    with _connect(urtod.endpoint, "bert") as guest, _connect(urtod.endpoint, "anna") as owner:
        assert guest.info().control == "owners"
        with pytest.raises(urto.NotPermitted):
            guest.pause()
        owner.pause()
        assert owner.info().paused


def test_equal_steps_give_equal_hashes_and_reset_goes_back(start: Start) -> None:
    urtod = start("pyramid", "--paused")
    with _connect(urtod.endpoint) as room:
        at_start = room.state_hash()
        first = room.step(30)
        after = room.state_hash()
        assert after != at_start
        room.spawn(urto.Circle(radius=1, position=(50, 50)))
        epoch = room.info().epoch
        assert room.reset() == epoch + 1
        assert (room.state_hash(), room.info().tick) == (at_start, 0)
        again = room.step(30)
        assert room.state_hash() == after
        assert np.array_equal(first.position, again.position)
        assert (again.tick, again.epoch) == (30, epoch + 1)


def test_a_late_joiner_gets_everything_at_once(start: Start) -> None:
    urtod = start("pyramid", "--paused")
    with _connect(urtod.endpoint, "early") as early:
        body = early.spawn(urto.Body(name="dumbbell", tags=["toy"], color=0x123456, position=(-20, 3), shapes=[
            urto.Circle(radius=0.5, position=(-1, 0)), urto.Circle(radius=0.5, position=(1, 0)),
        ]))  # fmt: skip
        early.step(3)
        with _connect(urtod.endpoint, "late") as late:
            state = late.state()
            assert (state.info.scene, state.info.tick, state.frame.tick) == ("pyramid", 3, 3)
            assert np.array_equal(state.frame.ids, [info.id for info in state.bodies])
            mine = next(info for info in state.bodies if info.id == body.id)
            assert (mine.name, mine.body.tags, mine.body.color) == ("dumbbell", ("toy",), 0x123456)
            assert [shape.position for shape in mine.body.shapes] == [(-1, 0), (1, 0)]
            assert late.body("dumbbell") == body
            assert late.state_hash() == early.state_hash()
            assert _wait_for(early, urto.MemberJoined, user="late")
            assert {member.user for member in late.info().members} == {"early", "late"}
        assert _wait_for(early, urto.MemberLeft, user="late")


def test_contacts_and_their_events(start: Start) -> None:
    urtod = start(EMPTY.replace("sub_steps: 1", "sub_steps: 4"), "--paused")
    with _connect(urtod.endpoint) as room:
        floor = room.spawn(urto.Box(width=20, height=1, position=(0, -0.5), type="static"))
        box = room.spawn(urto.Box(width=1, height=1, position=(0, 1), mass=3))
        gate = room.spawn(urto.Box(width=1, height=0.2, position=(0, 0.6), type="static", sensor=True))
        room.step(128)
        contacts = room.contacts()
        touching = (contacts.body_a == floor.id) & (contacts.body_b == box.id)
        touching |= (contacts.body_a == box.id) & (contacts.body_b == floor.id)
        assert touching.sum() == 2
        assert contacts.point[touching][:, 0] == pytest.approx([-0.5, 0.5], abs=0.01) or contacts.point[touching][
            :, 0
        ] == pytest.approx([0.5, -0.5], abs=0.01)
        assert np.abs(contacts.normal[touching]) == pytest.approx(np.array([[0, 1], [0, 1]]), abs=1e-6)
        # At rest the floor gives back the weight: m g dt in each tick.
        assert contacts.normal_impulse[touching].sum() == pytest.approx(3 * 8 * TIME_STEP, rel=0.02)
        begin = _wait_for(room, urto.ContactBegin, sensor=False)
        assert isinstance(begin, urto.ContactBegin)
        assert {begin.body_a, begin.body_b} == {floor.id, box.id}
        # Dropped from 0.5 m: v = sqrt(2 g h), less at most one step of gravity.
        assert begin.approach_speed == pytest.approx((2 * 8 * 0.5) ** 0.5, abs=8 * TIME_STEP)
        since = [event for event in room.events(since=1, timeout=0.5) if isinstance(event, urto.ContactBegin)]
        assert {gate.id, box.id} in [{event.body_a, event.body_b} for event in since if event.sensor]
        box.set_transform((0, 9))
        room.step()
        assert _wait_for(room, urto.ContactEnd, sensor=False)


def test_events_are_numbered_without_gaps_and_can_be_asked_again(start: Start) -> None:
    urtod = start(EMPTY, "--paused")
    with _connect(urtod.endpoint) as room:
        bodies = room.spawn([urto.Circle(radius=0.1, position=(index, 0)) for index in range(20)])
        bodies[3].despawn()
        last = _wait_for(room, urto.BodyRemoved, id=bodies[3].id, user="tester")
        again = list(itertools.islice(room.events(since=1, timeout=TIMEOUT_S), last.sequence))
        assert [event.sequence for event in again] == list(range(1, last.sequence + 1))
        assert sum(isinstance(event, urto.BodyAdded) for event in again) == 20
        with room.batch(answer=False) as batch:
            batch.spawn(urto.Circle(radius=-1))
        assert _wait_for(room, urto.BatchRejected, user="tester")


def test_queries(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")
    with _connect(urtod.endpoint) as room:
        near = room.spawn(urto.Box(width=2, height=2, position=(5, 0)))
        far = room.spawn(urto.Circle(radius=1, position=(10, 0)))
        room.step()
        assert [hit.body for hit in room.query_point((5.9, 0.9))] == [near]
        assert room.query_point((7, 0)) == []
        assert [hit.body for hit in room.query_region((5, -1), (9.5, 1))] == [near, far]
        first, second = room.query_ray((0, 0), (20, 0))
        assert (first.body, second.body) == (near, far)
        assert first.point == pytest.approx((4, 0))
        assert first.normal == pytest.approx((-1, 0))
        assert first.fraction == pytest.approx(0.2)
        assert second.point == pytest.approx((9, 0))
        (hit,) = room.query_nearest((12, 0), distance_max=5)
        assert (hit.body, hit.distance) == (far, pytest.approx(1))
        assert hit.point == pytest.approx((11, 0))
        assert len(room.query_nearest((7, 0), distance_max=100, count_max=5)) == 2


def test_energy_is_kept_in_flight(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")
    with _connect(urtod.endpoint) as room:
        room.spawn(urto.Circle(radius=0.5, mass=2, velocity=(3, 4), angular_velocity=2))
        # ½ m v² + ½ I ω² with I = m r² / 2.
        expected = 0.5 * 2 * 25 + 0.5 * (2 * 0.25 / 2) * 4
        assert room.energy() == pytest.approx(expected)
        room.step(100)
        diagnostics = room.diagnostics()
        assert diagnostics.energy == pytest.approx(expected, rel=1e-12)
        assert diagnostics.momentum == pytest.approx((6, 8))


def test_a_faster_room_makes_more_ticks(start: Start) -> None:
    urtod = start(WEIGHTLESS)
    with _connect(urtod.endpoint) as room:
        room.set_time_scale(4)
        assert _wait_for(room, urto.TimeScaleChanged, scale=4.0, user="tester")
        assert room.info().time_scale == 4


def test_a_client_that_is_killed_is_told_to_the_others(start: Start) -> None:
    urtod = start(WEIGHTLESS)
    script = (
        f"import urto, sys\nwith urto.connect({urtod.endpoint!r}, user='victim') as room:\n"
        "    print('in', flush=True); sys.stdin.read()"
    )
    with _connect(urtod.endpoint, "witness") as room:
        victim = subprocess.Popen(
            [sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert victim.stdout is not None
        assert victim.stdout.readline() == "in\n"
        joined = _wait_for(room, urto.MemberJoined, user="victim")
        os.kill(victim.pid, signal.SIGKILL)
        left = _wait_for(room, urto.MemberLeft, user="victim")
        assert left.session == joined.session  # type: ignore[union-attr]
        assert all(member.user != "victim" for member in room.info().members)
        victim.communicate()


@pytest.mark.parametrize("by", [signal.SIGINT, signal.SIGTERM])
def test_the_server_ends_in_order_and_its_clients_notice(start: Start, by: signal.Signals) -> None:
    urtod = start(WEIGHTLESS)
    with _connect(urtod.endpoint) as room:
        frames = room.frames()
        next(frames)
        assert urtod.stop(by) == 0
        with pytest.raises(urto.ConnectionLost):
            for _ in frames:
                pass
        with pytest.raises(urto.ConnectionLost):
            room.info()


def test_a_server_that_is_killed_is_lost_too(start: Start) -> None:
    urtod = start(WEIGHTLESS)
    with _connect(urtod.endpoint) as room:
        frames = room.frames()
        next(frames)
        urtod.stop(signal.SIGKILL)
        with pytest.raises(urto.ConnectionLost):
            for _ in frames:
                pass


def test_a_server_that_comes_back_serves_its_old_clients(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--room", "lab")
    with _connect(urtod.endpoint) as room:
        _wait_for(room, urto.MemberJoined, user="tester")
        frames = room.frames(timeout=TIMEOUT_S)
        next(frames)
        urtod.stop()
        with pytest.raises(urto.ConnectionLost):
            for _ in frames:
                pass
        again = start(WEIGHTLESS, "--room", "lab", listen=urtod.endpoint)
        # Zenoh finds its way back by itself; until then the room says that it is gone.
        while True:
            version = room._core.signal.version
            try:
                room._core.check_present()
                break
            except urto.ConnectionLost:
                room._core.signal.wait(version).result(TIMEOUT_S)
        events = room.events(timeout=TIMEOUT_S)
        with pytest.raises(urto.EventGap, match="restarted"):
            next(events)
        assert next(events).sequence >= 1
        ball = room.spawn(urto.Circle(radius=1))
        assert any(ball in frame for frame in frames)
        assert again.stop() == 0


def test_the_asyncio_face(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")

    async def main() -> None:
        async with await urto.aio.connect(urtod.endpoint, user="tester", timeout=TIMEOUT_S) as room:
            bodies = await room.spawn([urto.Circle(radius=0.1, position=(index, 0)) for index in range(10)])
            await asyncio.gather(*(body.apply_force((1, 0)) for body in bodies))
            frame = await room.step(8)
            assert len(frame) == 10
            assert [frame[body].velocity[0] > 0 for body in bodies] == [True] * 10
            async for event in room.events(timeout=TIMEOUT_S):
                if isinstance(event, urto.BodyAdded) and event.id == bodies[-1].id:
                    break
            await room.resume()
            assert (await anext(room.frames(timeout=TIMEOUT_S))).tick >= 8

    asyncio.run(main())


def test_passwords(start: Start, tmp_path) -> None:  # type: ignore[no-untyped-def]
    users = tmp_path / "users.txt"
    users.write_text("anna:secret\n", encoding="utf-8")
    urtod = start(WEIGHTLESS, "--users", str(users))
    with urto.connect(urtod.endpoint, user="anna", password="secret", timeout=TIMEOUT_S) as room:
        assert room.info().authenticated
        room.spawn(urto.Circle(radius=1))
    for user, password in (("anna", "wrong"), ("bert", "secret"), ("anna", None)):
        with pytest.raises(urto.ConnectionFailed):
            urto.connect(urtod.endpoint, user=user, password=password, timeout=2)

"""The asyncio face: the same core, awaited."""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import Awaitable, Callable

import pytest

import urto
from support.fake_room import GRAVITY_Y, TIME_STEP, FakeRoom, Publishing


def _with_room(fake: FakeRoom, use: Callable[[urto.aio.Room], Awaitable[None]]) -> None:
    async def main() -> None:
        async with await urto.aio.connect(fake.endpoint, user="tester", timeout=10) as room:
            await use(room)
        with pytest.raises(urto.ClosedError):
            await room.info()

    asyncio.run(main())


def test_it_has_all_that_the_sync_face_has() -> None:
    for sync, awaited in ((urto.Room, urto.aio.Room), (urto.BodyHandle, urto.aio.BodyHandle)):
        for name, member in inspect.getmembers(sync):
            if name.startswith("_"):
                continue
            assert hasattr(awaited, name), name
            if inspect.isfunction(member) and name != "batch":
                there = inspect.signature(getattr(awaited, name)).parameters
                assert list(there) == list(inspect.signature(member).parameters), name


def test_a_body_flies_as_computed(fake: FakeRoom) -> None:
    async def use(room: urto.aio.Room) -> None:
        body = await room.spawn(urto.Box(width=1, height=2, position=(0, 5), mass=2))
        await body.apply_impulse((6, 0))
        frame = await room.step(3)
        assert frame[body].position == (9 * TIME_STEP, 5 + 6 * GRAVITY_Y * TIME_STEP**2)
        assert (await body.info()).velocity == frame[body].velocity
        assert await room.energy() == 7
        assert [hit.body for hit in await room.query_point((0, 0))] == [body]
        for hits in (
            await room.query_cast((0, 0), (1, 1)),
            await room.query_overlap(urto.Circle(radius=1)),
            await room.query_closest((0, 0), distance_max=1),
        ):
            assert ([hit.body for hit in hits], hits.truncated) == ([body], False)

    _with_room(fake, use)


def test_frames_and_events_are_iterated(fake: FakeRoom) -> None:
    async def use(room: urto.aio.Room) -> None:
        async with room.batch() as batch:
            ball = batch.spawn(urto.Circle(radius=1))
            batch.apply_impulse(ball, (1, 0))
        frames = room.frames()
        fake.advance()
        with Publishing(fake):
            assert (await anext(frames))[ball].velocity[0] == 1
        assert isinstance(await anext(room.events(timeout=10)), urto.MemberJoined)
        assert [event async for event in room.events(timeout=0)] == []

    _with_room(fake, use)


def test_rejections_and_timeouts_are_the_same_errors(fake: FakeRoom) -> None:
    async def use(room: urto.aio.Room) -> None:
        with pytest.raises(urto.InvalidValue):
            await room.spawn(urto.Box(width=0, height=1))
        with pytest.raises(urto.RequestTimeout):
            await anext(room.frames(timeout=0.01))

    _with_room(fake, use)


def test_a_wait_can_be_cancelled_and_the_room_used_on(fake: FakeRoom) -> None:
    async def use(room: urto.aio.Room) -> None:
        waiting = asyncio.ensure_future(anext(room.frames(timeout=float("inf"))))
        done, _ = await asyncio.wait([waiting], timeout=0.01)
        assert not done
        waiting.cancel()
        with pytest.raises(asyncio.CancelledError):
            await waiting
        assert (await room.info()).room == "demo"

    _with_room(fake, use)


def test_many_requests_run_side_by_side(fake: FakeRoom) -> None:
    async def use(room: urto.aio.Room) -> None:
        bodies = await asyncio.gather(*(room.spawn(urto.Circle(radius=1)) for _ in range(50)))
        assert sorted(body.id for body in bodies) == list(range(1, 51))

    _with_room(fake, use)

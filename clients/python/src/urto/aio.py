"""The asyncio face: the same rooms, bodies and errors as `urto`, awaited.

    import asyncio
    import urto

    async def main() -> None:
        async with await urto.aio.connect() as room:
            ball = await room.spawn(urto.Circle(radius=0.5, position=(0, 5)))
            await ball.apply_impulse((3, 0))
            async for frame in room.frames():
                print(frame.tick, frame[ball].position)

    asyncio.run(main())

What a method does, takes and raises is told at its namesake in `urto.Room` and `urto.BodyHandle`.
"""

from __future__ import annotations

import math
from collections.abc import AsyncIterator, Iterable
from contextlib import asynccontextmanager
from types import TracebackType
from typing import TypeAlias, overload

from urto import _commands, _core
from urto._batch import Batch
from urto._bodies import BodyInfo, QueryShape, Spawnable, VectorLike
from urto._commands import BodyRef, FrameName, QueryOptions
from urto._core import Core, EventCursor, FrameCursor, RoomState
from urto._events import Event
from urto._frame import Contacts, Frame
from urto._handle import Handle
from urto._info import Diagnostics, RoomInfo
from urto._joints import Joint, JointInfo, JointRef, Motor
from urto._keys import DEFAULT_ENDPOINT
from urto._op import run_async
from urto._transport import Transport, ZenohTransport

__all__ = ["BodyHandle", "BodyHit", "Events", "Frames", "Hits", "Room", "connect", "rooms"]


async def connect(
    endpoint: str = DEFAULT_ENDPOINT,
    room: str | None = None,
    user: str | None = None,
    password: str | None = None,
    timeout: float = 5.0,
) -> Room:
    """Joins a room; see `urto.connect`. Use it as `async with await connect(...) as room:`."""
    return Room(await run_async(_core.connect(endpoint, room, user, password, timeout)))


async def rooms(
    endpoint: str = DEFAULT_ENDPOINT, user: str | None = None, password: str | None = None, timeout: float = 5.0
) -> tuple[str, ...]:
    """Names of the rooms that the server at `endpoint` has; see `urto.rooms`."""
    transport: Transport = await run_async(
        _core.open_transport(ZenohTransport.open, endpoint, user, password, timeout)
    )
    try:
        return await run_async(_core.list_rooms(transport, timeout))
    finally:
        transport.close()


class BodyHandle(Handle):
    """A body of a room; see `urto.BodyHandle`."""

    __slots__ = ("_core",)

    def __init__(self, core: Core, body_id: int, name: str = "") -> None:
        super().__init__(body_id, name)
        self._core = core

    async def apply_impulse(
        self,
        impulse: VectorLike,
        *,
        point: VectorLike | None = None,
        frame: FrameName = "world",
        angular: float = 0.0,
    ) -> int:
        """Changes the momentum at once (N·s at a point in m; N·m·s)."""
        return await run_async(self._core.command(_commands.impulse(self, impulse, point, frame, angular)))

    async def apply_force(
        self, force: VectorLike, *, torque: float = 0.0, frame: FrameName = "world", duration: float | None = None
    ) -> int:
        """Pushes from now on, for `duration` s or until changed (N; N·m)."""
        return await run_async(self._core.command(_commands.force(self, force, torque, frame, duration)))

    async def set_velocity(self, velocity: VectorLike | None = None, *, angular_velocity: float | None = None) -> int:
        """Sets m/s and rad/s; None leaves it."""
        return await run_async(self._core.command(_commands.set_velocity(self, velocity, angular_velocity)))

    async def set_transform(self, position: VectorLike | None = None, *, angle: float | None = None) -> int:
        """Teleports to m and rad; None leaves it."""
        return await run_async(self._core.command(_commands.set_transform(self, position, angle)))

    async def despawn(self) -> int:
        """Removes the body."""
        return await run_async(self._core.command(_commands.despawn(self)))

    async def info(self) -> BodyInfo:
        """What the room knows of the body now."""
        return await run_async(self._core.body_info(self))


BodyHit: TypeAlias = _core.BodyHit[BodyHandle]
"""A body that a query found; see its attributes."""

Hits: TypeAlias = _core.Hits[BodyHandle]
"""A list of `BodyHit`s that knows whether it is all of them."""


class Room:
    """A membership in a room; see `urto.Room`."""

    def __init__(self, core: Core) -> None:
        self._core = core

    async def __aenter__(self) -> Room:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    def __repr__(self) -> str:
        return f"<Room {self.name!r} at {self.endpoint} as {self.user!r}>"

    async def close(self) -> None:
        """Leaves the room. May be called twice."""
        await run_async(_core.close(self._core))

    @property
    def name(self) -> str:
        """The room's name."""
        return self._core.room

    @property
    def endpoint(self) -> str:
        """Zenoh locator of its server."""
        return self._core.endpoint

    @property
    def user(self) -> str:
        """The name of this member."""
        return self._core.user

    @property
    def session(self) -> str:
        """Tells this membership from others of the same user."""
        return self._core.session

    def _handle(self, body_id: int, name: str = "") -> BodyHandle:
        return BodyHandle(self._core, body_id, name)

    # Bodies

    @overload
    async def spawn(self, body: Spawnable) -> BodyHandle: ...
    @overload
    async def spawn(self, body: Iterable[Spawnable]) -> list[BodyHandle]: ...
    async def spawn(self, body: Spawnable | Iterable[Spawnable]) -> BodyHandle | list[BodyHandle]:
        """Adds a body, or several at one tick (all or none)."""
        async with self.batch() as batch:
            handles = batch.spawn(body)
        return handles

    @asynccontextmanager
    async def batch(self, *, answer: bool = True, timeout: float | None = None) -> AsyncIterator[Batch[BodyHandle]]:
        """Collects commands and sends them at the end of the `async with` block: all at one tick, or none."""
        batch = Batch(self._handle)
        yield batch
        await run_async(self._core.send_batch(batch, answer, timeout))

    async def body(self, ref: BodyRef) -> BodyHandle:
        """The handle of a body by its name or id."""
        info = await run_async(self._core.body_info(ref))
        return self._handle(info.id, info.name)

    async def bodies(self) -> tuple[BodyInfo, ...]:
        """Every body with its shapes and where it is, ascending id."""
        return (await self.state()).bodies

    # Joints

    async def create_joint(self, joint: Joint) -> int:
        """Joins two bodies; the joint's id.

        Raises:
            InvalidValue, UnknownBody, WrongBodyType, DuplicateName, QuotaExceeded, NotSupported: nothing was joined.
        """
        return await run_async(self._core.create_joint(joint))

    async def destroy_joint(self, joint: JointRef) -> int:
        """Takes a joint away, by its id or name. Returns the tick."""
        return await run_async(self._core.command(_commands.destroy_joint(joint)))

    async def set_motor(self, joint: JointRef, motor: Motor) -> int:
        """Replaces the motor of a revolute joint (rad/s, N·m) or a prismatic one (m/s, N). Returns the tick."""
        return await run_async(self._core.command(_commands.set_motor(joint, motor)))

    async def set_target(self, joint: JointRef, target: VectorLike) -> int:
        """Moves the point (m, world frame) that a mouse joint draws its body to. Returns the tick."""
        return await run_async(self._core.command(_commands.set_target(joint, target)))

    async def joints(self) -> tuple[JointInfo, ...]:
        """Every joint with its position and what it carries, ascending id."""
        return await run_async(self._core.joints())

    # Time

    async def pause(self) -> int:
        """Time stands still; commands still take effect."""
        return await run_async(self._core.command(_commands.pause()))

    async def resume(self) -> int:
        """Time goes on."""
        return await run_async(self._core.command(_commands.resume()))

    async def step(self, ticks: int = 1, *, timeout: float | None = None) -> Frame:
        """Advances a paused room by `ticks` (1 to 36000) and gives the full frame after the last."""
        return await run_async(self._core.step(ticks, timeout))

    async def reset(self) -> int:
        """Back to tick 0 of the scene; gives the new epoch."""
        return await run_async(self._core.reset(None))

    async def set_time_scale(self, scale: float) -> int:
        """Simulated seconds per second, 0.01 to 100."""
        return await run_async(self._core.command(_commands.set_time_scale(scale)))

    # Frames and events

    async def frame(self) -> Frame:
        """The full frame of this moment, asked of the room."""
        return (await self.state()).frame

    def frames(self, *, timeout: float | None = None) -> Frames:
        """Iterates over live frames, always the newest."""
        cursor = FrameCursor(self._core.snapshots.latest[0], _core.snapshot_interval_ticks(self._core.first_info))
        self._core.subscribe_to_snapshots()
        return Frames(self._core, cursor, timeout)

    @property
    def frames_missed(self) -> int:
        """Frames that the iterators of `frames` have skipped so far."""
        return self._core.frames_missed

    def events(self, *, since: int | None = None, timeout: float = math.inf) -> Events:
        """Iterates over events in order, without gaps."""
        core = self._core
        cursor = core.event_cursor if since is None else EventCursor(since, core.generation)
        return Events(core, cursor, timeout)

    # Questions

    async def info(self) -> RoomInfo:
        """What the room says about itself."""
        return await run_async(self._core.info(None))

    async def state(self, *, saved_state: bool = False) -> RoomState:
        """Info, bodies and full frame of one tick; with `saved_state` also the world's saved state."""
        return await run_async(self._core.state(saved_state, None))

    async def diagnostics(self) -> Diagnostics:
        """Energy, momentum, state hash and cost at this tick."""
        return await run_async(self._core.diagnostics())

    async def energy(self) -> float:
        """J, kinetic and potential."""
        return (await self.diagnostics()).energy

    async def state_hash(self) -> int:
        """Hash of the world's whole state, 64 bits."""
        return (await self.diagnostics()).state_hash

    async def contacts(self) -> Contacts:
        """All contact points of this moment."""
        return await run_async(self._core.contacts())

    async def query_point(self, point: VectorLike) -> list[BodyHit]:
        """Bodies that contain a point (m)."""
        return await run_async(self._core.hits(_commands.query_point(point), self._handle))

    async def query_region(self, lower: VectorLike, upper: VectorLike) -> list[BodyHit]:
        """Bodies whose bounding box overlaps the rectangle (m)."""
        return await run_async(self._core.hits(_commands.query_region(lower, upper), self._handle))

    async def query_ray(self, origin: VectorLike, translation: VectorLike) -> list[BodyHit]:
        """Bodies along a segment (m), nearest first."""
        return await run_async(self._core.hits(_commands.query_ray(origin, translation), self._handle))

    async def query_nearest(
        self, point: VectorLike, *, distance_max: float, count_max: int = 1
    ) -> list[BodyHit]:
        """Up to `count_max` bodies within `distance_max` m of a point, nearest first."""
        return await run_async(self._core.hits(_commands.query_nearest(point, distance_max, count_max), self._handle))

    async def query_cast(
        self,
        shape: QueryShape,
        translation: VectorLike,
        *,
        category: int | None = None,
        mask: int | None = None,
        count_max: int | None = None,
    ) -> Hits:
        """Moves a shape along `translation` (m); bodies that it meets, earliest first. See `urto.Room.query_cast`."""
        options = QueryOptions(category, mask, count_max)
        return await run_async(self._core.hits(_commands.query_cast(shape, translation, options), self._handle))

    async def query_overlap(
        self,
        shape: QueryShape,
        *,
        category: int | None = None,
        mask: int | None = None,
        count_max: int | None = None,
    ) -> Hits:
        """Bodies that a shape touches or overlaps, ascending id. See `urto.Room.query_overlap`."""
        options = QueryOptions(category, mask, count_max)
        return await run_async(self._core.hits(_commands.query_overlap(shape, options), self._handle))

    async def query_closest(
        self,
        shape: QueryShape,
        *,
        distance_max: float,
        category: int | None = None,
        mask: int | None = None,
        count_max: int | None = None,
    ) -> Hits:
        """Bodies within `distance_max` m of a shape, nearest first. See `urto.Room.query_closest`."""
        options = QueryOptions(category, mask, count_max)
        return await run_async(self._core.hits(_commands.query_closest(shape, distance_max, options), self._handle))


class Frames:
    """Asynchronous iterator of live frames; see `urto.Room.frames`."""

    def __init__(self, core: Core, cursor: FrameCursor, timeout: float | None) -> None:
        self._core = core
        self._cursor = cursor
        self._timeout = timeout

    def __aiter__(self) -> Frames:
        return self

    async def __anext__(self) -> Frame:
        return await run_async(self._core.next_frame(self._cursor, self._timeout))

    @property
    def missed(self) -> int:
        """Frames that this iterator has skipped."""
        return self._cursor.missed


class Events:
    """Asynchronous iterator of events; see `urto.Room.events`."""

    def __init__(self, core: Core, cursor: EventCursor, timeout: float) -> None:
        self._core = core
        self._cursor = cursor
        self._timeout = timeout

    def __aiter__(self) -> Events:
        return self

    async def __anext__(self) -> Event:
        event = await run_async(self._core.next_event(self._cursor, self._timeout))
        if event is None:
            raise StopAsyncIteration
        return event

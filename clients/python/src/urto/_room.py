"""The sync face: a room and its bodies."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
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
from urto._op import run
from urto._transport import Transport, ZenohTransport


def connect(
    endpoint: str = DEFAULT_ENDPOINT,
    room: str | None = None,
    user: str | None = None,
    password: str | None = None,
    timeout: float = 5.0,
) -> Room:
    """Joins a room. Use it in a `with` statement, which leaves the room at its end.

    Args:
        endpoint: Zenoh locator of the server, e.g. "tcp/127.0.0.1:7447".
        room: its name; None: the only one that the server has.
        user: 1 to 64 of letters, digits, _ and -; None: the system's user, or "anonymous".
        password: if the server checks users.
        timeout: s, of joining and of every later request that does not name its own.

    Raises:
        ConnectionFailed: no server there, or it refused the credentials.
        RoomNotFound: no such room, or several and none was named.
        ProtocolError: the server speaks another protocol version.
    """
    return Room(run(_core.connect(endpoint, room, user, password, timeout)))


def rooms(
    endpoint: str = DEFAULT_ENDPOINT, user: str | None = None, password: str | None = None, timeout: float = 5.0
) -> tuple[str, ...]:
    """Names of the rooms that the server at `endpoint` has. ConnectionFailed if there is no server."""
    transport: Transport = run(_core.open_transport(ZenohTransport.open, endpoint, user, password, timeout))
    try:
        return run(_core.list_rooms(transport, timeout))
    finally:
        transport.close()


class BodyHandle(Handle):
    """A body of a room. Every method asks the room; a body that is gone is `UnknownBody`."""

    __slots__ = ("_core",)

    def __init__(self, core: Core, body_id: int, name: str = "") -> None:
        super().__init__(body_id, name)
        self._core = core

    def apply_impulse(
        self,
        impulse: VectorLike,
        *,
        point: VectorLike | None = None,
        frame: FrameName = "world",
        angular: float = 0.0,
    ) -> int:
        """Changes the momentum at once. Dynamic bodies only.

        Args:
            impulse: N·s, in `frame`.
            point: m, in `frame`, where it acts; None: the centre of mass.
            frame: "world" or "body".
            angular: N·m·s, added about the centre of mass.

        Returns:
            The tick at which it took effect.
        """
        return run(self._core.command(_commands.impulse(self, impulse, point, frame, angular)))

    def apply_force(
        self, force: VectorLike, *, torque: float = 0.0, frame: FrameName = "world", duration: float | None = None
    ) -> int:
        """Pushes from now on; replaces the body's earlier force, and zero ends it. Dynamic bodies only.

        Args:
            force: N, in `frame`, at the centre of mass.
            torque: N·m.
            frame: "world", or "body": turns with the body.
            duration: s of simulated time > 0; None: until changed.

        Returns:
            The tick at which it took effect.
        """
        return run(self._core.command(_commands.force(self, force, torque, frame, duration)))

    def set_velocity(self, velocity: VectorLike | None = None, *, angular_velocity: float | None = None) -> int:
        """Sets m/s (world frame, of the centre of mass) and rad/s; None leaves it. Not for static bodies."""
        return run(self._core.command(_commands.set_velocity(self, velocity, angular_velocity)))

    def set_transform(self, position: VectorLike | None = None, *, angle: float | None = None) -> int:
        """Teleports to m (world frame) and rad; None leaves it."""
        return run(self._core.command(_commands.set_transform(self, position, angle)))

    def despawn(self) -> int:
        """Removes the body."""
        return run(self._core.command(_commands.despawn(self)))

    def info(self) -> BodyInfo:
        """What the room knows of the body now."""
        return run(self._core.body_info(self))


BodyHit: TypeAlias = _core.BodyHit[BodyHandle]
"""A body that a query found; see its attributes."""

Hits: TypeAlias = _core.Hits[BodyHandle]
"""A list of `BodyHit`s that knows whether it is all of them: `truncated`."""


class Room:
    """A membership in a room, made by `connect`. Its methods may be called from any thread."""

    def __init__(self, core: Core) -> None:
        self._core = core

    def __enter__(self) -> Room:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Room {self.name!r} at {self.endpoint} as {self.user!r}>"

    def close(self) -> None:
        """Leaves the room. May be called twice."""
        self._core.close()

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
    def spawn(self, body: Spawnable) -> BodyHandle: ...
    @overload
    def spawn(self, body: Iterable[Spawnable]) -> list[BodyHandle]: ...
    def spawn(self, body: Spawnable | Iterable[Spawnable]) -> BodyHandle | list[BodyHandle]:
        """Adds a body, or several at one tick (all or none).

        Raises:
            InvalidValue, DuplicateName, DegenerateShape, QuotaExceeded: nothing was added.
        """
        with self.batch() as batch:
            return batch.spawn(body)

    @contextmanager
    def batch(self, *, answer: bool = True, timeout: float | None = None) -> Iterator[Batch[BodyHandle]]:
        """Collects commands and sends them at the end of the `with` block: all take effect at one tick, or none.

        Args:
            answer: wait for the room's answer and raise if it refuses. False: send and go on; new bodies then get no
                ids here, and a refusal appears as a `BatchRejected` event.
            timeout: s to wait for the answer; None: the room's.
        """
        batch = Batch(self._handle)
        yield batch
        run(self._core.send_batch(batch, answer, timeout))

    def body(self, ref: BodyRef) -> BodyHandle:
        """The handle of a body by its name or id. UnknownBody if there is none."""
        info = run(self._core.body_info(ref))
        return self._handle(info.id, info.name)

    def bodies(self) -> tuple[BodyInfo, ...]:
        """Every body with its shapes and where it is, ascending id."""
        return self.state().bodies

    # Joints

    def create_joint(self, joint: Joint) -> int:
        """Joins two bodies; the joint's id.

        Raises:
            InvalidValue, UnknownBody, WrongBodyType, DuplicateName, QuotaExceeded, NotSupported: nothing was joined.
        """
        return run(self._core.create_joint(joint))

    def destroy_joint(self, joint: JointRef) -> int:
        """Takes a joint away, by its id or name. Returns the tick."""
        return run(self._core.command(_commands.destroy_joint(joint)))

    def set_motor(self, joint: JointRef, motor: Motor) -> int:
        """Replaces the motor of a revolute joint (rad/s, N·m) or a prismatic one (m/s, N). Returns the tick."""
        return run(self._core.command(_commands.set_motor(joint, motor)))

    def set_target(self, joint: JointRef, target: VectorLike) -> int:
        """Moves the point (m, world frame) that a mouse joint draws its body to. Returns the tick."""
        return run(self._core.command(_commands.set_target(joint, target)))

    def joints(self) -> tuple[JointInfo, ...]:
        """Every joint with its position and what it carries, ascending id."""
        return run(self._core.joints())

    # Time

    def pause(self) -> int:
        """Time stands still; commands still take effect. Returns the tick."""
        return run(self._core.command(_commands.pause()))

    def resume(self) -> int:
        """Time goes on. Returns the tick."""
        return run(self._core.command(_commands.resume()))

    def step(self, ticks: int = 1, *, timeout: float | None = None) -> Frame:
        """Advances a paused room by `ticks` (1 to 36000).

        Args:
            ticks: how many.
            timeout: s; None: the room's and the time that is simulated.

        Returns:
            The full frame after the last of them.

        Raises:
            NotPaused: the room runs by itself.
        """
        return run(self._core.step(ticks, timeout))

    def reset(self) -> int:
        """Back to tick 0 of the scene; spawned bodies are gone and ids start anew. Returns the new epoch."""
        return run(self._core.reset(None))

    def set_time_scale(self, scale: float) -> int:
        """Simulated seconds per second, 0.01 to 100. Returns the tick."""
        return run(self._core.command(_commands.set_time_scale(scale)))

    # Frames and events

    def frame(self) -> Frame:
        """The full frame of this moment, static bodies included, asked of the room."""
        return self.state().frame

    def frames(self, *, timeout: float | None = None) -> Frames:
        """Iterates over live frames as they come, always the newest; frames that come while you are busy are missed.

        Args:
            timeout: s to wait for a frame before RequestTimeout is raised; None: the room's; math.inf: for ever.

        Raises:
            ConnectionLost: from the iterator, when the server is gone.
        """
        cursor = FrameCursor(self._core.snapshots.latest[0], _core.snapshot_interval_ticks(self._core.first_info))
        self._core.subscribe_to_snapshots()
        return Frames(self._core, cursor, timeout)

    @property
    def frames_missed(self) -> int:
        """Frames that the iterators of `frames` have skipped so far, by their ticks and the room's snapshot rate."""
        return self._core.frames_missed

    def events(self, *, since: int | None = None, timeout: float = math.inf) -> Events:
        """Iterates over events in order, without gaps; what was lost on the way is asked of the room again.

        Args:
            since: sequence number of the first event wanted. None: go on after the last event that was read from this
                room, beginning with the first since joining.
            timeout: the iteration ends after that many s without an event; 0: when none is waiting.

        Raises:
            EventGap: from the iterator, if the room has forgotten events; it goes on after them.
            ConnectionLost: from the iterator, when the server is gone.
        """
        core = self._core
        cursor = core.event_cursor if since is None else EventCursor(since, core.generation)
        return Events(core, cursor, timeout)

    # Questions

    def info(self) -> RoomInfo:
        """What the room says about itself."""
        return run(self._core.info(None))

    def state(self, *, saved_state: bool = False) -> RoomState:
        """Info, bodies and full frame of one tick; with `saved_state` also the world's saved state."""
        return run(self._core.state(saved_state, None))

    def diagnostics(self) -> Diagnostics:
        """Energy, momentum, state hash and cost at this tick."""
        return run(self._core.diagnostics())

    def energy(self) -> float:
        """J, kinetic and potential (of the uniform gravity relative to y = 0, and of fields that have a potential)."""
        return self.diagnostics().energy

    def state_hash(self) -> int:
        """Hash of the world's whole state, 64 bits. Equal histories have equal hashes."""
        return self.diagnostics().state_hash

    def contacts(self) -> Contacts:
        """All contact points of this moment."""
        return run(self._core.contacts())

    def query_point(self, point: VectorLike) -> list[BodyHit]:
        """Bodies that contain a point (m, world frame)."""
        return run(self._core.hits(_commands.query_point(point), self._handle))

    def query_region(self, lower: VectorLike, upper: VectorLike) -> list[BodyHit]:
        """Bodies whose bounding box overlaps the rectangle (m, world frame)."""
        return run(self._core.hits(_commands.query_region(lower, upper), self._handle))

    def query_ray(self, origin: VectorLike, translation: VectorLike) -> list[BodyHit]:
        """Bodies along a segment from `origin` to `origin + translation` (m, world frame), nearest first."""
        return run(self._core.hits(_commands.query_ray(origin, translation), self._handle))

    def query_nearest(self, point: VectorLike, *, distance_max: float, count_max: int = 1) -> list[BodyHit]:
        """Up to `count_max` (at most 1024) bodies within `distance_max` m of a point (world frame), nearest first."""
        return run(self._core.hits(_commands.query_nearest(point, distance_max, count_max), self._handle))

    def query_cast(
        self,
        shape: QueryShape,
        translation: VectorLike,
        *,
        category: int | None = None,
        mask: int | None = None,
        count_max: int | None = None,
    ) -> Hits:
        """Moves a shape along `translation` (m) without turning it; the bodies that it meets, earliest first.

        Each body is named with its first touch: `fraction`, `distance`, `point` and `normal`. What the shape touches or
        overlaps at the start is met at fraction 0 with the normal (0, 0), also if it moves away from it. Chains are
        seen from both sides, sensors not at all.

        Args:
            shape: a Box, Circle, Polygon (convex, at most 8 vertices) or Capsule at its position and angle in the
                world, or a point, which makes it a ray.
            translation: m, world frame, up to 1e7 along each axis.
            category: bit set of 32: what the shape is; None: every bit. With both None all shapes are seen.
            mask: bit set of 32: what it sees; None: every bit. A shape is seen if each mask has a bit of the other's
                category.
            count_max: of bodies, 1 to 4096; None: 256. Later ones are left out, and `truncated` says so.

        Raises:
            InvalidValue, DegenerateShape: a value outside its range; the error names the field.
        """
        options = QueryOptions(category, mask, count_max)
        return run(self._core.hits(_commands.query_cast(shape, translation, options), self._handle))

    def query_overlap(
        self,
        shape: QueryShape,
        *,
        category: int | None = None,
        mask: int | None = None,
        count_max: int | None = None,
    ) -> Hits:
        """Bodies that a shape touches or overlaps, ascending id: by their own shapes, not by their bounds.

        A `Box` at its centre asks for an axis-aligned rectangle, a point for what contains it.

        Args:
            shape: as in `query_cast`.
            category: as in `query_cast`.
            mask: as in `query_cast`.
            count_max: of bodies, 1 to 4096; None: 256. Higher ids are left out, and `truncated` says so.

        Raises:
            InvalidValue, DegenerateShape: a value outside its range; the error names the field.
        """
        options = QueryOptions(category, mask, count_max)
        return run(self._core.hits(_commands.query_overlap(shape, options), self._handle))

    def query_closest(
        self,
        shape: QueryShape,
        *,
        distance_max: float,
        category: int | None = None,
        mask: int | None = None,
        count_max: int | None = None,
    ) -> Hits:
        """Bodies within `distance_max` m of a shape, nearest first, with the nearest points of both.

        `point` is the body's, `query_point` the shape's, `normal` the direction from the first to the second. Of what
        overlaps, `distance` is negative: moved by −distance along the normal, the shape is free of the body.

        Args:
            shape: as in `query_cast`.
            distance_max: m, 0 to 1e7; 0 finds only what touches or overlaps.
            category: as in `query_cast`.
            mask: as in `query_cast`.
            count_max: of bodies, 1 to 4096; None: 256. Further ones are left out, and `truncated` says so.

        Raises:
            InvalidValue, DegenerateShape: a value outside its range; the error names the field.
        """
        options = QueryOptions(category, mask, count_max)
        return run(self._core.hits(_commands.query_closest(shape, distance_max, options), self._handle))


class Frames:
    """Iterator of live frames; see `Room.frames`."""

    def __init__(self, core: Core, cursor: FrameCursor, timeout: float | None) -> None:
        self._core = core
        self._cursor = cursor
        self._timeout = timeout

    def __iter__(self) -> Frames:
        return self

    def __next__(self) -> Frame:
        return run(self._core.next_frame(self._cursor, self._timeout))

    @property
    def missed(self) -> int:
        """Frames that this iterator has skipped."""
        return self._cursor.missed


class Events:
    """Iterator of events; see `Room.events`. It can go on after it raised `EventGap`."""

    def __init__(self, core: Core, cursor: EventCursor, timeout: float) -> None:
        self._core = core
        self._cursor = cursor
        self._timeout = timeout

    def __iter__(self) -> Events:
        return self

    def __next__(self) -> Event:
        event = run(self._core.next_event(self._cursor, self._timeout))
        if event is None:
            raise StopIteration
        return event



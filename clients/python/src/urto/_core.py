"""What a client does, without knowing whether its caller blocks or awaits (see _op.py)."""

from __future__ import annotations

import contextlib
import getpass
import math
import secrets
import threading
import time
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

from google.protobuf.message import DecodeError, Message

from urto import _commands, _keys
from urto._batch import Batch
from urto._bodies import BodyInfo, Vector, body_info_from_proto, vector_from_proto
from urto._joints import Joint, JointInfo, joint_info_from_proto
from urto._events import Event, event_from_proto
from urto._exceptions import (
    ClosedError,
    ConnectionLost,
    EventGap,
    InvalidArgument,
    ProtocolError,
    RequestTimeout,
    RoomNotFound,
    rejection_from_proto,
)
from urto._frame import Contacts, Frame
from urto._handle import Handle
from urto._info import Diagnostics, RoomInfo, diagnostics_from_proto, room_info_from_proto
from urto._mailbox import EventLog, LatestPayload, Signal
from urto._op import Op, Wait
from urto._proto.v1 import command_pb2, room_pb2, scene_pb2, snapshot_pb2
from urto._transport import Transport, ZenohTransport

SNAPSHOTS_KEPT = 2
"""Ring of a subscription to live frames: latest wins, and a slow reader sees frames at most this old."""

EVENT_BATCHES_KEPT = 1024
"""Ring of a subscription to events; what it loses is asked of the room again."""

EVENT_POLL_S = 1.0
"""After that long without an event the room is asked whether the last ones were lost on the way."""

DISCOVERY_POLL_S = 0.1
"""How often a room that is not there yet is looked for again."""

M = TypeVar("M", bound=Message)
H = TypeVar("H", bound=Handle)


class OpenTransport(Protocol):
    """How a transport is made: `ZenohTransport.open`, or a test's own."""

    def __call__(self, endpoint: str, user: str | None, password: str | None, timeout: float) -> Transport: ...


@dataclass(frozen=True)
class BodyHit(Generic[H]):
    """A body that a query found.

    Attributes:
        body: its handle.
        point: m, world frame: where the ray enters, where the cast shape touches, or the body's point nearest to the
            query's.
        normal: unit, out of the body (ray, cast, nearest and closest); zero if a ray or a cast starts inside.
        fraction: of the translation of a ray or a cast, 0 to 1.
        distance: m. Ray and cast: come so far; nearest: 0 inside; closest: negative if they overlap.
        query_point: m, world frame: the point of the query's shape nearest to the body (closest).
    """

    body: H
    point: Vector
    normal: Vector
    fraction: float
    distance: float
    query_point: Vector


class Hits(list[BodyHit[H]]):
    """What a query found, in its order.

    Attributes:
        truncated: more bodies were found than asked for; those that come later in the order are left out.
    """

    def __init__(self, hits: Iterable[BodyHit[H]], truncated: bool) -> None:
        super().__init__(hits)
        self.truncated = truncated


@dataclass(frozen=True)
class RoomState:
    """All that a late joiner needs.

    Attributes:
        info: what the room says about itself.
        bodies: every body, ascending id.
        joints: every joint, ascending id.
        frame: full, of the same tick.
        view: lower and upper corner of what a viewer should frame at first, m; None if the scene does not say.
        saved_state: the world's saved state, if it was asked for; else empty.
    """

    info: RoomInfo
    bodies: tuple[BodyInfo, ...]
    joints: tuple[JointInfo, ...]
    frame: Frame
    view: tuple[Vector, Vector] | None
    saved_state: bytes


def parse(kind: type[M], payload: bytes) -> M:
    try:
        message: M = kind()
        message.ParseFromString(payload)
    except DecodeError as error:
        raise ProtocolError(f"a {kind.__name__} that cannot be read: {error}") from None
    return message


def frame_from_proto(snapshot: snapshot_pb2.Snapshot) -> Frame:
    try:
        return Frame(snapshot)
    except ValueError as error:
        raise ProtocolError(f"a snapshot that cannot be read: {error}") from None


def default_user() -> str:
    """The user of this system if that can be part of a key, else "anonymous"."""
    try:
        return _keys.check_name("user", getpass.getuser())
    except (InvalidArgument, KeyError, OSError):
        return "anonymous"


def _in_thread(function: Callable[[], Any]) -> Future[Any]:
    # Opening a session blocks in native code; on a thread of its own it can be interrupted and awaited.
    future: Future[Any] = Future()

    def work() -> None:
        try:
            result = function()
        except BaseException as error:
            if future.set_running_or_notify_cancel():
                future.set_exception(error)
            return
        if future.set_running_or_notify_cancel():
            future.set_result(result)
        else:
            result.close()

    threading.Thread(target=work, name="urto open", daemon=True).start()
    return future


def open_transport(
    opener: OpenTransport, endpoint: str, user: str | None, password: str | None, timeout: float
) -> Op[Transport]:
    transport: Transport = yield Wait(_in_thread(lambda: opener(endpoint, user, password, timeout)))
    return transport


def list_rooms(transport: Transport, timeout: float) -> Op[tuple[str, ...]]:
    """Names of the rooms that the server has, sorted."""
    keys: list[str] = yield Wait(transport.alive(_keys.ALL_ROOMS_ALIVE, timeout))
    return tuple(sorted({_keys.room_of_alive_key(key) for key in keys}))


def connect(
    endpoint: str,
    room: str | None,
    user: str | None,
    password: str | None,
    timeout: float,
    opener: OpenTransport = ZenohTransport.open,
) -> Op[Core]:
    """Opens a session, finds the room, and joins it."""
    if not (math.isfinite(timeout) and timeout > 0):
        raise InvalidArgument(f"timeout must be seconds > 0, not {timeout!r}")
    if room is not None:
        _keys.check_name("room", room)
    name = default_user() if user is None else _keys.check_name("user", user)
    transport = yield from open_transport(opener, endpoint, name, password, timeout)
    try:
        deadline = time.monotonic() + timeout
        if room is None:
            room = yield from _only_room(transport, endpoint, timeout, deadline)
        info = yield from _info_when_there(transport, endpoint, room, timeout, deadline)
        core = Core(transport, endpoint, room, name, timeout, info)
        core.join()
        return core
    except BaseException:
        transport.close()
        raise


def _only_room(transport: Transport, endpoint: str, timeout: float, deadline: float) -> Op[str]:
    while True:
        rooms = yield from list_rooms(transport, timeout)
        if len(rooms) == 1:
            return rooms[0]
        if rooms:
            raise RoomNotFound(f"several rooms at {endpoint}, name one of: {', '.join(rooms)}", rooms)
        if time.monotonic() > deadline:
            raise RoomNotFound(f"no room at {endpoint} within {timeout:g} s")
        yield from sleep(DISCOVERY_POLL_S)


def _info_when_there(
    transport: Transport, endpoint: str, room: str, timeout: float, deadline: float
) -> Op[RoomInfo]:
    while True:
        payloads: list[bytes] = yield Wait(transport.query(_keys.info(room), None, timeout))
        if payloads:
            info = room_info_from_proto(parse(room_pb2.RoomInfo, payloads[0]))
            if info.protocol_version != _keys.PROTOCOL_VERSION:
                raise ProtocolError(
                    f"the server (Urto {info.server_version}) speaks protocol {info.protocol_version}, "
                    f"this client {_keys.PROTOCOL_VERSION}: upgrade the older one"
                )
            return info
        rooms = yield from list_rooms(transport, timeout)
        if time.monotonic() > deadline or (rooms and room not in rooms):
            there = f"there are: {', '.join(rooms)}" if rooms else "there is none"
            raise RoomNotFound(f"no room {room!r} at {endpoint}; {there}", rooms)
        yield from sleep(DISCOVERY_POLL_S)


def close(core: Core) -> Op[None]:
    """Closes `core` on a thread of its own: it waits for the transport's threads."""

    def work() -> Core:
        core.close()
        return core

    yield Wait(_in_thread(work))


def sleep(seconds: float) -> Op[None]:
    with contextlib.suppress(TimeoutError):
        yield Wait(Future(), seconds)


class Core:
    """A membership in one room."""

    def __init__(
        self, transport: Transport, endpoint: str, room: str, user: str, timeout: float, info: RoomInfo
    ) -> None:
        self.transport = transport
        self.endpoint = endpoint
        self.room = room
        self.user = user
        self.session = secrets.token_hex(8)
        self.timeout = timeout
        self.first_info = info
        self.signal = Signal()
        self.snapshots = LatestPayload(self.signal)
        self.event_log = EventLog(self.signal)
        self.event_cursor = EventCursor(None)
        self.closed = False
        self.frames_missed = 0
        self.generation = 0
        self._present = True
        self._sequence = 0
        self._lock = threading.Lock()
        self._subscribed_to_snapshots = False

    def join(self) -> None:
        # Events first: the room tells of the join, so there is always a first one to count on from.
        self.transport.subscribe(_keys.event(self.room), EVENT_BATCHES_KEPT, self.event_log.add_payload)
        self.transport.watch_alive(_keys.alive(self.room), self._on_alive)
        self.transport.declare_alive(_keys.member(self.room, self.user, self.session))

    def close(self) -> None:
        self.closed = True
        self.transport.close()
        self.signal.wake()

    def _on_alive(self, present: bool) -> None:
        if present and not self._present:  # the server was restarted: its events count anew
            self.event_log.clear()
            self.generation += 1
        self._present = present
        self.signal.wake()

    def check_present(self) -> None:
        """ClosedError or ConnectionLost if nothing more can come."""
        if self.closed:
            raise ClosedError("the room is closed")
        if not self._present:
            raise ConnectionLost(f"room {self.room!r} at {self.endpoint} is gone: its server or the network ended")

    # Requests

    def ask(self, selector: str, payload: bytes | None, timeout: float | None) -> Op[bytes]:
        if self.closed:
            raise ClosedError("the room is closed")
        limit = self.timeout if timeout is None else timeout
        try:
            payloads: list[bytes] = yield Wait(self.transport.query(selector, payload, limit))
        except RequestTimeout as error:
            self.check_present()
            raise RequestTimeout(f"room {self.room!r} at {self.endpoint}: {error}") from None
        if not payloads:
            self.check_present()
            raise ConnectionLost(f"nobody answers for room {self.room!r} at {self.endpoint}")
        answer: bytes = payloads[0]
        return answer

    def execute(
        self, commands: list[command_pb2.Command], timeout: float | None = None
    ) -> Op[command_pb2.CommandReply]:
        """Sends one batch and gives its answer; a rejection is raised."""
        if not commands:
            raise InvalidArgument("a batch needs at least one command")
        payload = self._batch_payload(commands)
        reply = parse(
            command_pb2.CommandReply,
            (yield from self.ask(_keys.command(self.room, self.user), payload, timeout)),
        )
        if reply.HasField("rejection"):
            raise rejection_from_proto(reply)
        if len(reply.results) != len(commands):
            raise ProtocolError(f"{len(reply.results)} results for {len(commands)} commands")
        return reply

    def post(self, commands: list[command_pb2.Command]) -> None:
        """Sends one batch without asking for an answer; a rejection appears as a BatchRejected event."""
        if not commands:
            raise InvalidArgument("a batch needs at least one command")
        self.transport.put(_keys.command(self.room, self.user), self._batch_payload(commands))

    def _batch_payload(self, commands: list[command_pb2.Command]) -> bytes:
        with self._lock:
            self._sequence += 1
            sequence = self._sequence
        payload: bytes = command_pb2.CommandBatch(sequence=sequence, commands=commands).SerializeToString()
        return payload

    def command(self, command: command_pb2.Command, timeout: float | None = None) -> Op[int]:
        """One command; gives the tick at which it took effect."""
        reply = yield from self.execute([command], timeout)
        return reply.tick

    def query(self, command: command_pb2.Command) -> Op[command_pb2.QueryResult]:
        reply = yield from self.execute([command])
        result: command_pb2.QueryResult = reply.results[0].query
        return result

    def send_batch(self, batch: Batch[H], answer: bool, timeout: float | None) -> Op[None]:
        commands = batch._take_commands()
        if not commands:
            return
        if answer:
            batch._settle((yield from self.execute(commands, timeout)))
        else:
            self.post(commands)

    def step(self, ticks: int, timeout: float | None) -> Op[Frame]:
        if timeout is None:  # a step may take as long as the time that it simulates
            timeout = self.timeout + ticks * self.first_info.time_step
        reply = yield from self.execute([_commands.step(ticks)], timeout)
        if not reply.results[0].HasField("snapshot"):
            raise ProtocolError("the answer to a step holds no snapshot")
        return frame_from_proto(reply.results[0].snapshot)

    def reset(self, timeout: float | None) -> Op[int]:
        reply = yield from self.execute([_commands.reset()], timeout)
        return reply.epoch

    # What the room says

    def info(self, timeout: float | None) -> Op[RoomInfo]:
        payload = yield from self.ask(_keys.info(self.room), None, timeout)
        return room_info_from_proto(parse(room_pb2.RoomInfo, payload))

    def state(self, saved_state: bool, timeout: float | None) -> Op[RoomState]:
        selector = _keys.state(self.room) + ("?saved_state=true" if saved_state else "")
        message = parse(room_pb2.RoomState, (yield from self.ask(selector, None, timeout)))
        return RoomState(
            info=room_info_from_proto(message.info),
            bodies=tuple(body_info_from_proto(body) for body in message.bodies),
            joints=tuple(joint_info_from_proto(joint) for joint in message.joints),
            frame=frame_from_proto(message.snapshot),
            view=_view(message.scene),
            saved_state=message.saved_state,
        )

    def hits(self, command: command_pb2.Command, make_handle: Callable[[int, str], H]) -> Op[Hits[H]]:
        result = yield from self.query(command)
        hits = [
            BodyHit(
                make_handle(hit.id, ""),
                vector_from_proto(hit.point),
                vector_from_proto(hit.normal),
                hit.fraction,
                hit.distance,
                vector_from_proto(hit.query_point),
            )
            for hit in result.hits
        ]
        return Hits(hits, result.truncated)

    def body_info(self, body: _commands.BodyRef) -> Op[BodyInfo]:
        result = yield from self.query(_commands.query_body(body))
        if not result.HasField("body"):
            raise ProtocolError("the answer to a query for a body holds none")
        return body_info_from_proto(result.body)

    def create_joint(self, joint: Joint) -> Op[int]:
        """The new joint's id."""
        reply = yield from self.execute([_commands.create_joint(joint)])
        joint_id: int = reply.results[0].id
        return joint_id

    def joints(self) -> Op[tuple[JointInfo, ...]]:
        result = yield from self.query(_commands.query_joints())
        return tuple(joint_info_from_proto(joint) for joint in result.joints.joints)

    def contacts(self) -> Op[Contacts]:
        result = yield from self.query(_commands.query_contacts())
        try:
            return Contacts(result.contacts)
        except ValueError as error:
            raise ProtocolError(f"contacts that cannot be read: {error}") from None

    def diagnostics(self) -> Op[Diagnostics]:
        result = yield from self.query(_commands.query_diagnostics())
        return diagnostics_from_proto(result.diagnostics)

    # Streams

    def subscribe_to_snapshots(self) -> None:
        with self._lock:
            if not self._subscribed_to_snapshots:
                self.transport.subscribe(_keys.snapshot(self.room), SNAPSHOTS_KEPT, self.snapshots.put)
                self._subscribed_to_snapshots = True

    def next_frame(self, cursor: FrameCursor, timeout: float | None) -> Op[Frame]:
        """The newest live frame that `cursor` has not seen, as soon as there is one."""
        limit = self.timeout if timeout is None else timeout
        deadline = time.monotonic() + limit
        while True:
            version = self.signal.version
            count, payload = self.snapshots.latest
            if count > cursor.count:
                frame = frame_from_proto(parse(snapshot_pb2.Snapshot, payload))
                self.frames_missed += cursor.advance(count, frame)
                return frame
            self.check_present()
            remaining = deadline - time.monotonic()
            try:
                yield Wait(self.signal.wait(version), None if math.isinf(limit) else max(0.0, remaining))
            except TimeoutError:
                why = " (it is paused)" if cursor.paused else ""
                raise RequestTimeout(f"no frame of room {self.room!r} within {limit:g} s{why}") from None

    def next_event(self, cursor: EventCursor, timeout: float) -> Op[Event | None]:
        """The event after the last that `cursor` has seen; None if there is none for `timeout` s."""
        deadline = time.monotonic() + timeout
        while True:
            version = self.signal.version
            if self.closed:
                raise ClosedError("the room is closed")
            if cursor.generation != self.generation:
                self._restart(cursor)
            if cursor.next is None:
                cursor.next = self.event_log.first
            if cursor.next is not None:
                event = self.event_log.take(cursor.next)
                if event is not None:
                    cursor.next += 1
                    return event_from_proto(cursor.next - 1, event)
                if self.event_log.latest > cursor.next:
                    yield from self._recover_events(cursor)
                    continue
            self.check_present()
            remaining = deadline - time.monotonic()
            if remaining <= 0:
                return None
            try:
                yield Wait(self.signal.wait(version), min(EVENT_POLL_S, remaining))
            except TimeoutError:
                if cursor.next is not None and remaining > EVENT_POLL_S:
                    yield from self._recover_events(cursor)

    def _restart(self, cursor: EventCursor) -> None:
        missed_from = cursor.next
        cursor.generation = self.generation
        cursor.next = None
        if missed_from is not None:
            raise EventGap("the room's server was restarted; its events count anew", missed_from, missed_from - 1)

    def _recover_events(self, cursor: EventCursor) -> Op[None]:
        """Asks the room for what follows `cursor`. EventGap if the room has forgotten some of it."""
        wanted = cursor.next
        assert wanted is not None
        payload = yield from self.ask(f"{_keys.event(self.room)}?from={wanted}", None, None)
        batch = parse(snapshot_pb2.EventBatch, payload)
        self.event_log.add(batch)
        if batch.events and batch.first_sequence <= wanted:
            return
        # Nothing was recovered at `wanted`: either there is nothing yet, or it is forgotten.
        following = batch.first_sequence if batch.events else batch.oldest_sequence
        if following > wanted:
            cursor.next = following
            raise EventGap(
                f"events {wanted} to {following - 1} of room {self.room!r} are gone: the room keeps no more",
                wanted,
                following - 1,
            )
        if self.event_log.take(wanted) is None and self.event_log.latest > wanted:
            raise ProtocolError(f"room {self.room!r} does not answer for event {wanted}, which it has published")


def _view(scene: scene_pb2.Scene) -> tuple[Vector, Vector] | None:
    if not scene.HasField("view"):
        return None
    return vector_from_proto(scene.view.lower), vector_from_proto(scene.view.upper)


class FrameCursor:
    """Where a reader of live frames is, and what it missed."""

    def __init__(self, count: int, interval_ticks: int) -> None:
        self.count = count
        self.missed = 0
        self.paused = False
        self._interval_ticks = interval_ticks
        self._last: tuple[int, int] | None = None

    def advance(self, count: int, frame: Frame) -> int:
        """Takes note of a frame; how many were missed since the last."""
        self.count = count
        self.paused = frame.paused
        missed = 0
        if self._last is not None and self._last[0] == frame.epoch:
            missed = max(0, (frame.tick - self._last[1]) // self._interval_ticks - 1)
        self.missed += missed
        self._last = (frame.epoch, frame.tick)
        return missed


class EventCursor:
    """Where a reader of events is. `next` None: at the first that arrived since joining."""

    def __init__(self, following: int | None, generation: int = 0) -> None:
        self.next = following
        self.generation = generation


def snapshot_interval_ticks(info: RoomInfo) -> int:
    """Ticks from one live frame to the next, as the room says."""
    if info.snapshot_rate_hz <= 0 or info.time_step <= 0:
        return 1
    return max(1, round(1.0 / (info.snapshot_rate_hz * info.time_step)))

"""Events of a room: typed, numbered without gaps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from urto._bodies import Body, Vector, body_from_proto, vector_from_proto
from urto._proto.v1 import snapshot_pb2


@dataclass(frozen=True, kw_only=True)
class EventBase:
    """What all events have: `sequence` grows by one from event to event; `tick` is the ticks done when it happened."""

    sequence: int
    tick: int


@dataclass(frozen=True, kw_only=True)
class ContactBegin(EventBase):
    """Two bodies began to touch at `point` (m, world frame), `normal` from a to b, closing in at m/s ≥ 0."""

    body_a: int
    body_b: int
    point: Vector
    normal: Vector
    approach_speed: float
    sensor: bool


@dataclass(frozen=True, kw_only=True)
class ContactHit(EventBase):
    """Two bodies struck each other; only in scenes that ask for it (`WorldSettings.hit_events`).

    A blow that is spread over ticks that follow each other is one hit; after a bounce the next is another.

    Attributes:
        body_a: id.
        body_b: id.
        point: m, world frame, where they closed in fastest.
        normal: unit, from a to b.
        approach_speed: m/s along the normal, at the start of the tick; above the scene's `speed_min`.
    """

    body_a: int
    body_b: int
    point: Vector
    normal: Vector
    approach_speed: float


@dataclass(frozen=True, kw_only=True)
class ContactEnd(EventBase):
    """Two bodies no longer touch."""

    body_a: int
    body_b: int
    sensor: bool


@dataclass(frozen=True, kw_only=True)
class BodyAdded(EventBase):
    """A body was spawned by `user`."""

    id: int
    body: Body
    layout: int
    user: str


@dataclass(frozen=True, kw_only=True)
class BodyRemoved(EventBase):
    """A body was despawned by `user`."""

    id: int
    layout: int
    user: str


@dataclass(frozen=True, kw_only=True)
class JointAdded(EventBase):
    """A joint was made by `user`; bodies are ids, `body_a` is 0 of a mouse joint."""

    id: int
    name: str
    kind: str
    body_a: int
    body_b: int
    user: str


@dataclass(frozen=True, kw_only=True)
class JointRemoved(EventBase):
    """A joint was taken away by `user`. Those of a removed body go without this event."""

    id: int
    user: str


@dataclass(frozen=True, kw_only=True)
class JointBroke(EventBase):
    """A joint carried more than it could: `force` in N and `torque` in N·m at `point` (m, world frame). It is gone."""

    id: int
    body_a: int
    body_b: int
    point: Vector
    force: float
    torque: float


@dataclass(frozen=True, kw_only=True)
class MemberJoined(EventBase):
    """A client entered the room."""

    user: str
    session: str


@dataclass(frozen=True, kw_only=True)
class MemberLeft(EventBase):
    """A client left the room, or its connection broke."""

    user: str
    session: str


@dataclass(frozen=True, kw_only=True)
class RoomPaused(EventBase):
    """Time stands still from here on."""

    user: str


@dataclass(frozen=True, kw_only=True)
class RoomResumed(EventBase):
    """Time goes on."""

    user: str


@dataclass(frozen=True, kw_only=True)
class RoomReset(EventBase):
    """The room is back at tick 0 of its scene; `epoch` is the new one."""

    user: str
    epoch: int


@dataclass(frozen=True, kw_only=True)
class TimeScaleChanged(EventBase):
    """`scale` simulated seconds per second from here on."""

    user: str
    scale: float


@dataclass(frozen=True, kw_only=True)
class BatchRejected(EventBase):
    """A batch that was sent without asking for an answer was refused; `batch` is its number by its sender."""

    user: str
    batch: int
    reason: str


@dataclass(frozen=True, kw_only=True)
class EventsDropped(EventBase):
    """`count` contact events beyond the room's limit per tick were left out."""

    count: int


@dataclass(frozen=True, kw_only=True)
class UnknownEvent(EventBase):
    """An event of a newer server that this client does not know."""


Event: TypeAlias = (
    ContactBegin | ContactHit | ContactEnd | BodyAdded | BodyRemoved | MemberJoined | MemberLeft | RoomPaused
    | RoomResumed | RoomReset | TimeScaleChanged | BatchRejected | EventsDropped | JointAdded | JointRemoved
    | JointBroke | UnknownEvent
)  # fmt: skip
"""Any event of a room."""


def event_from_proto(sequence: int, message: snapshot_pb2.Event) -> Event:  # noqa: C901 - one branch per kind
    tick = message.tick
    kind = message.WhichOneof("event")
    match kind:
        case "contact_begin":
            begin = message.contact_begin
            return ContactBegin(
                sequence=sequence, tick=tick, body_a=begin.body_a, body_b=begin.body_b,
                point=vector_from_proto(begin.point), normal=vector_from_proto(begin.normal),
                approach_speed=begin.approach_speed, sensor=begin.sensor,
            )  # fmt: skip
        case "contact_hit":
            hit = message.contact_hit
            return ContactHit(
                sequence=sequence, tick=tick, body_a=hit.body_a, body_b=hit.body_b,
                point=vector_from_proto(hit.point), normal=vector_from_proto(hit.normal),
                approach_speed=hit.approach_speed,
            )  # fmt: skip
        case "contact_end":
            end = message.contact_end
            return ContactEnd(sequence=sequence, tick=tick, body_a=end.body_a, body_b=end.body_b, sensor=end.sensor)
        case "body_added":
            added = message.body_added
            return BodyAdded(
                sequence=sequence, tick=tick, id=added.id, body=body_from_proto(added.body), layout=added.layout,
                user=added.user,
            )  # fmt: skip
        case "body_removed":
            removed = message.body_removed
            return BodyRemoved(
                sequence=sequence, tick=tick, id=removed.id, layout=removed.layout, user=removed.user
            )  # fmt: skip
        case "joint_added":
            made = message.joint_added
            return JointAdded(
                sequence=sequence, tick=tick, id=made.id, name=made.joint.name,
                kind=made.joint.WhichOneof("kind") or "", body_a=made.joint.body_a.id, body_b=made.joint.body_b.id,
                user=made.user,
            )  # fmt: skip
        case "joint_removed":
            return JointRemoved(
                sequence=sequence, tick=tick, id=message.joint_removed.id, user=message.joint_removed.user
            )
        case "joint_broke":
            broke = message.joint_broke
            return JointBroke(
                sequence=sequence, tick=tick, id=broke.id, body_a=broke.body_a, body_b=broke.body_b,
                point=vector_from_proto(broke.point), force=broke.force, torque=broke.torque,
            )  # fmt: skip
        case "member_joined":
            joined = message.member_joined
            return MemberJoined(sequence=sequence, tick=tick, user=joined.user, session=joined.session)
        case "member_left":
            left = message.member_left
            return MemberLeft(sequence=sequence, tick=tick, user=left.user, session=left.session)
        case "room_paused":
            return RoomPaused(sequence=sequence, tick=tick, user=message.room_paused.user)
        case "room_resumed":
            return RoomResumed(sequence=sequence, tick=tick, user=message.room_resumed.user)
        case "room_reset":
            reset = message.room_reset
            return RoomReset(sequence=sequence, tick=tick, user=reset.user, epoch=reset.epoch)
        case "time_scale_changed":
            scale = message.time_scale_changed
            return TimeScaleChanged(sequence=sequence, tick=tick, user=scale.user, scale=scale.scale)
        case "batch_rejected":
            refused = message.batch_rejected
            return BatchRejected(
                sequence=sequence, tick=tick, user=refused.user, batch=refused.sequence, reason=refused.reason
            )  # fmt: skip
        case "events_dropped":
            return EventsDropped(sequence=sequence, tick=tick, count=message.events_dropped.count)
        case _:
            return UnknownEvent(sequence=sequence, tick=tick)

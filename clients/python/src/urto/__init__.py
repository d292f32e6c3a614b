"""Client of Urto: physics rooms as a service.

    import urto

    with urto.connect() as room:
        ball = room.spawn(urto.Circle(radius=0.5, position=(0, 5)))
        ball.apply_impulse((3, 0))
        for frame in room.frames():
            print(frame.tick, frame[ball].position)

`urto.aio` is the same for asyncio. All errors are `UrtoError`s; see `urto._exceptions` for their tree.
"""

from __future__ import annotations

from urto import aio
from urto._batch import Batch
from urto._bodies import (
    Body,
    BodyInfo,
    BodyType,
    Box,
    Capsule,
    Chain,
    Circle,
    Polygon,
    Shape,
    Spawnable,
    Vector,
    VectorLike,
)
from urto._core import RoomState
from urto._events import (
    BatchRejected,
    BodyAdded,
    BodyRemoved,
    ContactBegin,
    ContactEnd,
    Event,
    EventsDropped,
    JointAdded,
    JointBroke,
    JointRemoved,
    MemberJoined,
    MemberLeft,
    RoomPaused,
    RoomReset,
    RoomResumed,
    TimeScaleChanged,
    UnknownEvent,
)
from urto._exceptions import (
    Cancelled,
    ClosedError,
    ConnectionFailed,
    ConnectionLost,
    DegenerateShape,
    DuplicateName,
    EventGap,
    InvalidArgument,
    InvalidValue,
    Malformed,
    NotPaused,
    NotPermitted,
    NotSupported,
    ProtocolError,
    QueueFull,
    QuotaExceeded,
    Rejected,
    RequestTimeout,
    RoomNotFound,
    UnknownBody,
    UnknownJoint,
    UrtoError,
    WrongBodyType,
    WrongJointKind,
)
from urto._frame import BodyState, Contacts, Frame, Statistics
from urto._info import Diagnostics, Feature, Limits, Member, RoomInfo
from urto._joints import (
    DistanceJoint,
    Joint,
    JointInfo,
    JointSpring,
    Motor,
    MouseJoint,
    PrismaticJoint,
    RevoluteJoint,
    WeldJoint,
)
from urto._keys import DEFAULT_ENDPOINT
from urto._room import BodyHandle, BodyHit, Events, Frames, Room, connect, rooms

__version__ = "0.1.0"

__all__ = [
    "DEFAULT_ENDPOINT",
    "Batch",
    "BatchRejected",
    "Body",
    "BodyAdded",
    "BodyHandle",
    "BodyHit",
    "BodyInfo",
    "BodyRemoved",
    "BodyState",
    "BodyType",
    "Box",
    "Cancelled",
    "Capsule",
    "Chain",
    "Circle",
    "ClosedError",
    "ConnectionFailed",
    "ConnectionLost",
    "ContactBegin",
    "ContactEnd",
    "Contacts",
    "DegenerateShape",
    "Diagnostics",
    "DistanceJoint",
    "DuplicateName",
    "Event",
    "EventGap",
    "Events",
    "EventsDropped",
    "Feature",
    "Frame",
    "Frames",
    "InvalidArgument",
    "InvalidValue",
    "Joint",
    "JointAdded",
    "JointBroke",
    "JointInfo",
    "JointRemoved",
    "JointSpring",
    "Limits",
    "Malformed",
    "Member",
    "MemberJoined",
    "MemberLeft",
    "Motor",
    "MouseJoint",
    "NotPaused",
    "NotPermitted",
    "NotSupported",
    "Polygon",
    "PrismaticJoint",
    "ProtocolError",
    "QueueFull",
    "QuotaExceeded",
    "Rejected",
    "RequestTimeout",
    "RevoluteJoint",
    "Room",
    "RoomInfo",
    "RoomNotFound",
    "RoomPaused",
    "RoomReset",
    "RoomResumed",
    "RoomState",
    "Shape",
    "Spawnable",
    "Statistics",
    "TimeScaleChanged",
    "UnknownBody",
    "UnknownEvent",
    "UnknownJoint",
    "UrtoError",
    "Vector",
    "VectorLike",
    "WeldJoint",
    "WrongBodyType",
    "WrongJointKind",
    "aio",
    "connect",
    "rooms",
]

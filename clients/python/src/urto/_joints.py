"""Descriptions of joints: what is made, and what a room says it holds.

SI units and radians; anchors are in the frames of their bodies. A joint's position is the angle of b against a
(revolute, weld), the way of b's anchor along the axis (prismatic), or the distance of the anchors (distance).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias, TypeVar, overload

from urto._bodies import Vector, VectorLike, to_number, vector_from_proto, vector_to_proto
from urto._exceptions import InvalidArgument
from urto._handle import Handle
from urto._proto.v1 import command_pb2, scene_pb2, snapshot_pb2

BodyRef: TypeAlias = Handle | int | str
"""A body: its handle, its id, or its name."""

J = TypeVar("J", bound="_JointFields")

JointRef: TypeAlias = int | str
"""A joint: its id or its name."""


def body_ref(body: BodyRef) -> scene_pb2.BodyRef:
    if isinstance(body, Handle):
        return body._to_proto()
    if isinstance(body, str):
        return scene_pb2.BodyRef(name=body)
    if isinstance(body, int) and not isinstance(body, bool) and 0 <= body < 2**64:
        return scene_pb2.BodyRef(id=body)
    raise InvalidArgument(f"a body is a handle, an id or a name, not {body!r}")


def joint_ref(joint: JointRef) -> command_pb2.JointRef:
    if isinstance(joint, str):
        return command_pb2.JointRef(name=joint)
    if isinstance(joint, int) and not isinstance(joint, bool) and 0 <= joint < 2**64:
        return command_pb2.JointRef(id=joint)
    raise InvalidArgument(f"a joint is an id or a name, not {joint!r}")


@dataclass(frozen=True)
class Motor:
    """Drives a revolute joint (rad/s, at most `bound` N·m) or a prismatic one (m/s, at most `bound` N)."""

    speed: float
    bound: float
    enabled: bool = True

    def _to_proto(self) -> scene_pb2.JointMotor:
        return scene_pb2.JointMotor(
            enabled=bool(self.enabled),
            speed=to_number("motor.speed", self.speed),
            bound=to_number("motor.bound", self.bound),
        )


@dataclass(frozen=True)
class JointSpring:
    """A damped spring by what one sees of it: Hz above 0, and its damping ratio (1: no swinging)."""

    hertz: float
    damping_ratio: float = 1.0

    def _to_proto(self) -> scene_pb2.JointSpring:
        return scene_pb2.JointSpring(
            hertz=to_number("spring.hertz", self.hertz),
            damping_ratio=to_number("spring.damping_ratio", self.damping_ratio),
        )


def _limits(limits: tuple[float, float] | None) -> scene_pb2.JointLimits | None:
    if limits is None:
        return None
    try:
        lower, upper = limits
    except (TypeError, ValueError):
        raise InvalidArgument(f"limits must be two numbers (lower, upper), not {limits!r}") from None
    return scene_pb2.JointLimits(lower=to_number("limits[0]", lower), upper=to_number("limits[1]", upper))


@overload
def _optional(part: Motor | None) -> scene_pb2.JointMotor | None: ...
@overload
def _optional(part: JointSpring | None) -> scene_pb2.JointSpring | None: ...
def _optional(part: Motor | JointSpring | None) -> scene_pb2.JointMotor | scene_pb2.JointSpring | None:
    return None if part is None else part._to_proto()


def _number(what: str, value: float | None) -> float | None:
    return None if value is None else to_number(what, value)


@dataclass(frozen=True, kw_only=True)
class _JointFields:
    """What every joint has.

    Attributes:
        name: optional, unique among the room's joints, at most 64 bytes.
        break_force: N > 0; a tick with more of it, in the mean, is the joint's last. None: it holds.
        break_torque: N·m > 0, likewise.
        collide_connected: may the two bodies touch each other?
    """

    name: str = ""
    break_force: float | None = None
    break_torque: float | None = None
    collide_connected: bool = False

    def _common(self) -> scene_pb2.Joint:
        return scene_pb2.Joint(
            name=self.name,
            break_force=_number("break_force", self.break_force),
            break_torque=_number("break_torque", self.break_torque),
            collide_connected=self.collide_connected,
        )


@dataclass(frozen=True, kw_only=True)
class _Pair(_JointFields):
    """Two bodies, at least one of them dynamic, and their anchors in m, each in its body's frame."""

    body_a: BodyRef
    body_b: BodyRef
    anchor_a: VectorLike = (0.0, 0.0)
    anchor_b: VectorLike = (0.0, 0.0)

    def _common(self) -> scene_pb2.Joint:
        message = super()._common()
        message.body_a.CopyFrom(body_ref(self.body_a))
        message.body_b.CopyFrom(body_ref(self.body_b))
        message.anchor_a.CopyFrom(vector_to_proto("anchor_a", self.anchor_a))
        message.anchor_b.CopyFrom(vector_to_proto("anchor_b", self.anchor_b))
        return message


@dataclass(frozen=True, kw_only=True)
class RevoluteJoint(_Pair):
    """Two bodies turn about a common point.

    Attributes:
        reference_angle: rad, b's angle less a's where the joint's is 0; None: as they are now.
        limits: rad, lower and upper, up to ±1000: whole turns count.
        motor: rad/s and N·m.
        spring: towards 0.
    """

    reference_angle: float | None = None
    limits: tuple[float, float] | None = None
    motor: Motor | None = None
    spring: JointSpring | None = None

    def _to_proto(self) -> scene_pb2.Joint:
        message = self._common()
        message.revolute.CopyFrom(
            scene_pb2.RevoluteJoint(
                reference_angle=_number("reference_angle", self.reference_angle),
                limits=_limits(self.limits),
                motor=_optional(self.motor),
                spring=_optional(self.spring),
            )
        )
        return message


@dataclass(frozen=True, kw_only=True)
class DistanceJoint(_Pair):
    """A rod between two points; with `limits` alone a rope, with `spring` a spring.

    Attributes:
        length: m ≥ 0, of the rod, or of the spring at rest; None: as it is now.
        limits: m ≥ 0, lower and upper.
        spring: towards `length`.
    """

    length: float | None = None
    limits: tuple[float, float] | None = None
    spring: JointSpring | None = None

    def _to_proto(self) -> scene_pb2.Joint:
        message = self._common()
        message.distance.CopyFrom(
            scene_pb2.DistanceJoint(
                length=_number("length", self.length),
                limits=_limits(self.limits),
                spring=_optional(self.spring),
            )
        )
        return message


@dataclass(frozen=True, kw_only=True)
class PrismaticJoint(_Pair):
    """b slides along an axis of a and does not turn against it.

    Attributes:
        axis: of any length but 0, in a's frame.
        reference_angle: rad, b's angle less a's; None: as it is now.
        limits: m, lower and upper.
        motor: m/s and N.
        spring: towards 0.
    """

    axis: VectorLike = (1.0, 0.0)
    reference_angle: float | None = None
    limits: tuple[float, float] | None = None
    motor: Motor | None = None
    spring: JointSpring | None = None

    def _to_proto(self) -> scene_pb2.Joint:
        message = self._common()
        message.prismatic.CopyFrom(
            scene_pb2.PrismaticJoint(
                axis=vector_to_proto("axis", self.axis),
                reference_angle=_number("reference_angle", self.reference_angle),
                limits=_limits(self.limits),
                motor=_optional(self.motor),
                spring=_optional(self.spring),
            )
        )
        return message


@dataclass(frozen=True, kw_only=True)
class WeldJoint(_Pair):
    """b keeps its place against a: stiffly, or by springs.

    Attributes:
        reference_angle: rad, b's angle less a's; None: as it is now.
        linear: spring of the place; None: stiff.
        angular: spring of the angle; None: stiff.
    """

    reference_angle: float | None = None
    linear: JointSpring | None = None
    angular: JointSpring | None = None

    def _to_proto(self) -> scene_pb2.Joint:
        message = self._common()
        message.weld.CopyFrom(
            scene_pb2.WeldJoint(
                reference_angle=_number("reference_angle", self.reference_angle),
                linear=_optional(self.linear),
                angular=_optional(self.angular),
            )
        )
        return message


@dataclass(frozen=True, kw_only=True)
class MouseJoint(_JointFields):
    """Draws a point of a body to a point of the world; `Room.set_target` moves that.

    Attributes:
        body: what is drawn; dynamic.
        anchor: m, in its frame.
        target: m, world frame.
        force_max: N ≥ 0.
        spring: how it draws.
    """

    body: BodyRef
    target: VectorLike
    force_max: float
    anchor: VectorLike = (0.0, 0.0)
    spring: JointSpring = JointSpring(5.0, 1.0)

    def _to_proto(self) -> scene_pb2.Joint:
        message = self._common()
        message.body_b.CopyFrom(body_ref(self.body))
        message.anchor_b.CopyFrom(vector_to_proto("anchor", self.anchor))
        message.mouse.CopyFrom(
            scene_pb2.MouseJoint(
                target=vector_to_proto("target", self.target),
                spring=self.spring._to_proto(),
                force_max=to_number("force_max", self.force_max),
            )
        )
        return message


def with_bodies(joint: J, changed: Callable[[BodyRef], BodyRef]) -> J:
    """The joint with other references to its bodies."""
    if isinstance(joint, MouseJoint):
        return replace(joint, body=changed(joint.body))
    assert isinstance(joint, _Pair)
    return replace(joint, body_a=changed(joint.body_a), body_b=changed(joint.body_b))


Joint: TypeAlias = RevoluteJoint | DistanceJoint | PrismaticJoint | WeldJoint | MouseJoint
"""What joins bodies."""


@dataclass(frozen=True, kw_only=True)
class JointInfo:
    """A joint as the room knows it.

    Attributes:
        id: the room's number for the joint.
        name: may be empty.
        kind: "revolute", "distance", "prismatic", "weld" or "mouse".
        body_a: id; 0 of a mouse joint.
        body_b: id.
        anchor_a: m, a's frame; of a mouse joint its target, world frame.
        anchor_b: m, b's frame.
        point_a: m, world frame: where a's anchor is, or the target.
        point_b: m, world frame.
        position: rad or m; of a mouse joint the distance to the target.
        speed: rad/s or m/s of the position.
        force: N on b, mean of the last tick.
        torque: N·m on b beside that force, mean of the last tick.
        motor: as it is set; None: none.
    """

    id: int
    name: str
    kind: str
    body_a: int
    body_b: int
    anchor_a: Vector
    anchor_b: Vector
    point_a: Vector
    point_b: Vector
    position: float
    speed: float
    force: Vector
    torque: float
    motor: Motor | None


def joint_info_from_proto(message: snapshot_pb2.JointInfo) -> JointInfo:
    joint, state = message.joint, message.state
    kind = joint.WhichOneof("kind") or ""
    motor = state.motor
    return JointInfo(
        id=message.id,
        name=joint.name,
        kind=kind,
        body_a=joint.body_a.id,
        body_b=joint.body_b.id,
        anchor_a=vector_from_proto(state.point_a if kind == "mouse" else joint.anchor_a),
        anchor_b=vector_from_proto(joint.anchor_b),
        point_a=vector_from_proto(state.point_a),
        point_b=vector_from_proto(state.point_b),
        position=state.position,
        speed=state.speed,
        force=vector_from_proto(state.force),
        torque=state.torque,
        motor=Motor(motor.speed, motor.bound, motor.enabled) if state.HasField("motor") else None,
    )

"""Builds the messages of commands and queries."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from urto._bodies import (
    QueryShape,
    Spawnable,
    VectorLike,
    body_to_proto,
    query_filter_to_proto,
    query_shape_to_proto,
    to_number,
    vector_to_proto,
)
from urto._exceptions import InvalidArgument
from urto._joints import BodyRef, Joint, JointRef, Motor, body_ref, joint_ref
from urto._proto.v1 import command_pb2

__all__ = ["BodyRef", "FrameName", "JointRef"]

FrameName: TypeAlias = Literal["world", "body"]

_FRAMES = {"world": command_pb2.FRAME_WORLD, "body": command_pb2.FRAME_BODY}


def _frame(name: str) -> command_pb2.Frame:
    if name not in _FRAMES:
        raise InvalidArgument(f"frame must be 'world' or 'body', not {name!r}")
    return _FRAMES[name]


def spawn(description: Spawnable) -> command_pb2.Command:
    return command_pb2.Command(spawn=command_pb2.Spawn(body=body_to_proto(description)))


def despawn(body: BodyRef) -> command_pb2.Command:
    return command_pb2.Command(despawn=command_pb2.Despawn(body=body_ref(body)))


def impulse(
    body: BodyRef, vector: VectorLike, point: VectorLike | None, frame: str, angular: float
) -> command_pb2.Command:
    message = command_pb2.Impulse(
        body=body_ref(body),
        impulse=vector_to_proto("impulse", vector),
        frame=_frame(frame),
        angular=to_number("angular", angular),
    )
    if point is not None:
        message.point.CopyFrom(vector_to_proto("point", point))
    return command_pb2.Command(impulse=message)


def force(
    body: BodyRef, vector: VectorLike, torque: float, frame: str, duration: float | None
) -> command_pb2.Command:
    message = command_pb2.Force(
        body=body_ref(body),
        force=vector_to_proto("force", vector),
        torque=to_number("torque", torque),
        frame=_frame(frame),
    )
    if duration is not None:
        message.duration = to_number("duration", duration)
    return command_pb2.Command(force=message)


def set_velocity(body: BodyRef, velocity: VectorLike | None, angular_velocity: float | None) -> command_pb2.Command:
    message = command_pb2.SetVelocity(body=body_ref(body))
    if velocity is not None:
        message.velocity.CopyFrom(vector_to_proto("velocity", velocity))
    if angular_velocity is not None:
        message.angular_velocity = to_number("angular_velocity", angular_velocity)
    return command_pb2.Command(set_velocity=message)


def set_transform(body: BodyRef, position: VectorLike | None, angle: float | None) -> command_pb2.Command:
    message = command_pb2.SetTransform(body=body_ref(body))
    if position is not None:
        message.position.CopyFrom(vector_to_proto("position", position))
    if angle is not None:
        message.angle = to_number("angle", angle)
    return command_pb2.Command(set_transform=message)


def create_joint(joint: Joint) -> command_pb2.Command:
    return command_pb2.Command(create_joint=command_pb2.CreateJoint(joint=joint._to_proto()))


def destroy_joint(joint: JointRef) -> command_pb2.Command:
    return command_pb2.Command(destroy_joint=command_pb2.DestroyJoint(joint=joint_ref(joint)))


def set_motor(joint: JointRef, motor: Motor) -> command_pb2.Command:
    return command_pb2.Command(set_motor=command_pb2.SetMotor(joint=joint_ref(joint), motor=motor._to_proto()))


def set_target(joint: JointRef, target: VectorLike) -> command_pb2.Command:
    return command_pb2.Command(
        set_target=command_pb2.SetTarget(joint=joint_ref(joint), target=vector_to_proto("target", target))
    )


def pause() -> command_pb2.Command:
    return command_pb2.Command(pause=command_pb2.Pause())


def resume() -> command_pb2.Command:
    return command_pb2.Command(resume=command_pb2.Resume())


def step(ticks: int) -> command_pb2.Command:
    if isinstance(ticks, bool) or not isinstance(ticks, int) or not 0 <= ticks < 2**32:
        raise InvalidArgument(f"ticks must be a whole number, not {ticks!r}")
    return command_pb2.Command(step=command_pb2.Step(ticks=ticks))


def reset() -> command_pb2.Command:
    return command_pb2.Command(reset=command_pb2.Reset())


def set_time_scale(scale: float) -> command_pb2.Command:
    return command_pb2.Command(set_time_scale=command_pb2.SetTimeScale(scale=to_number("scale", scale)))


def _query(query: command_pb2.Query) -> command_pb2.Command:
    return command_pb2.Command(query=query)


def query_point(point: VectorLike) -> command_pb2.Command:
    return _query(command_pb2.Query(point=command_pb2.PointQuery(point=vector_to_proto("point", point))))


def query_region(lower: VectorLike, upper: VectorLike) -> command_pb2.Command:
    region = command_pb2.RegionQuery(lower=vector_to_proto("lower", lower), upper=vector_to_proto("upper", upper))
    return _query(command_pb2.Query(region=region))


def query_ray(origin: VectorLike, translation: VectorLike) -> command_pb2.Command:
    ray = command_pb2.RayQuery(
        origin=vector_to_proto("origin", origin), translation=vector_to_proto("translation", translation)
    )
    return _query(command_pb2.Query(ray=ray))


def _count(what: str, value: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 2**32:
        raise InvalidArgument(f"{what} must be a whole number, not {value!r}")
    return value


def query_nearest(point: VectorLike, distance_max: float, count_max: int) -> command_pb2.Command:
    nearest = command_pb2.NearestQuery(
        point=vector_to_proto("point", point),
        distance_max=to_number("distance_max", distance_max),
        count_max=_count("count_max", count_max),
    )
    return _query(command_pb2.Query(nearest=nearest))


@dataclass(frozen=True)
class QueryOptions:
    """What a query with a shape sees, and how much of it; None: everything, and as many as the room's default."""

    category: int | None = None
    mask: int | None = None
    count_max: int | None = None

    def count(self) -> int:
        """As the wire has it, where 0 is the default."""
        if self.count_max is None:
            return 0
        if _count("count_max", self.count_max) == 0:
            raise InvalidArgument("count_max must be at least 1")
        return self.count_max

    def filter(self) -> command_pb2.QueryFilter | None:
        return query_filter_to_proto(self.category, self.mask)


def query_cast(shape: QueryShape, translation: VectorLike, options: QueryOptions) -> command_pb2.Command:
    cast = command_pb2.CastQuery(
        shape=query_shape_to_proto(shape),
        translation=vector_to_proto("translation", translation),
        filter=options.filter(),
        count_max=options.count(),
    )
    return _query(command_pb2.Query(cast=cast))


def query_overlap(shape: QueryShape, options: QueryOptions) -> command_pb2.Command:
    overlap = command_pb2.OverlapQuery(
        shape=query_shape_to_proto(shape), filter=options.filter(), count_max=options.count()
    )
    return _query(command_pb2.Query(overlap=overlap))


def query_closest(shape: QueryShape, distance_max: float, options: QueryOptions) -> command_pb2.Command:
    closest = command_pb2.ClosestQuery(
        shape=query_shape_to_proto(shape),
        distance_max=to_number("distance_max", distance_max),
        filter=options.filter(),
        count_max=options.count(),
    )
    return _query(command_pb2.Query(closest=closest))


def query_contacts() -> command_pb2.Command:
    return _query(command_pb2.Query(contacts=command_pb2.ContactsQuery()))


def query_diagnostics() -> command_pb2.Command:
    return _query(command_pb2.Query(diagnostics=command_pb2.DiagnosticsQuery()))


def query_body(body: BodyRef) -> command_pb2.Command:
    return _query(command_pb2.Query(body=command_pb2.BodyQuery(body=body_ref(body))))


def query_joints() -> command_pb2.Command:
    return _query(command_pb2.Query(joints=command_pb2.JointsQuery()))

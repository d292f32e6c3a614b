"""What a room says about itself, and answers to queries about its world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from urto._bodies import Vector, vector_from_proto
from urto._frame import Statistics, statistics_from_proto
from urto._proto.v1 import room_pb2, scene_pb2, snapshot_pb2

Permission: TypeAlias = Literal["everyone", "owners", "nobody"]

_PERMISSIONS: dict[int, Permission] = {
    room_pb2.PERMISSION_EVERYONE: "everyone",
    room_pb2.PERMISSION_OWNERS: "owners",
    room_pb2.PERMISSION_NOBODY: "nobody",
}


@dataclass(frozen=True)
class Member:
    """Someone who is in the room."""

    user: str
    session: str


@dataclass(frozen=True)
class Feature:
    """One choice of the room's model: what runs in a step, and why."""

    name: str
    choice: str
    on: bool
    reason: str


@dataclass(frozen=True, kw_only=True)
class Limits:
    """The room's bounds. What passes one is rejected; events beyond `events_kept_max` are forgotten."""

    bodies_max: int
    shapes_max: int
    joints_max: int
    batch_commands_max: int
    queue_batches_max: int
    batches_per_tick_max: int
    message_bytes_max: int
    members_max: int
    events_kept_max: int
    step_ticks_max: int


@dataclass(frozen=True, kw_only=True)
class RoomInfo:
    """What a room says about itself.

    Attributes:
        room: its name.
        server_version: of Urto.
        protocol_version: 1.
        scene: name of its scene.
        description: of the scene.
        epoch: grows by one with each reset.
        tick: ticks done.
        time_step: s of one tick.
        time_scale: simulated seconds per second.
        snapshot_rate_hz: of live frames at time scale 1.
        paused: whether time stands still.
        members: who is there.
        model: what runs in a step, and why.
        limits: the room's bounds.
        statistics: of the last tick.
        control: who may pause, step, reset and scale time.
        authenticated: users are checked by password; else a name is only a name.
        uptime: s.
        state_hash: of the world's whole state.
        precision: "float" or "double".
    """

    room: str
    server_version: str
    protocol_version: int
    scene: str
    description: str
    epoch: int
    tick: int
    time_step: float
    time_scale: float
    snapshot_rate_hz: float
    paused: bool
    members: tuple[Member, ...]
    model: tuple[Feature, ...]
    limits: Limits
    statistics: Statistics
    control: Permission
    authenticated: bool
    uptime: float
    state_hash: int
    precision: Literal["float", "double"]


def room_info_from_proto(message: room_pb2.RoomInfo) -> RoomInfo:
    limits = message.limits
    return RoomInfo(
        room=message.room,
        server_version=message.server_version,
        protocol_version=message.protocol_version,
        scene=message.scene,
        description=message.description,
        epoch=message.epoch,
        tick=message.tick,
        time_step=message.time_step,
        time_scale=message.time_scale,
        snapshot_rate_hz=message.snapshot_rate_hz,
        paused=message.paused,
        members=tuple(Member(member.user, member.session) for member in message.members),
        model=tuple(Feature(item.name, item.choice, item.on, item.reason) for item in message.model),
        limits=Limits(
            bodies_max=limits.bodies_max,
            shapes_max=limits.shapes_max,
            joints_max=limits.joints_max,
            batch_commands_max=limits.batch_commands_max,
            queue_batches_max=limits.queue_batches_max,
            batches_per_tick_max=limits.batches_per_tick_max,
            message_bytes_max=limits.message_bytes_max,
            members_max=limits.members_max,
            events_kept_max=limits.events_kept_max,
            step_ticks_max=limits.step_ticks_max,
        ),
        statistics=statistics_from_proto(message.statistics),
        control=_PERMISSIONS.get(message.control, "everyone"),
        authenticated=message.authenticated,
        uptime=message.uptime,
        state_hash=message.state_hash,
        precision="double" if message.precision == scene_pb2.PRECISION_DOUBLE else "float",
    )


@dataclass(frozen=True, kw_only=True)
class Diagnostics:
    """Conserved quantities and cost at one tick.

    Attributes:
        tick: ticks done.
        sim_time: s.
        state_hash: of the world's whole state.
        kinetic_energy: J.
        potential_energy: J, of the uniform gravity relative to y = 0 and of fields that have a potential.
        momentum: kg·m/s.
        angular_momentum: kg·m²/s about the world's origin.
        statistics: of the last tick.
    """

    tick: int
    sim_time: float
    state_hash: int
    kinetic_energy: float
    potential_energy: float
    momentum: Vector
    angular_momentum: float
    statistics: Statistics

    @property
    def energy(self) -> float:
        """J, kinetic and potential."""
        return self.kinetic_energy + self.potential_energy


def diagnostics_from_proto(message: snapshot_pb2.Diagnostics) -> Diagnostics:
    return Diagnostics(
        tick=message.tick,
        sim_time=message.sim_time,
        state_hash=message.state_hash,
        kinetic_energy=message.kinetic_energy,
        potential_energy=message.potential_energy,
        momentum=vector_from_proto(message.momentum),
        angular_momentum=message.angular_momentum,
        statistics=statistics_from_proto(message.statistics),
    )

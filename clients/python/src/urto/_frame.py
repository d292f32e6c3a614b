"""The state of a room's bodies at one tick, as numpy arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from urto._bodies import Vector
from urto._proto.v1 import snapshot_pb2

if TYPE_CHECKING:
    from urto._handle import Handle

_Array = TypeVar("_Array", bound=npt.NDArray[np.generic])
Floats = npt.NDArray[np.floating[Any]]
"""float32 or float64, as the room's precision is."""


@dataclass(frozen=True, kw_only=True)
class Statistics:
    """What the last tick cost and held.

    Attributes:
        body_count: bodies in the room.
        awake_count: of these, awake.
        contact_count: touching pairs of shapes.
        step_ms: ms of the world's step.
        overrun_count: ticks given up since the start because the room could not keep pace.
        member_count: members of the room.
        kinetic_energy: J.
        potential_energy: J, of the uniform gravity relative to y = 0 and of fields that have a potential.
        penetration_max: m ≥ 0.
        phases: ms of each phase of the step, by name.
    """

    body_count: int
    awake_count: int
    contact_count: int
    step_ms: float
    overrun_count: int
    member_count: int
    kinetic_energy: float
    potential_energy: float
    penetration_max: float
    phases: dict[str, float]


def statistics_from_proto(message: snapshot_pb2.Statistics) -> Statistics:
    return Statistics(
        body_count=message.body_count,
        awake_count=message.awake_count,
        contact_count=message.contact_count,
        step_ms=message.step_ms,
        overrun_count=message.overrun_count,
        member_count=message.member_count,
        kinetic_energy=message.kinetic_energy,
        potential_energy=message.potential_energy,
        penetration_max=message.penetration_max,
        phases={phase.name: phase.ms for phase in message.phases},
    )


class BodyState(NamedTuple):
    """One body's row of a frame."""

    position: Vector
    """m, world frame: the body's origin."""
    angle: float
    """rad in (−π, π]."""
    velocity: Vector
    """m/s, of the centre of mass."""
    angular_velocity: float
    """rad/s."""
    awake: bool


class Frame:
    """The state of N bodies after a tick. All arrays are read-only and in one order (ascending id).

    The scalar is float32 or float64 as the room's precision is. Live frames (`Room.frames`) hold the bodies that can
    move; full ones (`Room.frame`, `Room.step`) also the static ones.

    Attributes:
        ids: (N,) uint64.
        position: (N, 2) m, world frame: the bodies' origins.
        angle: (N,) rad in (−π, π].
        velocity: (N, 2) m/s, of the centres of mass.
        angular_velocity: (N,) rad/s.
        awake: (N,) bool.
        tick: ticks done since the start or the last reset.
        sim_time: s, tick times time step.
        epoch: grows by one with each reset.
        layout: grows whenever a body is added or removed.
        paused: whether the room was.
        full: whether static bodies are included.
        state_hash: of the world's whole state; 0 unless the room publishes hashes.
        event_sequence: of the last event published before this frame.
        statistics: what the tick cost and held.
    """

    __slots__ = (
        "ids", "position", "angle", "velocity", "angular_velocity", "awake", "tick", "sim_time", "epoch", "layout",
        "paused", "full", "state_hash", "event_sequence", "statistics",
    )  # fmt: skip

    def __init__(self, snapshot: snapshot_pb2.Snapshot) -> None:
        self.ids: npt.NDArray[np.uint64] = _read_only(np.array(snapshot.id, dtype=np.uint64))
        count = len(self.ids)
        self.position: Floats
        self.angle: Floats
        self.velocity: Floats
        self.angular_velocity: Floats
        if snapshot.x_double:
            self.position = _pairs(snapshot.x_double, snapshot.y_double, count, np.float64)
            self.angle = _column(snapshot.angle_double, count, np.float64)
            self.velocity = _pairs(snapshot.velocity_x_double, snapshot.velocity_y_double, count, np.float64)
            self.angular_velocity = _column(snapshot.angular_velocity_double, count, np.float64)
        else:
            self.position = _pairs(snapshot.x, snapshot.y, count, np.float32)
            self.angle = _column(snapshot.angle, count, np.float32)
            self.velocity = _pairs(snapshot.velocity_x, snapshot.velocity_y, count, np.float32)
            self.angular_velocity = _column(snapshot.angular_velocity, count, np.float32)
        awake = np.frombuffer(snapshot.awake, dtype=np.uint8).astype(np.bool_)
        if len(awake) != count:
            raise ValueError(f"a snapshot of {count} bodies has {len(awake)} awake flags")
        self.awake: npt.NDArray[np.bool_] = _read_only(awake)
        self.tick: int = snapshot.tick
        self.sim_time: float = snapshot.sim_time
        self.epoch: int = snapshot.epoch
        self.layout: int = snapshot.layout
        self.paused: bool = snapshot.paused
        self.full: bool = snapshot.full
        self.state_hash: int = snapshot.state_hash
        self.event_sequence: int = snapshot.event_sequence
        self.statistics: Statistics = statistics_from_proto(snapshot.statistics)

    def __len__(self) -> int:
        return len(self.ids)

    def __repr__(self) -> str:
        return f"<Frame tick={self.tick} sim_time={self.sim_time:.4f} epoch={self.epoch} bodies={len(self.ids)}>"

    def index(self, body: Handle | int) -> int:
        """The row of `body` in the arrays. KeyError if it is not in this frame."""
        body_id = body if isinstance(body, int) else body.id
        row = int(np.searchsorted(self.ids, np.uint64(body_id)))
        if row == len(self.ids) or int(self.ids[row]) != body_id:
            hint = "" if self.full else " (a live frame holds no static bodies)"
            raise KeyError(f"body {body_id} is not in the frame of tick {self.tick}{hint}")
        return row

    def __contains__(self, body: Handle | int) -> bool:
        try:
            self.index(body)
        except KeyError:
            return False
        return True

    def __getitem__(self, body: Handle | int) -> BodyState:
        """The state of one body. KeyError if it is not in this frame."""
        row = self.index(body)
        return BodyState(
            position=(float(self.position[row, 0]), float(self.position[row, 1])),
            angle=float(self.angle[row]),
            velocity=(float(self.velocity[row, 0]), float(self.velocity[row, 1])),
            angular_velocity=float(self.angular_velocity[row]),
            awake=bool(self.awake[row]),
        )


class Contacts:
    """M contact points at one moment. All arrays are read-only.

    Attributes:
        body_a: (M,) uint64 ids.
        body_b: (M,) uint64 ids.
        point: (M, 2) m, world frame.
        normal: (M, 2) unit, from a to b.
        separation: (M,) m, negative if penetrating.
        normal_impulse: (M,) N·s over the last tick, ≥ 0.
        tangent_impulse: (M,) N·s over the last tick, along the normal turned by −90°.
    """

    __slots__ = ("body_a", "body_b", "point", "normal", "separation", "normal_impulse", "tangent_impulse")

    def __init__(self, message: snapshot_pb2.Contacts) -> None:
        count = len(message.body_a)
        self.body_a: npt.NDArray[np.uint64] = _read_only(np.array(message.body_a, dtype=np.uint64))
        self.body_b: npt.NDArray[np.uint64] = _read_only(np.array(message.body_b, dtype=np.uint64))
        self.point = _pairs(message.x, message.y, count, np.float64)
        self.normal = _pairs(message.normal_x, message.normal_y, count, np.float64)
        self.separation = _column(message.separation, count, np.float64)
        self.normal_impulse = _column(message.normal_impulse, count, np.float64)
        self.tangent_impulse = _column(message.tangent_impulse, count, np.float64)

    def __len__(self) -> int:
        return len(self.body_a)

    def __repr__(self) -> str:
        return f"<Contacts points={len(self)}>"


def _column(values: object, count: int, dtype: type[np.float32] | type[np.float64]) -> Floats:
    column: Floats = np.array(values, dtype=dtype)
    if column.shape != (count,):
        raise ValueError(f"a column of {column.size} entries where there should be {count}")
    return _read_only(column)


def _pairs(x: object, y: object, count: int, dtype: type[np.float32] | type[np.float64]) -> Floats:
    pairs: Floats = np.empty((count, 2), dtype=dtype)
    pairs[:, 0] = _column(x, count, dtype)
    pairs[:, 1] = _column(y, count, dtype)
    return _read_only(pairs)


def _read_only(array: _Array) -> _Array:
    array.flags.writeable = False
    return array

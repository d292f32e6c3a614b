"""What a body would meet: discs that are cast all round from it, and what lies nearest to it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from urto import _commands
from urto._bodies import Circle, Vector
from urto._commands import BodyRef, QueryOptions
from urto._frame import Frame
from urto._op import run
from urto._proto.v1 import command_pb2
from urto._room import Room

FEELERS = 32
"""Directions, evenly all round."""

REACH = 0.3
"""How far the discs are cast and the nearest is sought, over the view's width."""

SIZE = 0.006
"""Radius of the discs, over the view's width."""


@dataclass(frozen=True)
class Felt:
    """What one look found.

    Attributes:
        origin: m, world frame: from where the discs were cast.
        ends: (FEELERS, 2) m: where they came to.
        met: (FEELERS,) whether something stopped them.
        radius: m, of the discs.
        nearest: the line to the nearest point of another body, (2, 2) m; None if none is in reach.
    """

    origin: Vector
    ends: npt.NDArray[np.float64]
    met: npt.NDArray[np.bool_]
    radius: float
    nearest: npt.NDArray[np.float64] | None


class Feelers:
    """Asks the room around one body, at most once a frame and in one batch."""

    def __init__(self, room: Room, body: BodyRef, width: float) -> None:
        self._room = room
        info = room.body(body).info()
        self._id = info.id
        self._position = info.position
        self._reach = REACH * width
        self._radius = SIZE * width

    def feel(self, frame: Frame) -> Felt:
        """What is around the body where it is in `frame`. A body that is gone is where it was last."""
        if self._id in frame:
            self._position = frame[self._id].position
        x, y = self._position
        turns = [2 * math.pi * index / FEELERS for index in range(FEELERS)]
        ways = [(self._reach * math.cos(turn), self._reach * math.sin(turn)) for turn in turns]
        two = QueryOptions(count_max=2)  # the body itself is one of them
        disc = Circle(radius=self._radius, position=self._position)
        commands = [_commands.query_cast(disc, way, two) for way in ways]
        commands.append(_commands.query_closest(self._position, self._reach, two))
        *casts, closest = [result.query for result in run(self._room._core.execute(commands)).results]
        firsts = [self._first(cast) for cast in casts]
        fractions = [1.0 if hit is None else hit.fraction for hit in firsts]
        other = self._first(closest)
        return Felt(
            origin=(x, y),
            ends=np.array([x, y]) + np.array(ways) * np.array(fractions)[:, None],
            met=np.array([hit is not None for hit in firsts]),
            radius=self._radius,
            nearest=None if other is None else np.array([[x, y], [other.point.x, other.point.y]]),
        )

    def _first(self, result: command_pb2.QueryResult) -> command_pb2.BodyHit | None:
        return next((hit for hit in result.hits if hit.id != self._id), None)

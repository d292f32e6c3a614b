"""Commands that take effect together: at one tick, in order, or none of them."""

from __future__ import annotations

import secrets
from collections.abc import Callable, Iterable
from typing import Generic, TypeVar, overload

from urto import _commands
from urto._bodies import Spawnable, VectorLike
from urto._commands import BodyRef, FrameName
from urto._exceptions import ClosedError, InvalidArgument, ProtocolError
from urto._handle import Handle
from urto._joints import Joint, JointRef, Motor, with_bodies
from urto._proto.v1 import command_pb2

H = TypeVar("H", bound=Handle)


class Batch(Generic[H]):
    """Collects commands; what opened it sends them as one when its `with` block ends without an error.

    Attributes:
        tick: ticks done when the commands took effect; None before the batch is sent, or if no answer was asked for.
    """

    def __init__(self, make_handle: Callable[[int, str], H]) -> None:
        self._make_handle = make_handle
        self._commands: list[command_pb2.Command] = []
        self._spawned: list[tuple[int, H]] = []
        self._open = True
        self.tick: int | None = None

    def __len__(self) -> int:
        return len(self._commands)

    @overload
    def spawn(self, body: Spawnable) -> H: ...
    @overload
    def spawn(self, body: Iterable[Spawnable]) -> list[H]: ...
    def spawn(self, body: Spawnable | Iterable[Spawnable]) -> H | list[H]:
        """Adds one body or several. The handles have ids once the batch is sent; in the batch they can be used too."""
        if isinstance(body, Iterable):
            return [self._spawn(each) for each in body]
        return self._spawn(body)

    def _spawn(self, body: Spawnable) -> H:
        self._add(_commands.spawn(body))
        handle = self._make_handle(0, body.name)
        self._spawned.append((len(self._commands) - 1, handle))
        return handle

    def despawn(self, body: BodyRef) -> None:
        """Removes a body."""
        self._add(_commands.despawn(self._named(body)))

    def apply_impulse(
        self,
        body: BodyRef,
        impulse: VectorLike,
        *,
        point: VectorLike | None = None,
        frame: FrameName = "world",
        angular: float = 0.0,
    ) -> None:
        """See `BodyHandle.apply_impulse`."""
        self._add(_commands.impulse(self._named(body), impulse, point, frame, angular))

    def apply_force(
        self,
        body: BodyRef,
        force: VectorLike,
        *,
        torque: float = 0.0,
        frame: FrameName = "world",
        duration: float | None = None,
    ) -> None:
        """See `BodyHandle.apply_force`."""
        self._add(_commands.force(self._named(body), force, torque, frame, duration))

    def set_velocity(
        self, body: BodyRef, velocity: VectorLike | None = None, *, angular_velocity: float | None = None
    ) -> None:
        """See `BodyHandle.set_velocity`."""
        self._add(_commands.set_velocity(self._named(body), velocity, angular_velocity))

    def set_transform(self, body: BodyRef, position: VectorLike | None = None, *, angle: float | None = None) -> None:
        """See `BodyHandle.set_transform`."""
        self._add(_commands.set_transform(self._named(body), position, angle))

    def create_joint(self, joint: Joint) -> None:
        """Joins two bodies, also ones of this batch. Give it a name to refer to it."""
        self._add(_commands.create_joint(with_bodies(joint, self._named)))

    def destroy_joint(self, joint: JointRef) -> None:
        """See `Room.destroy_joint`."""
        self._add(_commands.destroy_joint(joint))

    def set_motor(self, joint: JointRef, motor: Motor) -> None:
        """See `Room.set_motor`."""
        self._add(_commands.set_motor(joint, motor))

    def set_target(self, joint: JointRef, target: VectorLike) -> None:
        """See `Room.set_target`."""
        self._add(_commands.set_target(joint, target))

    def pause(self) -> None:
        """Time stands still from here on."""
        self._add(_commands.pause())

    def resume(self) -> None:
        """Time goes on."""
        self._add(_commands.resume())

    def set_time_scale(self, scale: float) -> None:
        """Simulated seconds per second, 0.01 to 100."""
        self._add(_commands.set_time_scale(scale))

    def _add(self, command: command_pb2.Command) -> None:
        if not self._open:
            raise ClosedError("the batch was sent already")
        self._commands.append(command)

    def _named(self, body: BodyRef) -> BodyRef:
        # Within a batch a new body has no id yet, so the schema refers to it by name: make one up if it has none.
        if isinstance(body, Handle) and not body.name:
            for index, handle in self._spawned:
                if handle is body:
                    body.name = f"unnamed-{secrets.token_hex(6)}"
                    self._commands[index].spawn.body.name = body.name
        return body

    def _take_commands(self) -> list[command_pb2.Command]:
        """Closes the batch and gives its commands."""
        if not self._open:
            raise InvalidArgument("the batch was sent already")
        self._open = False
        return self._commands

    def _settle(self, reply: command_pb2.CommandReply) -> None:
        """Gives the handles their ids."""
        if len(reply.results) != len(self._commands):
            raise ProtocolError(f"{len(reply.results)} results for {len(self._commands)} commands")
        for index, handle in self._spawned:
            handle._settle(reply.results[index].id)
        self.tick = reply.tick

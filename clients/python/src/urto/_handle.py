"""What the sync and the asyncio handles of a body have in common."""

from __future__ import annotations

from urto._exceptions import InvalidArgument
from urto._proto.v1 import scene_pb2


class Handle:
    """A body of a room, by id. Handles compare equal if their ids do.

    In an open batch the body is not there yet; it is then named by `name`, which the batch makes up if need be.
    """

    __slots__ = ("_id", "name")

    def __init__(self, body_id: int, name: str = "") -> None:
        self._id = body_id
        self.name = name

    @property
    def id(self) -> int:
        """The room's number for the body, > 0. InvalidArgument while its batch has not been sent."""
        if self._id == 0:
            raise InvalidArgument("the body has no id before its batch is sent")
        return self._id

    def _settle(self, body_id: int) -> None:
        """Gives the handle its id when the answer to its batch is there."""
        self._id = body_id

    def _to_proto(self) -> scene_pb2.BodyRef:
        return scene_pb2.BodyRef(id=self._id) if self._id else scene_pb2.BodyRef(name=self.name)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Handle):
            return NotImplemented
        return self is other or (self._id != 0 and self._id == other._id)

    def __hash__(self) -> int:
        return hash(self.id)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} id={self._id or 'pending'}{f' name={self.name!r}' if self.name else ''}>"

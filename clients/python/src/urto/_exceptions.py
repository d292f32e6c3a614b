"""Every error that the client raises.

UrtoError
├── InvalidArgument (ValueError)    what was asked makes no sense before it is sent
├── ConnectionFailed                no server at the endpoint, or it refused the credentials
├── ConnectionLost                  the room went away while it was in use
├── RoomNotFound                    the server answers, but has no such room (or several and none was named)
├── RequestTimeout (TimeoutError)   no answer in time
├── ProtocolError                   the answer cannot be read: another protocol version, or a broken message
├── ClosedError                     the room was closed by this program
├── EventGap                        events are gone for good: more were missed than the room keeps
└── Rejected                        the room refused a batch; nothing of it was done
    ├── Malformed                   not a batch, or a command without content
    ├── InvalidValue                a number or text outside its range; NaN
    ├── UnknownBody                 no body of that id or name
    ├── DuplicateName               a body of that name is there already
    ├── DegenerateShape             a polygon without area, crossing itself, or too thin
    ├── WrongBodyType               an impulse on a static body, say
    ├── NotPermitted                the member's role does not allow it
    ├── QuotaExceeded               a limit of the room on bodies, shapes, or batch size
    ├── QueueFull                   more commands waiting than the member's queue holds
    ├── NotPaused                   step needs a paused room
    ├── Cancelled                   a reset or shutdown overtook the step
    ├── UnknownJoint                no joint of that id or name
    ├── WrongJointKind              a motor of a weld, say
    └── NotSupported                the solver of the room cannot do it
"""

from __future__ import annotations

from urto._proto.v1 import command_pb2


class UrtoError(Exception):
    """Base of all errors of this package."""


class InvalidArgument(UrtoError, ValueError):
    """What was asked makes no sense before it is sent; the message says which argument."""


class ConnectionFailed(UrtoError):
    """No server at the endpoint, or it refused the credentials (Zenoh does not tell these apart)."""


class ConnectionLost(UrtoError):
    """The room went away while it was in use: its server ended or the network broke."""


class RoomNotFound(UrtoError):
    """The server answers, but has no such room, or several and none was named.

    Attributes:
        rooms: names of the rooms that are there.
    """

    def __init__(self, message: str, rooms: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.rooms = rooms


class RequestTimeout(UrtoError, TimeoutError):
    """No answer in time. Whether a command took effect is not known."""


class ProtocolError(UrtoError):
    """The answer cannot be read: another protocol version, or a broken message."""


class ClosedError(UrtoError):
    """The room was closed by this program."""


class EventGap(UrtoError):
    """Events are gone for good: more were missed than the room keeps, or the room was restarted.

    The iterator that raised it goes on with the next event that is there.

    Attributes:
        first: sequence number of the first missing event.
        last: sequence number of the last missing event; below `first` if the room was restarted and the
            count is not known.
    """

    def __init__(self, message: str, first: int, last: int) -> None:
        super().__init__(message)
        self.first = first
        self.last = last


class Rejected(UrtoError):
    """The room refused a batch; nothing of it was done.

    Attributes:
        code: name of the reason, e.g. "INVALID_VALUE".
        index: index of the refused command in its batch, from 0.
        field: path of the field in the schema, e.g. "spawn.body.shapes[0].box.width"; may be empty.
        value: what was sent there, as text.
        tick: ticks done when the batch was refused.
    """

    code = "UNSPECIFIED"

    def __init__(self, message: str, *, index: int = 0, field: str = "", value: str = "", tick: int = 0) -> None:
        super().__init__(message)
        self.index = index
        self.field = field
        self.value = value
        self.tick = tick


class Malformed(Rejected):
    """Not a batch, a command without content, or an unknown enum value."""

    code = "MALFORMED"


class InvalidValue(Rejected):
    """A number or text outside its range; NaN."""

    code = "INVALID_VALUE"


class UnknownBody(Rejected):
    """No body of that id or name is in the room."""

    code = "UNKNOWN_BODY"


class DuplicateName(Rejected):
    """A body of that name is in the room already."""

    code = "DUPLICATE_NAME"


class DegenerateShape(Rejected):
    """A polygon without area, crossing itself, or too thin."""

    code = "DEGENERATE_SHAPE"


class WrongBodyType(Rejected):
    """The command does not go with the type of the body: an impulse on a static one, say."""

    code = "WRONG_BODY_TYPE"


class NotPermitted(Rejected):
    """The member's role does not allow it."""

    code = "NOT_PERMITTED"


class QuotaExceeded(Rejected):
    """A limit of the room on bodies, shapes, or batch size."""

    code = "QUOTA"


class QueueFull(Rejected):
    """More commands are waiting than the member's queue holds."""

    code = "QUEUE_FULL"


class NotPaused(Rejected):
    """Stepping needs a paused room."""

    code = "NOT_PAUSED"


class Cancelled(Rejected):
    """A reset or shutdown overtook the step."""

    code = "CANCELLED"


class UnknownJoint(Rejected):
    """No joint of that id or name is in the room."""

    code = "UNKNOWN_JOINT"


class WrongJointKind(Rejected):
    """The command does not go with the kind of the joint: a motor of a weld, say."""

    code = "WRONG_JOINT_KIND"


class NotSupported(Rejected):
    """The solver of the room cannot do it."""

    code = "NOT_SUPPORTED"


_REJECTIONS: dict[str, type[Rejected]] = {
    kind.code: kind
    for kind in (
        Malformed, InvalidValue, UnknownBody, DuplicateName, DegenerateShape, WrongBodyType, NotPermitted,
        QuotaExceeded, QueueFull, NotPaused, Cancelled, UnknownJoint, WrongJointKind, NotSupported,
    )
}  # fmt: skip


def rejection_from_proto(reply: command_pb2.CommandReply) -> Rejected:
    """The typed exception for a reply whose `rejection` is set."""
    rejection = reply.rejection
    try:
        code = command_pb2.RejectionCode.Name(rejection.code).removeprefix("REJECTION_CODE_")
    except ValueError:  # a newer server may know more codes
        code = str(int(rejection.code))
    text = rejection.message or f"rejected: {code}"
    if rejection.field and rejection.field not in text:
        text += f" ({rejection.field} = {rejection.value})"
    kind = _REJECTIONS.get(code, Rejected)
    error = kind(text, index=rejection.index, field=rejection.field, value=rejection.value, tick=reply.tick)
    if kind is Rejected:
        error.code = code
    return error

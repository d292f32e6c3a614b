from urto._proto.v1 import scene_pb2 as _scene_pb2
from urto._proto.v1 import snapshot_pb2 as _snapshot_pb2
from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor
PERMISSION_EVERYONE: Permission
PERMISSION_NOBODY: Permission
PERMISSION_OWNERS: Permission
PERMISSION_UNSPECIFIED: Permission

class Feature(_message.Message):
    __slots__ = ["choice", "name", "on", "reason"]
    CHOICE_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    ON_FIELD_NUMBER: _ClassVar[int]
    REASON_FIELD_NUMBER: _ClassVar[int]
    choice: str
    name: str
    on: bool
    reason: str
    def __init__(self, name: _Optional[str] = ..., choice: _Optional[str] = ..., on: bool = ..., reason: _Optional[str] = ...) -> None: ...

class Limits(_message.Message):
    __slots__ = ["batch_commands_max", "batches_per_tick_max", "bodies_max", "events_kept_max", "joints_max", "members_max", "message_bytes_max", "queue_batches_max", "shapes_max", "step_ticks_max"]
    BATCHES_PER_TICK_MAX_FIELD_NUMBER: _ClassVar[int]
    BATCH_COMMANDS_MAX_FIELD_NUMBER: _ClassVar[int]
    BODIES_MAX_FIELD_NUMBER: _ClassVar[int]
    EVENTS_KEPT_MAX_FIELD_NUMBER: _ClassVar[int]
    JOINTS_MAX_FIELD_NUMBER: _ClassVar[int]
    MEMBERS_MAX_FIELD_NUMBER: _ClassVar[int]
    MESSAGE_BYTES_MAX_FIELD_NUMBER: _ClassVar[int]
    QUEUE_BATCHES_MAX_FIELD_NUMBER: _ClassVar[int]
    SHAPES_MAX_FIELD_NUMBER: _ClassVar[int]
    STEP_TICKS_MAX_FIELD_NUMBER: _ClassVar[int]
    batch_commands_max: int
    batches_per_tick_max: int
    bodies_max: int
    events_kept_max: int
    joints_max: int
    members_max: int
    message_bytes_max: int
    queue_batches_max: int
    shapes_max: int
    step_ticks_max: int
    def __init__(self, bodies_max: _Optional[int] = ..., shapes_max: _Optional[int] = ..., batch_commands_max: _Optional[int] = ..., queue_batches_max: _Optional[int] = ..., batches_per_tick_max: _Optional[int] = ..., message_bytes_max: _Optional[int] = ..., members_max: _Optional[int] = ..., events_kept_max: _Optional[int] = ..., step_ticks_max: _Optional[int] = ..., joints_max: _Optional[int] = ...) -> None: ...

class Member(_message.Message):
    __slots__ = ["session", "user"]
    SESSION_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    session: str
    user: str
    def __init__(self, user: _Optional[str] = ..., session: _Optional[str] = ...) -> None: ...

class RoomInfo(_message.Message):
    __slots__ = ["authenticated", "control", "description", "epoch", "limits", "members", "model", "paused", "precision", "protocol_version", "room", "scene", "server_version", "snapshot_rate_hz", "state_hash", "statistics", "tick", "time_scale", "time_step", "uptime"]
    AUTHENTICATED_FIELD_NUMBER: _ClassVar[int]
    CONTROL_FIELD_NUMBER: _ClassVar[int]
    DESCRIPTION_FIELD_NUMBER: _ClassVar[int]
    EPOCH_FIELD_NUMBER: _ClassVar[int]
    LIMITS_FIELD_NUMBER: _ClassVar[int]
    MEMBERS_FIELD_NUMBER: _ClassVar[int]
    MODEL_FIELD_NUMBER: _ClassVar[int]
    PAUSED_FIELD_NUMBER: _ClassVar[int]
    PRECISION_FIELD_NUMBER: _ClassVar[int]
    PROTOCOL_VERSION_FIELD_NUMBER: _ClassVar[int]
    ROOM_FIELD_NUMBER: _ClassVar[int]
    SCENE_FIELD_NUMBER: _ClassVar[int]
    SERVER_VERSION_FIELD_NUMBER: _ClassVar[int]
    SNAPSHOT_RATE_HZ_FIELD_NUMBER: _ClassVar[int]
    STATE_HASH_FIELD_NUMBER: _ClassVar[int]
    STATISTICS_FIELD_NUMBER: _ClassVar[int]
    TICK_FIELD_NUMBER: _ClassVar[int]
    TIME_SCALE_FIELD_NUMBER: _ClassVar[int]
    TIME_STEP_FIELD_NUMBER: _ClassVar[int]
    UPTIME_FIELD_NUMBER: _ClassVar[int]
    authenticated: bool
    control: Permission
    description: str
    epoch: int
    limits: Limits
    members: _containers.RepeatedCompositeFieldContainer[Member]
    model: _containers.RepeatedCompositeFieldContainer[Feature]
    paused: bool
    precision: _scene_pb2.Precision
    protocol_version: int
    room: str
    scene: str
    server_version: str
    snapshot_rate_hz: float
    state_hash: int
    statistics: _snapshot_pb2.Statistics
    tick: int
    time_scale: float
    time_step: float
    uptime: float
    def __init__(self, room: _Optional[str] = ..., server_version: _Optional[str] = ..., protocol_version: _Optional[int] = ..., scene: _Optional[str] = ..., description: _Optional[str] = ..., epoch: _Optional[int] = ..., tick: _Optional[int] = ..., time_step: _Optional[float] = ..., time_scale: _Optional[float] = ..., snapshot_rate_hz: _Optional[float] = ..., paused: bool = ..., members: _Optional[_Iterable[_Union[Member, _Mapping]]] = ..., model: _Optional[_Iterable[_Union[Feature, _Mapping]]] = ..., limits: _Optional[_Union[Limits, _Mapping]] = ..., statistics: _Optional[_Union[_snapshot_pb2.Statistics, _Mapping]] = ..., control: _Optional[_Union[Permission, str]] = ..., authenticated: bool = ..., uptime: _Optional[float] = ..., state_hash: _Optional[int] = ..., precision: _Optional[_Union[_scene_pb2.Precision, str]] = ...) -> None: ...

class RoomState(_message.Message):
    __slots__ = ["bodies", "info", "joints", "saved_state", "scene", "snapshot"]
    BODIES_FIELD_NUMBER: _ClassVar[int]
    INFO_FIELD_NUMBER: _ClassVar[int]
    JOINTS_FIELD_NUMBER: _ClassVar[int]
    SAVED_STATE_FIELD_NUMBER: _ClassVar[int]
    SCENE_FIELD_NUMBER: _ClassVar[int]
    SNAPSHOT_FIELD_NUMBER: _ClassVar[int]
    bodies: _containers.RepeatedCompositeFieldContainer[_snapshot_pb2.BodyInfo]
    info: RoomInfo
    joints: _containers.RepeatedCompositeFieldContainer[_snapshot_pb2.JointInfo]
    saved_state: bytes
    scene: _scene_pb2.Scene
    snapshot: _snapshot_pb2.Snapshot
    def __init__(self, info: _Optional[_Union[RoomInfo, _Mapping]] = ..., scene: _Optional[_Union[_scene_pb2.Scene, _Mapping]] = ..., bodies: _Optional[_Iterable[_Union[_snapshot_pb2.BodyInfo, _Mapping]]] = ..., snapshot: _Optional[_Union[_snapshot_pb2.Snapshot, _Mapping]] = ..., joints: _Optional[_Iterable[_Union[_snapshot_pb2.JointInfo, _Mapping]]] = ..., saved_state: _Optional[bytes] = ...) -> None: ...

class Permission(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

from urto._proto.v1 import scene_pb2 as _scene_pb2
from google.protobuf.internal import containers as _containers
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class BatchRejected(_message.Message):
    __slots__ = ["reason", "sequence", "user"]
    REASON_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    reason: str
    sequence: int
    user: str
    def __init__(self, user: _Optional[str] = ..., sequence: _Optional[int] = ..., reason: _Optional[str] = ...) -> None: ...

class BodyAdded(_message.Message):
    __slots__ = ["body", "id", "layout", "user"]
    BODY_FIELD_NUMBER: _ClassVar[int]
    ID_FIELD_NUMBER: _ClassVar[int]
    LAYOUT_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    body: _scene_pb2.Body
    id: int
    layout: int
    user: str
    def __init__(self, id: _Optional[int] = ..., body: _Optional[_Union[_scene_pb2.Body, _Mapping]] = ..., layout: _Optional[int] = ..., user: _Optional[str] = ...) -> None: ...

class BodyInfo(_message.Message):
    __slots__ = ["angle", "angular_velocity", "awake", "body", "center_of_mass", "id", "inertia", "mass", "position", "velocity"]
    ANGLE_FIELD_NUMBER: _ClassVar[int]
    ANGULAR_VELOCITY_FIELD_NUMBER: _ClassVar[int]
    AWAKE_FIELD_NUMBER: _ClassVar[int]
    BODY_FIELD_NUMBER: _ClassVar[int]
    CENTER_OF_MASS_FIELD_NUMBER: _ClassVar[int]
    ID_FIELD_NUMBER: _ClassVar[int]
    INERTIA_FIELD_NUMBER: _ClassVar[int]
    MASS_FIELD_NUMBER: _ClassVar[int]
    POSITION_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_FIELD_NUMBER: _ClassVar[int]
    angle: float
    angular_velocity: float
    awake: bool
    body: _scene_pb2.Body
    center_of_mass: _scene_pb2.Vector
    id: int
    inertia: float
    mass: float
    position: _scene_pb2.Vector
    velocity: _scene_pb2.Vector
    def __init__(self, id: _Optional[int] = ..., body: _Optional[_Union[_scene_pb2.Body, _Mapping]] = ..., mass: _Optional[float] = ..., inertia: _Optional[float] = ..., center_of_mass: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., position: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., angle: _Optional[float] = ..., velocity: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., angular_velocity: _Optional[float] = ..., awake: bool = ...) -> None: ...

class BodyRemoved(_message.Message):
    __slots__ = ["id", "layout", "user"]
    ID_FIELD_NUMBER: _ClassVar[int]
    LAYOUT_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    id: int
    layout: int
    user: str
    def __init__(self, id: _Optional[int] = ..., layout: _Optional[int] = ..., user: _Optional[str] = ...) -> None: ...

class ContactBegin(_message.Message):
    __slots__ = ["approach_speed", "body_a", "body_b", "normal", "point", "sensor"]
    APPROACH_SPEED_FIELD_NUMBER: _ClassVar[int]
    BODY_A_FIELD_NUMBER: _ClassVar[int]
    BODY_B_FIELD_NUMBER: _ClassVar[int]
    NORMAL_FIELD_NUMBER: _ClassVar[int]
    POINT_FIELD_NUMBER: _ClassVar[int]
    SENSOR_FIELD_NUMBER: _ClassVar[int]
    approach_speed: float
    body_a: int
    body_b: int
    normal: _scene_pb2.Vector
    point: _scene_pb2.Vector
    sensor: bool
    def __init__(self, body_a: _Optional[int] = ..., body_b: _Optional[int] = ..., point: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., normal: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., approach_speed: _Optional[float] = ..., sensor: bool = ...) -> None: ...

class ContactEnd(_message.Message):
    __slots__ = ["body_a", "body_b", "sensor"]
    BODY_A_FIELD_NUMBER: _ClassVar[int]
    BODY_B_FIELD_NUMBER: _ClassVar[int]
    SENSOR_FIELD_NUMBER: _ClassVar[int]
    body_a: int
    body_b: int
    sensor: bool
    def __init__(self, body_a: _Optional[int] = ..., body_b: _Optional[int] = ..., sensor: bool = ...) -> None: ...

class ContactHit(_message.Message):
    __slots__ = ["approach_speed", "body_a", "body_b", "normal", "point"]
    APPROACH_SPEED_FIELD_NUMBER: _ClassVar[int]
    BODY_A_FIELD_NUMBER: _ClassVar[int]
    BODY_B_FIELD_NUMBER: _ClassVar[int]
    NORMAL_FIELD_NUMBER: _ClassVar[int]
    POINT_FIELD_NUMBER: _ClassVar[int]
    approach_speed: float
    body_a: int
    body_b: int
    normal: _scene_pb2.Vector
    point: _scene_pb2.Vector
    def __init__(self, body_a: _Optional[int] = ..., body_b: _Optional[int] = ..., point: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., normal: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., approach_speed: _Optional[float] = ...) -> None: ...

class Contacts(_message.Message):
    __slots__ = ["body_a", "body_b", "normal_impulse", "normal_x", "normal_y", "separation", "tangent_impulse", "x", "y"]
    BODY_A_FIELD_NUMBER: _ClassVar[int]
    BODY_B_FIELD_NUMBER: _ClassVar[int]
    NORMAL_IMPULSE_FIELD_NUMBER: _ClassVar[int]
    NORMAL_X_FIELD_NUMBER: _ClassVar[int]
    NORMAL_Y_FIELD_NUMBER: _ClassVar[int]
    SEPARATION_FIELD_NUMBER: _ClassVar[int]
    TANGENT_IMPULSE_FIELD_NUMBER: _ClassVar[int]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    body_a: _containers.RepeatedScalarFieldContainer[int]
    body_b: _containers.RepeatedScalarFieldContainer[int]
    normal_impulse: _containers.RepeatedScalarFieldContainer[float]
    normal_x: _containers.RepeatedScalarFieldContainer[float]
    normal_y: _containers.RepeatedScalarFieldContainer[float]
    separation: _containers.RepeatedScalarFieldContainer[float]
    tangent_impulse: _containers.RepeatedScalarFieldContainer[float]
    x: _containers.RepeatedScalarFieldContainer[float]
    y: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, body_a: _Optional[_Iterable[int]] = ..., body_b: _Optional[_Iterable[int]] = ..., x: _Optional[_Iterable[float]] = ..., y: _Optional[_Iterable[float]] = ..., normal_x: _Optional[_Iterable[float]] = ..., normal_y: _Optional[_Iterable[float]] = ..., separation: _Optional[_Iterable[float]] = ..., normal_impulse: _Optional[_Iterable[float]] = ..., tangent_impulse: _Optional[_Iterable[float]] = ...) -> None: ...

class Diagnostics(_message.Message):
    __slots__ = ["angular_momentum", "kinetic_energy", "momentum", "potential_energy", "sim_time", "state_hash", "statistics", "tick"]
    ANGULAR_MOMENTUM_FIELD_NUMBER: _ClassVar[int]
    KINETIC_ENERGY_FIELD_NUMBER: _ClassVar[int]
    MOMENTUM_FIELD_NUMBER: _ClassVar[int]
    POTENTIAL_ENERGY_FIELD_NUMBER: _ClassVar[int]
    SIM_TIME_FIELD_NUMBER: _ClassVar[int]
    STATE_HASH_FIELD_NUMBER: _ClassVar[int]
    STATISTICS_FIELD_NUMBER: _ClassVar[int]
    TICK_FIELD_NUMBER: _ClassVar[int]
    angular_momentum: float
    kinetic_energy: float
    momentum: _scene_pb2.Vector
    potential_energy: float
    sim_time: float
    state_hash: int
    statistics: Statistics
    tick: int
    def __init__(self, tick: _Optional[int] = ..., sim_time: _Optional[float] = ..., state_hash: _Optional[int] = ..., kinetic_energy: _Optional[float] = ..., potential_energy: _Optional[float] = ..., momentum: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., angular_momentum: _Optional[float] = ..., statistics: _Optional[_Union[Statistics, _Mapping]] = ...) -> None: ...

class Event(_message.Message):
    __slots__ = ["batch_rejected", "body_added", "body_removed", "contact_begin", "contact_end", "contact_hit", "events_dropped", "joint_added", "joint_broke", "joint_removed", "member_joined", "member_left", "room_paused", "room_reset", "room_resumed", "tick", "time_scale_changed"]
    BATCH_REJECTED_FIELD_NUMBER: _ClassVar[int]
    BODY_ADDED_FIELD_NUMBER: _ClassVar[int]
    BODY_REMOVED_FIELD_NUMBER: _ClassVar[int]
    CONTACT_BEGIN_FIELD_NUMBER: _ClassVar[int]
    CONTACT_END_FIELD_NUMBER: _ClassVar[int]
    CONTACT_HIT_FIELD_NUMBER: _ClassVar[int]
    EVENTS_DROPPED_FIELD_NUMBER: _ClassVar[int]
    JOINT_ADDED_FIELD_NUMBER: _ClassVar[int]
    JOINT_BROKE_FIELD_NUMBER: _ClassVar[int]
    JOINT_REMOVED_FIELD_NUMBER: _ClassVar[int]
    MEMBER_JOINED_FIELD_NUMBER: _ClassVar[int]
    MEMBER_LEFT_FIELD_NUMBER: _ClassVar[int]
    ROOM_PAUSED_FIELD_NUMBER: _ClassVar[int]
    ROOM_RESET_FIELD_NUMBER: _ClassVar[int]
    ROOM_RESUMED_FIELD_NUMBER: _ClassVar[int]
    TICK_FIELD_NUMBER: _ClassVar[int]
    TIME_SCALE_CHANGED_FIELD_NUMBER: _ClassVar[int]
    batch_rejected: BatchRejected
    body_added: BodyAdded
    body_removed: BodyRemoved
    contact_begin: ContactBegin
    contact_end: ContactEnd
    contact_hit: ContactHit
    events_dropped: EventsDropped
    joint_added: JointAdded
    joint_broke: JointBroke
    joint_removed: JointRemoved
    member_joined: MemberJoined
    member_left: MemberLeft
    room_paused: RoomPaused
    room_reset: RoomReset
    room_resumed: RoomResumed
    tick: int
    time_scale_changed: TimeScaleChanged
    def __init__(self, tick: _Optional[int] = ..., contact_begin: _Optional[_Union[ContactBegin, _Mapping]] = ..., contact_end: _Optional[_Union[ContactEnd, _Mapping]] = ..., body_added: _Optional[_Union[BodyAdded, _Mapping]] = ..., body_removed: _Optional[_Union[BodyRemoved, _Mapping]] = ..., member_joined: _Optional[_Union[MemberJoined, _Mapping]] = ..., member_left: _Optional[_Union[MemberLeft, _Mapping]] = ..., room_paused: _Optional[_Union[RoomPaused, _Mapping]] = ..., room_resumed: _Optional[_Union[RoomResumed, _Mapping]] = ..., room_reset: _Optional[_Union[RoomReset, _Mapping]] = ..., time_scale_changed: _Optional[_Union[TimeScaleChanged, _Mapping]] = ..., batch_rejected: _Optional[_Union[BatchRejected, _Mapping]] = ..., events_dropped: _Optional[_Union[EventsDropped, _Mapping]] = ..., joint_added: _Optional[_Union[JointAdded, _Mapping]] = ..., joint_removed: _Optional[_Union[JointRemoved, _Mapping]] = ..., joint_broke: _Optional[_Union[JointBroke, _Mapping]] = ..., contact_hit: _Optional[_Union[ContactHit, _Mapping]] = ...) -> None: ...

class EventBatch(_message.Message):
    __slots__ = ["epoch", "events", "first_sequence", "oldest_sequence"]
    EPOCH_FIELD_NUMBER: _ClassVar[int]
    EVENTS_FIELD_NUMBER: _ClassVar[int]
    FIRST_SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    OLDEST_SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    epoch: int
    events: _containers.RepeatedCompositeFieldContainer[Event]
    first_sequence: int
    oldest_sequence: int
    def __init__(self, epoch: _Optional[int] = ..., first_sequence: _Optional[int] = ..., events: _Optional[_Iterable[_Union[Event, _Mapping]]] = ..., oldest_sequence: _Optional[int] = ...) -> None: ...

class EventsDropped(_message.Message):
    __slots__ = ["count"]
    COUNT_FIELD_NUMBER: _ClassVar[int]
    count: int
    def __init__(self, count: _Optional[int] = ...) -> None: ...

class JointAdded(_message.Message):
    __slots__ = ["id", "joint", "user"]
    ID_FIELD_NUMBER: _ClassVar[int]
    JOINT_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    id: int
    joint: _scene_pb2.Joint
    user: str
    def __init__(self, id: _Optional[int] = ..., joint: _Optional[_Union[_scene_pb2.Joint, _Mapping]] = ..., user: _Optional[str] = ...) -> None: ...

class JointBroke(_message.Message):
    __slots__ = ["body_a", "body_b", "force", "id", "point", "torque"]
    BODY_A_FIELD_NUMBER: _ClassVar[int]
    BODY_B_FIELD_NUMBER: _ClassVar[int]
    FORCE_FIELD_NUMBER: _ClassVar[int]
    ID_FIELD_NUMBER: _ClassVar[int]
    POINT_FIELD_NUMBER: _ClassVar[int]
    TORQUE_FIELD_NUMBER: _ClassVar[int]
    body_a: int
    body_b: int
    force: float
    id: int
    point: _scene_pb2.Vector
    torque: float
    def __init__(self, id: _Optional[int] = ..., body_a: _Optional[int] = ..., body_b: _Optional[int] = ..., point: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., force: _Optional[float] = ..., torque: _Optional[float] = ...) -> None: ...

class JointInfo(_message.Message):
    __slots__ = ["id", "joint", "state"]
    ID_FIELD_NUMBER: _ClassVar[int]
    JOINT_FIELD_NUMBER: _ClassVar[int]
    STATE_FIELD_NUMBER: _ClassVar[int]
    id: int
    joint: _scene_pb2.Joint
    state: JointState
    def __init__(self, id: _Optional[int] = ..., joint: _Optional[_Union[_scene_pb2.Joint, _Mapping]] = ..., state: _Optional[_Union[JointState, _Mapping]] = ...) -> None: ...

class JointRemoved(_message.Message):
    __slots__ = ["id", "user"]
    ID_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    id: int
    user: str
    def __init__(self, id: _Optional[int] = ..., user: _Optional[str] = ...) -> None: ...

class JointState(_message.Message):
    __slots__ = ["force", "motor", "point_a", "point_b", "position", "speed", "torque"]
    FORCE_FIELD_NUMBER: _ClassVar[int]
    MOTOR_FIELD_NUMBER: _ClassVar[int]
    POINT_A_FIELD_NUMBER: _ClassVar[int]
    POINT_B_FIELD_NUMBER: _ClassVar[int]
    POSITION_FIELD_NUMBER: _ClassVar[int]
    SPEED_FIELD_NUMBER: _ClassVar[int]
    TORQUE_FIELD_NUMBER: _ClassVar[int]
    force: _scene_pb2.Vector
    motor: _scene_pb2.JointMotor
    point_a: _scene_pb2.Vector
    point_b: _scene_pb2.Vector
    position: float
    speed: float
    torque: float
    def __init__(self, point_a: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., point_b: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., position: _Optional[float] = ..., speed: _Optional[float] = ..., force: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., torque: _Optional[float] = ..., motor: _Optional[_Union[_scene_pb2.JointMotor, _Mapping]] = ...) -> None: ...

class Joints(_message.Message):
    __slots__ = ["joints"]
    JOINTS_FIELD_NUMBER: _ClassVar[int]
    joints: _containers.RepeatedCompositeFieldContainer[JointInfo]
    def __init__(self, joints: _Optional[_Iterable[_Union[JointInfo, _Mapping]]] = ...) -> None: ...

class MemberJoined(_message.Message):
    __slots__ = ["session", "user"]
    SESSION_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    session: str
    user: str
    def __init__(self, user: _Optional[str] = ..., session: _Optional[str] = ...) -> None: ...

class MemberLeft(_message.Message):
    __slots__ = ["session", "user"]
    SESSION_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    session: str
    user: str
    def __init__(self, user: _Optional[str] = ..., session: _Optional[str] = ...) -> None: ...

class PhaseTime(_message.Message):
    __slots__ = ["ms", "name"]
    MS_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    ms: float
    name: str
    def __init__(self, name: _Optional[str] = ..., ms: _Optional[float] = ...) -> None: ...

class RoomPaused(_message.Message):
    __slots__ = ["user"]
    USER_FIELD_NUMBER: _ClassVar[int]
    user: str
    def __init__(self, user: _Optional[str] = ...) -> None: ...

class RoomReset(_message.Message):
    __slots__ = ["epoch", "user"]
    EPOCH_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    epoch: int
    user: str
    def __init__(self, user: _Optional[str] = ..., epoch: _Optional[int] = ...) -> None: ...

class RoomResumed(_message.Message):
    __slots__ = ["user"]
    USER_FIELD_NUMBER: _ClassVar[int]
    user: str
    def __init__(self, user: _Optional[str] = ...) -> None: ...

class Snapshot(_message.Message):
    __slots__ = ["angle", "angle_double", "angular_velocity", "angular_velocity_double", "awake", "epoch", "event_sequence", "full", "id", "layout", "paused", "sim_time", "state_hash", "statistics", "tick", "velocity_x", "velocity_x_double", "velocity_y", "velocity_y_double", "x", "x_double", "y", "y_double"]
    ANGLE_DOUBLE_FIELD_NUMBER: _ClassVar[int]
    ANGLE_FIELD_NUMBER: _ClassVar[int]
    ANGULAR_VELOCITY_DOUBLE_FIELD_NUMBER: _ClassVar[int]
    ANGULAR_VELOCITY_FIELD_NUMBER: _ClassVar[int]
    AWAKE_FIELD_NUMBER: _ClassVar[int]
    EPOCH_FIELD_NUMBER: _ClassVar[int]
    EVENT_SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    FULL_FIELD_NUMBER: _ClassVar[int]
    ID_FIELD_NUMBER: _ClassVar[int]
    LAYOUT_FIELD_NUMBER: _ClassVar[int]
    PAUSED_FIELD_NUMBER: _ClassVar[int]
    SIM_TIME_FIELD_NUMBER: _ClassVar[int]
    STATE_HASH_FIELD_NUMBER: _ClassVar[int]
    STATISTICS_FIELD_NUMBER: _ClassVar[int]
    TICK_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_X_DOUBLE_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_X_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_Y_DOUBLE_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_Y_FIELD_NUMBER: _ClassVar[int]
    X_DOUBLE_FIELD_NUMBER: _ClassVar[int]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_DOUBLE_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    angle: _containers.RepeatedScalarFieldContainer[float]
    angle_double: _containers.RepeatedScalarFieldContainer[float]
    angular_velocity: _containers.RepeatedScalarFieldContainer[float]
    angular_velocity_double: _containers.RepeatedScalarFieldContainer[float]
    awake: bytes
    epoch: int
    event_sequence: int
    full: bool
    id: _containers.RepeatedScalarFieldContainer[int]
    layout: int
    paused: bool
    sim_time: float
    state_hash: int
    statistics: Statistics
    tick: int
    velocity_x: _containers.RepeatedScalarFieldContainer[float]
    velocity_x_double: _containers.RepeatedScalarFieldContainer[float]
    velocity_y: _containers.RepeatedScalarFieldContainer[float]
    velocity_y_double: _containers.RepeatedScalarFieldContainer[float]
    x: _containers.RepeatedScalarFieldContainer[float]
    x_double: _containers.RepeatedScalarFieldContainer[float]
    y: _containers.RepeatedScalarFieldContainer[float]
    y_double: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, epoch: _Optional[int] = ..., tick: _Optional[int] = ..., sim_time: _Optional[float] = ..., layout: _Optional[int] = ..., id: _Optional[_Iterable[int]] = ..., x: _Optional[_Iterable[float]] = ..., y: _Optional[_Iterable[float]] = ..., angle: _Optional[_Iterable[float]] = ..., velocity_x: _Optional[_Iterable[float]] = ..., velocity_y: _Optional[_Iterable[float]] = ..., angular_velocity: _Optional[_Iterable[float]] = ..., x_double: _Optional[_Iterable[float]] = ..., y_double: _Optional[_Iterable[float]] = ..., angle_double: _Optional[_Iterable[float]] = ..., velocity_x_double: _Optional[_Iterable[float]] = ..., velocity_y_double: _Optional[_Iterable[float]] = ..., angular_velocity_double: _Optional[_Iterable[float]] = ..., awake: _Optional[bytes] = ..., paused: bool = ..., event_sequence: _Optional[int] = ..., state_hash: _Optional[int] = ..., full: bool = ..., statistics: _Optional[_Union[Statistics, _Mapping]] = ...) -> None: ...

class Statistics(_message.Message):
    __slots__ = ["awake_count", "body_count", "contact_count", "kinetic_energy", "member_count", "overrun_count", "penetration_max", "phases", "potential_energy", "step_ms"]
    AWAKE_COUNT_FIELD_NUMBER: _ClassVar[int]
    BODY_COUNT_FIELD_NUMBER: _ClassVar[int]
    CONTACT_COUNT_FIELD_NUMBER: _ClassVar[int]
    KINETIC_ENERGY_FIELD_NUMBER: _ClassVar[int]
    MEMBER_COUNT_FIELD_NUMBER: _ClassVar[int]
    OVERRUN_COUNT_FIELD_NUMBER: _ClassVar[int]
    PENETRATION_MAX_FIELD_NUMBER: _ClassVar[int]
    PHASES_FIELD_NUMBER: _ClassVar[int]
    POTENTIAL_ENERGY_FIELD_NUMBER: _ClassVar[int]
    STEP_MS_FIELD_NUMBER: _ClassVar[int]
    awake_count: int
    body_count: int
    contact_count: int
    kinetic_energy: float
    member_count: int
    overrun_count: int
    penetration_max: float
    phases: _containers.RepeatedCompositeFieldContainer[PhaseTime]
    potential_energy: float
    step_ms: float
    def __init__(self, body_count: _Optional[int] = ..., awake_count: _Optional[int] = ..., contact_count: _Optional[int] = ..., step_ms: _Optional[float] = ..., overrun_count: _Optional[int] = ..., member_count: _Optional[int] = ..., kinetic_energy: _Optional[float] = ..., potential_energy: _Optional[float] = ..., penetration_max: _Optional[float] = ..., phases: _Optional[_Iterable[_Union[PhaseTime, _Mapping]]] = ...) -> None: ...

class TimeScaleChanged(_message.Message):
    __slots__ = ["scale", "user"]
    SCALE_FIELD_NUMBER: _ClassVar[int]
    USER_FIELD_NUMBER: _ClassVar[int]
    scale: float
    user: str
    def __init__(self, user: _Optional[str] = ..., scale: _Optional[float] = ...) -> None: ...

from urto._proto.v1 import scene_pb2 as _scene_pb2
from urto._proto.v1 import snapshot_pb2 as _snapshot_pb2
from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor
FRAME_BODY: Frame
FRAME_UNSPECIFIED: Frame
FRAME_WORLD: Frame
REJECTION_CODE_CANCELLED: RejectionCode
REJECTION_CODE_DEGENERATE_SHAPE: RejectionCode
REJECTION_CODE_DUPLICATE_NAME: RejectionCode
REJECTION_CODE_INVALID_VALUE: RejectionCode
REJECTION_CODE_MALFORMED: RejectionCode
REJECTION_CODE_NOT_PAUSED: RejectionCode
REJECTION_CODE_NOT_PERMITTED: RejectionCode
REJECTION_CODE_NOT_SUPPORTED: RejectionCode
REJECTION_CODE_QUEUE_FULL: RejectionCode
REJECTION_CODE_QUOTA: RejectionCode
REJECTION_CODE_UNKNOWN_BODY: RejectionCode
REJECTION_CODE_UNKNOWN_JOINT: RejectionCode
REJECTION_CODE_UNSPECIFIED: RejectionCode
REJECTION_CODE_WRONG_BODY_TYPE: RejectionCode
REJECTION_CODE_WRONG_JOINT_KIND: RejectionCode

class BodyHit(_message.Message):
    __slots__ = ["distance", "fraction", "id", "normal", "point", "query_point"]
    DISTANCE_FIELD_NUMBER: _ClassVar[int]
    FRACTION_FIELD_NUMBER: _ClassVar[int]
    ID_FIELD_NUMBER: _ClassVar[int]
    NORMAL_FIELD_NUMBER: _ClassVar[int]
    POINT_FIELD_NUMBER: _ClassVar[int]
    QUERY_POINT_FIELD_NUMBER: _ClassVar[int]
    distance: float
    fraction: float
    id: int
    normal: _scene_pb2.Vector
    point: _scene_pb2.Vector
    query_point: _scene_pb2.Vector
    def __init__(self, id: _Optional[int] = ..., point: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., normal: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., fraction: _Optional[float] = ..., distance: _Optional[float] = ..., query_point: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ...) -> None: ...

class BodyQuery(_message.Message):
    __slots__ = ["body"]
    BODY_FIELD_NUMBER: _ClassVar[int]
    body: _scene_pb2.BodyRef
    def __init__(self, body: _Optional[_Union[_scene_pb2.BodyRef, _Mapping]] = ...) -> None: ...

class CastQuery(_message.Message):
    __slots__ = ["count_max", "filter", "shape", "translation"]
    COUNT_MAX_FIELD_NUMBER: _ClassVar[int]
    FILTER_FIELD_NUMBER: _ClassVar[int]
    SHAPE_FIELD_NUMBER: _ClassVar[int]
    TRANSLATION_FIELD_NUMBER: _ClassVar[int]
    count_max: int
    filter: QueryFilter
    shape: QueryShape
    translation: _scene_pb2.Vector
    def __init__(self, shape: _Optional[_Union[QueryShape, _Mapping]] = ..., translation: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., filter: _Optional[_Union[QueryFilter, _Mapping]] = ..., count_max: _Optional[int] = ...) -> None: ...

class ClosestQuery(_message.Message):
    __slots__ = ["count_max", "distance_max", "filter", "shape"]
    COUNT_MAX_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_MAX_FIELD_NUMBER: _ClassVar[int]
    FILTER_FIELD_NUMBER: _ClassVar[int]
    SHAPE_FIELD_NUMBER: _ClassVar[int]
    count_max: int
    distance_max: float
    filter: QueryFilter
    shape: QueryShape
    def __init__(self, shape: _Optional[_Union[QueryShape, _Mapping]] = ..., distance_max: _Optional[float] = ..., filter: _Optional[_Union[QueryFilter, _Mapping]] = ..., count_max: _Optional[int] = ...) -> None: ...

class Command(_message.Message):
    __slots__ = ["create_joint", "despawn", "destroy_joint", "force", "impulse", "pause", "query", "reset", "resume", "set_motor", "set_target", "set_time_scale", "set_transform", "set_velocity", "spawn", "step"]
    CREATE_JOINT_FIELD_NUMBER: _ClassVar[int]
    DESPAWN_FIELD_NUMBER: _ClassVar[int]
    DESTROY_JOINT_FIELD_NUMBER: _ClassVar[int]
    FORCE_FIELD_NUMBER: _ClassVar[int]
    IMPULSE_FIELD_NUMBER: _ClassVar[int]
    PAUSE_FIELD_NUMBER: _ClassVar[int]
    QUERY_FIELD_NUMBER: _ClassVar[int]
    RESET_FIELD_NUMBER: _ClassVar[int]
    RESUME_FIELD_NUMBER: _ClassVar[int]
    SET_MOTOR_FIELD_NUMBER: _ClassVar[int]
    SET_TARGET_FIELD_NUMBER: _ClassVar[int]
    SET_TIME_SCALE_FIELD_NUMBER: _ClassVar[int]
    SET_TRANSFORM_FIELD_NUMBER: _ClassVar[int]
    SET_VELOCITY_FIELD_NUMBER: _ClassVar[int]
    SPAWN_FIELD_NUMBER: _ClassVar[int]
    STEP_FIELD_NUMBER: _ClassVar[int]
    create_joint: CreateJoint
    despawn: Despawn
    destroy_joint: DestroyJoint
    force: Force
    impulse: Impulse
    pause: Pause
    query: Query
    reset: Reset
    resume: Resume
    set_motor: SetMotor
    set_target: SetTarget
    set_time_scale: SetTimeScale
    set_transform: SetTransform
    set_velocity: SetVelocity
    spawn: Spawn
    step: Step
    def __init__(self, spawn: _Optional[_Union[Spawn, _Mapping]] = ..., despawn: _Optional[_Union[Despawn, _Mapping]] = ..., impulse: _Optional[_Union[Impulse, _Mapping]] = ..., force: _Optional[_Union[Force, _Mapping]] = ..., set_velocity: _Optional[_Union[SetVelocity, _Mapping]] = ..., set_transform: _Optional[_Union[SetTransform, _Mapping]] = ..., pause: _Optional[_Union[Pause, _Mapping]] = ..., resume: _Optional[_Union[Resume, _Mapping]] = ..., step: _Optional[_Union[Step, _Mapping]] = ..., reset: _Optional[_Union[Reset, _Mapping]] = ..., set_time_scale: _Optional[_Union[SetTimeScale, _Mapping]] = ..., query: _Optional[_Union[Query, _Mapping]] = ..., create_joint: _Optional[_Union[CreateJoint, _Mapping]] = ..., destroy_joint: _Optional[_Union[DestroyJoint, _Mapping]] = ..., set_motor: _Optional[_Union[SetMotor, _Mapping]] = ..., set_target: _Optional[_Union[SetTarget, _Mapping]] = ...) -> None: ...

class CommandBatch(_message.Message):
    __slots__ = ["commands", "sequence"]
    COMMANDS_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    commands: _containers.RepeatedCompositeFieldContainer[Command]
    sequence: int
    def __init__(self, sequence: _Optional[int] = ..., commands: _Optional[_Iterable[_Union[Command, _Mapping]]] = ...) -> None: ...

class CommandReply(_message.Message):
    __slots__ = ["epoch", "rejection", "results", "sequence", "tick"]
    EPOCH_FIELD_NUMBER: _ClassVar[int]
    REJECTION_FIELD_NUMBER: _ClassVar[int]
    RESULTS_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    TICK_FIELD_NUMBER: _ClassVar[int]
    epoch: int
    rejection: Rejection
    results: _containers.RepeatedCompositeFieldContainer[CommandResult]
    sequence: int
    tick: int
    def __init__(self, sequence: _Optional[int] = ..., tick: _Optional[int] = ..., results: _Optional[_Iterable[_Union[CommandResult, _Mapping]]] = ..., rejection: _Optional[_Union[Rejection, _Mapping]] = ..., epoch: _Optional[int] = ...) -> None: ...

class CommandResult(_message.Message):
    __slots__ = ["id", "query", "snapshot"]
    ID_FIELD_NUMBER: _ClassVar[int]
    QUERY_FIELD_NUMBER: _ClassVar[int]
    SNAPSHOT_FIELD_NUMBER: _ClassVar[int]
    id: int
    query: QueryResult
    snapshot: _snapshot_pb2.Snapshot
    def __init__(self, id: _Optional[int] = ..., query: _Optional[_Union[QueryResult, _Mapping]] = ..., snapshot: _Optional[_Union[_snapshot_pb2.Snapshot, _Mapping]] = ...) -> None: ...

class ContactsQuery(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class CreateJoint(_message.Message):
    __slots__ = ["joint"]
    JOINT_FIELD_NUMBER: _ClassVar[int]
    joint: _scene_pb2.Joint
    def __init__(self, joint: _Optional[_Union[_scene_pb2.Joint, _Mapping]] = ...) -> None: ...

class Despawn(_message.Message):
    __slots__ = ["body"]
    BODY_FIELD_NUMBER: _ClassVar[int]
    body: _scene_pb2.BodyRef
    def __init__(self, body: _Optional[_Union[_scene_pb2.BodyRef, _Mapping]] = ...) -> None: ...

class DestroyJoint(_message.Message):
    __slots__ = ["joint"]
    JOINT_FIELD_NUMBER: _ClassVar[int]
    joint: JointRef
    def __init__(self, joint: _Optional[_Union[JointRef, _Mapping]] = ...) -> None: ...

class DiagnosticsQuery(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class Force(_message.Message):
    __slots__ = ["body", "duration", "force", "frame", "torque"]
    BODY_FIELD_NUMBER: _ClassVar[int]
    DURATION_FIELD_NUMBER: _ClassVar[int]
    FORCE_FIELD_NUMBER: _ClassVar[int]
    FRAME_FIELD_NUMBER: _ClassVar[int]
    TORQUE_FIELD_NUMBER: _ClassVar[int]
    body: _scene_pb2.BodyRef
    duration: float
    force: _scene_pb2.Vector
    frame: Frame
    torque: float
    def __init__(self, body: _Optional[_Union[_scene_pb2.BodyRef, _Mapping]] = ..., force: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., torque: _Optional[float] = ..., frame: _Optional[_Union[Frame, str]] = ..., duration: _Optional[float] = ...) -> None: ...

class Impulse(_message.Message):
    __slots__ = ["angular", "body", "frame", "impulse", "point"]
    ANGULAR_FIELD_NUMBER: _ClassVar[int]
    BODY_FIELD_NUMBER: _ClassVar[int]
    FRAME_FIELD_NUMBER: _ClassVar[int]
    IMPULSE_FIELD_NUMBER: _ClassVar[int]
    POINT_FIELD_NUMBER: _ClassVar[int]
    angular: float
    body: _scene_pb2.BodyRef
    frame: Frame
    impulse: _scene_pb2.Vector
    point: _scene_pb2.Vector
    def __init__(self, body: _Optional[_Union[_scene_pb2.BodyRef, _Mapping]] = ..., impulse: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., point: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., frame: _Optional[_Union[Frame, str]] = ..., angular: _Optional[float] = ...) -> None: ...

class JointRef(_message.Message):
    __slots__ = ["id", "name"]
    ID_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    id: int
    name: str
    def __init__(self, id: _Optional[int] = ..., name: _Optional[str] = ...) -> None: ...

class JointsQuery(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class NearestQuery(_message.Message):
    __slots__ = ["count_max", "distance_max", "point"]
    COUNT_MAX_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_MAX_FIELD_NUMBER: _ClassVar[int]
    POINT_FIELD_NUMBER: _ClassVar[int]
    count_max: int
    distance_max: float
    point: _scene_pb2.Vector
    def __init__(self, point: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., distance_max: _Optional[float] = ..., count_max: _Optional[int] = ...) -> None: ...

class OverlapQuery(_message.Message):
    __slots__ = ["count_max", "filter", "shape"]
    COUNT_MAX_FIELD_NUMBER: _ClassVar[int]
    FILTER_FIELD_NUMBER: _ClassVar[int]
    SHAPE_FIELD_NUMBER: _ClassVar[int]
    count_max: int
    filter: QueryFilter
    shape: QueryShape
    def __init__(self, shape: _Optional[_Union[QueryShape, _Mapping]] = ..., filter: _Optional[_Union[QueryFilter, _Mapping]] = ..., count_max: _Optional[int] = ...) -> None: ...

class Pause(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class Point(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class PointQuery(_message.Message):
    __slots__ = ["point"]
    POINT_FIELD_NUMBER: _ClassVar[int]
    point: _scene_pb2.Vector
    def __init__(self, point: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ...) -> None: ...

class Query(_message.Message):
    __slots__ = ["body", "cast", "closest", "contacts", "diagnostics", "joints", "nearest", "overlap", "point", "ray", "region"]
    BODY_FIELD_NUMBER: _ClassVar[int]
    CAST_FIELD_NUMBER: _ClassVar[int]
    CLOSEST_FIELD_NUMBER: _ClassVar[int]
    CONTACTS_FIELD_NUMBER: _ClassVar[int]
    DIAGNOSTICS_FIELD_NUMBER: _ClassVar[int]
    JOINTS_FIELD_NUMBER: _ClassVar[int]
    NEAREST_FIELD_NUMBER: _ClassVar[int]
    OVERLAP_FIELD_NUMBER: _ClassVar[int]
    POINT_FIELD_NUMBER: _ClassVar[int]
    RAY_FIELD_NUMBER: _ClassVar[int]
    REGION_FIELD_NUMBER: _ClassVar[int]
    body: BodyQuery
    cast: CastQuery
    closest: ClosestQuery
    contacts: ContactsQuery
    diagnostics: DiagnosticsQuery
    joints: JointsQuery
    nearest: NearestQuery
    overlap: OverlapQuery
    point: PointQuery
    ray: RayQuery
    region: RegionQuery
    def __init__(self, point: _Optional[_Union[PointQuery, _Mapping]] = ..., region: _Optional[_Union[RegionQuery, _Mapping]] = ..., ray: _Optional[_Union[RayQuery, _Mapping]] = ..., nearest: _Optional[_Union[NearestQuery, _Mapping]] = ..., contacts: _Optional[_Union[ContactsQuery, _Mapping]] = ..., diagnostics: _Optional[_Union[DiagnosticsQuery, _Mapping]] = ..., body: _Optional[_Union[BodyQuery, _Mapping]] = ..., joints: _Optional[_Union[JointsQuery, _Mapping]] = ..., cast: _Optional[_Union[CastQuery, _Mapping]] = ..., overlap: _Optional[_Union[OverlapQuery, _Mapping]] = ..., closest: _Optional[_Union[ClosestQuery, _Mapping]] = ...) -> None: ...

class QueryFilter(_message.Message):
    __slots__ = ["category", "mask"]
    CATEGORY_FIELD_NUMBER: _ClassVar[int]
    MASK_FIELD_NUMBER: _ClassVar[int]
    category: int
    mask: int
    def __init__(self, category: _Optional[int] = ..., mask: _Optional[int] = ...) -> None: ...

class QueryResult(_message.Message):
    __slots__ = ["body", "contacts", "diagnostics", "hits", "joints", "truncated"]
    BODY_FIELD_NUMBER: _ClassVar[int]
    CONTACTS_FIELD_NUMBER: _ClassVar[int]
    DIAGNOSTICS_FIELD_NUMBER: _ClassVar[int]
    HITS_FIELD_NUMBER: _ClassVar[int]
    JOINTS_FIELD_NUMBER: _ClassVar[int]
    TRUNCATED_FIELD_NUMBER: _ClassVar[int]
    body: _snapshot_pb2.BodyInfo
    contacts: _snapshot_pb2.Contacts
    diagnostics: _snapshot_pb2.Diagnostics
    hits: _containers.RepeatedCompositeFieldContainer[BodyHit]
    joints: _snapshot_pb2.Joints
    truncated: bool
    def __init__(self, hits: _Optional[_Iterable[_Union[BodyHit, _Mapping]]] = ..., contacts: _Optional[_Union[_snapshot_pb2.Contacts, _Mapping]] = ..., diagnostics: _Optional[_Union[_snapshot_pb2.Diagnostics, _Mapping]] = ..., body: _Optional[_Union[_snapshot_pb2.BodyInfo, _Mapping]] = ..., joints: _Optional[_Union[_snapshot_pb2.Joints, _Mapping]] = ..., truncated: bool = ...) -> None: ...

class QueryShape(_message.Message):
    __slots__ = ["angle", "box", "capsule", "circle", "point", "polygon", "position"]
    ANGLE_FIELD_NUMBER: _ClassVar[int]
    BOX_FIELD_NUMBER: _ClassVar[int]
    CAPSULE_FIELD_NUMBER: _ClassVar[int]
    CIRCLE_FIELD_NUMBER: _ClassVar[int]
    POINT_FIELD_NUMBER: _ClassVar[int]
    POLYGON_FIELD_NUMBER: _ClassVar[int]
    POSITION_FIELD_NUMBER: _ClassVar[int]
    angle: float
    box: _scene_pb2.Box
    capsule: _scene_pb2.Capsule
    circle: _scene_pb2.Circle
    point: Point
    polygon: _scene_pb2.Polygon
    position: _scene_pb2.Vector
    def __init__(self, point: _Optional[_Union[Point, _Mapping]] = ..., box: _Optional[_Union[_scene_pb2.Box, _Mapping]] = ..., circle: _Optional[_Union[_scene_pb2.Circle, _Mapping]] = ..., polygon: _Optional[_Union[_scene_pb2.Polygon, _Mapping]] = ..., capsule: _Optional[_Union[_scene_pb2.Capsule, _Mapping]] = ..., position: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., angle: _Optional[float] = ...) -> None: ...

class RayQuery(_message.Message):
    __slots__ = ["origin", "translation"]
    ORIGIN_FIELD_NUMBER: _ClassVar[int]
    TRANSLATION_FIELD_NUMBER: _ClassVar[int]
    origin: _scene_pb2.Vector
    translation: _scene_pb2.Vector
    def __init__(self, origin: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., translation: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ...) -> None: ...

class RegionQuery(_message.Message):
    __slots__ = ["lower", "upper"]
    LOWER_FIELD_NUMBER: _ClassVar[int]
    UPPER_FIELD_NUMBER: _ClassVar[int]
    lower: _scene_pb2.Vector
    upper: _scene_pb2.Vector
    def __init__(self, lower: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., upper: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ...) -> None: ...

class Rejection(_message.Message):
    __slots__ = ["code", "field", "index", "message", "value"]
    CODE_FIELD_NUMBER: _ClassVar[int]
    FIELD_FIELD_NUMBER: _ClassVar[int]
    INDEX_FIELD_NUMBER: _ClassVar[int]
    MESSAGE_FIELD_NUMBER: _ClassVar[int]
    VALUE_FIELD_NUMBER: _ClassVar[int]
    code: RejectionCode
    field: str
    index: int
    message: str
    value: str
    def __init__(self, code: _Optional[_Union[RejectionCode, str]] = ..., index: _Optional[int] = ..., field: _Optional[str] = ..., value: _Optional[str] = ..., message: _Optional[str] = ...) -> None: ...

class Reset(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class Resume(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class SetMotor(_message.Message):
    __slots__ = ["joint", "motor"]
    JOINT_FIELD_NUMBER: _ClassVar[int]
    MOTOR_FIELD_NUMBER: _ClassVar[int]
    joint: JointRef
    motor: _scene_pb2.JointMotor
    def __init__(self, joint: _Optional[_Union[JointRef, _Mapping]] = ..., motor: _Optional[_Union[_scene_pb2.JointMotor, _Mapping]] = ...) -> None: ...

class SetTarget(_message.Message):
    __slots__ = ["joint", "target"]
    JOINT_FIELD_NUMBER: _ClassVar[int]
    TARGET_FIELD_NUMBER: _ClassVar[int]
    joint: JointRef
    target: _scene_pb2.Vector
    def __init__(self, joint: _Optional[_Union[JointRef, _Mapping]] = ..., target: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ...) -> None: ...

class SetTimeScale(_message.Message):
    __slots__ = ["scale"]
    SCALE_FIELD_NUMBER: _ClassVar[int]
    scale: float
    def __init__(self, scale: _Optional[float] = ...) -> None: ...

class SetTransform(_message.Message):
    __slots__ = ["angle", "body", "position"]
    ANGLE_FIELD_NUMBER: _ClassVar[int]
    BODY_FIELD_NUMBER: _ClassVar[int]
    POSITION_FIELD_NUMBER: _ClassVar[int]
    angle: float
    body: _scene_pb2.BodyRef
    position: _scene_pb2.Vector
    def __init__(self, body: _Optional[_Union[_scene_pb2.BodyRef, _Mapping]] = ..., position: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., angle: _Optional[float] = ...) -> None: ...

class SetVelocity(_message.Message):
    __slots__ = ["angular_velocity", "body", "velocity"]
    ANGULAR_VELOCITY_FIELD_NUMBER: _ClassVar[int]
    BODY_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_FIELD_NUMBER: _ClassVar[int]
    angular_velocity: float
    body: _scene_pb2.BodyRef
    velocity: _scene_pb2.Vector
    def __init__(self, body: _Optional[_Union[_scene_pb2.BodyRef, _Mapping]] = ..., velocity: _Optional[_Union[_scene_pb2.Vector, _Mapping]] = ..., angular_velocity: _Optional[float] = ...) -> None: ...

class Spawn(_message.Message):
    __slots__ = ["body"]
    BODY_FIELD_NUMBER: _ClassVar[int]
    body: _scene_pb2.Body
    def __init__(self, body: _Optional[_Union[_scene_pb2.Body, _Mapping]] = ...) -> None: ...

class Step(_message.Message):
    __slots__ = ["ticks"]
    TICKS_FIELD_NUMBER: _ClassVar[int]
    ticks: int
    def __init__(self, ticks: _Optional[int] = ...) -> None: ...

class Frame(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class RejectionCode(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

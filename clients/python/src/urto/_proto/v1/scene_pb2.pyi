from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

BODY_TYPE_DYNAMIC: BodyType
BODY_TYPE_KINEMATIC: BodyType
BODY_TYPE_STATIC: BodyType
BODY_TYPE_UNSPECIFIED: BodyType
BROAD_PHASE_BRUTE_FORCE: BroadPhase
BROAD_PHASE_BVH: BroadPhase
BROAD_PHASE_QUADTREE: BroadPhase
BROAD_PHASE_UNSPECIFIED: BroadPhase
DESCRIPTOR: _descriptor.FileDescriptor
INTEGRATOR_EXPLICIT_EULER: Integrator
INTEGRATOR_RUNGE_KUTTA_4: Integrator
INTEGRATOR_SEMI_IMPLICIT_EULER: Integrator
INTEGRATOR_UNSPECIFIED: Integrator
INTEGRATOR_VERLET: Integrator
MIXING_AVERAGE: Mixing
MIXING_GEOMETRIC_MEAN: Mixing
MIXING_MAXIMUM: Mixing
MIXING_MINIMUM: Mixing
MIXING_UNSPECIFIED: Mixing
NARROW_PHASE_GJK: NarrowPhase
NARROW_PHASE_SAT: NarrowPhase
NARROW_PHASE_UNSPECIFIED: NarrowPhase
PRECISION_DOUBLE: Precision
PRECISION_FLOAT: Precision
PRECISION_UNSPECIFIED: Precision
SOLVER_PRECISE: Solver
SOLVER_SOFT_STEP: Solver
SOLVER_THESIS: Solver
SOLVER_UNSPECIFIED: Solver

class Body(_message.Message):
    __slots__ = ["angle", "angular_damping", "angular_velocity", "awake", "color", "fixed_rotation", "gravity_scale", "linear_damping", "mass", "name", "position", "shapes", "tags", "type", "velocity"]
    ANGLE_FIELD_NUMBER: _ClassVar[int]
    ANGULAR_DAMPING_FIELD_NUMBER: _ClassVar[int]
    ANGULAR_VELOCITY_FIELD_NUMBER: _ClassVar[int]
    AWAKE_FIELD_NUMBER: _ClassVar[int]
    COLOR_FIELD_NUMBER: _ClassVar[int]
    FIXED_ROTATION_FIELD_NUMBER: _ClassVar[int]
    GRAVITY_SCALE_FIELD_NUMBER: _ClassVar[int]
    LINEAR_DAMPING_FIELD_NUMBER: _ClassVar[int]
    MASS_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    POSITION_FIELD_NUMBER: _ClassVar[int]
    SHAPES_FIELD_NUMBER: _ClassVar[int]
    TAGS_FIELD_NUMBER: _ClassVar[int]
    TYPE_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_FIELD_NUMBER: _ClassVar[int]
    angle: float
    angular_damping: float
    angular_velocity: float
    awake: bool
    color: int
    fixed_rotation: bool
    gravity_scale: float
    linear_damping: float
    mass: float
    name: str
    position: Vector
    shapes: _containers.RepeatedCompositeFieldContainer[Shape]
    tags: _containers.RepeatedScalarFieldContainer[str]
    type: BodyType
    velocity: Vector
    def __init__(self, name: _Optional[str] = ..., tags: _Optional[_Iterable[str]] = ..., type: _Optional[_Union[BodyType, str]] = ..., position: _Optional[_Union[Vector, _Mapping]] = ..., angle: _Optional[float] = ..., velocity: _Optional[_Union[Vector, _Mapping]] = ..., angular_velocity: _Optional[float] = ..., shapes: _Optional[_Iterable[_Union[Shape, _Mapping]]] = ..., mass: _Optional[float] = ..., linear_damping: _Optional[float] = ..., angular_damping: _Optional[float] = ..., gravity_scale: _Optional[float] = ..., fixed_rotation: bool = ..., awake: bool = ..., color: _Optional[int] = ...) -> None: ...

class BodyRef(_message.Message):
    __slots__ = ["id", "name"]
    ID_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    id: int
    name: str
    def __init__(self, id: _Optional[int] = ..., name: _Optional[str] = ...) -> None: ...

class Box(_message.Message):
    __slots__ = ["angle", "center", "height", "radius", "width"]
    ANGLE_FIELD_NUMBER: _ClassVar[int]
    CENTER_FIELD_NUMBER: _ClassVar[int]
    HEIGHT_FIELD_NUMBER: _ClassVar[int]
    RADIUS_FIELD_NUMBER: _ClassVar[int]
    WIDTH_FIELD_NUMBER: _ClassVar[int]
    angle: float
    center: Vector
    height: float
    radius: float
    width: float
    def __init__(self, width: _Optional[float] = ..., height: _Optional[float] = ..., center: _Optional[_Union[Vector, _Mapping]] = ..., angle: _Optional[float] = ..., radius: _Optional[float] = ...) -> None: ...

class Capsule(_message.Message):
    __slots__ = ["a", "b", "radius"]
    A_FIELD_NUMBER: _ClassVar[int]
    B_FIELD_NUMBER: _ClassVar[int]
    RADIUS_FIELD_NUMBER: _ClassVar[int]
    a: Vector
    b: Vector
    radius: float
    def __init__(self, a: _Optional[_Union[Vector, _Mapping]] = ..., b: _Optional[_Union[Vector, _Mapping]] = ..., radius: _Optional[float] = ...) -> None: ...

class Chain(_message.Message):
    __slots__ = ["loop", "vertices"]
    LOOP_FIELD_NUMBER: _ClassVar[int]
    VERTICES_FIELD_NUMBER: _ClassVar[int]
    loop: bool
    vertices: _containers.RepeatedCompositeFieldContainer[Vector]
    def __init__(self, vertices: _Optional[_Iterable[_Union[Vector, _Mapping]]] = ..., loop: bool = ...) -> None: ...

class Circle(_message.Message):
    __slots__ = ["center", "radius"]
    CENTER_FIELD_NUMBER: _ClassVar[int]
    RADIUS_FIELD_NUMBER: _ClassVar[int]
    center: Vector
    radius: float
    def __init__(self, radius: _Optional[float] = ..., center: _Optional[_Union[Vector, _Mapping]] = ...) -> None: ...

class DistanceJoint(_message.Message):
    __slots__ = ["length", "limits", "spring"]
    LENGTH_FIELD_NUMBER: _ClassVar[int]
    LIMITS_FIELD_NUMBER: _ClassVar[int]
    SPRING_FIELD_NUMBER: _ClassVar[int]
    length: float
    limits: JointLimits
    spring: JointSpring
    def __init__(self, length: _Optional[float] = ..., limits: _Optional[_Union[JointLimits, _Mapping]] = ..., spring: _Optional[_Union[JointSpring, _Mapping]] = ...) -> None: ...

class Drag(_message.Message):
    __slots__ = ["linear", "quadratic"]
    LINEAR_FIELD_NUMBER: _ClassVar[int]
    QUADRATIC_FIELD_NUMBER: _ClassVar[int]
    linear: float
    quadratic: float
    def __init__(self, linear: _Optional[float] = ..., quadratic: _Optional[float] = ...) -> None: ...

class ForceField(_message.Message):
    __slots__ = ["drag", "point_attractor", "spring"]
    DRAG_FIELD_NUMBER: _ClassVar[int]
    POINT_ATTRACTOR_FIELD_NUMBER: _ClassVar[int]
    SPRING_FIELD_NUMBER: _ClassVar[int]
    drag: Drag
    point_attractor: PointAttractor
    spring: Spring
    def __init__(self, point_attractor: _Optional[_Union[PointAttractor, _Mapping]] = ..., drag: _Optional[_Union[Drag, _Mapping]] = ..., spring: _Optional[_Union[Spring, _Mapping]] = ...) -> None: ...

class HitEvents(_message.Message):
    __slots__ = ["speed_min"]
    SPEED_MIN_FIELD_NUMBER: _ClassVar[int]
    speed_min: float
    def __init__(self, speed_min: _Optional[float] = ...) -> None: ...

class Joint(_message.Message):
    __slots__ = ["anchor_a", "anchor_b", "body_a", "body_b", "break_force", "break_torque", "collide_connected", "distance", "mouse", "name", "prismatic", "revolute", "weld"]
    ANCHOR_A_FIELD_NUMBER: _ClassVar[int]
    ANCHOR_B_FIELD_NUMBER: _ClassVar[int]
    BODY_A_FIELD_NUMBER: _ClassVar[int]
    BODY_B_FIELD_NUMBER: _ClassVar[int]
    BREAK_FORCE_FIELD_NUMBER: _ClassVar[int]
    BREAK_TORQUE_FIELD_NUMBER: _ClassVar[int]
    COLLIDE_CONNECTED_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_FIELD_NUMBER: _ClassVar[int]
    MOUSE_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    PRISMATIC_FIELD_NUMBER: _ClassVar[int]
    REVOLUTE_FIELD_NUMBER: _ClassVar[int]
    WELD_FIELD_NUMBER: _ClassVar[int]
    anchor_a: Vector
    anchor_b: Vector
    body_a: BodyRef
    body_b: BodyRef
    break_force: float
    break_torque: float
    collide_connected: bool
    distance: DistanceJoint
    mouse: MouseJoint
    name: str
    prismatic: PrismaticJoint
    revolute: RevoluteJoint
    weld: WeldJoint
    def __init__(self, name: _Optional[str] = ..., body_a: _Optional[_Union[BodyRef, _Mapping]] = ..., body_b: _Optional[_Union[BodyRef, _Mapping]] = ..., anchor_a: _Optional[_Union[Vector, _Mapping]] = ..., anchor_b: _Optional[_Union[Vector, _Mapping]] = ..., revolute: _Optional[_Union[RevoluteJoint, _Mapping]] = ..., distance: _Optional[_Union[DistanceJoint, _Mapping]] = ..., prismatic: _Optional[_Union[PrismaticJoint, _Mapping]] = ..., weld: _Optional[_Union[WeldJoint, _Mapping]] = ..., mouse: _Optional[_Union[MouseJoint, _Mapping]] = ..., break_force: _Optional[float] = ..., break_torque: _Optional[float] = ..., collide_connected: bool = ...) -> None: ...

class JointLimits(_message.Message):
    __slots__ = ["lower", "upper"]
    LOWER_FIELD_NUMBER: _ClassVar[int]
    UPPER_FIELD_NUMBER: _ClassVar[int]
    lower: float
    upper: float
    def __init__(self, lower: _Optional[float] = ..., upper: _Optional[float] = ...) -> None: ...

class JointMotor(_message.Message):
    __slots__ = ["bound", "enabled", "speed"]
    BOUND_FIELD_NUMBER: _ClassVar[int]
    ENABLED_FIELD_NUMBER: _ClassVar[int]
    SPEED_FIELD_NUMBER: _ClassVar[int]
    bound: float
    enabled: bool
    speed: float
    def __init__(self, enabled: bool = ..., speed: _Optional[float] = ..., bound: _Optional[float] = ...) -> None: ...

class JointSpring(_message.Message):
    __slots__ = ["damping_ratio", "hertz"]
    DAMPING_RATIO_FIELD_NUMBER: _ClassVar[int]
    HERTZ_FIELD_NUMBER: _ClassVar[int]
    damping_ratio: float
    hertz: float
    def __init__(self, hertz: _Optional[float] = ..., damping_ratio: _Optional[float] = ...) -> None: ...

class MouseJoint(_message.Message):
    __slots__ = ["force_max", "spring", "target"]
    FORCE_MAX_FIELD_NUMBER: _ClassVar[int]
    SPRING_FIELD_NUMBER: _ClassVar[int]
    TARGET_FIELD_NUMBER: _ClassVar[int]
    force_max: float
    spring: JointSpring
    target: Vector
    def __init__(self, target: _Optional[_Union[Vector, _Mapping]] = ..., spring: _Optional[_Union[JointSpring, _Mapping]] = ..., force_max: _Optional[float] = ...) -> None: ...

class PointAttractor(_message.Message):
    __slots__ = ["center", "softening", "strength"]
    CENTER_FIELD_NUMBER: _ClassVar[int]
    SOFTENING_FIELD_NUMBER: _ClassVar[int]
    STRENGTH_FIELD_NUMBER: _ClassVar[int]
    center: Vector
    softening: float
    strength: float
    def __init__(self, center: _Optional[_Union[Vector, _Mapping]] = ..., strength: _Optional[float] = ..., softening: _Optional[float] = ...) -> None: ...

class Polygon(_message.Message):
    __slots__ = ["radius", "vertices"]
    RADIUS_FIELD_NUMBER: _ClassVar[int]
    VERTICES_FIELD_NUMBER: _ClassVar[int]
    radius: float
    vertices: _containers.RepeatedCompositeFieldContainer[Vector]
    def __init__(self, vertices: _Optional[_Iterable[_Union[Vector, _Mapping]]] = ..., radius: _Optional[float] = ...) -> None: ...

class PrismaticJoint(_message.Message):
    __slots__ = ["axis", "limits", "motor", "reference_angle", "spring"]
    AXIS_FIELD_NUMBER: _ClassVar[int]
    LIMITS_FIELD_NUMBER: _ClassVar[int]
    MOTOR_FIELD_NUMBER: _ClassVar[int]
    REFERENCE_ANGLE_FIELD_NUMBER: _ClassVar[int]
    SPRING_FIELD_NUMBER: _ClassVar[int]
    axis: Vector
    limits: JointLimits
    motor: JointMotor
    reference_angle: float
    spring: JointSpring
    def __init__(self, axis: _Optional[_Union[Vector, _Mapping]] = ..., reference_angle: _Optional[float] = ..., limits: _Optional[_Union[JointLimits, _Mapping]] = ..., motor: _Optional[_Union[JointMotor, _Mapping]] = ..., spring: _Optional[_Union[JointSpring, _Mapping]] = ...) -> None: ...

class RevoluteJoint(_message.Message):
    __slots__ = ["limits", "motor", "reference_angle", "spring"]
    LIMITS_FIELD_NUMBER: _ClassVar[int]
    MOTOR_FIELD_NUMBER: _ClassVar[int]
    REFERENCE_ANGLE_FIELD_NUMBER: _ClassVar[int]
    SPRING_FIELD_NUMBER: _ClassVar[int]
    limits: JointLimits
    motor: JointMotor
    reference_angle: float
    spring: JointSpring
    def __init__(self, reference_angle: _Optional[float] = ..., limits: _Optional[_Union[JointLimits, _Mapping]] = ..., motor: _Optional[_Union[JointMotor, _Mapping]] = ..., spring: _Optional[_Union[JointSpring, _Mapping]] = ...) -> None: ...

class Scene(_message.Message):
    __slots__ = ["bodies", "description", "fields", "joints", "name", "view", "world"]
    BODIES_FIELD_NUMBER: _ClassVar[int]
    DESCRIPTION_FIELD_NUMBER: _ClassVar[int]
    FIELDS_FIELD_NUMBER: _ClassVar[int]
    JOINTS_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    VIEW_FIELD_NUMBER: _ClassVar[int]
    WORLD_FIELD_NUMBER: _ClassVar[int]
    bodies: _containers.RepeatedCompositeFieldContainer[Body]
    description: str
    fields: _containers.RepeatedCompositeFieldContainer[ForceField]
    joints: _containers.RepeatedCompositeFieldContainer[Joint]
    name: str
    view: View
    world: WorldSettings
    def __init__(self, name: _Optional[str] = ..., description: _Optional[str] = ..., world: _Optional[_Union[WorldSettings, _Mapping]] = ..., bodies: _Optional[_Iterable[_Union[Body, _Mapping]]] = ..., fields: _Optional[_Iterable[_Union[ForceField, _Mapping]]] = ..., view: _Optional[_Union[View, _Mapping]] = ..., joints: _Optional[_Iterable[_Union[Joint, _Mapping]]] = ...) -> None: ...

class Shape(_message.Message):
    __slots__ = ["box", "capsule", "category", "chain", "circle", "density", "friction", "mask", "polygon", "restitution", "sensor"]
    BOX_FIELD_NUMBER: _ClassVar[int]
    CAPSULE_FIELD_NUMBER: _ClassVar[int]
    CATEGORY_FIELD_NUMBER: _ClassVar[int]
    CHAIN_FIELD_NUMBER: _ClassVar[int]
    CIRCLE_FIELD_NUMBER: _ClassVar[int]
    DENSITY_FIELD_NUMBER: _ClassVar[int]
    FRICTION_FIELD_NUMBER: _ClassVar[int]
    MASK_FIELD_NUMBER: _ClassVar[int]
    POLYGON_FIELD_NUMBER: _ClassVar[int]
    RESTITUTION_FIELD_NUMBER: _ClassVar[int]
    SENSOR_FIELD_NUMBER: _ClassVar[int]
    box: Box
    capsule: Capsule
    category: int
    chain: Chain
    circle: Circle
    density: float
    friction: float
    mask: int
    polygon: Polygon
    restitution: float
    sensor: bool
    def __init__(self, box: _Optional[_Union[Box, _Mapping]] = ..., circle: _Optional[_Union[Circle, _Mapping]] = ..., polygon: _Optional[_Union[Polygon, _Mapping]] = ..., capsule: _Optional[_Union[Capsule, _Mapping]] = ..., chain: _Optional[_Union[Chain, _Mapping]] = ..., density: _Optional[float] = ..., friction: _Optional[float] = ..., restitution: _Optional[float] = ..., category: _Optional[int] = ..., mask: _Optional[int] = ..., sensor: bool = ...) -> None: ...

class Spring(_message.Message):
    __slots__ = ["center", "damping", "stiffness"]
    CENTER_FIELD_NUMBER: _ClassVar[int]
    DAMPING_FIELD_NUMBER: _ClassVar[int]
    STIFFNESS_FIELD_NUMBER: _ClassVar[int]
    center: Vector
    damping: float
    stiffness: float
    def __init__(self, center: _Optional[_Union[Vector, _Mapping]] = ..., stiffness: _Optional[float] = ..., damping: _Optional[float] = ...) -> None: ...

class Vector(_message.Message):
    __slots__ = ["x", "y"]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    x: float
    y: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ...) -> None: ...

class View(_message.Message):
    __slots__ = ["lower", "upper"]
    LOWER_FIELD_NUMBER: _ClassVar[int]
    UPPER_FIELD_NUMBER: _ClassVar[int]
    lower: Vector
    upper: Vector
    def __init__(self, lower: _Optional[_Union[Vector, _Mapping]] = ..., upper: _Optional[_Union[Vector, _Mapping]] = ...) -> None: ...

class WeldJoint(_message.Message):
    __slots__ = ["angular", "linear", "reference_angle"]
    ANGULAR_FIELD_NUMBER: _ClassVar[int]
    LINEAR_FIELD_NUMBER: _ClassVar[int]
    REFERENCE_ANGLE_FIELD_NUMBER: _ClassVar[int]
    angular: JointSpring
    linear: JointSpring
    reference_angle: float
    def __init__(self, reference_angle: _Optional[float] = ..., linear: _Optional[_Union[JointSpring, _Mapping]] = ..., angular: _Optional[_Union[JointSpring, _Mapping]] = ...) -> None: ...

class WorldSettings(_message.Message):
    __slots__ = ["broad_phase", "continuous", "friction_mixing", "gravity", "hit_events", "integrator", "narrow_phase", "precision", "restitution_mixing", "restitution_threshold", "sleeping", "solver", "sub_steps", "time_step"]
    BROAD_PHASE_FIELD_NUMBER: _ClassVar[int]
    CONTINUOUS_FIELD_NUMBER: _ClassVar[int]
    FRICTION_MIXING_FIELD_NUMBER: _ClassVar[int]
    GRAVITY_FIELD_NUMBER: _ClassVar[int]
    HIT_EVENTS_FIELD_NUMBER: _ClassVar[int]
    INTEGRATOR_FIELD_NUMBER: _ClassVar[int]
    NARROW_PHASE_FIELD_NUMBER: _ClassVar[int]
    PRECISION_FIELD_NUMBER: _ClassVar[int]
    RESTITUTION_MIXING_FIELD_NUMBER: _ClassVar[int]
    RESTITUTION_THRESHOLD_FIELD_NUMBER: _ClassVar[int]
    SLEEPING_FIELD_NUMBER: _ClassVar[int]
    SOLVER_FIELD_NUMBER: _ClassVar[int]
    SUB_STEPS_FIELD_NUMBER: _ClassVar[int]
    TIME_STEP_FIELD_NUMBER: _ClassVar[int]
    broad_phase: BroadPhase
    continuous: bool
    friction_mixing: Mixing
    gravity: Vector
    hit_events: HitEvents
    integrator: Integrator
    narrow_phase: NarrowPhase
    precision: Precision
    restitution_mixing: Mixing
    restitution_threshold: float
    sleeping: bool
    solver: Solver
    sub_steps: int
    time_step: float
    def __init__(self, precision: _Optional[_Union[Precision, str]] = ..., gravity: _Optional[_Union[Vector, _Mapping]] = ..., time_step: _Optional[float] = ..., sub_steps: _Optional[int] = ..., solver: _Optional[_Union[Solver, str]] = ..., integrator: _Optional[_Union[Integrator, str]] = ..., broad_phase: _Optional[_Union[BroadPhase, str]] = ..., narrow_phase: _Optional[_Union[NarrowPhase, str]] = ..., sleeping: bool = ..., continuous: bool = ..., friction_mixing: _Optional[_Union[Mixing, str]] = ..., restitution_mixing: _Optional[_Union[Mixing, str]] = ..., restitution_threshold: _Optional[float] = ..., hit_events: _Optional[_Union[HitEvents, _Mapping]] = ...) -> None: ...

class Precision(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class BroadPhase(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class NarrowPhase(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class Solver(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class Integrator(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class Mixing(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class BodyType(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

"""Descriptions of bodies: what is spawned, and what a room says it holds.

SI units and radians; angles are counter-clockwise and the y axis points up.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, SupportsFloat, TypeAlias, TypedDict

from urto._exceptions import InvalidArgument
from urto._proto.v1 import command_pb2, scene_pb2, snapshot_pb2

Vector: TypeAlias = tuple[float, float]
"""A vector or a point (x, y); the field that holds it gives unit and frame."""

VectorLike: TypeAlias = Sequence[SupportsFloat] | tuple[SupportsFloat, SupportsFloat]
"""What is accepted as a vector: any sequence of two numbers, also a numpy array's list."""

BodyType: TypeAlias = Literal["dynamic", "static", "kinematic"]

_TYPE_TO_PROTO = {
    "dynamic": scene_pb2.BODY_TYPE_DYNAMIC,
    "static": scene_pb2.BODY_TYPE_STATIC,
    "kinematic": scene_pb2.BODY_TYPE_KINEMATIC,
}
_TYPE_FROM_PROTO: dict[int, BodyType] = {
    scene_pb2.BODY_TYPE_UNSPECIFIED: "dynamic",
    scene_pb2.BODY_TYPE_DYNAMIC: "dynamic",
    scene_pb2.BODY_TYPE_STATIC: "static",
    scene_pb2.BODY_TYPE_KINEMATIC: "kinematic",
}


def to_number(what: str, value: object) -> float:
    """`value` as a float; InvalidArgument names `what` if it is none."""
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InvalidArgument(f"{what} must be a number, not {value!r}") from None


def to_vector(what: str, value: object) -> Vector:
    """`value` as two floats; InvalidArgument names `what` if it is not that."""
    try:
        parts = list(value)  # type: ignore[call-overload]
    except TypeError:
        parts = []
    if len(parts) != 2:
        raise InvalidArgument(f"{what} must be two numbers (x, y), not {value!r}")
    return to_number(f"{what}[0]", parts[0]), to_number(f"{what}[1]", parts[1])


def vector_to_proto(what: str, value: object) -> scene_pb2.Vector:
    x, y = to_vector(what, value)
    return scene_pb2.Vector(x=x, y=y)


def vector_from_proto(vector: scene_pb2.Vector) -> Vector:
    return vector.x, vector.y


@dataclass(frozen=True, kw_only=True)
class _BodyFields:
    """What belongs to a body as a whole. The room checks the ranges.

    Attributes:
        position: m. Of a body: of its origin in the world. Of a shape inside a `Body`: of its centre in the body.
        angle: rad, of the body in the world, or of the shape in the body.
        name: optional, unique in the room, at most 64 bytes.
        tags: at most 8, each at most 32 bytes.
        type: "dynamic"; "static" never moves; "kinematic" moves with the velocity it is given, pushed by nothing.
        velocity: m/s, of the centre of mass.
        angular_velocity: rad/s.
        mass: kg > 0; None: areas times densities. Dynamic bodies only.
        linear_damping: 1/s ≥ 0.
        angular_damping: 1/s ≥ 0.
        gravity_scale: multiplies the uniform gravity; None: 1.
        fixed_rotation: the body never turns.
        awake: False: it sleeps until touched.
        color: 0xRRGGBB for viewers; None: by id.
    """

    position: VectorLike = (0.0, 0.0)
    angle: float = 0.0
    name: str = ""
    tags: Sequence[str] = ()
    type: BodyType = "dynamic"
    velocity: VectorLike = (0.0, 0.0)
    angular_velocity: float = 0.0
    mass: float | None = None
    linear_damping: float = 0.0
    angular_damping: float = 0.0
    gravity_scale: float | None = None
    fixed_rotation: bool = False
    awake: bool = True
    color: int | None = None


@dataclass(frozen=True, kw_only=True)
class Shape(_BodyFields):
    """Base of `Box`, `Circle`, `Polygon`, `Capsule` and `Chain`.

    Spawned alone a shape is a body of that one shape; then all fields count. Inside `Body(shapes=[...])` only its
    geometry, `position`, `angle` and the fields below do.

    Attributes:
        density: kg/m² > 0; None: 1.
        friction: ≥ 0; None: 0.6.
        restitution: 0 to 1.
        category: bit set of 32: what this shape is; None: 1.
        mask: bit set of 32: what it touches; None: everything. Two shapes touch if each mask has a bit of the
            other's category.
        sensor: reports overlap, pushes nothing.
    """

    density: float | None = None
    friction: float | None = None
    restitution: float = 0.0
    category: int | None = None
    mask: int | None = None
    sensor: bool = False


@dataclass(frozen=True, kw_only=True)
class Box(Shape):
    """A rectangle around its position: `width` m along its x axis, `height` m along its y axis, both > 0.

    It is grown by `radius` m ≥ 0 on all sides, which rounds its corners.
    """

    width: float
    height: float
    radius: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Circle(Shape):
    """A disc of `radius` m > 0 around its position."""

    radius: float


@dataclass(frozen=True, kw_only=True)
class Polygon(Shape):
    """A simple polygon, convex or concave, of 3 to 64 `vertices` in m relative to its position, either winding.

    It is grown by `radius` m ≥ 0 on all sides, which rounds its corners; such a one must be convex and have at most 8
    vertices.
    """

    vertices: Sequence[VectorLike]
    radius: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Capsule(Shape):
    """All points within `radius` m > 0 of the segment from `a` to `b`, in m relative to its position."""

    a: VectorLike
    b: VectorLike
    radius: float


@dataclass(frozen=True, kw_only=True)
class Chain(Shape):
    """Terrain: a line of 2 to 4096 `vertices` in m relative to its position, closed if it is a `loop`.

    It stops what comes from the right of its direction and lets through what comes from the left: a floor is listed
    from right to left, the walls of a room clockwise. Bodies slide over its joints as over one line. Not for dynamic
    bodies.
    """

    vertices: Sequence[VectorLike]
    loop: bool = False


@dataclass(frozen=True, kw_only=True)
class Body(_BodyFields):
    """A body of one or more shapes (1 to 64) that move as one."""

    shapes: Sequence[Shape]


Spawnable: TypeAlias = Shape | Body
"""What `Room.spawn` takes."""

QueryShape: TypeAlias = Box | Circle | Polygon | Capsule | VectorLike
"""What casts, overlaps and closest-point queries look with: a convex shape at its `position` (m, world frame) and
`angle` (rad), or a point (m, world frame). Of a shape only these and its geometry count."""

_SHAPE_ONLY_DEFAULTS = {
    field.name: field.default
    for field in dataclasses.fields(_BodyFields)
    if field.name not in ("position", "angle")
}


def body_to_proto(description: Spawnable) -> scene_pb2.Body:
    """The message that spawns `description`."""
    if isinstance(description, Body):
        shapes = [_shape_in_body(index, shape) for index, shape in enumerate(description.shapes)]
    elif isinstance(description, Shape):
        shapes = [_shape_to_proto(description, (0.0, 0.0), 0.0)]
    else:
        raise InvalidArgument(f"spawn takes a Box, Circle, Polygon, Capsule, Chain or Body, not {description!r}")
    body_type = _TYPE_TO_PROTO.get(description.type)
    if body_type is None:
        raise InvalidArgument(f"type must be 'dynamic', 'static' or 'kinematic', not {description.type!r}")
    body = scene_pb2.Body(
        name=description.name,
        tags=list(description.tags),
        type=body_type,
        position=vector_to_proto("position", description.position),
        angle=to_number("angle", description.angle),
        velocity=vector_to_proto("velocity", description.velocity),
        angular_velocity=to_number("angular_velocity", description.angular_velocity),
        shapes=shapes,
        linear_damping=to_number("linear_damping", description.linear_damping),
        angular_damping=to_number("angular_damping", description.angular_damping),
        fixed_rotation=bool(description.fixed_rotation),
    )
    if description.mass is not None:
        body.mass = to_number("mass", description.mass)
    if description.gravity_scale is not None:
        body.gravity_scale = to_number("gravity_scale", description.gravity_scale)
    if not description.awake:
        body.awake = False
    if description.color is not None:
        body.color = _bits("color", description.color)
    return body


def query_shape_to_proto(shape: object) -> command_pb2.QueryShape:
    """The message of a point or of a convex shape at its place."""
    if not isinstance(shape, Shape):
        return command_pb2.QueryShape(point=command_pb2.Point(), position=vector_to_proto("shape", shape))
    if isinstance(shape, Chain):
        raise InvalidArgument("a query takes a Box, Circle, Polygon, Capsule or a point, not a Chain")
    if shape.category is not None or shape.mask is not None:
        raise InvalidArgument("category and mask belong to the query: give them to it instead of to its shape")
    geometry = _shape_to_proto(shape, (0.0, 0.0), 0.0)
    message = command_pb2.QueryShape(
        position=vector_to_proto("position", shape.position), angle=to_number("angle", shape.angle)
    )
    kind = geometry.WhichOneof("geometry")
    assert kind is not None
    getattr(message, kind).CopyFrom(getattr(geometry, kind))
    return message


def query_filter_to_proto(category: int | None, mask: int | None) -> command_pb2.QueryFilter | None:
    """None if nothing is filtered."""
    if category is None and mask is None:
        return None
    message = command_pb2.QueryFilter()
    if category is not None:
        message.category = _bits("category", category)
    if mask is not None:
        message.mask = _bits("mask", mask)
    return message


def _shape_in_body(index: int, shape: Shape) -> scene_pb2.Shape:
    for name, default in _SHAPE_ONLY_DEFAULTS.items():
        if getattr(shape, name) != default:
            raise InvalidArgument(f"shapes[{index}].{name} belongs to the body: give it to Body(...) instead")
    return _shape_to_proto(shape, to_vector(f"shapes[{index}].position", shape.position), shape.angle)


def _shape_to_proto(shape: Shape, center: Vector, angle: float) -> scene_pb2.Shape:
    message = scene_pb2.Shape(restitution=to_number("restitution", shape.restitution), sensor=bool(shape.sensor))
    x, y = center
    if isinstance(shape, Box):
        message.box.width = to_number("width", shape.width)
        message.box.height = to_number("height", shape.height)
        message.box.center.x, message.box.center.y = x, y
        message.box.angle = to_number("angle", angle)
        message.box.radius = to_number("radius", shape.radius)
    elif isinstance(shape, Circle):
        message.circle.radius = to_number("radius", shape.radius)
        message.circle.center.x, message.circle.center.y = x, y
    elif isinstance(shape, Polygon):
        message.polygon.vertices.extend(_placed("vertices", shape.vertices, center, angle))
        message.polygon.radius = to_number("radius", shape.radius)
    elif isinstance(shape, Capsule):
        a, b = _placed("ends", (shape.a, shape.b), center, angle)
        message.capsule.a.CopyFrom(a)
        message.capsule.b.CopyFrom(b)
        message.capsule.radius = to_number("radius", shape.radius)
    elif isinstance(shape, Chain):
        message.chain.vertices.extend(_placed("vertices", shape.vertices, center, angle))
        message.chain.loop = bool(shape.loop)
    else:
        raise InvalidArgument(f"a shape is a Box, Circle, Polygon, Capsule or Chain, not {shape!r}")
    if shape.density is not None:
        message.density = to_number("density", shape.density)
    if shape.friction is not None:
        message.friction = to_number("friction", shape.friction)
    if shape.category is not None:
        message.category = _bits("category", shape.category)
    if shape.mask is not None:
        message.mask = _bits("mask", shape.mask)
    return message


def _placed(what: str, points: Sequence[VectorLike], center: Vector, angle: float) -> list[scene_pb2.Vector]:
    """Points relative to a shape's position and angle, in the body's frame."""
    cosine, sine = math.cos(angle), math.sin(angle)
    placed = []
    for index, point in enumerate(points):
        x, y = to_vector(f"{what}[{index}]", point)
        placed.append(
            scene_pb2.Vector(x=center[0] + cosine * x - sine * y, y=center[1] + sine * x + cosine * y)
        )
    if not placed:
        raise InvalidArgument(f"{what} must be points, there are none")
    return placed


def _bits(what: str, value: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 2**32:
        raise InvalidArgument(f"{what} must be a whole number from 0 to 0xffffffff, not {value!r}")
    return value


def body_from_proto(body: scene_pb2.Body) -> Body:
    """The description that a room holds of a body."""
    return Body(
        position=vector_from_proto(body.position),
        angle=body.angle,
        name=body.name,
        tags=tuple(body.tags),
        type=_TYPE_FROM_PROTO.get(body.type, "dynamic"),
        velocity=vector_from_proto(body.velocity),
        angular_velocity=body.angular_velocity,
        mass=body.mass if body.HasField("mass") else None,
        linear_damping=body.linear_damping,
        angular_damping=body.angular_damping,
        gravity_scale=body.gravity_scale if body.HasField("gravity_scale") else None,
        fixed_rotation=body.fixed_rotation,
        awake=body.awake if body.HasField("awake") else True,
        color=body.color if body.HasField("color") else None,
        shapes=tuple(_shapes_from_proto(body.shapes)),
    )


class _Surface(TypedDict):
    density: float | None
    friction: float | None
    restitution: float
    category: int | None
    mask: int | None
    sensor: bool


def _shapes_from_proto(shapes: Iterable[scene_pb2.Shape]) -> Iterable[Shape]:
    for shape in shapes:
        surface = _Surface(
            density=shape.density if shape.HasField("density") else None,
            friction=shape.friction if shape.HasField("friction") else None,
            restitution=shape.restitution,
            category=shape.category if shape.HasField("category") else None,
            mask=shape.mask if shape.HasField("mask") else None,
            sensor=shape.sensor,
        )
        kind = shape.WhichOneof("geometry")
        if kind == "box":
            yield Box(
                width=shape.box.width, height=shape.box.height, position=vector_from_proto(shape.box.center),
                angle=shape.box.angle, radius=shape.box.radius, **surface,
            )  # fmt: skip
        elif kind == "circle":
            yield Circle(radius=shape.circle.radius, position=vector_from_proto(shape.circle.center), **surface)
        elif kind == "polygon":
            yield Polygon(vertices=_vectors(shape.polygon.vertices), radius=shape.polygon.radius, **surface)
        elif kind == "capsule":
            yield Capsule(
                a=vector_from_proto(shape.capsule.a), b=vector_from_proto(shape.capsule.b),
                radius=shape.capsule.radius, **surface,
            )  # fmt: skip
        elif kind == "chain":
            yield Chain(vertices=_vectors(shape.chain.vertices), loop=shape.chain.loop, **surface)


def _vectors(vectors: Iterable[scene_pb2.Vector]) -> tuple[Vector, ...]:
    return tuple(vector_from_proto(vector) for vector in vectors)


@dataclass(frozen=True, kw_only=True)
class BodyInfo:
    """A body as the room knows it.

    Attributes:
        id: the room's number for it, > 0.
        body: its description as it was spawned.
        mass: kg; 0 unless dynamic.
        inertia: kg·m² about the centre of mass.
        center_of_mass: m, body frame.
        position: m, world frame, now.
        angle: rad in (−π, π], now.
        velocity: m/s, of the centre of mass, now.
        angular_velocity: rad/s, now.
        awake: False while it sleeps.
    """

    id: int
    body: Body
    mass: float
    inertia: float
    center_of_mass: Vector
    position: Vector
    angle: float
    velocity: Vector
    angular_velocity: float
    awake: bool

    @property
    def name(self) -> str:
        """The name it was spawned with, or ""."""
        return self.body.name


def body_info_from_proto(info: snapshot_pb2.BodyInfo) -> BodyInfo:
    return BodyInfo(
        id=info.id,
        body=body_from_proto(info.body),
        mass=info.mass,
        inertia=info.inertia,
        center_of_mass=vector_from_proto(info.center_of_mass),
        position=vector_from_proto(info.position),
        angle=info.angle,
        velocity=vector_from_proto(info.velocity),
        angular_velocity=info.angular_velocity,
        awake=info.awake,
    )

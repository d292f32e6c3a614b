"""Descriptions of bodies to messages and back."""

from __future__ import annotations

import math

import numpy as np
import pytest

import urto
from urto._bodies import body_from_proto, body_to_proto


def test_a_shape_alone_is_a_body_of_that_shape() -> None:
    message = body_to_proto(urto.Box(width=2, height=1, position=(3, 4), angle=0.5, friction=0.25, name="crate"))
    assert (message.position.x, message.position.y, message.angle, message.name) == (3, 4, 0.5, "crate")
    (shape,) = message.shapes
    assert (shape.box.width, shape.box.center.x, shape.box.angle, shape.friction) == (2, 0, 0, 0.25)
    assert not shape.HasField("density")
    assert not message.HasField("mass")


def test_shapes_of_a_body_lie_in_its_frame() -> None:
    message = body_to_proto(
        urto.Body(
            position=(10, 0),
            shapes=[
                urto.Box(width=2, height=1, position=(1, 2), angle=0.5),
                urto.Circle(radius=1, position=(-1, 0)),
                urto.Polygon(vertices=[(1, 0), (2, 0), (1, 1)], position=(5, 5), angle=math.pi / 2),
                urto.Capsule(a=(1, 0), b=(2, 0), radius=1, position=(5, 5), angle=math.pi / 2),
                urto.Chain(vertices=[(1, 0), (2, 0)], position=(5, 5)),
            ],
        )
    )
    box, circle, polygon, capsule, chain = message.shapes
    assert (box.box.center.x, box.box.center.y, box.box.angle) == (1, 2, 0.5)
    assert circle.circle.center.x == -1
    turned = [(vertex.x, vertex.y) for vertex in polygon.polygon.vertices]
    assert np.allclose(turned, [(5, 6), (5, 7), (4, 6)])
    assert np.allclose([capsule.capsule.a.x, capsule.capsule.a.y, capsule.capsule.b.y], [5, 6, 7])
    assert [(vertex.x, vertex.y) for vertex in chain.chain.vertices] == [(6, 5), (7, 5)]


def test_there_and_back() -> None:
    body = urto.Body(
        position=(1.0, 2.0), angle=0.5, name="b", tags=("t",), type="kinematic", velocity=(3.0, 4.0),
        angular_velocity=5.0, linear_damping=0.1, angular_damping=0.2, gravity_scale=0.5, fixed_rotation=True,
        awake=False, color=0xABCDEF, mass=7.0,
        shapes=(
            urto.Box(width=1.0, height=2.0, position=(0.5, 0.0), angle=0.25, density=3.0, friction=0.5,
                     restitution=0.5, category=2, mask=4, sensor=True),
            urto.Circle(radius=1.0),
            urto.Polygon(vertices=((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))),
            urto.Polygon(vertices=((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)), radius=0.25),
            urto.Box(width=1.0, height=2.0, radius=0.5),
            urto.Capsule(a=(0.0, 1.0), b=(2.0, 3.0), radius=0.5, friction=0.25),
            urto.Chain(vertices=((0.0, 0.0), (-1.0, 0.0)), restitution=0.5),
            urto.Chain(vertices=((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)), loop=True),
        ),
    )  # fmt: skip
    assert body_from_proto(body_to_proto(body)) == body


@pytest.mark.parametrize(
    ("description", "text"),
    [
        (urto.Box(width="wide", height=1), "width must be a number, not 'wide'"),
        (urto.Circle(radius=1, position=(1, 2, 3)), "position must be two numbers"),
        (urto.Circle(radius=1, position=5), "position must be two numbers"),
        (urto.Circle(radius=1, type="ghost"), "type must be"),
        (urto.Circle(radius=1, mask=-1), "mask must be a whole number"),
        (urto.Polygon(vertices=[]), "vertices must be points, there are none"),
        (urto.Body(shapes=[urto.Circle(radius=1, name="inner")]), r"shapes\[0\].name belongs to the body"),
        ("box", "spawn takes a Box"),
    ],
)
def test_nonsense_is_told_before_it_is_sent(description: object, text: str) -> None:
    with pytest.raises(urto.InvalidArgument, match=text):
        body_to_proto(description)  # type: ignore[arg-type]


def test_numpy_vectors_serve() -> None:
    circle = urto.Circle(radius=np.float32(0.5), position=np.array([1.0, 2.0]))  # type: ignore[arg-type]
    message = body_to_proto(circle)
    assert (message.position.y, message.shapes[0].circle.radius) == (2, 0.5)

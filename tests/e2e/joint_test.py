"""Joints through a served room and the Python client."""

from __future__ import annotations

import math

import pytest
import urto
from conftest import EMPTY, TIMEOUT_S, WEIGHTLESS, Start

ANCHORS = """
bodies { name: "post" type: BODY_TYPE_STATIC shapes { circle { radius: 0.1 } mask: 0 } }
bodies { name: "box" position { y: -1 } shapes { box { width: 1 height: 1 } } }
joints { name: "hook" body_a { name: "post" } body_b { name: "box" } anchor_b { y: 1 } revolute {} }
"""


def test_scene_hangs_from_its_joint_and_breaks_when_it_is_too_much(start: Start) -> None:
    urtod = start(EMPTY + ANCHORS.replace("revolute {}", "revolute {} break_force: 10"), "--paused")
    with urto.connect(urtod.endpoint) as room:
        room.step(64)
        (joint,) = room.joints()
        assert (joint.name, joint.kind) == ("hook", "revolute")
        assert joint.force == pytest.approx((0, 8), abs=1e-3)  # 1 kg at 8 m/s²
        assert room.state().joints == room.joints()
        room.body("box").apply_force((0, -3))
        room.step(1)
        broke = next(event for event in room.events(timeout=TIMEOUT_S) if isinstance(event, urto.JointBroke))
        assert broke.id == joint.id
        assert broke.force > 10
        assert room.joints() == ()
        with pytest.raises(urto.UnknownJoint):
            room.destroy_joint("hook")
        room.reset()
        assert [joint.name for joint in room.joints()] == ["hook"]


def test_every_kind_is_made_and_driven(start: Start) -> None:
    urtod = start(WEIGHTLESS, "--paused")
    with urto.connect(urtod.endpoint) as room:
        with room.batch() as batch:
            post = batch.spawn(urto.Circle(radius=0.1, type="static"))
            wheel, slider, ball, flag, dragged = (
                batch.spawn(urto.Circle(radius=0.5, position=(x, 0))) for x in (2.0, 4.0, 6.0, 8.0, 10.0)
            )
            batch.create_joint(
                urto.RevoluteJoint(
                    name="axle", body_a=post, body_b=wheel, anchor_a=(2, 0), motor=urto.Motor(speed=3, bound=100)
                )
            )
            batch.create_joint(
                urto.PrismaticJoint(
                    name="rail", body_a=post, body_b=slider, anchor_a=(4, 0), axis=(0, 1), limits=(0, 1),
                    motor=urto.Motor(speed=2, bound=5),
                )
            )  # fmt: skip
            batch.create_joint(
                urto.DistanceJoint(
                    name="spring", body_a=post, body_b=ball, length=5, spring=urto.JointSpring(hertz=1, damping_ratio=1)
                )
            )
            batch.create_joint(urto.WeldJoint(name="weld", body_a=post, body_b=flag, anchor_a=(8, 0)))
            batch.create_joint(urto.MouseJoint(name="drag", body=dragged, target=(12, 1), force_max=100))
        room.step(64 * 4)
        joints = {joint.name: joint for joint in room.joints()}
        assert {name: joint.kind for name, joint in joints.items()} == {
            "axle": "revolute", "rail": "prismatic", "spring": "distance", "weld": "weld", "drag": "mouse",
        }  # fmt: skip
        assert joints["axle"].speed == pytest.approx(3, abs=1e-6)
        assert joints["axle"].motor == urto.Motor(3, 100)
        assert joints["rail"].position == pytest.approx(1, abs=1e-3)
        assert joints["spring"].position == pytest.approx(5, abs=1e-6)
        assert joints["drag"].position == pytest.approx(0, abs=1e-3)
        room.set_motor("axle", urto.Motor(speed=-1, bound=100))
        room.set_target("drag", (0, 5))
        room.step(64 * 4)
        joints = {joint.name: joint for joint in room.joints()}
        assert joints["axle"].speed == pytest.approx(-1, abs=1e-6)
        assert math.dist(joints["drag"].point_b, (0, 5)) < 1e-3
        room.body(wheel.id).despawn()
        assert "axle" not in {joint.name for joint in room.joints()}
        with pytest.raises(urto.WrongJointKind):
            room.set_motor("weld", urto.Motor(1, 1))
        with pytest.raises(urto.InvalidValue):
            room.create_joint(urto.DistanceJoint(body_a=post, body_b=ball, length=-1))


def test_solver_without_joints_says_so(start: Start) -> None:
    urtod = start(EMPTY.replace("sub_steps: 1", "sub_steps: 1 solver: SOLVER_THESIS"), "--paused")
    with urto.connect(urtod.endpoint) as room:
        a = room.spawn(urto.Circle(radius=0.1, type="static"))
        b = room.spawn(urto.Circle(radius=0.1, position=(1, 0)))
        with pytest.raises(urto.NotSupported):
            room.create_joint(urto.WeldJoint(body_a=a, body_b=b))

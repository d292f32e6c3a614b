#include "codec/scene_codec.h"

#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "support/proto_text.h"

namespace urto::codec {
namespace {

using testing::from_text;

// Every field is set, each to another value than its default.
constexpr const char* kFullScene = R"(
name: "full" description: "All there is."
world {
  precision: PRECISION_DOUBLE gravity { x: 1 y: 2 } time_step: 0.01 sub_steps: 7 solver: SOLVER_PRECISE
  integrator: INTEGRATOR_RUNGE_KUTTA_4 broad_phase: BROAD_PHASE_BVH narrow_phase: NARROW_PHASE_GJK
  sleeping: false continuous: false friction_mixing: MIXING_MINIMUM restitution_mixing: MIXING_AVERAGE
  restitution_threshold: 3 hit_events { speed_min: 4 }
}
bodies {
  name: "b" tags: "t1" tags: "t2" type: BODY_TYPE_KINEMATIC position { x: 1 y: 2 } angle: 3
  velocity { x: 4 y: 5 } angular_velocity: 6
  shapes { box { width: 1 height: 2 center { x: 3 y: 4 } angle: 5 radius: 7 } density: 6 friction: 7 restitution: 0.5
           category: 0x10 mask: 0x20 sensor: true }
  shapes { circle { radius: 1 center { x: 2 y: 3 } } density: 1 friction: 0.6 restitution: 0 category: 1
           mask: 0xffffffff sensor: false }
  shapes { polygon { vertices { x: 0 y: 0 } vertices { x: 1 y: 0 } vertices { x: 0 y: 1 } } density: 1 friction: 0.6
           restitution: 0 category: 1 mask: 0xffffffff sensor: false }
  shapes { box { width: 1 height: 2 center { x: 3 y: 4 } angle: 5 radius: 6 } density: 1 friction: 0.6 restitution: 0
           category: 1 mask: 0xffffffff sensor: false }
  shapes { polygon { vertices { x: 0 y: 0 } vertices { x: 1 y: 0 } vertices { x: 0 y: 1 } radius: 0.5 } density: 1
           friction: 0.6 restitution: 0 category: 1 mask: 0xffffffff sensor: false }
  shapes { capsule { a { x: 1 y: 2 } b { x: 3 y: 4 } radius: 5 } density: 1 friction: 0.6 restitution: 0 category: 1
           mask: 0xffffffff sensor: false }
  shapes { chain { vertices { x: 0 y: 0 } vertices { x: 1 y: 0 } vertices { x: 0 y: 1 } loop: true } density: 1
           friction: 0.6 restitution: 0 category: 1 mask: 0xffffffff sensor: false }
  mass: 8 linear_damping: 9 angular_damping: 10 gravity_scale: 11 fixed_rotation: true awake: false color: 0x123456
}
fields { point_attractor { center { x: 1 y: 2 } strength: 3 softening: 4 } }
fields { drag { linear: 5 quadratic: 6 } }
fields { spring { center { x: 7 y: 8 } stiffness: 9 damping: 10 } }
view { lower { x: -1 y: -2 } upper { x: 3 y: 4 } }
)";

TEST(SceneCodec, EveryFieldSurvivesTheRoundTrip) {
  const auto message = from_text<v1::Scene>(kFullScene);
  v1::Scene back;
  write_scene(scene_from_proto(message), &back);
  google::protobuf::util::MessageDifferencer differencer;
  std::string differences;
  differencer.ReportDifferencesToString(&differences);
  EXPECT_TRUE(differencer.Compare(message, back)) << differences;
}

TEST(SceneCodec, AbsentFieldsTakeTheEnginesDefaults) {
  const SceneDef scene = scene_from_proto(from_text<v1::Scene>("name: 'a' bodies { shapes { box {} } }"));
  const WorldSettings defaults;
  EXPECT_EQ(scene.world.precision, Precision::kFloat);
  EXPECT_EQ(scene.world.gravity, Vec2(0, -9.81));
  EXPECT_EQ(scene.world.time_step, 1.0 / 60.0);
  EXPECT_EQ(scene.world.sub_steps, 4u);
  EXPECT_EQ(scene.world.solver, SolverKind::kSoftStep);
  EXPECT_EQ(scene.world.broad_phase, BroadPhaseKind::kAuto);
  EXPECT_EQ(scene.world.friction_mixing, Mixing::kGeometricMean);
  EXPECT_EQ(scene.world.restitution_mixing, Mixing::kMaximum);
  EXPECT_TRUE(scene.world.sleeping);
  EXPECT_TRUE(scene.world.continuous);
  EXPECT_FALSE(scene.world.hit_events);
  const SceneDef asking = scene_from_proto(from_text<v1::Scene>("world { hit_events {} }"));
  EXPECT_EQ(asking.world.hit_events->speed_min, kHitSpeedDefault);
  EXPECT_FALSE(scene.view);
  const BodySpec& body = scene.bodies.at(0);
  EXPECT_EQ(body.def.type, BodyType::kDynamic);
  EXPECT_FALSE(body.def.mass);
  EXPECT_TRUE(body.def.awake);
  EXPECT_EQ(body.def.gravity_scale, 1);
  EXPECT_FALSE(body.color);
  EXPECT_EQ(body.def.shapes[0].material.density, 1);
  EXPECT_EQ(body.def.shapes[0].material.friction, 0.6);
  EXPECT_EQ(body.def.shapes[0].filter.category, 1u);
  EXPECT_EQ(body.def.shapes[0].filter.mask, 0xffffffffu);
}

TEST(SceneCodec, ZeroThatWasWrittenIsNoDefault) {
  const SceneDef scene = scene_from_proto(from_text<v1::Scene>(
      "world { gravity {} restitution_threshold: 0 sleeping: false } "
      "bodies { gravity_scale: 0 awake: false color: 0 shapes { box {} friction: 0 category: 0 mask: 0 } }"));
  EXPECT_EQ(scene.world.gravity, Vec2(0, 0));
  EXPECT_EQ(scene.world.restitution_threshold, 0);
  EXPECT_EQ(scene.bodies[0].def.gravity_scale, 0);
  EXPECT_EQ(scene.bodies[0].color, 0u);
  EXPECT_EQ(scene.bodies[0].def.shapes[0].material.friction, 0);
  EXPECT_EQ(scene.bodies[0].def.shapes[0].filter.mask, 0u);
}

}  // namespace
}  // namespace urto::codec

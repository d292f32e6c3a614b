#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "room/room.h"
#include "support/fake_world.h"
#include "support/room_driver.h"

namespace urto {
namespace {

using testing::box_body;
using ::testing::ElementsAre;
using testing::FakeWorld;
using ::testing::IsEmpty;
using testing::RoomDriver;
using ::testing::SizeIs;

BodySpec body_named(const std::string& name, double x, BodyType type = BodyType::kDynamic) {
  BodySpec spec;
  spec.name = name;
  spec.def.type = type;
  spec.def.position = {x, 0};
  spec.def.shapes.push_back({Box{1, 1, {0, 0}, 0}, {}, {}, false});
  return spec;
}

JointSpec joint_named(const std::string& name, BodyRef a, BodyRef b, JointGeometry geometry = RevoluteJoint{}) {
  JointSpec spec;
  spec.name = name;
  spec.body_a = std::move(a);
  spec.body_b = std::move(b);
  spec.def.geometry = std::move(geometry);
  return spec;
}

JointSpec mouse_named(const std::string& name, BodyRef body) {
  JointSpec spec;
  spec.name = name;
  spec.body_b = std::move(body);
  spec.def.geometry = MouseJoint{{1, 2}, {5, 1}, 10};
  return spec;
}

SceneDef scene_of_joints() {
  SceneDef scene;
  scene.name = "joints";
  scene.world.gravity = {0, 0};
  scene.bodies = {body_named("post", 0, BodyType::kStatic), body_named("wheel", 2), body_named("box", 4)};
  scene.joints = {joint_named("axle", "post", "wheel"), joint_named("rod", "wheel", "box", DistanceJoint{})};
  scene.joints[0].def.anchor_a = {2, 0};
  return scene;
}

class RoomJoints : public ::testing::Test {
 protected:
  RoomDriver driver_{RoomSettings{}, scene_of_joints()};

  std::vector<std::string> names() {
    std::vector<std::string> out;
    const BatchReply reply = driver_.ask({RoomQuery(JointsQuery{})});
    for (const JointInfo& joint : *reply.results.at(0).query->joints) out.push_back(joint.record->spec.name);
    return out;
  }
  RejectionCode code_of(std::vector<Command> commands) {
    const BatchReply reply = driver_.ask(std::move(commands));
    EXPECT_TRUE(reply.rejection);
    return reply.rejection ? reply.rejection->code : RejectionCode::kMalformed;
  }
};

TEST_F(RoomJoints, SceneBringsItsJoints) {
  EXPECT_THAT(names(), ElementsAre("axle", "rod"));
  const auto view = driver_.room->view({true, false});
  ASSERT_TRUE(view);
  ASSERT_THAT(view->joints, SizeIs(2));
  EXPECT_EQ(view->joints[1].state.kind, JointKind::kDistance);
  EXPECT_NEAR(view->joints[1].state.position, 2, 1e-6);
}

TEST_F(RoomJoints, JointIsMadeTogetherWithItsBodies) {
  const BatchReply reply = driver_.ask({Spawn{body_named("a", 6)}, Spawn{body_named("b", 8)},
                                        CreateJoint{joint_named("link", "a", "b", WeldJoint{})},
                                        CreateJoint{mouse_named("drag", "b")}, SetTarget{"drag", {7, 7}}});
  ASSERT_FALSE(reply.rejection);
  EXPECT_EQ(reply.results.at(2).id, driver_.room->world().joints().at(2));
  EXPECT_THAT(names(), ElementsAre("axle", "rod", "link", "drag"));
  const auto added = driver_.events_of<JointAdded>();
  ASSERT_THAT(added, SizeIs(2));
  EXPECT_EQ(added[0].joint->user, "ann");
  EXPECT_EQ(added[0].joint->spec.def.body_a, reply.results.at(0).id);
  EXPECT_EQ(driver_.room->world().joint(reply.results.at(3).id)->point_a, Vec2(7, 7));
}

TEST_F(RoomJoints, MotorIsSetByName) {
  ASSERT_FALSE(driver_.ask({SetMotor{"axle", {true, 3, 100}}}).rejection);
  for (int i = 0; i < 60; ++i) driver_.tick();
  const JointId axle = driver_.room->world().joints().at(0);
  EXPECT_NEAR(driver_.room->world().joint(axle)->speed, 3, 0.5);  // the box swings on its rod
}

TEST_F(RoomJoints, DestroyedJointIsGone) {
  ASSERT_FALSE(driver_.ask({DestroyJoint{"rod"}}).rejection);
  EXPECT_THAT(names(), ElementsAre("axle"));
  EXPECT_THAT(driver_.events_of<JointRemoved>(), SizeIs(1));
  EXPECT_EQ(code_of({DestroyJoint{"rod"}}), RejectionCode::kUnknownJoint);
}

TEST_F(RoomJoints, JointGoesWithItsBodyAndComesBackWithAReset) {
  ASSERT_FALSE(driver_.ask({Despawn{"box"}}).rejection);
  EXPECT_THAT(names(), ElementsAre("axle"));
  ASSERT_FALSE(driver_.ask({Reset{}}).rejection);
  EXPECT_THAT(names(), ElementsAre("axle", "rod"));
}

TEST_F(RoomJoints, BatchKnowsWhatItWillHaveDone) {
  // A joint whose body the batch takes away first; a name that it gives twice; one that it frees and gives again.
  EXPECT_EQ(code_of({Despawn{"wheel"}, SetMotor{"axle", {}}}), RejectionCode::kUnknownJoint);
  EXPECT_EQ(code_of({CreateJoint{joint_named("new", "post", "box")}, CreateJoint{joint_named("new", "post", "box")}}),
            RejectionCode::kDuplicateName);
  EXPECT_EQ(
      code_of({Spawn{body_named("a", 6)}, CreateJoint{joint_named("n", "a", "box")}, Despawn{"a"}, DestroyJoint{"n"}}),
      RejectionCode::kUnknownJoint);
  EXPECT_FALSE(driver_.ask({DestroyJoint{"rod"}, CreateJoint{joint_named("rod", "post", "box")}}).rejection);
  EXPECT_FALSE(driver_.ask({Reset{}, SetMotor{"axle", {true, 1, 1}}}).rejection);
}

TEST_F(RoomJoints, WhatTheEngineWouldRefuseIsRefused) {
  const auto create = [&](JointSpec spec) { return code_of({CreateJoint{std::move(spec)}}); };
  EXPECT_EQ(create(joint_named("", "nobody", "box")), RejectionCode::kUnknownBody);
  EXPECT_EQ(create(joint_named("", "post", BodyId{99})), RejectionCode::kUnknownBody);
  EXPECT_EQ(create(joint_named("", "box", "box")), RejectionCode::kInvalidValue);
  EXPECT_EQ(create(joint_named("axle", "post", "box")), RejectionCode::kDuplicateName);
  EXPECT_EQ(create(joint_named(std::string(100, 'x'), "post", "box")), RejectionCode::kInvalidValue);
  EXPECT_EQ(create(joint_named("", "post", "box", DistanceJoint{-1.0, {}, {}})), RejectionCode::kInvalidValue);
  EXPECT_EQ(create(joint_named("", "post", "box", MouseJoint{})), RejectionCode::kInvalidValue);
  JointSpec lonely = mouse_named("", "box");
  lonely.def.geometry = WeldJoint{};
  EXPECT_EQ(create(lonely), RejectionCode::kInvalidValue);
  EXPECT_EQ(create(mouse_named("", "post")), RejectionCode::kWrongBodyType);
  EXPECT_EQ(code_of({SetMotor{"rod", {}}}), RejectionCode::kWrongJointKind);
  EXPECT_EQ(code_of({SetTarget{"axle", {0, 0}}}), RejectionCode::kWrongJointKind);
  EXPECT_EQ(code_of({SetMotor{"axle", {true, 0, -1}}}), RejectionCode::kInvalidValue);
  EXPECT_EQ(code_of({SetMotor{JointId{77}, {}}}), RejectionCode::kUnknownJoint);
  EXPECT_THAT(names(), ElementsAre("axle", "rod"));
}

TEST(RoomJointLimits, RoomHoldsSoManyJoints) {
  RoomSettings settings;
  settings.limits.joints_max = 2;
  RoomDriver driver(settings, scene_of_joints());
  const BatchReply reply = driver.ask({CreateJoint{joint_named("", "post", "box")}});
  ASSERT_TRUE(reply.rejection);
  EXPECT_EQ(reply.rejection->code, RejectionCode::kQuota);
  EXPECT_FALSE(driver.ask({DestroyJoint{"rod"}, CreateJoint{joint_named("", "post", "box")}}).rejection);
  settings.limits.joints_max = 1;
  const auto refused = Room::create(settings, scene_of_joints(), testing::real_world);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "joints");
}

TEST(RoomJointEvents, BrokenJointIsToldAndForgotten) {
  FakeWorld* world = nullptr;
  RoomDriver driver(RoomSettings{}, scene_of_joints(),
                    [&](const WorldSettings& settings) -> Expected<std::unique_ptr<World>> {
                      auto made = std::make_unique<FakeWorld>(settings);
                      world = made.get();
                      return made;
                    });
  driver.tick();
  world->next_breaks = {2};
  driver.tick();
  ASSERT_THAT(driver.events_of<JointEvent>(), SizeIs(1));
  EXPECT_EQ(driver.events_of<JointEvent>()[0].joint, 2u);
  EXPECT_THAT(*driver.ask({RoomQuery(JointsQuery{})}).results.at(0).query->joints, SizeIs(1));
}

TEST(RoomJointScenes, BadJointOfASceneIsNamed) {
  SceneDef scene = scene_of_joints();
  scene.joints[1].body_b = "nobody";
  const auto refused = Room::create({}, scene, testing::real_world);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "joints[1].body_b");
}

}  // namespace
}  // namespace urto

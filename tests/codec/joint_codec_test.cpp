#include "codec/joint_codec.h"

#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "codec/command_codec.h"
#include "codec/scene_codec.h"
#include "support/proto_text.h"
#include "urto/v1/command.pb.h"

namespace urto::codec {
namespace {

using google::protobuf::util::MessageDifferencer;
using testing::from_text;

// Every field is set, each to another value than its default.
const char* const kFullJoints[] = {
    R"(name: "r" body_a { name: "a" } body_b { id: 7 } anchor_a { x: 1 y: 2 } anchor_b { x: 3 y: 4 }
       revolute { reference_angle: 5 limits { lower: -6 upper: 7 } motor { enabled: false speed: 8 bound: 9 }
                  spring { hertz: 10 damping_ratio: 11 } }
       break_force: 12 break_torque: 13 collide_connected: true)",
    R"(name: "" body_a { id: 1 } body_b { id: 2 } anchor_a { x: 0 y: 0 } anchor_b { x: 0 y: 0 }
       distance { length: 1 limits { lower: 2 upper: 3 } spring { hertz: 4 damping_ratio: 5 } }
       collide_connected: false)",
    R"(name: "" body_a { id: 1 } body_b { id: 2 } anchor_a { x: 0 y: 0 } anchor_b { x: 0 y: 0 }
       prismatic { axis { x: 1 y: 2 } reference_angle: 3 limits { lower: 4 upper: 5 }
                   motor { enabled: true speed: 6 bound: 7 } spring { hertz: 8 damping_ratio: 9 } }
       collide_connected: false)",
    R"(name: "" body_a { id: 1 } body_b { id: 2 } anchor_a { x: 0 y: 0 } anchor_b { x: 0 y: 0 }
       weld { reference_angle: 1 linear { hertz: 2 damping_ratio: 3 } angular { hertz: 4 damping_ratio: 5 } }
       collide_connected: false)",
    R"(name: "" body_b { id: 2 } anchor_a { x: 0 y: 0 } anchor_b { x: 0 y: 0 }
       mouse { target { x: 1 y: 2 } spring { hertz: 3 damping_ratio: 4 } force_max: 5 } collide_connected: false)",
};

TEST(JointCodec, EveryFieldSurvivesTheWayThereAndBack) {
  for (const char* text : kFullJoints) {
    const auto message = from_text<v1::Joint>(text);
    v1::Joint again;
    write_joint(joint_from_proto(message), &again);
    EXPECT_TRUE(MessageDifferencer::Equals(message, again)) << again.DebugString();
  }
}

TEST(JointCodec, SceneKeepsItsJoints) {
  v1::Scene message;
  for (const char* text : kFullJoints) *message.add_joints() = from_text<v1::Joint>(text);
  v1::Scene again;
  write_scene(scene_from_proto(message), &again);
  ASSERT_EQ(again.joints_size(), message.joints_size());
  for (int i = 0; i < message.joints_size(); ++i)
    EXPECT_TRUE(MessageDifferencer::Equals(message.joints(i), again.joints(i)));
}

TEST(JointCodec, AbsentFieldsAreDefaults) {
  const JointSpec joint = joint_from_proto(from_text<v1::Joint>("body_b { id: 1 } mouse { force_max: 2 }"));
  EXPECT_FALSE(joint.body_a);
  const auto& mouse = std::get<MouseJoint>(joint.def.geometry);
  EXPECT_EQ(mouse.spring.hertz, 5);
  EXPECT_EQ(mouse.spring.damping_ratio, 1);
  EXPECT_EQ(joint.def.break_force, kUnbreakable);
  const JointSpec slider = joint_from_proto(from_text<v1::Joint>("prismatic { motor { speed: 1 } }"));
  EXPECT_EQ(std::get<PrismaticJoint>(slider.def.geometry).axis, Vec2(1, 0));
  EXPECT_TRUE(std::get<PrismaticJoint>(slider.def.geometry).motor->enabled);
}

tl::expected<CommandBatch, DecodeFailure> decode(const std::string& command) {
  return decode_batch(from_text<v1::CommandBatch>("commands { " + command + " }").SerializeAsString(), Limits{});
}

template <class C>
C command(const std::string& text) {
  const auto batch = decode(text);
  EXPECT_TRUE(batch) << text;
  return std::get<C>(batch->commands.at(0));
}

TEST(JointCodec, DecodesEveryCommand) {
  const auto create =
      command<CreateJoint>("create_joint { joint { name: 'j' body_a { id: 1 } body_b { id: 2 } weld {} } }");
  EXPECT_EQ(create.joint.name, "j");
  EXPECT_EQ(create.joint.body_a, BodyRef(BodyId{1}));
  EXPECT_EQ(std::get<JointId>(command<DestroyJoint>("destroy_joint { joint { id: 3 } }").joint), 3u);
  const auto motor = command<SetMotor>("set_motor { joint { name: 'm' } motor { speed: 4 bound: 5 } }");
  EXPECT_EQ(std::get<std::string>(motor.joint), "m");
  EXPECT_TRUE(motor.motor.enabled);
  EXPECT_EQ(motor.motor.speed, 4);
  EXPECT_EQ(motor.motor.bound, 5);
  EXPECT_EQ(command<SetTarget>("set_target { joint { id: 1 } target { x: 6 y: 7 } }").target, Vec2(6, 7));
  EXPECT_TRUE(std::holds_alternative<JointsQuery>(command<RoomQuery>("query { joints {} }")));
}

TEST(JointCodec, WhatIsMissingOrWrongIsNamed) {
  const auto field_of = [](const std::string& text) {
    const auto batch = decode(text);
    EXPECT_FALSE(batch) << text;
    return batch ? std::string() : batch.error().rejection.field;
  };
  EXPECT_EQ(field_of("create_joint {}"), "create_joint.joint");
  EXPECT_EQ(field_of("create_joint { joint { weld {} } }"), "create_joint.joint.body_b");
  EXPECT_EQ(field_of("create_joint { joint { body_b { id: 1 } } }"), "create_joint.joint.kind");
  EXPECT_EQ(field_of("create_joint { joint { body_b {} weld {} } }"), "create_joint.joint.body_b.ref");
  EXPECT_EQ(field_of("create_joint { joint { body_b { id: 1 } weld {} break_force: inf } }"),
            "create_joint.joint.break_force");
  EXPECT_EQ(field_of("destroy_joint {}"), "destroy_joint.joint");
  EXPECT_EQ(field_of("set_motor { joint { id: 1 } }"), "set_motor.motor");
  EXPECT_EQ(field_of("set_target { joint { id: 1 } }"), "set_target.target");
}

}  // namespace
}  // namespace urto::codec

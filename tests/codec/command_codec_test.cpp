#include "codec/command_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/proto_text.h"
#include "support/scenes.h"
#include "urto/v1/command.pb.h"

namespace urto::codec {
namespace {

using testing::box_body;
using testing::from_bytes;
using testing::from_text;

CommandBatch decoded(const std::string& text) {
  auto batch = decode_batch(from_text<v1::CommandBatch>(text).SerializeAsString(), Limits{});
  EXPECT_TRUE(batch) << batch.error().rejection.field << ": " << batch.error().rejection.message;
  return batch.value_or(CommandBatch{});
}

template <class C>
C command(const std::string& text) {
  const CommandBatch batch = decoded("commands { " + text + " }");
  return std::get<C>(batch.commands.at(0));
}

TEST(CommandCodec, DecodesEveryCommand) {
  const auto spawn = command<Spawn>("spawn { body { name: 'crate' shapes { circle { radius: 2 } } } }");
  EXPECT_EQ(spawn.body.name, "crate");
  EXPECT_EQ(std::get<Circle>(spawn.body.def.shapes.at(0).geometry).radius, 2);
  EXPECT_EQ(std::get<BodyId>(command<Despawn>("despawn { body { id: 7 } }").body), 7u);

  const auto impulse = command<Impulse>(
      "impulse { body { name: 'a' } impulse { x: 1 y: 2 } point { x: 3 } frame: FRAME_BODY angular: 4 }");
  EXPECT_EQ(std::get<std::string>(impulse.body), "a");
  EXPECT_EQ(impulse.impulse, Vec2(1, 2));
  EXPECT_EQ(impulse.point, Vec2(3, 0));
  EXPECT_TRUE(impulse.in_body_frame);
  EXPECT_EQ(impulse.angular, 4);
  EXPECT_FALSE(command<Impulse>("impulse { body { id: 1 } }").point);
  EXPECT_FALSE(command<Impulse>("impulse { body { id: 1 } frame: FRAME_WORLD }").in_body_frame);

  const auto force = command<Force>("force { body { id: 1 } force { y: 5 } torque: 6 frame: FRAME_BODY duration: 7 }");
  EXPECT_EQ(force.force, Vec2(0, 5));
  EXPECT_EQ(force.torque, 6);
  EXPECT_TRUE(force.in_body_frame);
  EXPECT_EQ(force.duration, 7);
  EXPECT_FALSE(command<Force>("force { body { id: 1 } }").duration);

  const auto velocity = command<SetVelocity>("set_velocity { body { id: 1 } velocity { x: 1 } angular_velocity: 0 }");
  EXPECT_EQ(velocity.velocity, Vec2(1, 0));
  EXPECT_EQ(velocity.angular_velocity, 0);
  EXPECT_FALSE(command<SetVelocity>("set_velocity { body { id: 1 } }").velocity);
  const auto transform = command<SetTransform>("set_transform { body { id: 1 } angle: 1 }");
  EXPECT_FALSE(transform.position);
  EXPECT_EQ(transform.angle, 1);

  command<Pause>("pause {}");
  command<Resume>("resume {}");
  command<Reset>("reset {}");
  EXPECT_EQ(command<Step>("step { ticks: 9 }").ticks, 9u);
  EXPECT_EQ(command<SetTimeScale>("set_time_scale { scale: 2 }").scale, 2);
}

TEST(CommandCodec, DecodesEveryQuery) {
  const auto query = [](const std::string& text) { return command<RoomQuery>("query { " + text + " }"); };
  EXPECT_EQ(std::get<PointQuery>(query("point { point { x: 1 } }")).point, Vec2(1, 0));
  EXPECT_EQ(std::get<RegionQuery>(query("region { lower { x: 1 } upper { y: 2 } }")).upper, Vec2(0, 2));
  EXPECT_EQ(std::get<RayQuery>(query("ray { origin { x: 1 } translation { y: 2 } }")).translation, Vec2(0, 2));
  const auto nearest = std::get<NearestQuery>(query("nearest { point { x: 1 } distance_max: 3 }"));
  EXPECT_EQ(nearest.distance_max, 3);
  EXPECT_EQ(nearest.count_max, 1u);  // of 0
  EXPECT_EQ(std::get<NearestQuery>(query("nearest { count_max: 5 }")).count_max, 5u);
  std::get<ContactsQuery>(query("contacts {}"));
  std::get<DiagnosticsQuery>(query("diagnostics {}"));
  EXPECT_EQ(std::get<std::string>(std::get<BodyQuery>(query("body { body { name: 'a' } }")).body), "a");
}

TEST(CommandCodec, DecodesQueriesWithAShape) {
  const auto query = [](const std::string& text) { return command<RoomQuery>("query { " + text + " }"); };
  const auto cast = std::get<CastQuery>(
      query("cast { shape { box { width: 1 height: 2 radius: 3 } position { x: 4 } angle: 5 } translation { y: 6 }"
            " filter { category: 7 mask: 8 } count_max: 9 }"));
  EXPECT_EQ(std::get<Box>(cast.shape.geometry).height, 2);
  EXPECT_EQ(std::get<Box>(cast.shape.geometry).radius, 3);
  EXPECT_EQ(cast.shape.position, Vec2(4, 0));
  EXPECT_EQ(cast.shape.angle, 5);
  EXPECT_EQ(cast.translation, Vec2(0, 6));
  EXPECT_EQ(cast.options.filter->category, 7u);
  EXPECT_EQ(cast.options.filter->mask, 8u);
  EXPECT_EQ(cast.options.count_max, 9u);
  const auto overlap = std::get<OverlapQuery>(query("overlap { shape { point {} position { x: 1 y: 2 } } }"));
  EXPECT_TRUE(std::holds_alternative<PointGeometry>(overlap.shape.geometry));
  EXPECT_EQ(overlap.shape.position, Vec2(1, 2));
  EXPECT_FALSE(overlap.options.filter);
  EXPECT_EQ(overlap.options.count_max, kQueryHitsDefault);  // of 0
  const auto closest = std::get<ClosestQuery>(
      query("closest { shape { capsule { a { x: 1 } b { x: 2 } radius: 3 } } distance_max: 4 filter { mask: 2 } }"));
  EXPECT_EQ(std::get<Capsule>(closest.shape.geometry).b, Vec2(2, 0));
  EXPECT_EQ(closest.distance_max, 4);
  EXPECT_EQ(closest.options.filter->category, 0xffffffffu);
  EXPECT_EQ(closest.options.filter->mask, 2u);
  const auto polygon = query("overlap { shape { polygon { vertices {} vertices { x: 1 } vertices { y: 1 } } } }");
  EXPECT_EQ(std::get<Polygon>(std::get<OverlapQuery>(polygon).shape.geometry).vertices.size(), 3u);
  const auto circle = query("overlap { shape { circle { radius: 2 } } }");
  EXPECT_EQ(std::get<Circle>(std::get<OverlapQuery>(circle).shape.geometry).radius, 2);
}

struct BadCommand {
  std::string name;
  std::string text;
  RejectionCode code;
  std::string field;
};

class RefusedCommand : public ::testing::TestWithParam<BadCommand> {};

TEST_P(RefusedCommand, NamesTheFieldAndTheCommand) {
  auto message = from_text<v1::CommandBatch>("sequence: 5 commands { pause {} } commands { " + GetParam().text + " }");
  const auto batch = decode_batch(message.SerializeAsString(), Limits{});
  ASSERT_FALSE(batch);
  EXPECT_EQ(batch.error().sequence, 5u);
  EXPECT_EQ(batch.error().rejection.code, GetParam().code);
  EXPECT_EQ(batch.error().rejection.index, 1u);
  EXPECT_EQ(batch.error().rejection.field, GetParam().field);
  EXPECT_FALSE(batch.error().rejection.message.empty());
}

INSTANTIATE_TEST_SUITE_P(
    CommandCodec, RefusedCommand,
    ::testing::ValuesIn(std::vector<BadCommand>{
        {"NoCommand", "", RejectionCode::kMalformed, "command"},
        {"SpawnWithoutBody", "spawn {}", RejectionCode::kMalformed, "spawn.body"},
        {"ShapeWithoutGeometry", "spawn { body { shapes { box {} } shapes { friction: 1 } } }",
         RejectionCode::kMalformed, "spawn.body.shapes[1].geometry"},
        {"UnknownBodyType", "spawn { body { type: 17 shapes { box {} } } }", RejectionCode::kMalformed,
         "spawn.body.type"},
        {"NanWidth", "spawn { body { shapes { box { width: nan } } } }", RejectionCode::kInvalidValue,
         "spawn.body.shapes[0].box.width"},
        {"InfiniteVertex", "spawn { body { shapes { polygon { vertices {} vertices { y: -inf } } } } }",
         RejectionCode::kInvalidValue, "spawn.body.shapes[0].polygon.vertices[1].y"},
        {"NanMass", "spawn { body { mass: nan } }", RejectionCode::kInvalidValue, "spawn.body.mass"},
        {"DespawnNothing", "despawn {}", RejectionCode::kMalformed, "despawn.body"},
        {"DespawnEmptyRef", "despawn { body {} }", RejectionCode::kMalformed, "despawn.body.ref"},
        {"ImpulseWithoutBody", "impulse { impulse { x: 1 } }", RejectionCode::kMalformed, "impulse.body"},
        {"UnknownFrame", "impulse { body { id: 1 } frame: 9 }", RejectionCode::kMalformed, "impulse.frame"},
        {"NanPoint", "impulse { body { id: 1 } point { y: nan } }", RejectionCode::kInvalidValue, "impulse.point.y"},
        {"ForceWithoutBody", "force {}", RejectionCode::kMalformed, "force.body"},
        {"InfiniteDuration", "force { body { id: 1 } duration: inf }", RejectionCode::kInvalidValue, "force.duration"},
        {"VelocityWithoutBody", "set_velocity {}", RejectionCode::kMalformed, "set_velocity.body"},
        {"TransformWithoutBody", "set_transform {}", RejectionCode::kMalformed, "set_transform.body"},
        {"NanTimeScale", "set_time_scale { scale: nan }", RejectionCode::kInvalidValue, "set_time_scale.scale"},
        {"EmptyQuery", "query {}", RejectionCode::kMalformed, "query.query"},
        {"CastOfNothing", "query { cast {} }", RejectionCode::kMalformed, "query.cast.shape"},
        {"OverlapOfNothing", "query { overlap {} }", RejectionCode::kMalformed, "query.overlap.shape"},
        {"ClosestToNothing", "query { closest {} }", RejectionCode::kMalformed, "query.closest.shape"},
        {"QueryShapeWithoutGeometry", "query { closest { shape {} } }", RejectionCode::kMalformed,
         "query.closest.shape.geometry"},
        {"NanShape", "query { cast { shape { circle { radius: nan } } } }", RejectionCode::kInvalidValue,
         "query.cast.shape.circle.radius"},
        {"HalfRegion", "query { region { lower {} } }", RejectionCode::kMalformed, "query.region.upper"},
        {"BodyQueryOfNothing", "query { body {} }", RejectionCode::kMalformed, "query.body.body"},
    }),
    [](const auto& each) { return each.param.name; });

TEST(CommandCodec, FieldsOfANewerSchemaAreNotOverlooked) {
  v1::CommandBatch batch;
  auto* impulse = batch.add_commands()->mutable_impulse();
  impulse->mutable_body()->set_id(1);
  impulse->GetReflection()->MutableUnknownFields(impulse)->AddVarint(99, 1);
  const auto refused = decode_batch(batch.SerializeAsString(), Limits{});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().rejection.code, RejectionCode::kMalformed);
  EXPECT_EQ(refused.error().rejection.field, "impulse");
  EXPECT_EQ(refused.error().rejection.value, "99");
}

TEST(CommandCodec, WhatIsNoBatchIsMalformed) {
  const auto refused = decode_batch("\xff\xff\xff no batch", Limits{});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().rejection.code, RejectionCode::kMalformed);
  const auto bad_text = decode_batch(std::string("\x12\x06\x12\x04\x0a\x02\x12\xc0", 8), Limits{});  // no UTF-8 name
  EXPECT_EQ(bad_text.error().rejection.code, RejectionCode::kMalformed);
}

TEST(CommandCodec, OversizedMessagesAreRefusedUnread) {
  Limits limits;
  limits.message_bytes_max = 100;
  EXPECT_EQ(decode_batch(std::string(101, '\0'), limits).error().rejection.code, RejectionCode::kQuota);
  limits = {};
  limits.batch_commands_max = 2;
  const auto many = from_text<v1::CommandBatch>("commands { pause {} } commands { pause {} } commands { pause {} }");
  EXPECT_EQ(decode_batch(many.SerializeAsString(), limits).error().rejection.field, "commands");
}

TEST(CommandCodec, RandomBytesNeverGetThroughUnchecked) {
  std::uint64_t seed = 20261122;
  SCOPED_TRACE(seed);
  const auto random = [&seed] { return (seed = seed * 6364136223846793005u + 1442695040888963407u) >> 33; };
  const auto good = from_text<v1::CommandBatch>(
      "commands { spawn { body { name: 'a' shapes { box { width: 1 height: 2 } } } } } commands { step { ticks: 1 } }");
  for (int i = 0; i < 20'000; ++i) {
    std::string bytes = good.SerializeAsString();
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    const auto batch = decode_batch(bytes, Limits{});
    if (!batch) continue;
    for (const Command& each : batch->commands) {
      if (const auto* spawn = std::get_if<Spawn>(&each)) {
        EXPECT_TRUE(spawn->body.def.position.allFinite());
      }
    }
  }
}

TEST(CommandCodec, EncodesAReply) {
  BatchReply reply;
  reply.sequence = 3;
  reply.epoch = 2;
  reply.tick = 44;
  reply.results.resize(3);
  reply.results[0].id = 9;
  reply.results[1].query.emplace();
  reply.results[1].query->hits.push_back({5, {1, 2}, {0, 1}, 0.5, 7});
  ContactPoint contact;
  contact.body_a = 1;
  contact.body_b = 2;
  contact.point = {3, 4};
  contact.separation = -0.01;
  contact.normal_impulse = 6;
  reply.results[1].query->contacts = {contact};
  auto frame = std::make_shared<Frame>();
  frame->tick = 50;
  frame->full = true;
  reply.results[2].snapshot = frame;
  const auto message = from_bytes<v1::CommandReply>(encode_reply(reply));
  EXPECT_EQ(message.sequence(), 3u);
  EXPECT_EQ(message.epoch(), 2u);
  EXPECT_EQ(message.tick(), 44u);
  ASSERT_EQ(message.results_size(), 3);
  EXPECT_EQ(message.results(0).id(), 9u);
  const auto& hit = message.results(1).query().hits(0);
  EXPECT_EQ(hit.id(), 5u);
  EXPECT_EQ(hit.point().y(), 2);
  EXPECT_EQ(hit.normal().y(), 1);
  EXPECT_EQ(hit.fraction(), 0.5);
  EXPECT_EQ(hit.distance(), 7);
  EXPECT_EQ(message.results(1).query().contacts().body_b(0), 2u);
  EXPECT_EQ(message.results(1).query().contacts().separation(0), -0.01);
  EXPECT_EQ(message.results(2).snapshot().tick(), 50u);
  EXPECT_TRUE(message.results(2).snapshot().full());
  EXPECT_FALSE(message.has_rejection());
}

TEST(CommandCodec, EncodesARejection) {
  BatchReply reply;
  reply.rejection = Rejection{RejectionCode::kQueueFull, 2, "a.b", "17", "Too many."};
  const auto message = from_bytes<v1::CommandReply>(encode_reply(reply));
  EXPECT_EQ(message.rejection().code(), v1::REJECTION_CODE_QUEUE_FULL);
  EXPECT_EQ(message.rejection().index(), 2u);
  EXPECT_EQ(message.rejection().field(), "a.b");
  EXPECT_EQ(message.rejection().value(), "17");
  EXPECT_EQ(message.rejection().message(), "Too many.");
}

}  // namespace
}  // namespace urto::codec

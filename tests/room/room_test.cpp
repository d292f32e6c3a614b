#include "room/room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/fake_world.h"
#include "support/room_driver.h"

namespace urto {
namespace {

using testing::box_body;
using ::testing::Each;
using ::testing::ElementsAre;
using testing::FakeWorld;
using testing::floating_scene;
using ::testing::IsEmpty;
using testing::paused_settings;
using testing::RoomDriver;
using ::testing::SizeIs;

constexpr double kTimeStep = 1.0 / 60.0;

TEST(Room, TickAdvancesByOneTimeStep) {
  RoomDriver driver;
  EXPECT_TRUE(driver.tick().stepped);
  const TickResult result = driver.tick();
  ASSERT_TRUE(result.frame);
  EXPECT_EQ(result.frame->tick, 2u);
  EXPECT_EQ(result.frame->epoch, 1u);
  EXPECT_DOUBLE_EQ(result.frame->sim_time, 2 * kTimeStep);
}

TEST(Room, AnswerNamesTheTickBeforeTheStepThatShowsTheEffect) {
  RoomDriver driver;
  driver.tick();
  const Ticket ticket = driver.send({Impulse{"box", {3, 0}}});
  const TickResult result = driver.tick();
  const auto reply = driver.answer(ticket);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->tick, 1u);
  ASSERT_TRUE(result.frame);
  EXPECT_EQ(result.frame->tick, 2u);
  EXPECT_DOUBLE_EQ(result.frame->bodies.velocity_x.at(0), 3.0);  // 1 kg
}

TEST(Room, LiveFramesLeaveStaticBodiesOut) {
  RoomDriver driver;
  const TickResult result = driver.tick();
  EXPECT_THAT(result.frame->bodies.id, SizeIs(1));
  EXPECT_FALSE(result.frame->full);
}

TEST(Room, FramesComeAtTheSnapshotRate) {
  RoomSettings settings;
  settings.snapshot_rate_hz = 20;
  RoomDriver driver(settings);
  std::vector<std::uint64_t> ticks;
  for (int i = 0; i < 9; ++i) {
    if (const auto frame = driver.tick().frame) ticks.push_back(frame->tick);
  }
  EXPECT_THAT(ticks, ElementsAre(3, 6, 9));
}

TEST(Room, SpawnAnswersTheIdAndBeginsALayout) {
  RoomDriver driver;
  const std::uint64_t layout = driver.tick().frame->layout;
  const BatchReply reply = driver.ask({Spawn{box_body("crate", {3, 3})}, Spawn{box_body("", {6, 3})}});
  ASSERT_THAT(reply.results, SizeIs(2));
  EXPECT_TRUE(driver.room->world().contains(reply.results[0].id));
  EXPECT_NE(reply.results[0].id, reply.results[1].id);
  const auto added = driver.events_of<BodyAdded>();
  ASSERT_THAT(added, SizeIs(2));
  EXPECT_EQ(added[0].body->spec.name, "crate");
  EXPECT_EQ(added[0].body->user, "ann");
  EXPECT_EQ(added[0].layout, layout + 1);
  EXPECT_EQ(added[1].layout, layout + 2);
  EXPECT_EQ(driver.tick().frame->layout, layout + 2);
}

TEST(Room, CommandsOfABatchSeeTheOnesBefore) {
  RoomDriver driver(paused_settings());
  const BatchReply reply =
      driver.ask({Spawn{box_body("crate", {3, 3})}, Impulse{"crate", {2, 0}}, RoomQuery(BodyQuery{"crate"}),
                  Despawn{"crate"}, Spawn{box_body("crate", {9, 9})}});
  ASSERT_FALSE(reply.rejection) << reply.rejection->message;
  EXPECT_DOUBLE_EQ(reply.results[2].query->body->state.velocity.x(), 2);
  EXPECT_EQ(driver.state_of("crate").position, Vec2(9, 9));
}

// Each of these batches begins with commands that are good, and ends with one that is not.
struct BadBatch {
  std::string name;
  Command last;
  RejectionCode code;
  std::string field;
};

class RejectedBatch : public ::testing::TestWithParam<BadBatch> {};

TEST_P(RejectedBatch, LeavesTheWorldAsItWas) {
  RoomDriver driver;
  driver.ask({Spawn{box_body("mover", {20, 5}, BodyType::kKinematic)}});
  const std::uint64_t hash = driver.room->world().state_hash();
  const auto count = driver.room->world().counters().bodies;
  driver.room->submit(
      {"ann", 99, {7, {Spawn{box_body("crate", {3, 3})}, Impulse{"box", {2, 0}}, Pause{}, GetParam().last}}, 1});
  // The world is looked at before it steps: a paused twin of the tick would hide what the batch did.
  const bool was_paused = driver.room->paused();
  const TickResult result = driver.room->tick();
  ASSERT_THAT(result.answers, SizeIs(1));
  const BatchReply& reply = result.answers[0].reply;
  ASSERT_TRUE(reply.rejection);
  EXPECT_EQ(reply.rejection->code, GetParam().code) << reply.rejection->message;
  EXPECT_EQ(reply.rejection->index, 3u);
  EXPECT_EQ(reply.rejection->field, GetParam().field);
  EXPECT_FALSE(reply.rejection->message.empty());
  EXPECT_EQ(reply.sequence, 7u);
  EXPECT_THAT(reply.results, IsEmpty());
  EXPECT_EQ(driver.room->paused(), was_paused);
  EXPECT_EQ(driver.room->world().counters().bodies, count);

  RoomDriver twin;
  twin.ask({Spawn{box_body("mover", {20, 5}, BodyType::kKinematic)}});
  ASSERT_EQ(twin.room->world().state_hash(), hash);
  twin.tick();
  EXPECT_EQ(driver.room->world().state_hash(), twin.room->world().state_hash());
}

BodySpec with(BodySpec spec, const std::function<void(BodySpec&)>& change) {
  change(spec);
  return spec;
}

const double kNan = std::nan("");

INSTANTIATE_TEST_SUITE_P(
    Room, RejectedBatch,
    ::testing::ValuesIn(std::vector<BadBatch>{
        {"DuplicateName", Spawn{box_body("crate", {0, 0})}, RejectionCode::kDuplicateName, "spawn.body.name"},
        {"NameOfTheScene", Spawn{box_body("box", {0, 0})}, RejectionCode::kDuplicateName, "spawn.body.name"},
        {"LongName", Spawn{box_body(std::string(65, 'n'), {0, 0})}, RejectionCode::kInvalidValue, "spawn.body.name"},
        {"NegativeWidth", Spawn{box_body("c", {0, 0}, BodyType::kDynamic, -1)}, RejectionCode::kInvalidValue,
         "spawn.body.shapes[0].box.width"},
        {"NanPosition", Spawn{box_body("c", {kNan, 0})}, RejectionCode::kInvalidValue, "spawn.body.position.x"},
        {"NoShapes", Spawn{with(box_body("c", {0, 0}), [](BodySpec& b) { b.def.shapes.clear(); })},
         RejectionCode::kInvalidValue, "spawn.body.shapes"},
        {"TooManyTags", Spawn{with(box_body("c", {0, 0}), [](BodySpec& b) { b.tags.assign(9, "t"); })},
         RejectionCode::kInvalidValue, "spawn.body.tags"},
        {"EmptyTag",
         Spawn{with(box_body("c", {0, 0}),
                    [](BodySpec& b) {
                      b.tags = {"good", ""};
                    })},
         RejectionCode::kInvalidValue, "spawn.body.tags[1]"},
        {"Color", Spawn{with(box_body("c", {0, 0}), [](BodySpec& b) { b.color = 0x1000000; })},
         RejectionCode::kInvalidValue, "spawn.body.color"},
        {"UnknownId", Despawn{BodyId{12345}}, RejectionCode::kUnknownBody, "despawn.body.id"},
        {"UnknownName", Impulse{"nobody", {1, 0}}, RejectionCode::kUnknownBody, "impulse.body.name"},
        {"PushStatic", Impulse{"floor", {1, 0}}, RejectionCode::kWrongBodyType, "impulse.body"},
        {"PushKinematic", Force{"mover", {1, 0}}, RejectionCode::kWrongBodyType, "force.body"},
        {"NanImpulse", Impulse{"box", {0, kNan}}, RejectionCode::kInvalidValue, "impulse.impulse.y"},
        {"HugeImpulse", Impulse{"box", {1e300, 0}}, RejectionCode::kInvalidValue, "impulse.impulse.x"},
        {"FarPoint", Impulse{"box", {1, 0}, Vec2(1e9, 0)}, RejectionCode::kInvalidValue, "impulse.point.x"},
        {"NanAngular", Impulse{"box", {1, 0}, std::nullopt, false, kNan}, RejectionCode::kInvalidValue,
         "impulse.angular"},
        {"NanTorque", Force{"box", {1, 0}, kNan}, RejectionCode::kInvalidValue, "force.torque"},
        {"ZeroDuration", Force{"box", {1, 0}, 0, false, 0.0}, RejectionCode::kInvalidValue, "force.duration"},
        {"NanDuration", Force{"box", {1, 0}, 0, false, kNan}, RejectionCode::kInvalidValue, "force.duration"},
        {"VelocityOfStatic", SetVelocity{"floor", Vec2(1, 0), {}}, RejectionCode::kWrongBodyType, "set_velocity.body"},
        {"FastVelocity", SetVelocity{"box", Vec2(0, 2e6), {}}, RejectionCode::kInvalidValue, "set_velocity.velocity.y"},
        {"FastSpin", SetVelocity{"box", {}, 2e6}, RejectionCode::kInvalidValue, "set_velocity.angular_velocity"},
        {"FarPosition", SetTransform{"box", Vec2(2e7, 0), {}}, RejectionCode::kInvalidValue,
         "set_transform.position.x"},
        {"NanAngle", SetTransform{"box", {}, kNan}, RejectionCode::kInvalidValue, "set_transform.angle"},
        {"NoTicks", Step{0}, RejectionCode::kInvalidValue, "step.ticks"},
        {"ManyTicks", Step{36001}, RejectionCode::kInvalidValue, "step.ticks"},
        {"SlowTime", SetTimeScale{0}, RejectionCode::kInvalidValue, "set_time_scale.scale"},
        {"NanTime", SetTimeScale{kNan}, RejectionCode::kInvalidValue, "set_time_scale.scale"},
        {"RegionInsideOut", RoomQuery(RegionQuery{{1, 1}, {0, 2}}), RejectionCode::kInvalidValue, "query.region.lower"},
        {"NanRay", RoomQuery(RayQuery{{0, 0}, {kNan, 0}}), RejectionCode::kInvalidValue, "query.ray.translation.x"},
        {"NegativeDistance", RoomQuery(NearestQuery{{0, 0}, -1, 1}), RejectionCode::kInvalidValue,
         "query.nearest.distance_max"},
        {"ManyNearest", RoomQuery(NearestQuery{{0, 0}, 1, 1025}), RejectionCode::kInvalidValue,
         "query.nearest.count_max"},
        {"CastOfANegativeBox", RoomQuery(CastQuery{{Box{1, -1, {0, 0}, 0}, {0, 0}, 0}, {1, 0}, {}}),
         RejectionCode::kInvalidValue, "query.cast.shape.box.height"},
        {"FarCast", RoomQuery(CastQuery{{PointGeometry{}, {0, 0}, 0}, {0, 1e9}, {}}), RejectionCode::kInvalidValue,
         "query.cast.translation.y"},
        {"OverlapOfALine", RoomQuery(OverlapQuery{{Polygon{{{0, 0}, {1, 0}, {2, 0}}, 0}, {0, 0}, 0}, {}}),
         RejectionCode::kDegenerateShape, "query.overlap.shape.polygon.vertices[2]"},
        {"ManyOverlaps", RoomQuery(OverlapQuery{{PointGeometry{}, {0, 0}, 0}, {std::nullopt, 4097}}),
         RejectionCode::kInvalidValue, "query.overlap.count_max"},
        {"ClosestAtNan", RoomQuery(ClosestQuery{{PointGeometry{}, {0, kNan}, 0}, 1, {}}), RejectionCode::kInvalidValue,
         "query.closest.shape.position.y"},
        {"ClosestBehind", RoomQuery(ClosestQuery{{PointGeometry{}, {0, 0}, 0}, -1, {}}), RejectionCode::kInvalidValue,
         "query.closest.distance_max"},
        {"UnknownBodyQuery", RoomQuery(BodyQuery{"nobody"}), RejectionCode::kUnknownBody, "query.body.body.name"},
    }),
    [](const auto& each) { return each.param.name; });

TEST(Room, EmptyAndOversizedBatchesAreRejected) {
  RoomDriver driver;
  EXPECT_EQ(driver.ask({}).rejection->code, RejectionCode::kInvalidValue);
  const std::vector<Command> most(1024, RoomQuery(ContactsQuery{}));
  EXPECT_FALSE(driver.ask(most).rejection);
  const std::vector<Command> many(1025, RoomQuery(ContactsQuery{}));
  EXPECT_EQ(driver.ask(many).rejection->code, RejectionCode::kQuota);
}

TEST(Room, StepIsTheLastOfItsBatch) {
  RoomDriver driver(paused_settings());
  const BatchReply reply = driver.ask({Step{1}, Impulse{"box", {1, 0}}});
  ASSERT_TRUE(reply.rejection);
  EXPECT_EQ(reply.rejection->field, "step");
  EXPECT_EQ(reply.rejection->index, 0u);
  EXPECT_EQ(driver.room->ticks_owed(), 0u);
}

TEST(Room, BodyQuotaCountsTheBatchItself) {
  RoomSettings settings;
  settings.limits.bodies_max = 4;
  RoomDriver driver(settings);
  EXPECT_EQ(driver.ask({Spawn{box_body("a", {3, 3})}, Spawn{box_body("b", {5, 3})}, Spawn{box_body("c", {7, 3})}})
                .rejection->index,
            2u);
  EXPECT_FALSE(driver.ask({Spawn{box_body("a", {3, 3})}, Spawn{box_body("b", {5, 3})}}).rejection);
  const BatchReply over = driver.ask({Spawn{box_body("c", {7, 3})}});
  EXPECT_EQ(over.rejection->code, RejectionCode::kQuota);
  EXPECT_FALSE(driver.ask({Despawn{"a"}, Spawn{box_body("c", {7, 3})}}).rejection);
}

TEST(Room, ShapeQuotaCountsTheBatchItself) {
  RoomSettings settings;
  settings.limits.shapes_max = 3;
  RoomDriver driver(settings);
  EXPECT_EQ(driver.ask({Spawn{box_body("a", {3, 3})}, Spawn{box_body("b", {5, 3})}}).rejection->field,
            "spawn.body.shapes");
  EXPECT_FALSE(driver.ask({Spawn{box_body("a", {3, 3})}, Despawn{"a"}, Spawn{box_body("a", {3, 3})}}).rejection);
}

TEST(Room, PausedRoomAppliesAndAnswersBetweenTicks) {
  RoomDriver driver(paused_settings());
  driver.tick();
  const Ticket ticket = driver.send({SetTransform{"box", Vec2(4, 4), {}}});
  EXPECT_TRUE(driver.room->has_work());
  const TickResult result = driver.tick();
  EXPECT_FALSE(result.stepped);
  EXPECT_TRUE(driver.answer(ticket));
  ASSERT_TRUE(result.frame);  // viewers see the change
  EXPECT_EQ(result.frame->bodies.x.at(0), 4);
  EXPECT_TRUE(result.frame->paused);
  EXPECT_FALSE(driver.room->has_work());
  EXPECT_FALSE(driver.tick().frame);
}

TEST(Room, StepIsAnsweredAfterItsLastTickWithTheWholeState) {
  RoomDriver driver(paused_settings());
  const Ticket ticket = driver.send({SetVelocity{"box", Vec2(6, 0), {}}, Step{3}});
  driver.tick();
  EXPECT_EQ(driver.room->ticks_owed(), 2u);
  driver.tick();
  EXPECT_FALSE(driver.answer(ticket));
  driver.tick();
  const auto reply = driver.answer(ticket);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->tick, 0u);
  ASSERT_TRUE(reply->results.at(1).snapshot);
  const Frame& frame = *reply->results[1].snapshot;
  EXPECT_EQ(frame.tick, 3u);
  EXPECT_TRUE(frame.full);
  EXPECT_THAT(frame.bodies.id, SizeIs(2));
  EXPECT_NEAR(frame.bodies.x.at(1), 6 * 3 * kTimeStep, 1e-12);
  EXPECT_FALSE(driver.tick().stepped);
}

TEST(Room, StepsQueueUpBehindEachOther) {
  RoomDriver driver(paused_settings());
  const Ticket first = driver.send({Step{2}}, "ann");
  const Ticket second = driver.send({Step{3}}, "bob");
  const Ticket third = driver.send({Step{1}}, "ann");
  for (int i = 0; i < 10; ++i) driver.tick();
  EXPECT_EQ(driver.room->world().step_count(), 6u);
  std::vector<std::uint64_t> ticks;
  for (const Ticket ticket : {first, second, third})
    ticks.push_back(driver.answer(ticket)->results.at(0).snapshot->tick);
  EXPECT_THAT(ticks, ElementsAre(2, 5, 6));
}

TEST(Room, StepNeedsAPausedRoom) {
  RoomDriver driver;
  EXPECT_EQ(driver.ask({Step{1}}).rejection->code, RejectionCode::kNotPaused);
  EXPECT_FALSE(driver.room->paused());
  driver.send({Pause{}, Step{1}});
  EXPECT_TRUE(driver.tick().stepped);
  EXPECT_FALSE(driver.tick().stepped);
  EXPECT_EQ(driver.ask({Resume{}, Step{1}}).rejection->code, RejectionCode::kNotPaused);
}

TEST(Room, WaitingStepsAreBounded) {
  RoomSettings settings = paused_settings();
  settings.limits.steps_waiting_max = 2;
  RoomDriver driver(settings);
  driver.send({Step{100}});
  driver.send({Step{100}});
  EXPECT_EQ(driver.ask({Step{100}}).rejection->code, RejectionCode::kQueueFull);
}

TEST(Room, ResetRebuildsTheScene) {
  RoomDriver driver(paused_settings());
  const std::uint64_t hash = driver.room->world().state_hash();
  const auto ids = [&] {
    std::vector<BodyId> found;
    const auto view = driver.room->view({true, false});
    for (const BodyInfo& body : view->bodies) found.push_back(body.record->id);
    return found;
  };
  const std::vector<BodyId> before = ids();
  driver.send({Spawn{box_body("crate", {3, 3})}, Despawn{"floor"}, Force{"box", {1, 0}}, Step{5}});
  for (int i = 0; i < 5; ++i) driver.tick();
  EXPECT_NE(ids(), before);
  const BatchReply reply = driver.ask({Reset{}});
  EXPECT_EQ(reply.epoch, 2u);
  EXPECT_EQ(reply.tick, 0u);
  EXPECT_EQ(driver.room->world().state_hash(), hash);
  EXPECT_EQ(ids(), before);
  EXPECT_EQ(driver.ask({Impulse{"crate", {1, 0}}}).rejection->code, RejectionCode::kUnknownBody);
  ASSERT_THAT(driver.events_of<RoomReset>(), SizeIs(1));
  EXPECT_EQ(driver.events_of<RoomReset>()[0].epoch, 2u);
  EXPECT_TRUE(driver.room->paused());
  driver.send({Step{1}});
  driver.tick();
  EXPECT_EQ(driver.state_of("box").velocity, Vec2(0, 0));  // the force is gone
}

TEST(Room, BatchGoesOnAfterItsReset) {
  RoomDriver driver(paused_settings());
  driver.ask({Spawn{box_body("crate", {3, 3})}, Despawn{"box"}});
  EXPECT_EQ(driver.ask({Reset{}, Impulse{"crate", {1, 0}}}).rejection->index, 1u);
  EXPECT_EQ(driver.room->world().counters().bodies, 2u);
  EXPECT_FALSE(driver.ask({Reset{}, Spawn{box_body("crate", {3, 3})}, Impulse{"box", {1, 0}}}).rejection);
  EXPECT_EQ(driver.state_of("box").velocity, Vec2(1, 0));
}

TEST(Room, ResetAndCloseCancelWaitingSteps) {
  RoomDriver driver(paused_settings());
  const Ticket overtaken = driver.send({Step{100}});
  driver.tick();
  driver.ask({Reset{}});
  ASSERT_TRUE(driver.answer(overtaken));
  EXPECT_EQ(driver.answer(overtaken)->rejection->code, RejectionCode::kCancelled);
  const Ticket step = driver.send({Step{100}});
  driver.tick();
  const Ticket queued = driver.send({Impulse{"box", {1, 0}}});
  std::vector<Ticket> cancelled;
  for (const Answer& answer : driver.room->close()) {
    EXPECT_EQ(answer.reply.rejection->code, RejectionCode::kCancelled);
    cancelled.push_back(answer.ticket);
  }
  EXPECT_THAT(cancelled, ElementsAre(step, queued));
}

TEST(Room, ForceActsUntilItIsSetAnew) {
  RoomDriver driver(paused_settings());
  driver.send({Force{"box", {6, 0}}, Step{10}});
  for (int i = 0; i < 10; ++i) driver.tick();
  EXPECT_NEAR(driver.state_of("box").velocity.x(), 6 * 10 * kTimeStep, 1e-12);
  driver.send({Force{"box", {0, 0}}, Step{10}});
  for (int i = 0; i < 10; ++i) driver.tick();
  EXPECT_NEAR(driver.state_of("box").velocity.x(), 6 * 10 * kTimeStep, 1e-12);
}

TEST(Room, ForceWithADurationEndsAfterTheTicksThatHoldIt) {
  // 0.1 s are 6 ticks exactly, though 0.1 / (1/60) rounds up; 0.101 s are 7; a moment is 1.
  const std::vector<std::pair<double, int>> cases{{0.1, 6}, {0.101, 7}, {1e-6, 1}};
  for (const auto& [duration, ticks] : cases) {
    RoomDriver driver(paused_settings());
    driver.send({Force{"box", {60, 0}, 0, false, duration}, Step{20}});
    for (int i = 0; i < 20; ++i) driver.tick();
    EXPECT_NEAR(driver.state_of("box").velocity.x(), ticks, 1e-12) << duration;
  }
}

TEST(Room, NewForceTakesTheEndOfTheOldOneAway) {
  RoomDriver driver(paused_settings());
  driver.send({Force{"box", {60, 0}, 0, false, 0.1}, Step{2}});
  for (int i = 0; i < 2; ++i) driver.tick();
  driver.send({Force{"box", {60, 0}}, Step{20}});
  for (int i = 0; i < 20; ++i) driver.tick();
  EXPECT_NEAR(driver.state_of("box").velocity.x(), 22, 1e-12);
}

TEST(Room, ImpulseInTheBodyFrameTurnsWithTheBody) {
  RoomDriver driver(paused_settings());
  driver.ask({SetTransform{"box", {}, std::acos(-1.0) / 2}});
  driver.ask({Impulse{"box", {2, 0}, std::nullopt, true}});
  EXPECT_NEAR(driver.state_of("box").velocity.x(), 0, 1e-12);
  EXPECT_NEAR(driver.state_of("box").velocity.y(), 2, 1e-12);
  // At the body's (0.5, 0), which is at world (0, 5.5), along the body's y, which is the world's −x: the arm is up, so
  // the torque is +0.5 · 1, over an inertia of 1/6.
  driver.ask({SetVelocity{"box", Vec2(0, 0), 0.0}, Impulse{"box", {0, 1}, Vec2(0.5, 0), true}});
  EXPECT_NEAR(driver.state_of("box").velocity.x(), -1, 1e-12);
  EXPECT_NEAR(driver.state_of("box").angular_velocity, 3, 1e-12);
}

TEST(Room, PartsOfAMotionThatAreAbsentStay) {
  RoomDriver driver(paused_settings());
  driver.ask({SetVelocity{"box", Vec2(1, 2), 3.0}});
  driver.ask({SetVelocity{"box", {}, 4.0}});
  driver.ask({SetTransform{"box", {}, 0.5}});
  driver.ask({SetTransform{"box", Vec2(7, 8), {}}});
  const BodyState state = driver.state_of("box");
  EXPECT_EQ(state.velocity, Vec2(1, 2));
  EXPECT_EQ(state.angular_velocity, 4);
  EXPECT_EQ(state.position, Vec2(7, 8));
  EXPECT_NEAR(state.angle, 0.5, 1e-15);
}

TEST(Room, BodyThatLeftTheRangeCanStillBeSet) {
  RoomDriver driver(paused_settings());
  driver.ask({Impulse{"box", {1e12, 0}}});
  EXPECT_FALSE(driver.ask({SetVelocity{"box", {}, 1.0}, SetTransform{"box", {}, 1.0}}).rejection);
  driver.send({Step{2}});
  driver.tick();
  driver.tick();
  EXPECT_FALSE(driver.ask({SetTransform{"box", {}, 2.0}, Impulse{"box", {1, 0}, Vec2(1, 0), true}}).rejection);
}

TEST(Room, OnlyThoseWhoMayControlTheTimeOfTheRoom) {
  RoomSettings settings;
  settings.roles = {Control::kOwners, {"ann"}};
  RoomDriver driver(settings);
  const std::vector<Command> controls{Pause{}, Resume{}, Step{1}, Reset{}, SetTimeScale{2}};
  for (const Command& command : controls) {
    EXPECT_EQ(driver.ask({command}, "bob").rejection->code, RejectionCode::kNotPermitted);
  }
  EXPECT_FALSE(driver.ask({Impulse{"box", {1, 0}}}, "bob").rejection);
  EXPECT_FALSE(driver.ask({Pause{}}, "ann").rejection);
  EXPECT_TRUE(driver.room->paused());
}

TEST(Room, NobodyMayControlWhereTheSettingSaysSo) {
  RoomSettings settings;
  settings.roles = {Control::kNobody, {"ann"}};
  RoomDriver driver(settings);
  EXPECT_EQ(driver.ask({Pause{}}, "ann").rejection->code, RejectionCode::kNotPermitted);
}

TEST(Room, BatchWithoutAnswerThatIsRejectedBecomesAnEvent) {
  RoomDriver driver;
  driver.room->submit({"bob", kNoAnswer, {17, {Despawn{"nobody"}}}, 10});
  const TickResult result = driver.tick();
  EXPECT_THAT(result.answers, IsEmpty());
  const auto rejected = driver.events_of<BatchRejected>();
  ASSERT_THAT(rejected, SizeIs(1));
  EXPECT_EQ(rejected[0].user, "bob");
  EXPECT_EQ(rejected[0].sequence, 17u);
  EXPECT_THAT(rejected[0].reason, ::testing::HasSubstr("despawn.body.name"));
}

TEST(Room, RejectionEventsAreBoundedPerTick) {
  RoomSettings settings;
  settings.limits.refusals_per_tick_max = 3;
  RoomDriver driver(settings);
  for (int i = 0; i < 8; ++i) driver.room->submit({"bob", kNoAnswer, {17, {Despawn{"nobody"}}}, 10});
  driver.tick();
  EXPECT_THAT(driver.events_of<BatchRejected>(), SizeIs(3));
  ASSERT_THAT(driver.events_of<EventsDropped>(), SizeIs(1));
  EXPECT_EQ(driver.events_of<EventsDropped>()[0].count, 5u);
}

TEST(Room, FullQueueIsAnsweredAtOnceAndNothingIsQueued) {
  RoomSettings settings;
  settings.limits.queue_batches_max = 2;
  RoomDriver driver(settings);
  driver.send({Impulse{"box", {1, 0}}});
  driver.send({Impulse{"box", {1, 0}}});
  const Ticket third = driver.send({Impulse{"box", {1, 0}}}, "ann", 3);
  const auto refused = driver.answer(third);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->rejection->code, RejectionCode::kQueueFull);
  EXPECT_EQ(refused->sequence, 3u);
  driver.tick();
  EXPECT_EQ(driver.state_of("box").velocity, Vec2(2, 0));
}

TEST(Room, MembersComeAndGo) {
  RoomSettings settings;
  settings.limits.members_max = 2;
  RoomDriver driver(settings);
  driver.room->join({"ann", "1"});
  driver.room->join({"ann", "1"});
  driver.room->join({"ann", "2"});
  driver.room->join({"bob", "1"});  // beyond the limit
  driver.room->leave({"ann", "1"});
  driver.room->leave({"cat", "1"});  // was never there
  const TickResult result = driver.tick();
  EXPECT_THAT(driver.events_of<MemberJoined>(), SizeIs(2));
  EXPECT_THAT(driver.events_of<MemberLeft>(), SizeIs(1));
  EXPECT_EQ(result.frame->statistics.member_count, 1u);
}

TEST(Room, PauseResumeAndTimeScaleAreEventsOnce) {
  RoomDriver driver;
  driver.ask({Pause{}, Pause{}, Resume{}, SetTimeScale{2}, SetTimeScale{2}});
  EXPECT_THAT(driver.events_of<RoomPaused>(), SizeIs(1));
  EXPECT_THAT(driver.events_of<RoomResumed>(), SizeIs(1));
  EXPECT_THAT(driver.events_of<TimeScaleChanged>(), SizeIs(1));
  EXPECT_EQ(driver.room->time_scale(), 2);
}

TEST(Room, EventsAreNumberedWithoutGapsAndCanBeAskedForAgain) {
  RoomDriver driver;
  const TickResult first = driver.tick();
  EXPECT_THAT(first.events.events, IsEmpty());
  driver.send({Spawn{box_body("a", {3, 3})}, Spawn{box_body("b", {6, 3})}});
  const TickResult second = driver.tick();
  EXPECT_EQ(second.events.first_sequence, 1u);
  EXPECT_THAT(second.events.events, SizeIs(2));
  EXPECT_EQ(second.frame->event_sequence, 2u);
  driver.send({Despawn{"a"}});
  const TickResult third = driver.tick();
  EXPECT_EQ(third.events.first_sequence, 3u);
  const EventSlice again = driver.room->events_since(2, 100);
  EXPECT_EQ(again.first_sequence, 2u);
  EXPECT_EQ(again.oldest_sequence, 1u);
  EXPECT_THAT(again.events, SizeIs(2));
}

TEST(Room, LateJoinerGetsEveryBodyWithItsStateNow) {
  RoomDriver driver;
  driver.ask({Spawn{box_body("crate", {3, 3})}, SetVelocity{"crate", Vec2(6, 0), {}}}, "bob");
  const auto view = driver.room->view({true, true});
  ASSERT_TRUE(view);
  ASSERT_THAT(view->bodies, SizeIs(3));
  EXPECT_EQ(view->bodies[2].record->spec.name, "crate");
  EXPECT_EQ(view->bodies[2].record->user, "bob");
  EXPECT_EQ(view->bodies[2].record->spec.def.position, Vec2(3, 3));  // as spawned
  EXPECT_NEAR(view->bodies[2].state.position.x(), 3 + 6 * kTimeStep, 1e-12);
  EXPECT_EQ(view->bodies[2].record->mass.mass, 1);
  ASSERT_TRUE(view->frame);
  EXPECT_TRUE(view->frame->full);
  EXPECT_THAT(view->frame->bodies.id, SizeIs(3));
  EXPECT_FALSE(view->saved_state.empty());
  EXPECT_EQ(view->state_hash, driver.room->world().state_hash());
  const auto info = driver.room->view({});
  EXPECT_THAT(info->bodies, IsEmpty());
  EXPECT_FALSE(info->frame);
  EXPECT_TRUE(info->saved_state.empty());
  EXPECT_FALSE(info->model.empty());
}

TEST(Room, QueriesSeeTheWorldAsItIsAtTheirTurn) {
  RoomDriver driver(paused_settings());
  const BatchReply reply =
      driver.ask({RoomQuery(PointQuery{{3, 3}}), Spawn{box_body("crate", {3, 3})}, RoomQuery(PointQuery{{3, 3}}),
                  RoomQuery(RegionQuery{{2, 2}, {4, 6}}), RoomQuery(RayQuery{{3, 10}, {0, -20}}),
                  RoomQuery(NearestQuery{{3, 5}, 10, 1}), RoomQuery(ContactsQuery{}), RoomQuery(DiagnosticsQuery{})});
  ASSERT_FALSE(reply.rejection) << reply.rejection->message;
  const BodyId crate = reply.results[1].id;
  EXPECT_THAT(reply.results[0].query->hits, IsEmpty());
  ASSERT_THAT(reply.results[2].query->hits, SizeIs(1));
  EXPECT_EQ(reply.results[2].query->hits[0].id, crate);
  EXPECT_EQ(reply.results[3].query->hits.at(0).id, crate);
  const auto& ray = reply.results[4].query->hits;
  ASSERT_THAT(ray, SizeIs(2));
  EXPECT_EQ(ray[0].id, crate);
  EXPECT_NEAR(ray[0].point.y(), 3.5, 1e-12);
  EXPECT_NEAR(ray[0].distance, 6.5, 1e-12);
  EXPECT_NEAR(ray[1].point.y(), 0, 1e-12);
  EXPECT_EQ(reply.results[5].query->hits.at(0).id, crate);
  EXPECT_NEAR(reply.results[5].query->hits[0].distance, 1.5, 1e-12);
  EXPECT_TRUE(reply.results[6].query->contacts);
  EXPECT_EQ(reply.results[7].query->diagnostics->state_hash, driver.room->world().state_hash());
}

TEST(Room, HitsAreEventsOfScenesThatAskForThem) {
  for (const bool asked : {false, true}) {
    SceneDef scene = floating_scene();
    scene.world.gravity = {0, -10};
    if (asked) scene.world.hit_events = HitEvents{2};
    RoomDriver driver({}, scene);
    const BodyId crate = driver.ask({Spawn{box_body("crate", {20, 2.5})}}).results[0].id;
    for (int i = 0; i < 60; ++i) driver.tick();
    std::vector<ContactEvent> hits;
    for (const ContactEvent& event : driver.events_of<ContactEvent>())
      if (event.kind == ContactEvent::Kind::kHit && (event.body_a == crate || event.body_b == crate))
        hits.push_back(event);
    ASSERT_THAT(hits, SizeIs(asked ? 1 : 0));
    if (asked) {
      EXPECT_NEAR(hits[0].approach_speed, std::sqrt(2 * 10 * 2.0), 0.3);
    }
  }
}

TEST(Room, QueriesWithAShapeAreAnsweredInOrder) {
  RoomDriver driver(paused_settings());
  QueryOptions one;
  one.count_max = 1;
  const QueryShape disc{Circle{0.5, {0, 0}}, {3, 10}, 0};
  const BatchReply reply = driver.ask({Spawn{box_body("crate", {3, 3})}, RoomQuery(CastQuery{disc, {0, -20}, {}}),
                                       RoomQuery(CastQuery{disc, {0, -20}, one}),
                                       RoomQuery(OverlapQuery{{Box{1, 8, {0, 0}, 0}, {3, 3}, 0}, {}}),
                                       RoomQuery(ClosestQuery{{Circle{0.5, {0, 0}}, {3, 4.2}, 0}, 20, one})});
  ASSERT_FALSE(reply.rejection) << reply.rejection->message;
  const BodyId crate = reply.results[0].id;
  const QueryResult& cast = *reply.results[1].query;
  ASSERT_THAT(cast.hits, SizeIs(2));
  EXPECT_FALSE(cast.truncated);
  EXPECT_EQ(cast.hits[0].id, crate);
  EXPECT_NEAR(cast.hits[0].fraction, 6.0 / 20, 1e-12);
  EXPECT_NEAR(cast.hits[0].distance, 6, 1e-12);
  EXPECT_NEAR(cast.hits[0].point.y(), 3.5, 1e-12);
  EXPECT_NEAR(cast.hits[0].normal.y(), 1, 1e-12);
  EXPECT_NEAR(cast.hits[1].distance, 9.5, 1e-12);  // the floor
  EXPECT_THAT(reply.results[2].query->hits, SizeIs(1));
  EXPECT_TRUE(reply.results[2].query->truncated);
  EXPECT_THAT(reply.results[3].query->hits, SizeIs(2));
  const QueryResult& closest = *reply.results[4].query;
  ASSERT_THAT(closest.hits, SizeIs(1));
  EXPECT_TRUE(closest.truncated);
  EXPECT_EQ(closest.hits[0].id, crate);
  EXPECT_NEAR(closest.hits[0].distance, 0.2, 1e-12);
  EXPECT_NEAR(closest.hits[0].query_point.y(), 3.7, 1e-12);
}

TEST(Room, ContactsBecomeEventsUpToTheLimit) {
  FakeWorld* world = nullptr;
  RoomSettings settings;
  settings.limits.contact_events_per_tick_max = 2;
  RoomDriver driver(settings, floating_scene(), [&](const WorldSettings& each) {
    auto made = std::make_unique<FakeWorld>(each);
    world = made.get();
    return Expected<std::unique_ptr<World>>(std::move(made));
  });
  world->next_contacts.assign(5, ContactEvent{});
  driver.tick();
  EXPECT_THAT(driver.events_of<ContactEvent>(), SizeIs(2));
  ASSERT_THAT(driver.events_of<EventsDropped>(), SizeIs(1));
  EXPECT_EQ(driver.events_of<EventsDropped>()[0].count, 3u);
  EXPECT_EQ(driver.events.front().tick, 1u);  // of the tick that they belong to
}

TEST(Room, EngineThatBreaksItsWordIsReported) {
  FakeWorld* world = nullptr;
  RoomDriver driver({}, floating_scene(), [&](const WorldSettings& each) {
    auto made = std::make_unique<FakeWorld>(each);
    world = made.get();
    return Expected<std::unique_ptr<World>>(std::move(made));
  });
  world->refuse = "set_velocity";
  const BatchReply reply = driver.ask({Impulse{"box", {1, 0}}, SetVelocity{"box", Vec2(1, 0), {}}});
  ASSERT_TRUE(reply.rejection);
  EXPECT_EQ(reply.rejection->index, 1u);
  EXPECT_THAT(reply.rejection->message, ::testing::HasSubstr("the commands before it were done"));
}

TEST(Room, SceneThatCannotBeBuiltNamesItsField) {
  SceneDef scene = floating_scene();
  scene.bodies.push_back(box_body("box", {1, 1}));
  EXPECT_EQ(Room::create({}, scene, testing::real_world).error().field, "bodies[2].name");
  scene.bodies.back() = box_body("bad", {1, 1}, BodyType::kDynamic, 0);
  EXPECT_EQ(Room::create({}, scene, testing::real_world).error().field, "bodies[2].shapes[0].box.width");
  scene = floating_scene();
  scene.world.time_step = 1;
  EXPECT_EQ(Room::create({}, scene, testing::real_world).error().field, "world.time_step");
  scene = floating_scene();
  scene.world.fields.push_back(Drag{-1, 0});
  EXPECT_EQ(Room::create({}, scene, testing::real_world).error().field, "fields[0].drag.linear");
  RoomSettings settings;
  settings.limits.bodies_max = 1;
  EXPECT_EQ(Room::create(settings, floating_scene(), testing::real_world).error().code, ErrorCode::kLimitReached);
}

TEST(Room, SameCommandsGiveTheSameStateHash) {
  const auto run = [] {
    RoomDriver driver;
    for (int i = 0; i < 30; ++i) {
      driver.send({Spawn{box_body("", {i * 0.3, 2.0 + i})}, Impulse{"box", {0.1, 0}}}, i % 2 == 0 ? "ann" : "bob");
      driver.tick();
    }
    return driver.room->world().state_hash();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace urto

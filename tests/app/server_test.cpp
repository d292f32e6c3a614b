#include "app/server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <map>

#include "app/server_threads.h"
#include "support/fake_world.h"
#include "support/proto_text.h"
#include "support/room_driver.h"
#include "transport/loopback_transport.h"
#include "urto/v1/command.pb.h"
#include "urto/v1/room.pb.h"
#include "urto/v1/snapshot.pb.h"

namespace urto::app {
namespace {

using testing::box_body;
using testing::floating_scene;
using testing::from_bytes;
using testing::from_text;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::uint64_t kMs = 1'000'000;
constexpr std::uint64_t kTick = 16'666'667;  // ns, a little more than 1/60 s

// A server on a network in memory, and one client. The test is the clock and all threads.
class ServerTest : public ::testing::Test {
 protected:
  void open(RoomSettings settings = {}, SceneDef scene = floating_scene(), WorldFactory factory = testing::real_world) {
    auto room = Room::create(std::move(settings), std::move(scene), std::move(factory));
    ASSERT_TRUE(room) << room.error().message;
    server = std::make_unique<Server>(std::move(*room), codec::HostInfo{"lab", "1.2.3", 60, false, 0}, *transport,
                                      [this] { ++wakes; });
    subscriptions.push_back(
        client
            ->declare_subscriber(
                "urto/v1/lab/snapshot",
                [this](auto, auto payload) { snapshots.push_back(from_bytes<v1::Snapshot>(std::string(payload))); })
            .value());
    subscriptions.push_back(client
                                ->declare_subscriber("urto/v1/lab/event",
                                                     [this](auto, auto payload) {
                                                       event_batches.push_back(
                                                           from_bytes<v1::EventBatch>(std::string(payload)));
                                                     })
                                .value());
    ASSERT_TRUE(server->start());
    run(0);
  }

  // Lets the server do what is due after so many nanoseconds more.
  std::optional<std::uint64_t> run(std::uint64_t passed_ns) {
    now += passed_ns;
    const auto next = server->run_once(now);
    server->send_all();
    return next;
  }

  struct Got {
    std::vector<std::string> replies;
    std::vector<std::string> errors;
    bool done = false;
  };

  std::shared_ptr<Got> get(const std::string& key, const std::string& parameters = "",
                           const std::string& payload = "") {
    auto got = std::make_shared<Got>();
    const auto status = client->get(
        {key, parameters, payload, "", std::chrono::milliseconds(1000)},
        {[got](const Reply& reply) { (reply.is_error ? got->errors : got->replies).emplace_back(reply.payload); },
         [got] { got->done = true; }});
    EXPECT_TRUE(status);
    return got;
  }

  std::shared_ptr<Got> send(const std::string& commands, const std::string& user = "ann") {
    return get("urto/v1/lab/cmd/" + user, "", from_text<v1::CommandBatch>(commands).SerializeAsString());
  }

  // Sends a batch and lets one tick pass.
  v1::CommandReply ask(const std::string& commands, const std::string& user = "ann") {
    const auto got = send(commands, user);
    run(kTick);
    EXPECT_THAT(got->replies, SizeIs(1));
    return from_bytes<v1::CommandReply>(got->replies.at(0));
  }

  std::vector<v1::Event> events() const {
    std::vector<v1::Event> all;
    for (const auto& batch : event_batches) all.insert(all.end(), batch.events().begin(), batch.events().end());
    return all;
  }

  LoopbackNetwork network;
  std::unique_ptr<Transport> transport = network.connect();
  std::unique_ptr<Transport> client = network.connect();
  std::unique_ptr<Server> server;
  std::vector<DeclarationPtr> subscriptions;
  std::vector<v1::Snapshot> snapshots;
  std::vector<v1::EventBatch> event_batches;
  int wakes = 0;
  std::uint64_t now = 1'000'000'000;
};

TEST_F(ServerTest, SnapshotsComeWithTheTicks) {
  open();
  for (int i = 0; i < 3; ++i) run(kTick);
  ASSERT_THAT(snapshots, SizeIs(3));
  EXPECT_EQ(snapshots[2].tick(), 3u);
  EXPECT_THAT(snapshots[2].id(), SizeIs(1));
}

TEST_F(ServerTest, CommandIsAnsweredAndShows) {
  open();
  const auto reply = ask("sequence: 8 commands { impulse { body { name: 'box' } impulse { x: 3 } } }");
  EXPECT_EQ(reply.sequence(), 8u);
  EXPECT_EQ(reply.tick(), 0u);
  EXPECT_EQ(reply.epoch(), 1u);
  EXPECT_FALSE(reply.has_rejection());
  EXPECT_EQ(snapshots.back().velocity_x_double(0), 3);
}

TEST_F(ServerTest, RejectionReachesTheOneWhoAsked) {
  open();
  const auto reply = ask("commands { spawn { body { shapes { box { width: -1 height: 1 } } } } }");
  EXPECT_EQ(reply.rejection().code(), v1::REJECTION_CODE_INVALID_VALUE);
  EXPECT_EQ(reply.rejection().field(), "spawn.body.shapes[0].box.width");
  EXPECT_EQ(reply.rejection().value(), "-1");
}

TEST_F(ServerTest, WhatIsNoBatchIsAnsweredAsMalformed) {
  open();
  const auto got = get("urto/v1/lab/cmd/ann", "", "\xff\xff");
  run(0);
  ASSERT_THAT(got->replies, SizeIs(1));
  EXPECT_EQ(from_bytes<v1::CommandReply>(got->replies[0]).rejection().code(), v1::REJECTION_CODE_MALFORMED);
}

TEST_F(ServerTest, UserHasToBeAName) {
  open();
  const auto got =
      get("urto/v1/lab/cmd/*", "", from_text<v1::CommandBatch>("commands { pause {} }").SerializeAsString());
  run(kTick);
  ASSERT_THAT(got->replies, SizeIs(1));
  EXPECT_EQ(from_bytes<v1::CommandReply>(got->replies[0]).rejection().code(), v1::REJECTION_CODE_MALFORMED);
  EXPECT_FALSE(server->room().paused());
}

TEST_F(ServerTest, PutIsABatchWithoutAnswer) {
  open();
  const auto batch = from_text<v1::CommandBatch>("commands { impulse { body { name: 'box' } impulse { x: 3 } } }");
  ASSERT_TRUE(client->put("urto/v1/lab/cmd/bob", batch.SerializeAsString(), {}));
  run(kTick);
  EXPECT_EQ(snapshots.back().velocity_x_double(0), 3);
}

TEST_F(ServerTest, PutThatIsRejectedBecomesAnEvent) {
  open();
  const auto batch = from_text<v1::CommandBatch>("sequence: 4 commands { despawn { body { name: 'nobody' } } }");
  ASSERT_TRUE(client->put("urto/v1/lab/cmd/bob", batch.SerializeAsString(), {}));
  ASSERT_TRUE(client->put("urto/v1/lab/cmd/bob", "\xff", {}));
  run(kTick);
  ASSERT_THAT(events(), SizeIs(2));
  std::map<std::uint64_t, std::string> reasons;
  for (const auto& event : events()) {
    EXPECT_EQ(event.batch_rejected().user(), "bob");
    reasons[event.batch_rejected().sequence()] = event.batch_rejected().reason();
  }
  EXPECT_THAT(reasons[4], HasSubstr("despawn.body.name"));
  EXPECT_THAT(reasons[0], HasSubstr("CommandBatch"));
}

TEST_F(ServerTest, PausedRoomAnswersWithoutTheClock) {
  RoomSettings settings;
  settings.paused = true;
  open(settings);
  EXPECT_EQ(run(0), std::nullopt);  // nothing to come back for
  const int before = wakes;
  const auto got = send("commands { query { body { body { name: 'box' } } } }");
  EXPECT_GT(wakes, before);
  run(0);
  ASSERT_THAT(got->replies, SizeIs(1));
  EXPECT_EQ(from_bytes<v1::CommandReply>(got->replies[0]).results(0).query().body().body().name(), "box");
}

TEST_F(ServerTest, StepIsAnsweredAfterItsLastTickWithoutTheClock) {
  RoomSettings settings;
  settings.paused = true;
  open(settings);
  const auto got =
      send("commands { set_velocity { body { name: 'box' } velocity { x: 6 } } } commands { step { ticks: 10 } }");
  for (int i = 0; i < 9; ++i) EXPECT_EQ(run(0), now);  // at once
  EXPECT_THAT(got->replies, IsEmpty());
  EXPECT_FALSE(got->done);
  EXPECT_EQ(run(0), std::nullopt);
  ASSERT_THAT(got->replies, SizeIs(1));
  const auto snapshot = from_bytes<v1::CommandReply>(got->replies[0]).results(1).snapshot();
  EXPECT_EQ(snapshot.tick(), 10u);
  EXPECT_TRUE(snapshot.full());
  EXPECT_NEAR(snapshot.x_double(1), 1, 1e-12);
}

TEST_F(ServerTest, OverrunsAreGivenUpAndReported) {
  open();
  run(kTick * 105);
  EXPECT_EQ(server->room().world().step_count(), kCatchUpTicksMax);
  run(kTick);
  EXPECT_EQ(snapshots.back().statistics().overrun_count(), 100u);
}

TEST_F(ServerTest, TimeScaleChangesTheRhythmNotTheStep) {
  open();
  ask("commands { set_time_scale { scale: 2 } }");
  const auto steps = server->room().world().step_count();
  run(kTick);
  EXPECT_EQ(server->room().world().step_count(), steps + 2);
  EXPECT_NEAR(snapshots.back().sim_time(), static_cast<double>(steps + 2) / 60, 1e-12);
}

TEST_F(ServerTest, InfoAndStateAreAnsweredToAllWhoAskAtOnce) {
  RoomSettings settings;
  settings.paused = true;
  open(settings);
  const auto info = get("urto/v1/lab/info");
  const auto state = get("urto/v1/lab/state");
  const auto saved = get("urto/v1/lab/state", "saved_state=true");
  run(2'000 * kMs);
  ASSERT_THAT(info->replies, SizeIs(1));
  const auto info_message = from_bytes<v1::RoomInfo>(info->replies[0]);
  EXPECT_EQ(info_message.room(), "lab");
  EXPECT_EQ(info_message.server_version(), "1.2.3");
  EXPECT_NEAR(info_message.uptime(), 2, 1e-9);
  const auto state_message = from_bytes<v1::RoomState>(state->replies.at(0));
  EXPECT_EQ(state_message.bodies_size(), 2);
  EXPECT_TRUE(state_message.saved_state().empty());
  EXPECT_FALSE(from_bytes<v1::RoomState>(saved->replies.at(0)).saved_state().empty());
}

TEST_F(ServerTest, ViewsAreMadeAtMostOnceAPeriod) {
  RoomSettings settings;
  settings.paused = true;
  open(settings);
  get("urto/v1/lab/info");
  run(100 * kMs);
  const auto second = get("urto/v1/lab/info");
  const std::uint64_t last = now;
  EXPECT_EQ(run(1 * kMs), last + kViewPeriodNs);
  EXPECT_THAT(second->replies, IsEmpty());
  run(kViewPeriodNs);
  EXPECT_THAT(second->replies, SizeIs(1));
}

TEST_F(ServerTest, TooManyQuestionsAreRefusedNotQueued) {
  RoomSettings settings;
  settings.paused = true;
  open(settings);
  std::vector<std::shared_ptr<Got>> asked;
  for (std::size_t i = 0; i < kRequestsMax + 3; ++i) asked.push_back(get("urto/v1/lab/info"));
  run(100 * kMs);
  std::size_t answered = 0, refused = 0;
  for (const auto& got : asked) {
    answered += got->replies.size();
    refused += got->errors.size();
    EXPECT_TRUE(got->done);
  }
  EXPECT_EQ(answered, kRequestsMax);
  EXPECT_EQ(refused, 3u);
}

TEST_F(ServerTest, EventsComeInOrderAndCanBeAskedForAgain) {
  open();
  ask("commands { spawn { body { name: 'a' position { x: 9 y: 9 } shapes { box { width: 1 height: 1 } } } } }");
  ask("commands { despawn { body { name: 'a' } } }");
  ASSERT_THAT(event_batches, SizeIs(2));
  EXPECT_EQ(event_batches[0].first_sequence(), 1u);
  EXPECT_EQ(event_batches[1].first_sequence(), 2u);
  const auto again = get("urto/v1/lab/event", "from=2");
  run(100 * kMs);
  const auto recovered = from_bytes<v1::EventBatch>(again->replies.at(0));
  EXPECT_EQ(recovered.first_sequence(), 2u);
  EXPECT_EQ(recovered.oldest_sequence(), 1u);
  EXPECT_TRUE(recovered.events(0).has_body_removed());
  const auto all = get("urto/v1/lab/event");
  run(100 * kMs);
  EXPECT_EQ(from_bytes<v1::EventBatch>(all->replies.at(0)).events_size(), 2);
  EXPECT_THAT(get("urto/v1/lab/event", "from=soon")->errors, SizeIs(1));
}

TEST_F(ServerTest, ManyEventsAreSplitIntoMessagesWithoutGaps) {
  testing::FakeWorld* world = nullptr;
  open({}, floating_scene(), [&](const WorldSettings& settings) {
    auto made = std::make_unique<testing::FakeWorld>(settings);
    world = made.get();
    return Expected<std::unique_ptr<World>>(std::move(made));
  });
  world->next_contacts.assign(2500, ContactEvent{});
  run(kTick);
  std::uint64_t next = 1;
  for (const auto& batch : event_batches) {
    EXPECT_EQ(batch.first_sequence(), next);
    EXPECT_LE(static_cast<std::size_t>(batch.events_size()), kEventsPerMessageMax);
    next += static_cast<std::uint64_t>(batch.events_size());
  }
  EXPECT_EQ(next, 2501u);
}

TEST_F(ServerTest, MembersAreThoseWhoseTokensLive) {
  open();
  auto token = client->declare_liveliness_token("urto/v1/lab/member/ann/s1").value();
  run(kTick);
  ASSERT_THAT(events(), SizeIs(1));
  EXPECT_EQ(events()[0].member_joined().user(), "ann");
  token.reset();
  run(kTick);
  ASSERT_THAT(events(), SizeIs(2));
  EXPECT_EQ(events()[1].member_left().session(), "s1");
}

TEST_F(ServerTest, MembersOfAPausedRoomAreAnnouncedToo) {
  RoomSettings settings;
  settings.paused = true;
  open(settings);
  const auto token = client->declare_liveliness_token("urto/v1/lab/member/ann/s1").value();
  run(0);
  EXPECT_THAT(events(), SizeIs(1));
}

TEST_F(ServerTest, RoomIsAliveFromStartToStop) {
  std::vector<bool> alive;
  subscriptions.push_back(
      client->declare_liveliness_subscriber("urto/v1/*/alive", [&](auto, bool is) { alive.push_back(is); }).value());
  open();
  EXPECT_THAT(alive, ::testing::ElementsAre(true));
  server->stop_listening();
  EXPECT_THAT(alive, ::testing::ElementsAre(true, false));
}

TEST_F(ServerTest, ClosingAnswersWhatWaits) {
  RoomSettings settings;
  settings.paused = true;
  open(settings);
  const auto step = send("commands { step { ticks: 1000 } }");
  run(0);
  const auto queued = send("commands { pause {} }");
  server->stop_listening();
  server->close_room();
  server->send_all();
  for (const auto& got : {step, queued}) {
    ASSERT_THAT(got->replies, SizeIs(1));
    EXPECT_EQ(from_bytes<v1::CommandReply>(got->replies[0]).rejection().code(), v1::REJECTION_CODE_CANCELLED);
  }
}

TEST_F(ServerTest, FullQueueIsAnsweredAtOnce) {
  RoomSettings settings;
  settings.limits.queue_batches_max = 1;
  open(settings);
  send("commands { pause {} }");
  const auto second = send("sequence: 2 commands { pause {} }");
  server->send_all();  // no tick has passed
  ASSERT_THAT(second->replies, SizeIs(1));
  const auto reply = from_bytes<v1::CommandReply>(second->replies[0]);
  EXPECT_EQ(reply.rejection().code(), v1::REJECTION_CODE_QUEUE_FULL);
  EXPECT_EQ(reply.sequence(), 2u);
}

TEST_F(ServerTest, ThreadsServeAndStop) {
  auto room = Room::create(testing::paused_settings(), floating_scene(), testing::real_world);
  Waker waker;
  Server threaded(std::move(*room), codec::HostInfo{"lab", "1.2.3", 60, false, 0}, *transport, [&] { waker.wake(); });
  ASSERT_TRUE(threaded.start());
  ServerThreads threads(threaded, waker);
  std::promise<std::string> answered;
  const auto batch = from_text<v1::CommandBatch>("commands { step { ticks: 100 } }");
  ASSERT_TRUE(client->get({"urto/v1/lab/cmd/ann", "", batch.SerializeAsString(), "", std::chrono::milliseconds(1000)},
                          {[&](const Reply& reply) { answered.set_value(std::string(reply.payload)); }, [] {}}));
  const auto reply = from_bytes<v1::CommandReply>(answered.get_future().get());
  EXPECT_EQ(reply.results(0).snapshot().tick(), 100u);
  threads.stop();
  EXPECT_EQ(threaded.room().world().step_count(), 100u);
}

}  // namespace
}  // namespace urto::app

#include "physics/team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

#include "physics/support/joints.h"

namespace urto {
namespace {

using namespace testing;

// Every index once, whatever the count and the number of members, and round after round.
TEST(TeamTest, SharesEveryIndexOnce) {
  for (unsigned members : {1u, 2u, 3u, 7u}) {
    Team team(members);
    EXPECT_EQ(team.members(), members);
    for (std::size_t count : {0u, 1u, 2u, 5u, 100u, 1001u}) {
      for (int round = 0; round < 50; ++round) {
        std::vector<int> seen(count, 0);
        team.share(count, 2, [&](unsigned part, std::size_t begin, std::size_t end) {
          EXPECT_LT(part, team.parts_max());
          for (std::size_t i = begin; i < end; ++i) ++seen[i];
        });
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(seen[i], 1) << i << " of " << count;
      }
    }
  }
}

TEST(TeamTest, SmallLoopsStayWithTheCaller) {
  Team team(4);
  const std::thread::id caller = std::this_thread::get_id();
  team.share(19, 10, [&](unsigned part, std::size_t begin, std::size_t end) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(part, 0u);
    EXPECT_EQ(begin, 0u);
    EXPECT_EQ(end, 19u);
  });
}

TEST(TeamTest, WhatMembersWroteIsSeenAfterwards) {
  Team team(3);
  std::vector<long> sums(team.parts_max(), 0);
  long total = 0;
  for (int round = 1; round <= 200; ++round) {
    team.share(300, 1, [&](unsigned part, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sums[part] += static_cast<long>(i);
    });
    total = std::accumulate(sums.begin(), sums.end(), 0L);
    ASSERT_EQ(total, round * (299L * 300L / 2));
  }
}

// A member in the middle of a part holds up the loop and nothing else: all other parts are done meanwhile.
TEST(TeamTest, OthersTakeOverWhatAHeldUpMemberHasNotBegun) {
  Team team(2);
  const std::thread::id caller = std::this_thread::get_id();
  for (int round = 0; round < 100; ++round) {
    std::atomic<unsigned> done{0};
    std::atomic<bool> held{false};
    unsigned parts = 0;
    team.share(100, 1, [&](unsigned part, std::size_t, std::size_t end) {
      if (end == 100) parts = part + 1;
      if (std::this_thread::get_id() != caller && !held.exchange(true)) {
        const unsigned others = team.parts_max() - 1;
        for (unsigned seen = done.load(); seen < others; seen = done.load()) done.wait(seen);
      }
      ++done;
      done.notify_all();
    });
    EXPECT_EQ(done.load(), parts);
  }
}

// Between steps the members fall asleep; the next loop is done all the same, whether they wake up in time or not.
TEST(TeamTest, SharesAfterARest) {
  Team team(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<int> seen(500, 0);
    team.share(seen.size(), 1, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    team.rest();
    for (std::size_t i = 0; i < seen.size(); ++i) ASSERT_EQ(seen[i], 1) << i;
    for (int i = 0; i < round * 1000; ++i) std::this_thread::yield();
  }
}

// Parts and what they find are numbered in the order of the loop.
TEST(TeamTest, PartsAreInTheOrderOfTheLoop) {
  Team team(4);
  for (std::size_t count : {16u, 17u, 40u, 1000u}) {
    std::vector<std::vector<std::size_t>> lists(team.parts_max());
    team.share(count, 8, [&](unsigned part, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) lists[part].push_back(i);
    });
    std::vector<std::size_t> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    ASSERT_EQ(all.size(), count);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(all[i], i);
  }
}

std::uint64_t hash_of_run(Precision precision, unsigned threads) {
  WorldSettings settings = settings_for(precision);
  auto world = World::create(settings, nullptr, threads).value();
  add(*world, floor_body(400));
  // So many that the solve is shared out too.
  for (int i = 0; i < 10; ++i) add_pyramid(*world, 20 + i % 4, 30.0 * i);
  for (int i = 0; i < 200; ++i) {
    BodyDef body = i % 3 == 0 ? ball_body(0.7 * i - 12, 26 + i % 7, 0.3) : box_body(0.7 * i - 12, 26 + i % 7);
    body.velocity = {i % 5 - 2.0, -3.0};
    body.shapes[0].material.restitution = 0.3;
    add(*world, body);
  }
  step_for(*world, 1.5);
  return world->state_hash();
}

TEST(TeamTest, AnyNumberOfThreadsGivesTheSameBits) {
  for (Precision precision : {Precision::kFloat, Precision::kDouble}) {
    const std::uint64_t alone = hash_of_run(precision, 1);
    for (unsigned threads : {2u, 3u, 4u}) EXPECT_EQ(hash_of_run(precision, threads), alone) << threads << " threads";
  }
}

// A net of discs that hangs from a rail, tears, and is shot at by balls too fast for a step.
struct NetRun {
  std::uint64_t hash = 0;
  std::vector<JointId> torn;  // in the order of the events
  std::vector<std::pair<BodyId, BodyId>> met;
};
NetRun run_of_net(Precision precision, unsigned threads) {
  constexpr int kSide = 24;
  auto world = World::create(settings_for(precision), nullptr, threads).value();
  const BodyId rail = add(*world, box_body(0, 1, 100, 0.2, BodyType::kStatic));
  std::vector<BodyId> knots;
  const auto tie = [&](BodyId a, BodyId b, const Vec2& at_a, const Vec2& at_b) {
    JointDef def = joint_between(a, b, at_a, at_b, RevoluteJoint{});
    if (knots.size() % 5 == 0) def.break_force = 60;
    join(*world, def);
  };
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double x = column - kSide / 2.0;
      knots.push_back(add(*world, ball_body(x, -row, 0.3)));
      const std::size_t last = knots.size() - 1;
      if (column > 0) tie(knots[last - 1], knots[last], {0.5, 0}, {-0.5, 0});
      if (row > 0) tie(knots[last - kSide], knots[last], {0, -0.5}, {0, 0.5});
      if (row == 0 && column % 3 == 0) tie(rail, knots[last], {x, -0.5}, {0, 0.5});
    }
  }
  for (int i = 0; i < 40; ++i) {
    BodyDef ball = ball_body(-40 - i, -0.5 * i, 0.1);
    ball.velocity = {90, 5};
    add(*world, ball);
  }
  NetRun run;
  for (int step = 0; step < 90; ++step) {
    world->step();
    for (const JointEvent& event : world->joint_events()) run.torn.push_back(event.joint);
    for (const ContactEvent& event : world->contact_events()) run.met.emplace_back(event.body_a, event.body_b);
  }
  run.hash = world->state_hash();
  return run;
}

TEST(TeamTest, AnyNumberOfThreadsGivesTheSameBitsOfJointsAndFastBodies) {
  for (Precision precision : {Precision::kFloat, Precision::kDouble}) {
    const NetRun alone = run_of_net(precision, 1);
    EXPECT_GT(alone.torn.size(), 10u);
    EXPECT_GT(alone.met.size(), 100u);
    for (unsigned threads : {2u, 4u}) {
      const NetRun run = run_of_net(precision, threads);
      EXPECT_EQ(run.hash, alone.hash) << threads << " threads";
      EXPECT_EQ(run.torn, alone.torn) << threads << " threads";
      EXPECT_EQ(run.met, alone.met) << threads << " threads";
    }
  }
}

TEST(TeamTest, AWorldRefusesNoThreadsAndTooMany) {
  for (unsigned threads : {0u, kThreadsMax + 1}) {
    const auto world = World::create(WorldSettings{}, nullptr, threads);
    ASSERT_FALSE(world);
    EXPECT_EQ(world.error().code, ErrorCode::kInvalidValue);
    EXPECT_EQ(world.error().field, "threads");
  }
}

}  // namespace
}  // namespace urto

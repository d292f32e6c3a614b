#include "physics/team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

// Every index once, whatever the count and the number of members, and round after round.
TEST(TeamTest, SharesEveryIndexOnce) {
  for (unsigned members : {1u, 2u, 3u, 7u}) {
    Team team(members);
    EXPECT_EQ(team.size(), members);
    for (std::size_t count : {0u, 1u, 2u, 5u, 100u, 1001u}) {
      for (int round = 0; round < 50; ++round) {
        std::vector<int> seen(count, 0);
        team.share(count, 2, [&](unsigned member, std::size_t begin, std::size_t end) {
          EXPECT_LT(member, members);
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
  team.share(19, 10, [&](unsigned member, std::size_t begin, std::size_t end) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(member, 0u);
    EXPECT_EQ(begin, 0u);
    EXPECT_EQ(end, 19u);
  });
}

TEST(TeamTest, WhatMembersWroteIsSeenAfterwards) {
  Team team(3);
  std::vector<long> sums(3, 0);
  long total = 0;
  for (int round = 1; round <= 200; ++round) {
    team.share(300, 1, [&](unsigned member, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sums[member] += static_cast<long>(i);
    });
    total = std::accumulate(sums.begin(), sums.end(), 0L);
    ASSERT_EQ(total, round * (299L * 300L / 2));
  }
}

std::uint64_t hash_of_run(Precision precision, unsigned threads) {
  WorldSettings settings = settings_for(precision);
  auto world = World::create(settings, nullptr, threads).value();
  add(*world, floor_body(400));
  for (int i = 0; i < 4; ++i) add_pyramid(*world, 20 + i, 30.0 * i);
  for (int i = 0; i < 200; ++i) {
    BodyDef body = i % 3 == 0 ? ball_body(0.7 * i - 12, 26 + i % 7, 0.3) : box_body(0.7 * i - 12, 26 + i % 7);
    body.velocity = {i % 5 - 2.0, -3.0};
    body.shapes[0].material.restitution = 0.3;
    add(*world, body);
  }
  step_for(*world, 3);
  return world->state_hash();
}

TEST(TeamTest, AnyNumberOfThreadsGivesTheSameBits) {
  for (Precision precision : {Precision::kFloat, Precision::kDouble}) {
    const std::uint64_t alone = hash_of_run(precision, 1);
    for (unsigned threads : {2u, 3u, 4u}) EXPECT_EQ(hash_of_run(precision, threads), alone) << threads << " threads";
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

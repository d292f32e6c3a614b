// Stacks stand, piles come to rest, islands fall asleep and wake.

#include <algorithm>
#include <cmath>
#include <random>

#include "physics/constants.h"
#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

// The farthest that any of the bodies has come sideways from where it was, m.
double drift_of(const World& world, const std::vector<BodyId>& ids, const std::vector<Vec2>& start) {
  double drift = 0;
  for (std::size_t i = 0; i < ids.size(); ++i)
    drift = std::max(drift, std::abs(world.body(ids[i])->position.x() - start[i].x()));
  return drift;
}

std::vector<Vec2> positions_of(const World& world, const std::vector<BodyId>& ids) {
  std::vector<Vec2> out;
  for (BodyId id : ids) out.push_back(world.body(id)->position);
  return out;
}

class StackTest : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Heights, StackTest, ::testing::Values(10, 20, 50));

TEST_P(StackTest, StandsForAMinuteAndSleeps) {
  auto world = make_world();
  add(*world, floor_body());
  const std::vector<BodyId> ids = add_stack(*world, GetParam());
  const std::vector<Vec2> start = positions_of(*world, ids);
  step_for(*world, 60);
  EXPECT_LT(drift_of(*world, ids, start), 1e-3);
  // Every box still lies on the one below: between half and a full height above it.
  for (std::size_t i = 1; i < ids.size(); ++i) {
    const double gap = world->body(ids[i])->position.y() - world->body(ids[i - 1])->position.y();
    EXPECT_NEAR(gap, 1, 0.05) << i;
  }
  EXPECT_EQ(world->counters().awake_bodies, 0u);
}

TEST(PyramidTest, TwentyRowsStandForAMinuteAndSleep) {
  auto world = make_world();
  add(*world, floor_body());
  const std::vector<BodyId> ids = add_pyramid(*world, 20);
  const std::vector<Vec2> start = positions_of(*world, ids);
  step_for(*world, 60);
  EXPECT_LT(drift_of(*world, ids, start), 0.05);
  EXPECT_NEAR(world->body(ids.back())->position.y(), 19.5, 0.1);
  EXPECT_EQ(world->counters().awake_bodies, 0u);
}

TEST(PileTest, ComesToRestAndSleeps) {
  auto world = make_world();
  add(*world, floor_body());
  add(*world, box_body(-6, 10, 1, 20, BodyType::kStatic));
  add(*world, box_body(6, 10, 1, 20, BodyType::kStatic));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-4, 4), size(0.3, 1);
  for (int i = 0; i < 100; ++i) {
    BodyDef def = i % 2 ? box_body(place(random), 2 + 0.5 * i, size(random), size(random))
                        : ball_body(place(random), 2 + 0.5 * i, 0.5 * size(random));
    def.angular_damping = 0.5;  // discs roll for ever otherwise
    add(*world, def);
  }
  step_for(*world, 60);
  EXPECT_EQ(world->counters().awake_bodies, 0u);
  EXPECT_LT(world->counters().penetration_max, 0.05);  // a twentieth of the largest body
}

TEST(SleepTest, ATouchWakesTheWholeIsland) {
  auto world = make_world();
  add(*world, floor_body());
  const std::vector<BodyId> ids = add_stack(*world, 5);
  step_for(*world, 5);
  ASSERT_EQ(world->counters().awake_bodies, 0u);
  ASSERT_TRUE(world->apply_impulse_to_center(ids[0], {0.01, 0}));
  EXPECT_EQ(world->counters().awake_bodies, 5u);
}

TEST(SleepTest, AFallingBodyWakesWhatItHits) {
  auto world = make_world();
  add(*world, floor_body());
  const BodyId resting = add(*world, box_body(0, 0.5));
  step_for(*world, 2);
  ASSERT_FALSE(world->body(resting)->awake);
  add(*world, box_body(0, 4));
  bool woken = false;
  for (int i = 0; i < 120 && !woken; ++i) {
    world->step();
    woken = world->body(resting)->awake;
  }
  EXPECT_TRUE(woken);
}

TEST(SleepTest, SleepingBodiesKeepTheirPlaceExactly) {
  auto world = make_world();
  add(*world, floor_body());
  const BodyId id = add(*world, box_body(0, 0.5));
  step_for(*world, 2);
  ASSERT_FALSE(world->body(id)->awake);
  const Vec2 before = world->body(id)->position;
  step_for(*world, 10);
  EXPECT_EQ(world->body(id)->position, before);
}

}  // namespace
}  // namespace urto

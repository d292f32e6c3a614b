#include "app/scene_cost.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/room_driver.h"

namespace urto::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::uint64_t kMs = 1'000'000;

// Clocks of worlds have no context: this one has moved on by a millisecond, or a second, at each look.
std::uint64_t looks = 0;
std::uint64_t millisecond_clock() { return kMs * ++looks; }
std::uint64_t second_clock() { return 1000 * kMs * ++looks; }

std::unique_ptr<Room> room_with(Clock clock) {
  const auto factory = [clock](const WorldSettings& settings) { return World::create(settings, clock); };
  return std::move(Room::create({}, testing::floating_scene(), factory).value());
}

TEST(SceneCostTest, IsTheMeanOfEachPhase) {
  const auto room = room_with(millisecond_clock);
  const SceneCost cost = measure_cost(*room);
  EXPECT_EQ(cost.steps, kCostStepsMax);
  for (const double ms : cost.mean.ms) EXPECT_DOUBLE_EQ(ms, 1);
  for (const double ms : cost.longest.ms) EXPECT_DOUBLE_EQ(ms, 1);
  EXPECT_DOUBLE_EQ(cost.mean.step_ms, static_cast<double>(Phase::kCount));
  EXPECT_EQ(room->world().step_count(), kCostStepsMax);
  EXPECT_EQ(cost.last.bodies, room->world().counters().bodies);
}

TEST(SceneCostTest, LeavesOutStepsInWhichAllSleep) {
  SceneDef scene = testing::floating_scene();
  for (BodySpec& body : scene.bodies) body.def.awake = false;
  const auto factory = [](const WorldSettings& settings) { return World::create(settings, millisecond_clock); };
  const auto room = std::move(Room::create({}, scene, factory).value());
  const SceneCost cost = measure_cost(*room);
  EXPECT_EQ(cost.steps, kCostStepsMax);
  EXPECT_EQ(cost.awake_steps, 0u);
  EXPECT_DOUBLE_EQ(cost.mean.step_ms, static_cast<double>(Phase::kCount));  // of all, then
}

TEST(SceneCostTest, EndsEarlyWhereStepsTakeLong) {
  const auto room = room_with(second_clock);  // five phases, five seconds a step
  EXPECT_EQ(measure_cost(*room).steps, 1u);
}

TEST(SceneCostTest, NamesEveryPhaseAndWhatWasMeasuredWhere) {
  const auto room = room_with(millisecond_clock);
  const SceneCost cost = measure_cost(*room);  // the box floats until it falls asleep
  const std::string text = cost_text(cost, 2);
  EXPECT_GT(cost.awake_steps, 0u);
  EXPECT_LT(cost.awake_steps, cost.steps);
  for (int phase = 0; phase < static_cast<int>(Phase::kCount); ++phase)
    EXPECT_THAT(text, HasSubstr(phase_name(static_cast<Phase>(phase))));
  EXPECT_THAT(text, HasSubstr("measured now on this machine"));
  EXPECT_THAT(text, HasSubstr("on 2 threads: of the first 300 steps the " + std::to_string(cost.awake_steps)));
  EXPECT_THAT(text, HasSubstr("1.0000"));
  EXPECT_THAT(cost_text(measure_cost(*room), 1), Not(HasSubstr("threads")));
}

}  // namespace
}  // namespace urto::app

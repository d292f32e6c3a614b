#include "physics/solver/contact_kernels.h"

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

std::uint64_t hash_of_run(Precision precision) {
  WorldSettings settings = settings_for(precision);
  auto world = make_world(settings);
  add(*world, floor_body());
  add_pyramid(*world, 9);
  for (int i = 0; i < 6; ++i) {
    BodyDef ball = ball_body(-12 - i, 1 + i, 0.4);
    ball.velocity = {15, 1};
    ball.shapes[0].material.restitution = 0.5;
    add(*world, ball);
  }
  step_for(*world, 3);
  return world->state_hash();
}

// One hash for every SIMD width that this machine has.
TEST(ContactKernelsTest, EveryInstructionSetGivesTheSameBits) {
  const std::vector<SimdTarget> targets = simd_targets();
  ASSERT_FALSE(targets.empty());
  const std::uint64_t single = hash_of_run(Precision::kFloat), twice = hash_of_run(Precision::kDouble);
  for (const SimdTarget& target : targets) {
    use_simd_target(target.id);
    EXPECT_EQ(hash_of_run(Precision::kFloat), single) << target.name;
    EXPECT_EQ(hash_of_run(Precision::kDouble), twice) << target.name;
  }
  use_simd_target(0);
  RecordProperty("targets", static_cast<int>(targets.size()));
}

}  // namespace
}  // namespace urto

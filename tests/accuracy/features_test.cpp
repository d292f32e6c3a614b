// A feature that is left out gives the same bits as one that is on and has nothing to do.

#include "accuracy/features.h"

#include <gtest/gtest.h>

#include "accuracy/lab.h"
#include "accuracy/urto_simulator.h"

namespace urto::accuracy {
namespace {

class FeaturesTest : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Features, FeaturesTest, ::testing::Range<std::size_t>(0, feature_cases().size()));

TEST_P(FeaturesTest, LeftOutGivesTheBitsOfIdle) {
  const FeatureCase each = feature_cases()[GetParam()];
  SCOPED_TRACE(each.feature + " in the " + each.scene);
  // Half a second: nothing sleeps yet, and nothing is fast.
  constexpr long kSteps = 29;
  Lab lab(make_urto, Method{});
  accuracy::Run without(lab, each.without), idle(lab, each.idle);
  without.steps(kSteps);
  idle.steps(kSteps);
  for (std::size_t i = 0; i + 1 < each.without.bodies.size(); ++i) {
    const BodyState a = without.body(i), b = idle.body(i);
    ASSERT_EQ(a.position, b.position) << i;
    ASSERT_EQ(a.angle, b.angle) << i;
    ASSERT_EQ(a.velocity, b.velocity) << i;
    ASSERT_EQ(a.angular_velocity, b.angular_velocity) << i;
  }
}

}  // namespace
}  // namespace urto::accuracy

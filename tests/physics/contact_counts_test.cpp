#include "physics/contact_counts.h"

#include <algorithm>
#include <set>
#include <utility>

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

class ContactCountsTest : public ::testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, ContactCountsTest, ::testing::Values(Precision::kFloat, Precision::kDouble));

// The deepest of the points that the world names one by one.
double deepest_point(const World& world) {
  double deepest = 0;
  for (const ContactPoint& point : world.contacts()) deepest = std::max(deepest, -point.separation);
  return deepest;
}

// A heap of boxes and balls that fall on each other, go to sleep in part, and are pushed again.
TEST_P(ContactCountsTest, AgreeWithPointsAndEventsWhileAHeapFallsRestsAndIsRestored) {
  const auto world = make_world(settings_for(GetParam()));
  add(*world, box_body(0, -1, 40, 2, BodyType::kStatic));
  BodyId last = 0;
  for (int i = 0; i < 60; ++i) {
    const double x = 1.1 * (i % 10), y = 0.4 + 1.3 * (i / 10);
    last = add(*world, i % 3 == 0 ? ball_body(x, y, 0.45) : box_body(x + 0.05 * (i % 7), y, 0.9, 0.7));
  }
  std::set<std::pair<BodyId, BodyId>> touching;
  double deepest_ever = 0;
  for (int step = 0; step < 800; ++step) {
    if (step == 300) {
      ASSERT_TRUE(world->apply_impulse_to_center(last, {0, -3}));
    }
    if (step % 50 == 25) {
      ASSERT_TRUE(world->restore(world->save()));  // no lane is current now
      EXPECT_DOUBLE_EQ(world->counters().penetration_max, deepest_point(*world)) << step;
    }
    world->step();
    for (const ContactEvent& event : world->contact_events()) {
      const std::pair pair(event.body_a, event.body_b);
      event.kind == ContactEvent::Kind::kBegin ? (void)touching.insert(pair) : (void)touching.erase(pair);
    }
    const Counters counters = world->counters();
    ASSERT_EQ(counters.contacts, touching.size()) << step;
    ASSERT_DOUBLE_EQ(counters.penetration_max, deepest_point(*world)) << step;
    deepest_ever = std::max(deepest_ever, counters.penetration_max);
  }
  EXPECT_GT(deepest_ever, 0);
  EXPECT_LT(world->counters().awake_bodies, 60u);
}

}  // namespace
}  // namespace urto

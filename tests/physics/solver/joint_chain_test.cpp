// Long and stretched chains: how far their joints are apart, as a share of the chain's length.
#include <cmath>

#include "physics/support/joints.h"

namespace urto {
namespace {

using namespace testing;

constexpr double kDown = -1.5707963267948966;

struct ChainRun {
  double stretch = 0;  // sum of the gaps / number of links of 1 m
  double speed = 0;    // m/s, the fastest link
};

ChainRun run_chain(int links, double load, double stretch, double seconds) {
  WorldSettings settings;
  settings.gravity = {0, -10};
  settings.sleeping = false;
  auto world = make_world(settings);
  const Links chain = add_links(*world, add_post(*world), links, kDown, stretch, load);
  step_for(*world, seconds);
  ChainRun out;
  for (const JointId id : chain.joints) {
    const JointState state = *world->joint(id);
    out.stretch += (state.point_b - state.point_a).norm() / links;
  }
  for (const BodyId id : chain.links) out.speed = std::max(out.speed, world->body(id)->velocity.norm());
  return out;
}

TEST(JointChain, HundredLinksHangStraight) {
  const ChainRun run = run_chain(100, 1, 1, 20);
  EXPECT_LT(run.stretch, 0.01);
  EXPECT_LT(run.speed, 0.5);
}

TEST(JointChain, StretchedToTwiceItsLengthComesBackWithinOnePercent) {
  EXPECT_LT(run_chain(10, 1, 2, 20).stretch, 0.01);
  EXPECT_LT(run_chain(20, 10, 2, 20).stretch, 0.01);
}

// The level is 1 %: not met. Gauss-Seidel carries a load up the chain one link a pass, and warm starts bring it no
// nearer than 2.66 % in 20 s. Fails when that gets better than the level, or changes by a tenth.
TEST(JointChain, HundredLinksUnderAHundredfoldLoadStretchMoreThanTheyShould) {
  const ChainRun run = run_chain(100, 100, 1, 20);
  EXPECT_GT(run.stretch, 0.01);
  EXPECT_NEAR(run.stretch, 0.0266, 0.1 * 0.0266);
}

}  // namespace
}  // namespace urto

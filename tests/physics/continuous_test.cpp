// Nothing tunnels, and nothing loses the rest of a step where it need not.

#include "physics/continuous.h"

#include <cmath>

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

WorldSettings weightless() {
  WorldSettings settings;
  settings.gravity = {0, 0};
  return settings;
}

// A plate of 400 m/s against a wall 0.1 m thick, still, turning, and in both precisions.
class PlateTest : public ::testing::TestWithParam<std::tuple<Precision, double>> {};
INSTANTIATE_TEST_SUITE_P(Spins, PlateTest,
                         ::testing::Combine(::testing::Values(Precision::kFloat, Precision::kDouble),
                                            ::testing::Values(0.0, 3.0, 30.0, -200.0)));

TEST_P(PlateTest, DoesNotCrossAThinWall) {
  WorldSettings settings = settings_for(std::get<0>(GetParam()));
  settings.gravity = {0, 0};
  for (int shot = 0; shot < 50; ++shot) {
    auto world = make_world(settings);
    add(*world, box_body(0, 0, 0.1, 40, BodyType::kStatic));
    BodyDef plate = box_body(-3 - 0.137 * shot, 0, 0.05, 1);
    plate.velocity = {400, 0};
    plate.angular_velocity = std::get<1>(GetParam());
    plate.angle = 0.1 * shot;
    const BodyId id = add(*world, plate);
    step_for(*world, 1);
    EXPECT_LT(world->body(id)->position.x(), 0) << "shot " << shot;
  }
}

TEST(ContinuousTest, BulletsMeetInTheAir) {
  int passed = 0;
  for (int shot = 0; shot < 64; ++shot) {
    auto world = make_world(weightless());
    BodyDef left = ball_body(-10 - 0.05 * shot, 0, 0.05), right = ball_body(10, 0, 0.05);
    left.velocity = {200, 0};
    right.velocity = {-200, 0};
    const BodyId a = add(*world, left), b = add(*world, right);
    step_for(*world, 0.5);
    passed += world->body(a)->position.x() > world->body(b)->position.x();
  }
  EXPECT_EQ(passed, 0);
}

TEST(ContinuousTest, AFastBoxHitsADynamicWall) {
  int passed = 0;
  for (int shot = 0; shot < 64; ++shot) {
    auto world = make_world(weightless());
    BodyDef wall = box_body(0, 0, 0.1, 10);
    wall.shapes[0].material.density = 1000;
    const BodyId b = add(*world, wall);
    BodyDef bullet = box_body(-5 - 0.07 * shot, 0, 0.1, 0.1);
    bullet.velocity = {300, 0};
    const BodyId a = add(*world, bullet);
    step_for(*world, 0.5);
    passed += world->body(a)->position.x() > world->body(b)->position.x();
  }
  EXPECT_EQ(passed, 0);
}

TEST(ContinuousTest, OffMeansThatThinWallsAreCrossed) {
  WorldSettings settings = weightless();
  settings.continuous = false;
  auto world = make_world(settings);
  add(*world, box_body(0, 0, 0.1, 40, BodyType::kStatic));
  BodyDef plate = box_body(-5, 0, 0.05, 1);
  plate.velocity = {400, 0};
  const BodyId id = add(*world, plate);
  step_for(*world, 1);
  EXPECT_GT(world->body(id)->position.x(), 1);  // so the tests above test something
}

BodyDef thrown(BodyDef def, const Vec2& velocity, double restitution = 0) {
  def.velocity = velocity;
  def.shapes[0].material.restitution = restitution;
  def.shapes[0].material.friction = 0;
  return def;
}

// An elastic ball between two walls comes back nearly as if the steps were not there: bounces that lost the rest of
// their steps would be half a step late each, 30 m of way in 61 of them. A step that ends nearer to the wall than a
// contact reaches (0.07 m, one in fourteen) leaves the bounce to the solver, which loses up to a metre.
TEST(ContinuousTest, AnElasticBallKeepsItsTime) {
  auto world = make_world(weightless());
  for (double x : {-5.0, 5.0})
    add(*world, thrown(box_body(x + std::copysign(0.5, x), 0, 1, 4, BodyType::kStatic), {0, 0}, 1));
  const double speed = 60, radius = 0.1, room = 10 - 2 * radius;
  const BodyId id = add(*world, thrown(ball_body(0, 0, radius), {speed, 0}, 1));
  step_for(*world, 10);
  const double folded = std::fmod(speed * 10 + room / 2, 2 * room);
  const double expected = folded < room ? folded - room / 2 : room * 1.5 - folded;
  EXPECT_NEAR(std::abs(world->body(id)->velocity.x()), speed, 1e-3);
  EXPECT_NEAR(world->body(id)->position.x(), expected, 61.0 / 14);
}

TEST(ContinuousTest, ABounceWithinAStepIsReported) {
  auto world = make_world(weightless());
  add(*world, thrown(box_body(0, 0, 0.1, 4, BodyType::kStatic), {0, 0}, 1));
  add(*world, thrown(ball_body(-2, 0, 0.05), {100, 0}, 1));
  int begun = 0, ended = 0;
  for (int i = 0; i < 10; ++i) {
    world->step();
    for (const ContactEvent& event : world->contact_events()) {
      begun += event.kind == ContactEvent::Kind::kBegin;
      ended += event.kind == ContactEvent::Kind::kEnd;
      if (event.kind != ContactEvent::Kind::kBegin) continue;
      EXPECT_NEAR(event.approach_speed, 100, 1e-3);
      EXPECT_NEAR(event.point.x(), -0.05, 0.01);
      EXPECT_NEAR(std::abs(event.normal.x()), 1, 1e-5);
    }
  }
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(ended, 1);
}

// A plate that strikes flat does not begin to turn, and one that does not spring stays.
TEST(ContinuousTest, AFlatImpactIsTakenAtBothEndsOfTheFace) {
  auto world = make_world(weightless());
  add(*world, thrown(box_body(0, 0, 0.1, 4, BodyType::kStatic), {0, 0}));
  const BodyId id = add(*world, thrown(box_body(-3, 0, 0.05, 1), {1000, 0}));
  step_for(*world, 0.1);
  EXPECT_NEAR(world->body(id)->velocity.x(), 0, 1e-2);
  EXPECT_NEAR(world->body(id)->angular_velocity, 0, 1e-3);
  EXPECT_LT(world->body(id)->position.x(), -0.075);
}

// Momentum and energy of two elastic bullets, as two balls of one mass exchange their velocities.
TEST(ContinuousTest, BulletsExchangeTheirVelocities) {
  auto world = make_world(weightless());
  const BodyId a = add(*world, thrown(ball_body(-3, 0, 0.05), {300, 0}, 1));
  const BodyId b = add(*world, thrown(ball_body(3, 0, 0.05), {-100, 0}, 1));
  step_for(*world, 0.1);
  EXPECT_NEAR(world->body(a)->velocity.x(), -100, 1e-3);
  EXPECT_NEAR(world->body(b)->velocity.x(), 300, 1e-3);
}

// What a wall that moves fast meets goes with it: in the air, on the floor, and asleep.
class MovingWallTest : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Speeds, MovingWallTest, ::testing::Values(5.0, 50.0, 500.0));

TEST_P(MovingWallTest, LeavesNothingBehind) {
  for (const bool rests : {false, true}) {
    auto world = make_world();
    add(*world, floor_body(10000));
    const BodyId id = add(*world, thrown(box_body(10, rests ? 0.1 : 3, 0.2, 0.2), {0, 0}));
    if (rests) {
      step_for(*world, 2);
      ASSERT_FALSE(world->body(id)->awake);
    }
    const BodyId wall = add(*world, box_body(0, 5, 0.1, 9.9, BodyType::kKinematic));
    ASSERT_TRUE(world->set_velocity(wall, {GetParam(), 0}, 0));
    for (int i = 0; i < 60 && world->body(wall)->position.x() < 100; ++i) world->step();
    while (world->body(wall)->position.x() < 12) world->step();
    EXPECT_GT(world->body(id)->position.x(), world->body(wall)->position.x()) << "rests " << rests;
  }
}

// A chain stops what comes from its right side only, however fast.
TEST(ContinuousTest, AChainIsOneSidedForBulletsToo) {
  for (const double from : {1.0, -1.0}) {
    auto world = make_world(weightless());
    BodyDef ground;
    ground.type = BodyType::kStatic;
    ground.shapes.push_back(ShapeDef{Chain{{{5, 0}, {2, 0}, {-2, 0}, {-5, 0}}, false}, {}, {}, false});
    add(*world, ground);
    const BodyId id = add(*world, thrown(ball_body(0.3, 4 * from, 0.05), {0, -100 * from}));
    step_for(*world, 0.2);
    const double y = world->body(id)->position.y();
    EXPECT_GT(y, from > 0 ? 0 : 5);
  }
}

}  // namespace
}  // namespace urto

#include "physics/hits.h"

#include <cmath>
#include <random>

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

struct Way {
  Precision precision;
  SolverKind solver;
};

class HitsTest : public ::testing::TestWithParam<Way> {
 protected:
  WorldSettings settings(std::optional<double> speed_min = 1.0) const {
    WorldSettings settings = settings_for(GetParam().precision);
    settings.solver = GetParam().solver;
    if (speed_min) settings.hit_events = HitEvents{*speed_min};
    return settings;
  }

  static std::vector<ContactEvent> hits_of(const World& world) {
    std::vector<ContactEvent> hits;
    for (const ContactEvent& event : world.contact_events())
      if (event.kind == ContactEvent::Kind::kHit) hits.push_back(event);
    return hits;
  }

  static std::vector<ContactEvent> hits_within(World& world, double seconds) {
    std::vector<ContactEvent> hits;
    for (int i = 0; i < seconds * 60; ++i) {
      world.step();
      for (const ContactEvent& event : hits_of(world)) hits.push_back(event);
    }
    return hits;
  }
};
INSTANTIATE_TEST_SUITE_P(Ways, HitsTest,
                         ::testing::Values(Way{Precision::kFloat, SolverKind::kSoftStep},
                                           Way{Precision::kDouble, SolverKind::kSoftStep},
                                           Way{Precision::kDouble, SolverKind::kPrecise}));

TEST_P(HitsTest, AFallIsOneHitWithItsSpeedPointAndNormal) {
  for (const double height : {0.3, 1.0, 5.0, 20.0, 80.0}) {
    SCOPED_TRACE(height);
    const auto world = make_world(settings());
    const BodyId floor = add(*world, floor_body());
    const BodyId box = add(*world, box_body(3, height + 0.5));
    const auto hits = hits_within(*world, 6);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_EQ(hits[0].body_a, floor);
    EXPECT_EQ(hits[0].body_b, box);
    EXPECT_FALSE(hits[0].sensor);
    // At the start of the tick of the blow: up to g/60 slower than at the blow itself. What the integrator adds to the
    // speed of a fall is less than that.
    EXPECT_NEAR(hits[0].approach_speed, std::sqrt(2 * 9.81 * height), 2 * 9.81 / 60);
    EXPECT_NEAR(std::abs(hits[0].point.x() - 3), 0.5, 0.01);
    EXPECT_NEAR(hits[0].point.y(), 0, 1e-4);
    EXPECT_NEAR((hits[0].normal - Vec2(0, 1)).norm(), 0, 1e-5);
  }
}

TEST_P(HitsTest, ABouncingBallHitsAtEachBounceAboveTheSpeed) {
  const auto world = make_world(settings(2.5));
  add(*world, floor_body());
  BodyDef ball = ball_body(0, 4.5);
  ball.shapes[0].material.restitution = 0.7;
  add(*world, ball);
  const auto hits = hits_within(*world, 8);
  // Falls 4 m: 8.86 m/s, then 0.7 of it each time: 6.2, 4.34, 3.04, 2.13.
  ASSERT_EQ(hits.size(), 4u);
  double speed = std::sqrt(2 * 9.81 * 4);
  for (const ContactEvent& hit : hits) {
    EXPECT_NEAR(hit.approach_speed, speed, 0.45);  // of a tick's gravity, at each of up to four bounces
    speed *= 0.7;
  }
}

TEST_P(HitsTest, WhatIsSlowOrNotAskedForMakesNone) {
  const auto fast = make_world(settings(50.0)), slow = make_world(settings(0.5)), off = make_world(settings({}));
  for (World* world : {fast.get(), slow.get(), off.get()}) {
    add(*world, floor_body());
    add(*world, box_body(0, 0.505));  // falls 5 mm: 0.3 m/s
    add(*world, box_body(5, 3));      // 2.5 m: 7 m/s
  }
  EXPECT_EQ(hits_within(*fast, 2).size(), 0u);
  EXPECT_EQ(hits_within(*slow, 2).size(), 1u);
  EXPECT_EQ(hits_within(*off, 2).size(), 0u);
}

TEST_P(HitsTest, ABlowOnATouchingContactIsAHit) {
  const auto world = make_world(settings());
  add(*world, floor_body());
  const BodyId box = add(*world, box_body(0, 0.5));
  EXPECT_EQ(hits_within(*world, 1).size(), 0u);
  // 5 m/s into the floor on which it lies.
  ASSERT_TRUE(world->apply_impulse_to_center(box, {0, -5}));
  const auto hits = hits_within(*world, 1);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(hits[0].approach_speed, 5, 1e-3);
}

TEST_P(HitsTest, ASensorIsNotStruck) {
  const auto world = make_world(settings());
  BodyDef coin = box_body(0, 0, 4, 1, BodyType::kStatic);
  coin.shapes[0].sensor = true;
  add(*world, coin);
  add(*world, ball_body(0, 5));
  EXPECT_EQ(hits_within(*world, 2).size(), 0u);
}

TEST_P(HitsTest, TheyDoNotMoveAnything) {
  const std::uint64_t seed = 5;
  SCOPED_TRACE("seed " + std::to_string(seed));
  const auto with = make_world(settings(0.0)), without = make_world(settings({}));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> spread(-6, 6);
  for (World* world : {with.get(), without.get()}) add(*world, floor_body());
  for (int i = 0; i < 30; ++i) {
    const BodyDef def = i % 2 ? box_body(spread(random), 8 + spread(random)) : ball_body(spread(random), 16);
    for (World* world : {with.get(), without.get()}) add(*world, def);
  }
  std::size_t hits = 0;
  for (int i = 0; i < 120; ++i) {
    with->step();
    without->step();
    hits += hits_of(*with).size();
    BodyColumns a, b;
    with->capture(a, true);
    without->capture(b, true);
    ASSERT_EQ(a.x, b.x);
    ASSERT_EQ(a.angle, b.angle);
  }
  EXPECT_GT(hits, 30u);
}

TEST_P(HitsTest, TheSameInTheSameOrderOnTwoThreads) {
  const std::uint64_t seed = 6;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> spread(-6, 6);
  const auto one = std::move(*World::create(settings(0.5), nullptr, 1));
  const auto two = std::move(*World::create(settings(0.5), nullptr, 2));
  for (World* world : {one.get(), two.get()}) add(*world, floor_body());
  for (int i = 0; i < 60; ++i) {
    const BodyDef def = box_body(spread(random), 8 + spread(random), 0.5, 0.5);
    for (World* world : {one.get(), two.get()}) add(*world, def);
  }
  std::size_t count = 0;
  for (int i = 0; i < 90; ++i) {
    one->step();
    two->step();
    const auto a = hits_of(*one), b = hits_of(*two);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].body_a, b[k].body_a);
      EXPECT_EQ(a[k].body_b, b[k].body_b);
      EXPECT_EQ(a[k].point, b[k].point);
      EXPECT_EQ(a[k].approach_speed, b[k].approach_speed);
      EXPECT_GT(a[k].approach_speed, 0.5);
      EXPECT_NEAR(a[k].normal.norm(), 1, 1e-5);
    }
    count += a.size();
  }
  EXPECT_GT(count, 60u);
}

TEST_P(HitsTest, TheSameAfterARestoreInTheMiddleOfABlow) {
  for (int at = 50; at < 70; ++at) {
    SCOPED_TRACE(at);
    const auto world = make_world(settings()), other = make_world(settings({}));
    add(*world, floor_body());
    add(*world, box_body(0, 5.5));
    for (int i = 0; i < at; ++i) world->step();
    ASSERT_TRUE(other->restore(world->save()));
    EXPECT_EQ(other->settings().hit_events->speed_min, 1.0);
    EXPECT_EQ(other->state_hash(), world->state_hash());
    EXPECT_EQ(hits_within(*world, 0.5).size(), hits_within(*other, 0.5).size());
    EXPECT_EQ(other->state_hash(), world->state_hash());
  }
}

TEST(Hits, ABulletThatIsStoppedBeforeAThinWallStrikesItAtItsSpeed) {
  WorldSettings settings;
  settings.hit_events = HitEvents{};
  settings.gravity = {0, 0};
  const auto world = make_world(settings);
  add(*world, box_body(0, 0, 0.02, 4, BodyType::kStatic));
  BodyDef bullet = ball_body(-10.3, 0, 0.05);
  bullet.velocity = {300, 0};
  add(*world, bullet);
  std::vector<ContactEvent> hits;
  for (int i = 0; i < 10; ++i) {
    world->step();
    for (const ContactEvent& event : world->contact_events())
      if (event.kind == ContactEvent::Kind::kHit) hits.push_back(event);
  }
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(hits[0].approach_speed, 300, 0.1);
}

TEST(Hits, AbsentTheyLeaveNoTraceInTheState) {
  WorldSettings settings;
  const auto absent = make_world(settings);
  settings.hit_events = HitEvents{};
  const auto present = make_world(settings);
  EXPECT_EQ(present->save().size(), absent->save().size() + sizeof(std::uint32_t) + sizeof(double));
  EXPECT_NE(present->state_hash(), absent->state_hash());
}

TEST(Hits, SettingsOutOfRangeAreRefused) {
  WorldSettings settings;
  settings.hit_events = HitEvents{-1};
  EXPECT_EQ(World::create(settings).error().field, "hit_events.speed_min");
  settings.hit_events = HitEvents{std::nan("")};
  EXPECT_EQ(World::create(settings).error().code, ErrorCode::kInvalidValue);
  settings.hit_events = HitEvents{};
  settings.solver = SolverKind::kThesis;
  EXPECT_EQ(World::create(settings).error().code, ErrorCode::kNotSupported);
}

}  // namespace
}  // namespace urto

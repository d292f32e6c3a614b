// The precise solver as a scene gets it: levels that a reference in closed form allows.

#include "physics/solver/precise/precise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/support/scenes.h"
#include "physics/world_of.h"

namespace urto {
namespace {

using namespace testing;

constexpr double kGravity = 9.81;

WorldSettings precise_settings() {
  WorldSettings settings;
  settings.precision = Precision::kDouble;
  settings.solver = SolverKind::kPrecise;
  settings.sleeping = false;
  settings.restitution_threshold = 0;
  return settings;
}

BodyDef with_material(BodyDef def, double friction, double restitution) {
  for (ShapeDef& shape : def.shapes) {
    shape.material.friction = friction;
    shape.material.restitution = restitution;
  }
  return def;
}

// N·s over the last step between two bodies.
double impulse_between(const World& world, BodyId a, BodyId b) {
  double sum = 0;
  for (const ContactPoint& c : world.contacts())
    if ((c.body_a == a && c.body_b == b) || (c.body_a == b && c.body_b == a)) sum += c.normal_impulse;
  return sum;
}

TEST(Precise, NeedsDoublePrecision) {
  WorldSettings settings = precise_settings();
  settings.precision = Precision::kFloat;
  const auto world = World::create(settings);
  ASSERT_FALSE(world.has_value());
  EXPECT_EQ(world.error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world.error().field, "solver");
}

// x = v t, y = v t − g t²/2. What remains is rounding: 600 steps of a coordinate of 500 m.
TEST(Precise, FlightIsAParabola) {
  for (const Vec2& v : {Vec2(3, 20), Vec2(-1, 50), Vec2(7.3, 44.7), Vec2(0, -0.1)}) {
    auto world = make_world(precise_settings());
    BodyDef def = ball_body(0, 0);
    def.velocity = v;
    const BodyId id = add(*world, def);
    for (int i = 1; i <= 600; ++i) {
      world->step();
      const double t = i * world->settings().time_step;
      const Vec2 p = world->body(id)->position;
      ASSERT_NEAR(p.x(), v.x() * t, 1e-12);
      ASSERT_NEAR(p.y(), v.y() * t - 0.5 * kGravity * t * t, 1e-12);
    }
  }
}

// What rounding left out of a velocity is state, as the velocity is; one that was given has nothing left out.
TEST(Precise, WhatVelocitiesLeaveOutIsState) {
  auto world = make_world(precise_settings());
  BodyDef def = ball_body(0, 0);
  def.velocity = {0, 50};
  const BodyId id = add(*world, def);
  const auto rests = [](World& of) -> std::vector<SpeedRest>& {
    return dynamic_cast<WorldOf<double>&>(of).data().speed_rests;
  };
  EXPECT_TRUE(rests(*world).empty());
  step_for(*world, 1);
  ASSERT_EQ(rests(*world).size(), 1u);
  EXPECT_NE(rests(*world)[0].rest_y, 0.0);
  auto copy = make_world(precise_settings());
  ASSERT_TRUE(copy->restore(world->save()).has_value());
  EXPECT_EQ(copy->state_hash(), world->state_hash());
  rests(*copy)[0].rest_y = 0.0;
  EXPECT_NE(copy->state_hash(), world->state_hash());
  ASSERT_TRUE(world->set_velocity(id, {0, 32}, 0).has_value());
  world->step();
  EXPECT_EQ(world->body(id)->velocity.y(), 32 + world->settings().time_step * -kGravity);
}

// What lies on contact k of N weighs (N − k) m g.
TEST(Precise, ForcesOfAStack) {
  for (int count : {1, 10, 50, 100}) {
    auto world = make_world(precise_settings());
    std::vector<BodyId> ids{add(*world, floor_body())};
    for (BodyId id : add_stack(*world, count)) ids.push_back(id);
    step_for(*world, 1);
    const double h = world->settings().time_step;
    for (int k = 0; k < count; ++k) {
      const double load = (count - k) * kGravity * h;
      EXPECT_NEAR(
          impulse_between(*world, ids[static_cast<std::size_t>(k)], ids[static_cast<std::size_t>(k) + 1]) / load, 1,
          1e-9)
          << "contact " << k << " of " << count;
    }
  }
}

TEST(Precise, HeavyOnLight) {
  for (double ratio : {1e2, 1e3, 1e4, 1e6}) {
    auto world = make_world(precise_settings());
    const BodyId ground = add(*world, floor_body()), light = add(*world, box_body(0, 0.5));
    BodyDef def = box_body(0, 1.5);
    def.mass = ratio;
    const BodyId heavy = add(*world, def);
    step_for(*world, 10);
    const double load = (1 + ratio) * kGravity * world->settings().time_step;
    EXPECT_NEAR(impulse_between(*world, ground, light) / load, 1, 1e-9) << ratio;
    EXPECT_NEAR(world->body(heavy)->position.y(), 1.5, 1e-7) << ratio;
  }
}

// A ball that bounces without loss follows 2√(2H/g) for twenty seconds.
TEST(Precise, ElasticBounceKeepsItsEnergy) {
  auto world = make_world(precise_settings());
  add(*world, with_material(floor_body(), 0, 1));
  const BodyId id = add(*world, with_material(ball_body(0, 5.5), 0, 1));
  const double period = 2 * std::sqrt(2 * 5 / kGravity);
  for (int i = 1; i <= 1200; ++i) {
    world->step();
    const double t = i * world->settings().time_step;
    const double phase = std::remainder(t, period);  // 0 at an apex
    ASSERT_NEAR(world->body(id)->position.y(), 5.5 - 0.5 * kGravity * phase * phase, 1e-9) << t;
  }
}

// Apexes e²ⁿ H, and rest at t₀ (1 + e)/(1 − e).
TEST(Precise, InelasticBounceComesToRest) {
  constexpr double kE = 0.8;
  auto world = make_world(precise_settings());
  add(*world, with_material(floor_body(), 0, kE));
  const BodyId id = add(*world, with_material(ball_body(0, 5.5), 0, kE));
  const double fall = std::sqrt(2 * 5 / kGravity), rest = fall * (1 + kE) / (1 - kE);
  step_for(*world, fall * (1 + 1.5 * kE));
  const double since = world->step_count() * world->settings().time_step - fall * (1 + kE);  // after the first apex
  EXPECT_NEAR(world->body(id)->position.y(), 0.5 + kE * kE * 5 - 0.5 * kGravity * since * since, 1e-9);
  while (world->step_count() * world->settings().time_step < rest - 0.05) world->step();
  EXPECT_GT(world->energy().kinetic, 1e-9);
  step_for(*world, 0.1);
  EXPECT_LT(world->energy().kinetic, 1e-20);
  EXPECT_NEAR(world->body(id)->position.y(), 0.5, 1e-9);
}

// Five balls: the last leaves with the speed of the first, with gaps and without.
TEST(Precise, CradleHandsTheBlowOn) {
  for (double gap : {1e-3, 0.0}) {
    WorldSettings settings = precise_settings();
    settings.gravity = {0, 0};
    auto world = make_world(settings);
    std::vector<BodyId> ids;
    for (int i = 0; i < 5; ++i) {
      BodyDef def = with_material(ball_body(i == 0 ? -2 : i * (1 + gap), 0), 0, 1);
      if (i == 0) def.velocity = {3, 0};
      ids.push_back(add(*world, def));
    }
    step_for(*world, 2);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(world->body(ids[i])->velocity.x(), 0, 1e-12);
    EXPECT_NEAR(world->body(ids[4])->velocity.x(), 3, 1e-12);
  }
}

// The incline is the gravity's: it sticks below the angle of friction, and slides with g (sin θ − μ cos θ) above.
TEST(Precise, BoxOnASlope) {
  constexpr double kMu = 0.5, kDegree = 0.017453292519943295;
  for (double beyond : {-0.1, 0.5}) {
    const double slope = std::atan(kMu) + beyond * kDegree;
    WorldSettings settings = precise_settings();
    settings.gravity = kGravity * Vec2(std::sin(slope), -std::cos(slope));
    auto world = make_world(settings);
    add(*world, with_material(floor_body(1000), kMu, 0));
    const BodyId id = add(*world, with_material(box_body(0, 0.5), kMu, 0));
    step_for(*world, 10);
    const double a = beyond < 0 ? 0 : kGravity * (std::sin(slope) - kMu * std::cos(slope));
    EXPECT_NEAR(world->body(id)->velocity.x(), a * 10, 1e-9);
    EXPECT_NEAR(world->body(id)->position.x(), 0.5 * a * 100, 1e-9);
  }
}

TEST(Precise, SlidingStopsWhereItShould) {
  for (double mu : {0.3, 0.47, 0.5}) {
    auto world = make_world(precise_settings());
    add(*world, with_material(floor_body(), mu, 0));
    BodyDef def = with_material(box_body(0, 0.5), mu, 0);
    def.velocity = {5, 0};
    const BodyId id = add(*world, def);
    step_for(*world, 3);
    EXPECT_NEAR(world->body(id)->position.x(), 25 / (2 * mu * kGravity), 1e-12) << mu;
    EXPECT_NEAR(world->body(id)->velocity.x(), 0, 1e-12);
  }
}

// A disc that slides at v rolls from t = v/3μg on, 5v²/18μg further, at 2v/3.
TEST(Precise, DiscBeginsToRoll) {
  constexpr double kV = 4, kMu = 0.3;
  auto world = make_world(precise_settings());
  add(*world, with_material(floor_body(), kMu, 0));
  BodyDef def = with_material(ball_body(0, 0.5), kMu, 0);
  def.velocity = {kV, 0};
  const BodyId id = add(*world, def);
  step_for(*world, 3);
  const double since = world->step_count() * world->settings().time_step - kV / (3 * kMu * kGravity);
  EXPECT_NEAR(world->body(id)->velocity.x(), 2 * kV / 3, 1e-12);
  EXPECT_NEAR(world->body(id)->angular_velocity, -4 * kV / 3, 1e-12);
  EXPECT_NEAR(world->body(id)->position.x(), 5 * kV * kV / (18 * kMu * kGravity) + since * 2 * kV / 3, 1e-12);
}

// A box of 1 m by 2 m flips where tan θ > 1/2 and friction holds it.
TEST(Precise, BoxTopplesOnASlope) {
  constexpr double kDegree = 0.017453292519943295;
  for (double beyond : {-0.05, 0.05}) {
    const double slope = std::atan(0.5) + beyond * kDegree;
    WorldSettings settings = precise_settings();
    settings.gravity = kGravity * Vec2(std::sin(slope), -std::cos(slope));
    auto world = make_world(settings);
    add(*world, with_material(floor_body(), 0.8, 0));
    const BodyId id = add(*world, with_material(box_body(0, 1, 1, 2), 0.8, 0));
    step_for(*world, 20);
    EXPECT_NEAR(world->body(id)->angle, beyond < 0 ? 0 : -90 * kDegree, 1e-3);
  }
}

// Two cards of 2 mm by 0.4 m that lean on each other by a corner at 25° to the vertical stand if μ ≥ ½ tan 25°.
TEST(Precise, CardPairStandsByItsFriction) {
  constexpr double kLean = 25 * 0.017453292519943295, kHalfWidth = 0.001, kHalfHeight = 0.2;
  const double c = std::cos(kLean), s = std::sin(kLean);
  for (double share : {0.98, 1.02}) {
    auto world = make_world(precise_settings());
    const double mu = share * 0.5 * std::tan(kLean);
    add(*world, with_material(floor_body(), mu, 0));
    const double x = c * kHalfWidth + s * kHalfHeight, y = c * kHalfHeight + s * kHalfWidth;
    std::vector<BodyId> cards;
    for (double side : {-1.0, 1.0}) {
      BodyDef def = with_material(box_body(side * x, y, 2 * kHalfWidth, 2 * kHalfHeight), mu, 0);
      def.angle = side * kLean;
      cards.push_back(add(*world, def));
    }
    step_for(*world, 20);
    if (share > 1) {
      EXPECT_NEAR(world->body(cards[0])->position.y(), y, 1e-6);
    } else {
      EXPECT_LT(world->body(cards[0])->position.y(), 0.5 * y);
    }
  }
}

// A box that would have to be held by more than friction can: what Painlevé's paradox is about. Finite, whatever
// happens.
TEST(Precise, PainleveRodStaysFinite) {
  for (double speed : {-10.0, -3.0, 3.0, 10.0}) {
    auto world = make_world(precise_settings());
    add(*world, with_material(floor_body(2000), 1.5, 0));
    BodyDef def = with_material(box_body(0, 0.5 * std::sin(0.9) + 0.005 * std::cos(0.9), 1, 0.01), 1.5, 0);
    def.angle = 0.9;
    def.velocity = {speed, 0};
    const BodyId id = add(*world, def);
    step_for(*world, 5);
    EXPECT_LT(std::abs(world->body(id)->position.x()), 50);
    EXPECT_LT(world->energy().kinetic, 1e-9);
  }
}

// The same while it slides: energy never grows but for the second-order error of a turn over a corner.
TEST(Precise, PainleveRodGainsNoEnergy) {
  for (double tangent : {1.2, 1.5, 2.0, 2.5, 3.0, 4.0}) {
    for (double friction : {1.4, 1.5, 1.7, 3.0}) {
      auto world = make_world(precise_settings());
      add(*world, with_material(floor_body(2000), friction, 0));
      const double angle = std::atan(tangent);
      BodyDef def = with_material(box_body(0, std::sin(angle) + 0.01 * std::cos(angle), 2, 0.02), friction, 0);
      def.angle = angle;
      def.velocity = {-5, 0};
      add(*world, def);
      const auto energy = [&world] { return world->energy().kinetic + world->energy().potential; };
      const double start = energy();
      double least = start, worst = 0;
      for (int i = 0; i < 300; ++i) {
        world->step();
        const double now = energy();
        worst = std::max(worst, (now - least) / start);
        least = std::min(least, now);
      }
      EXPECT_LT(worst, 1e-4) << "tan " << tangent << ", friction " << friction;
    }
  }
}

// Discs that bounce off each other and off walls without loss.
TEST(Precise, ElasticDiscsKeepTheirEnergy) {
  WorldSettings settings = precise_settings();
  settings.gravity = {0, 0};
  auto world = make_world(settings);
  for (const Vec2& at : {Vec2(0, -3.5), Vec2(0, 3.5)})
    add(*world, with_material(box_body(at.x(), at.y(), 8, 1, BodyType::kStatic), 0, 1));
  for (const Vec2& at : {Vec2(-3.5, 0), Vec2(3.5, 0)})
    add(*world, with_material(box_body(at.x(), at.y(), 1, 8, BodyType::kStatic), 0, 1));
  for (int i = 0; i < 36; ++i) {
    BodyDef def = with_material(ball_body(0.8 * (i % 6) - 2, 0.8 * (i / 6) - 2, 0.2), 0, 1);
    def.velocity = {5 * std::cos(1.7 * i), 5 * std::sin(1.7 * i)};
    add(*world, def);
  }
  const double before = world->energy().kinetic;
  step_for(*world, 10);
  EXPECT_NEAR(world->energy().kinetic / before, 1, 1e-12);
}

// Every row of the pyramid rests on the ground in the end.
TEST(Precise, PyramidStandsOnTheGround) {
  auto world = make_world(precise_settings());
  const BodyId ground = add(*world, floor_body());
  const std::vector<BodyId> ids = add_pyramid(*world, 10);
  step_for(*world, 2);
  double force = 0;
  for (const ContactPoint& c : world->contacts())
    if (c.body_a == ground) force += c.normal_impulse / world->settings().time_step;
  EXPECT_NEAR(force / (static_cast<double>(ids.size()) * kGravity), 1, 1e-9);
  EXPECT_LT(world->energy().kinetic, 1e-18);
}

// A force over a step acts where the corner is half-way through it. Where the step begins it would do work, and the
// box would lose 8e-4 of its energy on the way down.
TEST(Precise, BoxThatTurnsOverACornerKeepsItsEnergy) {
  auto world = make_world(precise_settings());
  add(*world, with_material(floor_body(), 1, 0));
  BodyDef def = with_material(box_body(0, 0), 1, 0);
  def.angle = 0.4;
  def.position.y() = 0.5 * (std::cos(def.angle) + std::sin(def.angle));
  const BodyId id = add(*world, def);
  const double start = world->energy().kinetic + kGravity * world->body(id)->position.y();
  while (world->body(id)->angle > 0.1) {
    world->step();
    EXPECT_NEAR((world->energy().kinetic + kGravity * world->body(id)->position.y()) / start, 1, 1e-4);
  }
}

// It rocks from corner to corner, in the end many times a step.
TEST(Precise, BoxThatFellOnACornerComesToRest) {
  auto world = make_world(precise_settings());
  add(*world, with_material(floor_body(), 0.6, 0));
  BodyDef def = with_material(box_body(0.3, 2), 0.6, 0);
  def.angle = 0.4;
  def.velocity = {1, 0};
  def.angular_velocity = 2;
  const BodyId id = add(*world, def);
  step_for(*world, 4);
  EXPECT_LT(world->energy().kinetic, 1e-18);
  EXPECT_NEAR(world->body(id)->position.y(), 0.5, 1e-6);
}

// One of the three may have gone on by itself while the others met: it must not keep a push that nobody gives it.
TEST(Precise, MomentumIsKeptWhereManyMeetInAStep) {
  WorldSettings settings = precise_settings();
  settings.gravity = {0, 0};
  auto world = make_world(settings);
  std::vector<BodyId> ids;
  for (int i = 0; i < 25; ++i) {
    BodyDef def = with_material(box_body(1.5 * (i % 5 - 2), 1.5 * (i / 5 - 2)), 0.6, 0.3);
    def.angle = i;
    def.velocity = -def.position;
    def.angular_velocity = i % 7 - 3;
    ids.push_back(add(*world, def));
  }
  const auto momentum = [&] {
    double x = 0, y = 0, angular = 0;
    for (const BodyId id : ids) {
      const BodyState body = *world->body(id);
      x += body.velocity.x();
      y += body.velocity.y();
      angular += body.position.x() * body.velocity.y() - body.position.y() * body.velocity.x();
      angular += body.angular_velocity / 6;  // a unit square of unit mass
    }
    return std::array<double, 3>{x, y, angular};
  };
  const auto start = momentum();
  step_for(*world, 5);
  const auto end = momentum();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(end[i], start[i], 1e-11) << i;
}

TEST(Precise, StepsOnAfterARestoreAsWithout) {
  auto world = make_world(precise_settings());
  add(*world, with_material(floor_body(), 0.5, 0.3));
  for (int i = 0; i < 6; ++i) {
    BodyDef def = with_material(box_body(0.3 * i, 1 + 1.2 * i), 0.5, 0.3);
    def.angle = 0.3 * i;
    add(*world, def);
  }
  step_for(*world, 1);
  auto copy = make_world(precise_settings());
  ASSERT_TRUE(copy->restore(world->save()).has_value());
  step_for(*world, 1);
  step_for(*copy, 1);
  EXPECT_EQ(world->state_hash(), copy->state_hash());
}

}  // namespace
}  // namespace urto

#include "physics/integrator.h"

#include <algorithm>
#include <cmath>

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

constexpr Integrator kAll[] = {Integrator::kExplicitEuler, Integrator::kSemiImplicitEuler, Integrator::kVerlet,
                               Integrator::kRungeKutta4};

WorldSettings flight_settings(Integrator integrator) {
  WorldSettings settings;
  settings.precision = Precision::kDouble;
  settings.integrator = integrator;
  settings.gravity = {0, -10};
  settings.sub_steps = 1;
  return settings;
}

// Ballistic flight: the error of position after t is −½ g h t (semi-implicit), +½ g h t (explicit), 0 otherwise.
TEST(IntegratorTest, BallisticErrorFollowsItsLaw) {
  const double factor[] = {+0.5, -0.5, 0, 0};
  for (int i = 0; i < 4; ++i) {
    const WorldSettings settings = flight_settings(kAll[i]);
    auto world = make_world(settings);
    BodyDef def = box_body(0, 0);
    def.velocity = {3, 40};
    const BodyId id = add(*world, def);
    step_for(*world, 10);
    const double exact = 40 * 10 - 0.5 * 10 * 100;
    const double law = factor[i] * 10 * settings.time_step * 10;
    EXPECT_NEAR(world->body(id)->position.y() - exact, law, 1e-10) << "integrator " << i;
    EXPECT_NEAR(world->body(id)->position.x(), 30, 1e-10);
  }
}

// Global error of a Kepler orbit of eccentricity 0.3 at 0.37 of its period, against the closest of many small steps.
Vec2 orbit_end(Integrator integrator, int steps) {
  const double period = 2 * 3.14159265358979323846;  // strength 1, semi-major axis 1
  Flight<double> f{Vec2(0.7, 0), Vec2(0, std::sqrt((1 + 0.3) / (1 - 0.3)))};
  const auto pull = [](const Vec2& x, const Vec2&) { return Vec2(-x / std::pow(x.squaredNorm(), 1.5)); };
  for (int i = 0; i < steps; ++i) f = advance<double>(integrator, f, 0.37 * period / steps, pull);
  return f.x;
}

TEST(IntegratorTest, OrdersOnAnOrbitAreOneOneTwoFour) {
  const Vec2 reference = orbit_end(Integrator::kRungeKutta4, 1 << 15);
  const double order[] = {1, 1, 2, 4};
  for (int i = 0; i < 4; ++i) {
    const double coarse = (orbit_end(kAll[i], 1024) - reference).norm();
    const double fine = (orbit_end(kAll[i], 2048) - reference).norm();
    EXPECT_NEAR(std::log2(coarse / fine), order[i], 0.05) << "integrator " << i;
  }
}

// An oscillator with ωh = 0.1 for 100 s: explicit Euler gains energy without bound, semi-implicit stays within ωh/2,
// Verlet within (ωh)²/4, Runge-Kutta loses (ωh)⁶/72 a step.
TEST(IntegratorTest, OscillatorKeepsItsEnergyAsTheTheorySays) {
  const double h = 0.1;
  const int steps = 1000;
  double worst[4] = {}, last[4] = {};
  for (int i = 0; i < 4; ++i) {
    Flight<double> f{Vec2(1, 0), Vec2(0, 0)};
    const auto spring = [](const Vec2& x, const Vec2&) { return Vec2(-x); };
    for (int k = 0; k < steps; ++k) {
      f = advance<double>(kAll[i], f, h, spring);
      last[i] = f.x.squaredNorm() + f.v.squaredNorm() - 1;
      worst[i] = std::max(worst[i], std::abs(last[i]));
    }
  }
  EXPECT_NEAR(last[0], std::pow(1 + h * h, steps) - 1, 1e-6 * last[0]);
  EXPECT_LT(worst[1], 1.1 * h / 2 / (1 - h / 2));
  EXPECT_LT(worst[2], 1.1 * h * h / 4);
  EXPECT_NEAR(last[3], -steps * std::pow(h, 6) / 72, 0.1 * steps * std::pow(h, 6) / 72);
}

TEST(IntegratorTest, VerletRunsBackToItsStart) {
  Flight<double> f{Vec2(1, 0.5), Vec2(0, 0.2)};
  const auto spring = [](const Vec2& x, const Vec2&) { return Vec2(-x); };
  for (int k = 0; k < 10000; ++k) f = advance<double>(Integrator::kVerlet, f, 0.1, spring);
  f.v = -f.v;
  for (int k = 0; k < 10000; ++k) f = advance<double>(Integrator::kVerlet, f, 0.1, spring);
  EXPECT_LT((f.x - Vec2(1, 0.5)).norm(), 1e-11);
}

// The world's fields do what the formulae say: a circular orbit stays circular under Runge-Kutta.
TEST(ForceFieldTest, AttractorHoldsACircularOrbit) {
  WorldSettings settings = flight_settings(Integrator::kRungeKutta4);
  settings.gravity = {0, 0};
  settings.fields.push_back(PointAttractor{{0, 0}, 100, 0});
  auto world = make_world(settings);
  BodyDef def = ball_body(10, 0, 0.1);
  def.velocity = {0, std::sqrt(100.0 / 10)};
  const BodyId id = add(*world, def);
  const double energy = world->energy().kinetic + world->energy().potential;
  step_for(*world, 60);
  EXPECT_NEAR(world->body(id)->position.norm(), 10, 1e-6);
  EXPECT_NEAR(world->energy().kinetic + world->energy().potential, energy, 1e-9 * std::abs(energy));
}

TEST(ForceFieldTest, TheCentreOfAnAttractorIsNoHole) {
  for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
    WorldSettings settings = settings_for(precision);
    settings.gravity = {0, 0};
    settings.fields.push_back(PointAttractor{{0, 0}, 40, 0});
    auto world = make_world(settings);
    for (int i = 0; i < 3; ++i) add(*world, box_body(1e-12 * i, 1e-20, 0.01, 0.01));
    step_for(*world, 2);
    EXPECT_TRUE(std::isfinite(world->energy().kinetic));
  }
}

TEST(ForceFieldTest, DragSlowsByItsLaw) {
  WorldSettings settings = flight_settings(Integrator::kRungeKutta4);
  settings.gravity = {0, 0};
  settings.fields.push_back(Drag{0.5, 0});
  auto world = make_world(settings);
  BodyDef def = box_body(0, 0);  // 1 kg
  def.velocity = {8, 0};
  const BodyId id = add(*world, def);
  step_for(*world, 2);
  EXPECT_NEAR(world->body(id)->velocity.x(), 8 * std::exp(-1.0), 1e-6);
}

TEST(ForceFieldTest, SpringSwingsWithItsPeriod) {
  WorldSettings settings = flight_settings(Integrator::kVerlet);
  settings.gravity = {0, 0};
  settings.fields.push_back(Spring{{0, 0}, 39.47841760435743, 0});  // k/m = (2π)²: one second
  auto world = make_world(settings);
  const BodyId id = add(*world, box_body(1, 0));
  step_for(*world, 1);
  EXPECT_NEAR(world->body(id)->position.x(), 1, 1e-3);
  step_for(*world, 0.5);
  EXPECT_NEAR(world->body(id)->position.x(), -1, 1e-2);
}

// The thesis moved first and accelerated then, which is the explicit method, though it chose the semi-implicit one.
TEST(IntegratorTest, SemiImplicitAcceleratesFirst) {
  const auto fall = [](const Vec2&, const Vec2&) { return Vec2(0, -10); };
  const Flight<double> f = advance<double>(Integrator::kSemiImplicitEuler, {Vec2(0, 0), Vec2(0, 0)}, 0.1, fall);
  EXPECT_DOUBLE_EQ(f.x.y(), -0.1);
  const Flight<double> g = advance<double>(Integrator::kExplicitEuler, {Vec2(0, 0), Vec2(0, 0)}, 0.1, fall);
  EXPECT_DOUBLE_EQ(g.x.y(), 0);
}

}  // namespace
}  // namespace urto

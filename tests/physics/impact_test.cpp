#include "physics/impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace urto {
namespace {

using V = Vec<double>;

double energy(const Twist<double>& t) { return 0.5 * (dot<double>(t.v, t.v) / t.inv_mass + t.w * t.w / t.inv_inertia); }

struct Impacts : ::testing::TestWithParam<unsigned> {
  std::mt19937 random{GetParam()};
  double between(double low, double high) { return low + (high - low) * (random() / 4294967296.0); }
  Twist<double> body() { return {V(between(-5, 5), between(-5, 5)), between(-5, 5), between(0.2, 5), between(0.2, 5)}; }
  Touch<double> one_point() {
    const double angle = between(-3, 3);
    Touch<double> touch;
    touch.normal = V(std::cos(angle), std::sin(angle));
    touch.count = 1;
    touch.arms_a[0] = V(between(-1, 1), between(-1, 1));
    touch.arms_b[0] = V(between(-1, 1), between(-1, 1));
    return touch;
  }
};
INSTANTIATE_TEST_SUITE_P(Seeds, Impacts, ::testing::Range(1u, 65u));

// Newton: the point leaves at e times the speed at which it came. Without friction the loss is
// (1 − e²)·v²/2k, k the inverse mass along the normal.
TEST_P(Impacts, FollowNewtonAndLoseWhatTheyShould) {
  const Touch<double> touch = one_point();
  Twist<double> a = body(), b = body();
  const double e = between(0, 1), v = normal_velocity(touch, a, b), before = energy(a) + energy(b);
  const V momentum = a.v / a.inv_mass + b.v / b.inv_mass;
  const double closing = collide_at(touch, e, 0.0, a, b);
  EXPECT_DOUBLE_EQ(closing, std::max(0.0, -v));
  EXPECT_NEAR(normal_velocity(touch, a, b), v < 0 ? -e * v : v, 1e-12) << "seed " << GetParam();
  const double la = cross<double>(touch.arms_a[0], touch.normal), lb = cross<double>(touch.arms_b[0], touch.normal);
  const double k = a.inv_mass + b.inv_mass + a.inv_inertia * la * la + b.inv_inertia * lb * lb;
  EXPECT_NEAR(before - energy(a) - energy(b), v < 0 ? (1 - e * e) * v * v / (2 * k) : 0, 1e-10);
  EXPECT_NEAR((a.v / a.inv_mass + b.v / b.inv_mass - momentum).norm(), 0, 1e-12);
}

// Coulomb: the impulse lies within the cone.
TEST_P(Impacts, StayInTheConeOfFriction) {
  const Touch<double> touch = one_point();
  Twist<double> a = body(), b = body();
  const double friction = between(0, 1);
  const V before = b.v;
  collide_at(touch, 0.0, friction, a, b);
  const V impulse = (b.v - before) / b.inv_mass;
  const double normal = dot<double>(impulse, touch.normal), tangential = cross<double>(touch.normal, impulse);
  EXPECT_GE(normal, -1e-12);
  EXPECT_LE(std::abs(tangential), friction * normal + 1e-9);
}

// Both ends of a face at once: an elastic plate that strikes flat comes back flat.
TEST(TwoPoints, StrikeTogether) {
  Touch<double> touch;
  touch.normal = V(1, 0);
  touch.count = 2;
  touch.arms_a[0] = V(0.5, 1);
  touch.arms_a[1] = V(0.5, -1);
  touch.arms_b[0] = V(-0.1, 1);
  touch.arms_b[1] = V(-0.1, -1);
  Twist<double> a{V(10, 0), 0, 1, 3}, wall;
  collide_at(touch, 0.8, 0.5, a, wall);
  EXPECT_NEAR(a.v.x(), -8, 1e-6);
  EXPECT_NEAR(a.w, 0, 1e-6);
}

}  // namespace
}  // namespace urto

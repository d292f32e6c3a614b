#include "physics/narrow_phase/time_of_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "physics/convex_shapes.h"
#include "physics/narrow_phase/gjk.h"

namespace urto {
namespace {

using testing_shapes::box;
using testing_shapes::cast_to;
using testing_shapes::circle;
using testing_shapes::random_shape;

constexpr double kStep = 1.0 / 60;  // s

Sweep<double> sweep_of(const Vec2& from, const Vec2& to, double angle, double turn) {
  Sweep<double> sweep;
  sweep.c0 = from;
  sweep.c1 = to;
  sweep.angle0 = angle;
  sweep.angle1 = angle + turn;
  return sweep;
}

template <class To, class From>
Sweep<To> cast_sweep(const Sweep<From>& sweep) {
  Sweep<To> out;
  out.local_center = sweep.local_center.template cast<To>();
  out.c0 = sweep.c0.template cast<To>();
  out.c1 = sweep.c1.template cast<To>();
  out.angle0 = static_cast<To>(sweep.angle0);
  out.angle1 = static_cast<To>(sweep.angle1);
  return out;
}

struct Shot {
  Convex<double> a, b;
  Sweep<double> sweep_a, sweep_b;
  double target = 1e-3, tolerance = 2.5e-4;  // m

  double distance_at(double t) const {
    return gjk_distance(a, b, sweep_a.pose(t).inverse_times(sweep_b.pose(t))).separation;
  }
  // As a world in S sees it: its rounded input, back in double.
  template <class S>
  Shot rounded() const {
    return {cast_to<double>(cast_to<S>(a)),
            cast_to<double>(cast_to<S>(b)),
            cast_sweep<double>(cast_sweep<S>(sweep_a)),
            cast_sweep<double>(cast_sweep<S>(sweep_b)),
            target,
            tolerance};
  }
  template <class S>
  Impact<S> impact() const {
    return time_of_impact(cast_to<S>(a), cast_sweep<S>(sweep_a), cast_to<S>(b), cast_sweep<S>(sweep_b),
                          static_cast<S>(target), static_cast<S>(tolerance));
  }
};

double reach_of(const Convex<double>& shape, const Sweep<double>& sweep) {
  double reach = 0;
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    reach = std::max(reach, (shape.vertices[i] - sweep.local_center).norm());
  }
  return reach;
}

// The plain method, in double: no point moves faster than the centres and the furthest corners do, so the distance may
// be walked off at that speed. Slow, but nothing in it can miss. level: the distance to reach.
struct Reference {
  double time = 1;
  bool reached = false, known = true;
};

Reference walk(const Shot& shot, double level) {
  const Vec2 motion = (shot.sweep_b.c1 - shot.sweep_b.c0) - (shot.sweep_a.c1 - shot.sweep_a.c0);
  const double speed = motion.norm() +
                       std::abs(shot.sweep_a.angle1 - shot.sweep_a.angle0) * reach_of(shot.a, shot.sweep_a) +
                       std::abs(shot.sweep_b.angle1 - shot.sweep_b.angle0) * reach_of(shot.b, shot.sweep_b);
  constexpr double kStepMin = 1e-7;  // of the time: at most 1e-7 · 25 m can be stepped over
  double t = 0;
  for (int k = 0; k < 20000; ++k) {
    const double room = shot.distance_at(t) - level;
    if (room < 0) return {t, true, true};
    if (t >= 1) return {1, false, true};
    t = std::min(1.0, t + std::max(kStepMin, speed > 0 ? room / speed : 1.0));
  }
  return {t, false, false};
}

struct Tally {
  int hits = 0, separated = 0, overlapped = 0, failed = 0, unknown = 0;
};

template <class S>
void expect_right(const Shot& shot64, Tally& tally) {
  const Shot shot = shot64.rounded<S>();
  const Impact<S> impact = shot64.impact<S>();
  // Coordinates reach 25 m: 16 roundings of that; and the step of the reference.
  const double slack = 25 * 16 * static_cast<double>(std::numeric_limits<S>::epsilon()) + 3e-6;
  const double begin = shot.distance_at(0);
  if (impact.kind == ImpactKind::kOverlapped) {
    ++tally.overlapped;
    EXPECT_LT(begin, shot.target + slack);
    EXPECT_EQ(impact.time, S(0));
    return;
  }
  EXPECT_GT(begin, shot.target - slack);
  EXPECT_LE(impact.iterations, 32);  // half of the bound
  // Never later than the truth: the reference has not come nearer than the target before.
  const Reference truth = walk(shot, shot.target - slack);
  if (!truth.known) {
    ++tally.unknown;
    return;
  }
  switch (impact.kind) {
    case ImpactKind::kSeparated:
      ++tally.separated;
      EXPECT_FALSE(truth.reached) << "missed at " << truth.time;
      break;
    case ImpactKind::kFailed:
      ++tally.failed;
      EXPECT_LE(impact.time, truth.time);
      break;
    default:
      ++tally.hits;
      EXPECT_LE(impact.time, truth.time);
      EXPECT_LE(shot.distance_at(impact.time), shot.target + shot.tolerance + slack);
  }
}

template <class S>
class TimeOfImpactTest : public testing::Test {
 public:
  template <class Draw>
  Tally shoot(std::uint64_t count, Draw draw) {
    Tally tally;
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      std::mt19937_64 random(seed);
      expect_right<S>(draw(random), tally);
      if (this->HasFailure()) break;
    }
    // Grazing shots that the slow reference does not settle are few.
    EXPECT_LE(tally.unknown, static_cast<int>(count / 500));
    EXPECT_EQ(tally.failed, 0);
    RecordProperty("hits", tally.hits);
    return tally;
  }
  using testing::Test::RecordProperty;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TimeOfImpactTest, Scalars);

double draw_between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec2 draw_vector(std::mt19937_64& random, double size) {
  const double angle = draw_between(random, 0, 6.283185307179586);
  return size * Vec2(std::cos(angle), std::sin(angle));
}

TYPED_TEST(TimeOfImpactTest, BallOnAWallInClosedForm) {
  using S = TypeParam;
  Shot shot{box(0.1, 10), circle(0.25), sweep_of({0, 0}, {0, 0}, 0, 0), sweep_of({-5, 1}, {5, 1}, 0, 0)};
  const Impact<S> impact = shot.impact<S>();
  ASSERT_EQ(impact.kind, ImpactKind::kHit);
  // Touches at x = −0.05 − 0.25 − target, 10 m a step.
  const double exact = (5 - 0.3 - shot.target) / 10;
  EXPECT_LE(impact.time, exact);
  EXPECT_GE(impact.time, exact - shot.tolerance / 10);
}

TYPED_TEST(TimeOfImpactTest, SpinningRodReachesTheWallInClosedForm) {
  using S = TypeParam;
  // A rod of half length 1 turns from flat; its tip meets a wall 0.5 below: sin θ = 0.5 − target.
  Shot shot{box(10, 1), testing_shapes::capsule({-1, 0}, {1, 0}, 0), sweep_of({0, -1}, {0, -1}, 0, 0),
            sweep_of({0, 0}, {0, 0}, 0, 3)};
  const Impact<S> impact = shot.impact<S>();
  ASSERT_EQ(impact.kind, ImpactKind::kHit);
  const double exact = std::asin(0.5 - shot.target) / 3;
  EXPECT_LE(impact.time, exact);
  EXPECT_GE(impact.time, std::asin(0.5 - shot.target - shot.tolerance) / 3 - 1e-6);
}

TYPED_TEST(TimeOfImpactTest, KindsAtTheStart) {
  using S = TypeParam;
  Shot shot{box(1, 1), box(1, 1), sweep_of({0, 0}, {0, 0}, 0, 0), sweep_of({0.9, 0}, {5, 0}, 0, 0)};
  EXPECT_EQ(shot.impact<S>().kind, ImpactKind::kOverlapped);
  EXPECT_EQ(shot.impact<S>().time, S(0));
  shot.sweep_b = sweep_of({1 + 1.1 * shot.target, 0}, {5, 0}, 0, 0);  // within the tolerance, but leaving
  EXPECT_EQ(shot.impact<S>().kind, ImpactKind::kSeparated);
  shot.sweep_b = sweep_of({1 + 1.1 * shot.target, 0}, {1 + 1.1 * shot.target, 3}, 0, 0);  // sliding along
  EXPECT_EQ(shot.impact<S>().kind, ImpactKind::kSeparated);
  shot.sweep_b = sweep_of({1 + 1.1 * shot.target, 0}, {0, 0}, 0, 0);
  EXPECT_EQ(shot.impact<S>().kind, ImpactKind::kHit);
  shot.sweep_b = sweep_of({2, 0}, {2, 0}, 0, 0);  // at rest
  EXPECT_EQ(shot.impact<S>().kind, ImpactKind::kSeparated);
}

// Plates of 1 mm at up to 1000 m/s, spinning or not, against walls and each other, aimed to meet.
TYPED_TEST(TimeOfImpactTest, ThinFastPlatesNeverPass) {
  const Tally tally = this->shoot(100000, [](std::mt19937_64& random) {
    const double speed = std::pow(10, draw_between(random, 1, 3)), spin = draw_between(random, 0, 1) < 0.3 ? 0 : 500;
    Shot shot;
    shot.a = box(1e-3, draw_between(random, 0.5, 2));
    shot.b = box(1e-3, draw_between(random, 0.1, 1));
    const Vec2 path = draw_vector(random, speed * kStep), beside = draw_vector(random, draw_between(random, 0, 1));
    const double place = draw_between(random, 0.05, 0.95);
    shot.sweep_a = sweep_of({0, 0}, {0, 0}, draw_between(random, -3, 3), 0);
    if (draw_between(random, 0, 1) < 0.5) shot.sweep_a.angle1 += spin * kStep * draw_between(random, -1, 1);
    shot.sweep_b = sweep_of(beside - place * path, beside + (1 - place) * path, draw_between(random, -3, 3),
                            spin * kStep * draw_between(random, -1, 1));
    return shot;
  });
  EXPECT_GT(tally.hits, 30000);
  EXPECT_GT(tally.separated, 10000);
}

// Every kind of shape, off-centre masses, slow and fast, near misses.
TYPED_TEST(TimeOfImpactTest, RandomShots) {
  const Tally tally = this->shoot(50000, [](std::mt19937_64& random) {
    Shot shot;
    shot.a = random_shape(random, draw_between(random, 0.1, 1));
    shot.b = random_shape(random, draw_between(random, 0.1, 1));
    for (Sweep<double>* sweep : {&shot.sweep_a, &shot.sweep_b}) {
      const double size = draw_between(random, 1, 3), far = draw_between(random, 0, 8);
      const Vec2 from = draw_vector(random, size);
      *sweep =
          sweep_of(from, from + draw_vector(random, far), draw_between(random, -3, 3), draw_between(random, -8, 8));
      sweep->local_center = draw_vector(random, draw_between(random, 0, 0.5));
      if (draw_between(random, 0, 1) < 0.3) sweep->angle1 = sweep->angle0;
    }
    return shot;
  });
  EXPECT_GT(tally.hits, 4000);
  EXPECT_GT(tally.separated, 7000);
  EXPECT_GT(tally.overlapped, 300);
}

// Resting and sliding contacts: a pair that starts near its target.
TYPED_TEST(TimeOfImpactTest, SlowShotsFromCloseBy) {
  const Tally tally = this->shoot(10000, [](std::mt19937_64& random) {
    Shot shot;
    shot.a = box(4, 1);
    shot.b = box(1, 1);
    shot.sweep_a = sweep_of({0, 0}, {0, 0}, 0, 0);
    const Vec2 from(draw_between(random, -3, 3), 1 + shot.target * draw_between(random, 1, 2));
    shot.sweep_b = sweep_of(from, from + Vec2(draw_between(random, -1, 1), draw_between(random, -0.01, 0.01)), 0,
                            draw_between(random, -0.02, 0.02));
    return shot;
  });
  EXPECT_GT(tally.hits, 1000);
  EXPECT_GT(tally.separated, 1000);
}

TYPED_TEST(TimeOfImpactTest, FarFromTheOriginTheDifferenceOfTheCentresCounts) {
  using S = TypeParam;
  Shot shot{box(0.1, 10), circle(0.25), sweep_of({0, 0}, {0, 0}, 0, 0), sweep_of({-5, 1}, {5, 1}, 0, 0)};
  const Impact<S> near = shot.impact<S>();
  for (Sweep<double>* sweep : {&shot.sweep_a, &shot.sweep_b}) {
    sweep->c0 += Vec2(65536, -65536);
    sweep->c1 += Vec2(65536, -65536);
  }
  const Impact<S> far = shot.impact<S>();
  EXPECT_EQ(near.kind, far.kind);
  EXPECT_EQ(near.time, far.time);
}

TYPED_TEST(TimeOfImpactTest, MirroredShotsTakeTheSameTime) {
  using S = TypeParam;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    Shot shot{random_shape(random, 0.5), random_shape(random, 0.5),
              sweep_of({0, 0}, draw_vector(random, 1), 0.3, draw_between(random, -4, 4)),
              sweep_of({3, 1}, draw_vector(random, 1), 0.1, draw_between(random, -4, 4))};
    Shot other = shot;
    other.a = testing_shapes::mirror(shot.a);
    other.b = testing_shapes::mirror(shot.b);
    for (Sweep<double>* sweep : {&other.sweep_a, &other.sweep_b}) {
      sweep->c0.x() = -sweep->c0.x();
      sweep->c1.x() = -sweep->c1.x();
      sweep->angle0 = -sweep->angle0;
      sweep->angle1 = -sweep->angle1;
    }
    const Impact<S> one = shot.impact<S>(), two = other.impact<S>();
    EXPECT_EQ(one.kind, two.kind);
    EXPECT_NEAR(one.time, two.time, 1e-3);
  }
}

}  // namespace
}  // namespace urto

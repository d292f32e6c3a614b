#include "physics/narrow_phase/ray_cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "physics/convex_shapes.h"

namespace urto {
namespace {

using testing_shapes::box;
using testing_shapes::capsule;
using testing_shapes::cast_to;
using testing_shapes::circle;
using testing_shapes::random_shape;

// Signed distance of a point from a shape, in double and by another way than the code under test: over segments, with
// the sign of the half-planes.
double signed_distance(const Convex<double>& shape, const Vec2& p) {
  double best = std::numeric_limits<double>::infinity();
  bool inside = shape.count > 2;
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    const Vec2 a = shape.vertices[i], edge = shape.vertices[(i + 1) % shape.count] - a;
    const double size = edge.squaredNorm();
    const double t = size > 0 ? std::clamp((p - a).dot(edge) / size, 0.0, 1.0) : 0.0;
    best = std::min(best, (p - a - t * edge).norm());
    inside = inside && shape.normals[i].dot(p - a) <= 0;
  }
  return (inside ? -best : best) - shape.radius;
}

template <class S>
class RayCastTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RayCastTest, Scalars);

TYPED_TEST(RayCastTest, BoxFromEachSide) {
  using S = TypeParam;
  const auto shape = cast_to<S>(box(4, 2));
  const Vec<S> starts[] = {Vec<S>(-4, 0), Vec<S>(4, 0), Vec<S>(0, -4), Vec<S>(0, 4)};
  const S fractions[] = {S(0.25), S(0.25), S(0.375), S(0.375)};
  for (int i = 0; i < 4; ++i) {
    const auto hit = ray_cast(shape, starts[i], Vec<S>(-2 * starts[i]));
    ASSERT_TRUE(hit.hit);
    EXPECT_EQ(hit.fraction, fractions[i]);
    EXPECT_EQ(hit.normal, Vec<S>(starts[i] / S(4)));
  }
}

TYPED_TEST(RayCastTest, MissesBesideBehindAndShortOf) {
  using S = TypeParam;
  for (const auto& shape64 : {box(2, 2), box(1, 1, 0.5), circle(1), capsule({-0.5, 0}, {0.5, 0}, 0.5)}) {
    const auto shape = cast_to<S>(shape64);
    EXPECT_FALSE(ray_cast(shape, Vec<S>(-3, S(1.01)), Vec<S>(6, 0)).hit);
    EXPECT_FALSE(ray_cast(shape, Vec<S>(-3, 0), Vec<S>(-6, 0)).hit);
    EXPECT_FALSE(ray_cast(shape, Vec<S>(-3, 0), Vec<S>(S(1.99), 0)).hit);
    EXPECT_TRUE(ray_cast(shape, Vec<S>(-3, 0), Vec<S>(S(2.01), 0)).hit);
    EXPECT_FALSE(ray_cast(shape, Vec<S>(-3, 0), Vec<S>(0, 0)).hit);
  }
}

TYPED_TEST(RayCastTest, StartInsideIsAHitAtZeroWithoutNormal) {
  using S = TypeParam;
  for (const auto& shape64 : {box(2, 2), box(1, 1, 0.5), circle(1), capsule({-0.5, 0}, {0.5, 0}, 0.5)}) {
    const auto hit = ray_cast(cast_to<S>(shape64), Vec<S>(S(0.1), S(0.2)), Vec<S>(5, 1));
    EXPECT_TRUE(hit.hit);
    EXPECT_EQ(hit.fraction, S(0));
    EXPECT_EQ(hit.normal, Vec<S>(0, 0));
  }
}

TYPED_TEST(RayCastTest, CircleInClosedForm) {
  using S = TypeParam;
  const auto hit = ray_cast(cast_to<S>(circle(5, {1, 2})), Vec<S>(-9, 5), Vec<S>(20, 0));
  ASSERT_TRUE(hit.hit);  // enters at (−3, 5): 3-4-5
  EXPECT_NEAR(hit.fraction, S(0.3), 4 * std::numeric_limits<S>::epsilon());
  EXPECT_NEAR(hit.normal.x(), S(-0.8), 4 * std::numeric_limits<S>::epsilon());
  EXPECT_NEAR(hit.normal.y(), S(0.6), 4 * std::numeric_limits<S>::epsilon());
}

TYPED_TEST(RayCastTest, ThinCapsuleIsHitEndOn) {
  using S = TypeParam;
  const auto segment = cast_to<S>(capsule({0, 0}, {2, 0}, 0));
  const auto end_on = ray_cast(segment, Vec<S>(-1, 0), Vec<S>(2, 0));
  ASSERT_TRUE(end_on.hit);
  EXPECT_EQ(end_on.fraction, S(0.5));
  EXPECT_EQ(end_on.normal, Vec<S>(-1, 0));
  const auto across = ray_cast(segment, Vec<S>(1, 1), Vec<S>(0, -4));
  ASSERT_TRUE(across.hit);
  EXPECT_EQ(across.fraction, S(0.25));
  EXPECT_EQ(across.normal, Vec<S>(0, 1));
}

// Random rays from random distances. The point of entry is on the outline, the segment before it is outside, the normal
// is the gradient of the distance; a reported miss stays outside all along.
TYPED_TEST(RayCastTest, RandomRaysEnterAtTheOutline) {
  using S = TypeParam;
  // Coordinates reach about 8 m: a handful of roundings of that, as a distance.
  const double tolerance = 8 * 16 * static_cast<double>(std::numeric_limits<S>::epsilon());
  int hits = 0, misses = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(-4, 4);
    const Convex<double> shape64 = random_shape(random, 1);
    const Convex<S> shape = cast_to<S>(shape64);
    const Vec<S> origin(static_cast<S>(coordinate(random)), static_cast<S>(coordinate(random)));
    // Towards the shape, more or less, and past it.
    const Vec<S> noise(static_cast<S>(0.5 * coordinate(random)), static_cast<S>(0.5 * coordinate(random)));
    const Vec<S> translation = noise - S(2) * origin;
    const Vec2 o = origin.template cast<double>(), d = translation.template cast<double>();
    const auto hit = ray_cast(shape, origin, translation);
    const double end = hit.hit ? hit.fraction : 1;
    if (hit.hit && hit.fraction == S(0)) {
      EXPECT_LE(signed_distance(shape64, o), tolerance);
      continue;
    }
    for (int k = 0; k < 64; ++k) EXPECT_GE(signed_distance(shape64, o + end * k / 64 * d), -tolerance);
    if (!hit.hit) {
      ++misses;
      continue;
    }
    ++hits;
    const Vec2 entry = o + end * d, normal = hit.normal.template cast<double>();
    // A grazing entry moves along the ray by more than across it: bound it by the slope.
    const double slope = -normal.dot(d) / d.norm();
    EXPECT_GT(slope, 0);
    EXPECT_NEAR(signed_distance(shape64, entry), 0, tolerance);
    EXPECT_NEAR(normal.norm(), 1, 4 * static_cast<double>(std::numeric_limits<S>::epsilon()));
    EXPECT_GE(signed_distance(shape64, entry + 1e-3 * normal), 1e-3 - 2 * tolerance);
    if (this->HasFailure()) return;
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
}

TYPED_TEST(RayCastTest, ContainsPointAgreesWithTheSignedDistance) {
  using S = TypeParam;
  const double tolerance = 8 * 8 * static_cast<double>(std::numeric_limits<S>::epsilon());
  int in = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(-2, 2);
    const Convex<double> shape = random_shape(random, 1);
    for (int k = 0; k < 10; ++k) {
      const Vec<S> p(static_cast<S>(coordinate(random)), static_cast<S>(coordinate(random)));
      const double distance = signed_distance(shape, p.template cast<double>());
      if (std::abs(distance) <= tolerance) continue;
      EXPECT_EQ(contains_point(cast_to<S>(shape), p), distance < 0) << "seed " << seed;
      in += distance < 0;
    }
  }
  EXPECT_GT(in, 1000);
}

TYPED_TEST(RayCastTest, OutlineBelongsToTheShape) {
  using S = TypeParam;
  EXPECT_TRUE(contains_point(cast_to<S>(box(2, 2)), Vec<S>(1, 1)));
  EXPECT_TRUE(contains_point(cast_to<S>(box(2, 2)), Vec<S>(0, -1)));
  EXPECT_TRUE(contains_point(cast_to<S>(circle(5)), Vec<S>(3, 4)));
  EXPECT_TRUE(contains_point(cast_to<S>(capsule({0, 0}, {1, 0}, 0.5)), Vec<S>(S(0.5), S(0.5))));
  EXPECT_FALSE(contains_point(cast_to<S>(capsule({0, 0}, {1, 0}, 0.5)), Vec<S>(S(0.5), S(0.5001))));
}

}  // namespace
}  // namespace urto

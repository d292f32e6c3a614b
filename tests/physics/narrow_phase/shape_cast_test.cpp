#include "physics/narrow_phase/shape_cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "physics/brute_force.h"
#include "physics/convex_shapes.h"
#include "physics/narrow_phase/ray_cast.h"

namespace urto {
namespace {

using testing_shapes::box;
using testing_shapes::brute_force;
using testing_shapes::capsule;
using testing_shapes::cast_pose;
using testing_shapes::cast_to;
using testing_shapes::circle;
using testing_shapes::pose_of;
using testing_shapes::random_shape;

constexpr int kSamples = 500;

Transform<double> moved(Transform<double> pose, const Vec2& translation, double t) {
  pose.p += t * translation;
  return pose;
}

struct Sampled {
  bool hit = false;
  double fraction = 1, least = std::numeric_limits<double>::infinity();  // m, of the separation
};

// Dense sampling and bisection on the separation that comparing everything with everything finds. It is a convex
// function of the fraction, so its least value lies next to the least sample.
Sampled sample(const Convex<double>& a, const Convex<double>& b, const Transform<double>& pose, const Vec2& way) {
  const auto separation = [&](double t) { return brute_force(a, b, moved(pose, way, t)); };
  Sampled out;
  double at_least = 0;
  for (int i = 0; i <= kSamples && out.least > 0; ++i) {
    const double t = double(i) / kSamples, value = separation(t);
    if (value < out.least) {
      out.least = value;
      at_least = t;
    }
  }
  double low = std::max(0.0, at_least - 1.0 / kSamples), high = std::min(1.0, at_least + 1.0 / kSamples);
  for (int i = 0; i < 60 && out.least > 0; ++i) {
    const double t1 = low + (high - low) / 3, t2 = high - (high - low) / 3;
    const double v1 = separation(t1), v2 = separation(t2);
    (v1 < v2 ? high : low) = v1 < v2 ? t2 : t1;
    if (std::min(v1, v2) < out.least) {
      out.least = std::min(v1, v2);
      at_least = v1 < v2 ? t1 : t2;
    }
  }
  if (out.least > 0) return out;
  out.hit = true;
  double outside = 0, inside = at_least;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (outside + inside);
    (separation(middle) > 0 ? outside : inside) = middle;
  }
  out.fraction = inside;
  return out;
}

template <class S>
class ShapeCastTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ShapeCastTest, Scalars);

TYPED_TEST(ShapeCastTest, ADiscMeetsABoxADiscAndACapsuleInClosedForm) {
  using S = TypeParam;
  const S tolerance = 8 * std::numeric_limits<S>::epsilon();
  const auto disc = cast_to<S>(circle(1));
  const auto at = cast_pose<S>(pose_of(-10, 0, 0));
  for (const auto& shape64 : {box(4, 2), circle(2), capsule({0, -3}, {0, 3}, 2), box(2, 2, 1)}) {
    const auto cast = shape_cast(cast_to<S>(shape64), disc, at, Vec<S>(20, 0));
    ASSERT_TRUE(cast.hit);
    EXPECT_FALSE(cast.overlapping);
    EXPECT_NEAR(cast.fraction, 0.35, tolerance);  // 7 m of 20 m
    EXPECT_NEAR(cast.normal.x(), -1, tolerance);
    EXPECT_NEAR(cast.point.x(), -2, 16 * tolerance);
  }
  // Past the corner of a box at (−2, 1), 0.6 m above it: the disc touches when its centre is 0.8 m before the corner.
  const auto corner = shape_cast(cast_to<S>(box(4, 2)), disc, cast_pose<S>(pose_of(-10, 1.6, 0)), Vec<S>(20, 0));
  ASSERT_TRUE(corner.hit);
  EXPECT_NEAR(corner.fraction, 7.2 / 20, tolerance);
  EXPECT_NEAR(corner.normal.x(), -0.8, 16 * tolerance);
  EXPECT_NEAR(corner.normal.y(), 0.6, 16 * tolerance);
}

TYPED_TEST(ShapeCastTest, MissesBesideBehindAndShortOf) {
  using S = TypeParam;
  const auto disc = cast_to<S>(circle(1));
  for (const auto& shape64 : {box(2, 2), circle(1), capsule({-0.5, 0}, {0.5, 0}, 1)}) {
    const auto shape = cast_to<S>(shape64);
    const auto cast = [&](double x, double y, double way) {
      return shape_cast(shape, disc, cast_pose<S>(pose_of(x, y, 0)), Vec<S>(S(way), 0)).hit;
    };
    EXPECT_FALSE(cast(-5, 2.001, 10));
    EXPECT_TRUE(cast(-5, 1.99, 10));
    EXPECT_FALSE(cast(-5, 0, -10));
    EXPECT_FALSE(cast(-5, 0, 2.49));
    EXPECT_TRUE(cast(-5, 0, 3.01));
    EXPECT_FALSE(cast(-5, 0, 0));
  }
}

TYPED_TEST(ShapeCastTest, WhatTouchesAtTheStartIsHitAtOnceWithoutANormalWhereverItGoes) {
  using S = TypeParam;
  for (const double x : {0.0, 1.0, 2.0}) {
    for (const double way : {-5.0, 0.0, 5.0}) {
      const auto cast =
          shape_cast(cast_to<S>(box(2, 2)), cast_to<S>(box(2, 2)), cast_pose<S>(pose_of(x, 0.5, 0)), Vec<S>(S(way), 0));
      EXPECT_TRUE(cast.hit && cast.overlapping);
      EXPECT_EQ(cast.fraction, S(0));
      EXPECT_EQ(cast.normal, Vec<S>(0, 0));
      EXPECT_LE(std::abs(cast.point.x()), 1);
    }
  }
}

TYPED_TEST(ShapeCastTest, APointIsARay) {
  using S = TypeParam;
  Convex<S> point;
  point.count = 1;
  int hits = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> spread(-4, 4);
    const auto shape = cast_to<S>(random_shape(random, 2));
    const Vec<S> origin(S(spread(random)), S(spread(random))), way(S(spread(random)), S(spread(random)));
    const auto ray = ray_cast(shape, origin, way);
    const auto cast = shape_cast(shape, point, Transform<S>{origin, {}}, way);
    ASSERT_EQ(cast.hit, ray.hit);
    // 16 roundings at coordinates of up to 12 m, twice; along a way that slants more than across the surface.
    const S slant = max_of<S>(S(0.01), -dot<S>(ray.normal, way));
    EXPECT_NEAR(cast.fraction * ray.hit, ray.fraction, 2 * 16 * 12 * std::numeric_limits<S>::epsilon() / slant);
    hits += ray.hit;
  }
  EXPECT_GT(hits, 400);
}

TYPED_TEST(ShapeCastTest, AgreesWithDenseSampling) {
  using S = TypeParam;
  int hits = 0, misses = 0, grazing = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> spread(-5, 5);
    const auto a = cast_to<S>(random_shape(random, 1.5)), b = cast_to<S>(random_shape(random, 1.5));
    const auto pose = cast_pose<S>(pose_of(spread(random), spread(random), spread(random)));
    const Vec<S> way(S(2 * spread(random)), S(2 * spread(random)));
    const auto cast = shape_cast(a, b, pose, way);
    const auto a64 = cast_to<double>(a), b64 = cast_to<double>(b);
    const auto pose64 = cast_pose<double>(pose);
    const Vec2 way64 = way.template cast<double>();
    // m: 16 roundings at coordinates of up to 20 m, twice.
    const double rounding = 2 * 16 * 20 * double(std::numeric_limits<S>::epsilon());
    const Sampled sampled = sample(a64, b64, pose64, way64);
    EXPECT_LE(cast.iterations, 40);
    if (std::abs(sampled.least) < rounding) {
      ++grazing;
      continue;
    }
    ASSERT_EQ(cast.hit, sampled.hit);
    if (!cast.hit) {
      ++misses;
      continue;
    }
    ++hits;
    const double separation = brute_force(a64, b64, moved(pose64, way64, double(cast.fraction)));
    if (cast.overlapping) {
      EXPECT_LE(separation, rounding);
      continue;
    }
    EXPECT_NEAR(separation, 0, rounding);
    const double closing = -dot<double>(cast.normal.template cast<double>(), way64);
    EXPECT_GT(closing, 0);
    // Second order near a graze: the error in time is the rounding over the closing speed.
    EXPECT_NEAR(double(cast.fraction), sampled.fraction, 2 * rounding / closing);
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
  EXPECT_LT(grazing, 30);
}

}  // namespace
}  // namespace urto

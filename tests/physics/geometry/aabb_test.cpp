#include "physics/geometry/aabb.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/convex_shapes.h"

namespace urto {
namespace {

template <class S>
class AabbTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(AabbTest, Scalars);

template <class S>
Aabb<S> of(double x0, double y0, double x1, double y1) {
  return {Vec<S>(static_cast<S>(x0), static_cast<S>(y0)), Vec<S>(static_cast<S>(x1), static_cast<S>(y1))};
}

// The thesis's formula lacks one of the four conditions; each of these four boxes fails exactly one.
TYPED_TEST(AabbTest, EachOfTheFourConditionsCounts) {
  using S = TypeParam;
  const auto middle = of<S>(0, 0, 1, 1);
  for (const auto& other : {of<S>(2, 0, 3, 1), of<S>(-3, 0, -2, 1), of<S>(0, 2, 1, 3), of<S>(0, -3, 1, -2)}) {
    EXPECT_FALSE(middle.overlaps(other));
    EXPECT_FALSE(other.overlaps(middle));
  }
}

TYPED_TEST(AabbTest, OverlapOnAGridIsOverlapOfBothProjections) {
  using S = TypeParam;
  const auto middle = of<S>(0, 0, 2, 2);
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      for (int w = 0; w <= 8; ++w) {
        for (int h = 0; h <= 8; ++h) {
          const auto other = of<S>(x, y, x + w, y + h);
          const bool expected = x <= 2 && x + w >= 0 && y <= 2 && y + h >= 0;
          EXPECT_EQ(middle.overlaps(other), expected);
          EXPECT_EQ(other.overlaps(middle), expected);
          EXPECT_EQ(middle.contains(other), x >= 0 && x + w <= 2 && y >= 0 && y + h <= 2);
        }
      }
    }
  }
}

TYPED_TEST(AabbTest, TouchingCountsAsOverlap) {
  using S = TypeParam;
  EXPECT_TRUE(of<S>(0, 0, 1, 1).overlaps(of<S>(1, 1, 2, 2)));
  EXPECT_TRUE(of<S>(0, 0, 1, 1).overlaps(of<S>(0.5, 0.5, 0.5, 0.5)));
  EXPECT_TRUE(of<S>(0, 0, 1, 1).contains(of<S>(0, 0, 1, 1)));
}

TYPED_TEST(AabbTest, MergedHoldsBothAndNothingMore) {
  using S = TypeParam;
  const auto merged = of<S>(0, 5, 1, 6).merged(of<S>(-2, 1, 0.5, 2));
  EXPECT_EQ(merged.lower, Vec<S>(-2, 1));
  EXPECT_EQ(merged.upper, Vec<S>(1, 6));
  EXPECT_EQ(merged.perimeter(), S(16));
  EXPECT_EQ(merged.center(), Vec<S>(S(-0.5), S(3.5)));
  EXPECT_EQ(merged.expanded(S(0.5)).lower, Vec<S>(S(-2.5), S(0.5)));
  EXPECT_EQ(merged.expanded(S(0.5)).upper, Vec<S>(S(1.5), S(6.5)));
}

TYPED_TEST(AabbTest, BoundsOfARotatedBoxInClosedForm) {
  using S = TypeParam;
  const auto shape = testing_shapes::cast_to<S>(testing_shapes::box(4, 2, 0.25));
  for (int k = 0; k < 60; ++k) {
    const double angle = 0.1 * k, c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
    const auto bounds = shape.bounds(testing_shapes::cast_pose<S>(testing_shapes::pose_of(10, -3, angle)));
    const double tolerance = 10 * 4 * static_cast<double>(std::numeric_limits<S>::epsilon());
    EXPECT_NEAR(bounds.upper.x(), 10 + 2 * c + s + 0.25, tolerance);
    EXPECT_NEAR(bounds.lower.x(), 10 - 2 * c - s - 0.25, tolerance);
    EXPECT_NEAR(bounds.upper.y(), -3 + 2 * s + c + 0.25, tolerance);
    EXPECT_NEAR(bounds.lower.y(), -3 - 2 * s - c - 0.25, tolerance);
  }
}

}  // namespace
}  // namespace urto

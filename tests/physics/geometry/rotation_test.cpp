#include "physics/geometry/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace urto {
namespace {

template <class S>
class RotationTest : public testing::Test {
 protected:
  // Of numbers up to 10 after a product and a sum.
  static constexpr S kTolerance = 10 * 4 * std::numeric_limits<S>::epsilon();

  static void expect_near(const Vec<S>& a, const Vec<S>& b) {
    EXPECT_NEAR(a.x(), b.x(), kTolerance);
    EXPECT_NEAR(a.y(), b.y(), kTolerance);
  }
  static Transform<S> frame(S x, S y, S angle) { return {Vec<S>(x, y), Rotation<S>::from_angle(angle)}; }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RotationTest, Scalars);

// The thesis's rotation returns the rotated offset minus the centre: (0, 1) − (3, 2) here.
TYPED_TEST(RotationTest, APlacedVertexIsTheCentrePlusTheRotatedOffset) {
  using S = TypeParam;
  const Transform<S> pose = this->frame(3, 2, S(1.5707963267948966));
  this->expect_near(pose.apply(Vec<S>(1, 0)), Vec<S>(3, 3));
  this->expect_near(pose.apply(Vec<S>(0, 1)), Vec<S>(2, 2));
  EXPECT_EQ(pose.apply(Vec<S>(0, 0)), Vec<S>(3, 2));
}

TYPED_TEST(RotationTest, CounterClockwiseIsPositive) {
  using S = TypeParam;
  this->expect_near(Rotation<S>::from_angle(S(0.5235987755982988)).apply(Vec<S>(2, 0)), Vec<S>(S(std::sqrt(3.0)), 1));
}

TYPED_TEST(RotationTest, InverseUndoesAndProductsCompose) {
  using S = TypeParam;
  for (int i = 0; i < 40; ++i) {
    const Transform<S> a = this->frame(S(1.5), -2, S(0.37) * S(i)), b = this->frame(-3, S(0.5), S(-0.71) * S(i));
    const Vec<S> v(S(0.25) * S(i) - 5, 3);
    this->expect_near(a.apply_inverse(a.apply(v)), v);
    this->expect_near(a.q.times(b.q).apply(v), a.q.apply(b.q.apply(v)));
    this->expect_near(a.q.inverse_times(b.q).apply(v), a.q.apply_inverse(b.q.apply(v)));
    // A point given in b, seen from a, is the same point of the world.
    this->expect_near(a.apply(a.inverse_times(b).apply(v)), b.apply(v));
  }
}

TYPED_TEST(RotationTest, CrossProductsFollowTheRightHand) {
  using S = TypeParam;
  const Vec<S> x(1, 0), y(0, 1);
  EXPECT_EQ(cross(x, y), S(1));
  EXPECT_EQ(cross(S(2), x), Vec<S>(0, 2));   // ω × v
  EXPECT_EQ(cross(x, S(2)), Vec<S>(0, -2));  // v × ω: the outward normal of a counter-clockwise edge along x
  EXPECT_EQ(dot(Vec<S>(3, 4), Vec<S>(3, 4)), S(25));
  EXPECT_EQ(length(Vec<S>(3, 4)), S(5));
}

TYPED_TEST(RotationTest, MinimumAndMaximumAreDefinedOnNaN) {
  using S = TypeParam;
  const S nan = std::numeric_limits<S>::quiet_NaN();
  EXPECT_EQ(min_of(S(1), nan), S(1));
  EXPECT_EQ(min_of(nan, S(1)), S(1));
  EXPECT_EQ(max_of(S(1), nan), S(1));
  EXPECT_EQ(max_of(nan, S(1)), S(1));
  EXPECT_FALSE(std::signbit(min_of(S(0), -S(0))));  // ties: the first
  EXPECT_EQ(clamp_to(S(3), S(0), S(2)), S(2));
  EXPECT_EQ(absolute(S(-3)), S(3));
}

}  // namespace
}  // namespace urto

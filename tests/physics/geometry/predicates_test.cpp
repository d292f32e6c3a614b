#include "physics/geometry/predicates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace urto {
namespace {

TEST(PredicatesTest, OrientationIsExactOneUlpBesideTheLine) {
  // On the line y = x, moved by single ulps: the rounded determinant answers at random here (Kettner et al. 2008).
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec2 p(0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53), q(12, 12), r(24, 24);
      const int expected = p.y() > p.x() ? 1 : (p.y() < p.x() ? -1 : 0);
      EXPECT_EQ(orientation(q, r, p), expected) << i << " " << j;
      EXPECT_EQ(orientation(r, p, q), expected);
      EXPECT_EQ(orientation(p, q, r), expected);
      EXPECT_EQ(orientation(q, p, r), -expected);
    }
  }
}

TEST(PredicatesTest, OrientationSeesWhatCancelsToItsLastBit) {
  const double tiny = 0x1p-70;
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {1, 1}), 0);
  EXPECT_EQ(orientation({tiny, 0}, {1, 1}, {2, 2}), -1);
  EXPECT_EQ(orientation({-tiny, 0}, {1, 1}, {2, 2}), 1);
}

TEST(PredicatesTest, SegmentsMeetWhenTheyCrossTouchOrOverlap) {
  const Vec2 a(0, 0), b(2, 2);
  EXPECT_TRUE(segments_meet(a, b, {0, 2}, {2, 0}));
  EXPECT_TRUE(segments_meet(a, b, {1, 1}, {5, 0}));
  EXPECT_TRUE(segments_meet(a, b, {1, 1}, {3, 3}));
  EXPECT_TRUE(segments_meet(a, b, {2, 2}, {3, 0}));
  EXPECT_FALSE(segments_meet(a, b, {3, 3}, {4, 4}));
  EXPECT_FALSE(segments_meet(a, b, {0, 1}, {1, 2}));
  EXPECT_FALSE(segments_meet(a, b, {1, 1 - 0x1p-50}, {5, 0}));
}

}  // namespace
}  // namespace urto

#include "physics/narrow_phase/chain_segment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "physics/convex_shapes.h"

namespace urto {
namespace {

using testing_shapes::box;
using testing_shapes::capsule;
using testing_shapes::cast_to;
using testing_shapes::circle;
using testing_shapes::pose_of;

constexpr double kReach = 0.02;

// From right to left, so that the front is above.
Convex<double> segment(const Vec2& before, const Vec2& v1, const Vec2& v2, const Vec2& after, std::uint32_t flags = 0) {
  Convex<double> s = testing_shapes::convex_of({v1, v2});
  s.vertices[Convex<double>::kGhostBefore] = before;
  s.vertices[Convex<double>::kGhostAfter] = after;
  s.flags = kConvexChainSegment | flags;
  return s;
}

Convex<double> flat() { return segment({2, 0}, {1, 0}, {-1, 0}, {-2, 0}); }

LocalManifold<double> touch(const Convex<double>& s, const Convex<double>& other, double x, double y,
                            double angle = 0) {
  return collide(s, other, pose_of(x, y, angle), kReach, NarrowPhaseKind::kSat);
}

TEST(ChainSegmentTest, StopsWhatComesFromItsRightOnly) {
  EXPECT_EQ(touch(flat(), circle(0.5), 0, 0.49).count, 1);
  EXPECT_EQ(touch(flat(), circle(0.5), 0, -0.49).count, 0);
  EXPECT_EQ(touch(flat(), box(1, 1), 0, 0.49).count, 2);
  EXPECT_EQ(touch(flat(), box(1, 1), 0, -0.49).count, 0);
  EXPECT_EQ(touch(flat(), capsule({-0.3, 0}, {0.3, 0}, 0.2), 0, 0.19).count, 2);
  EXPECT_EQ(touch(flat(), capsule({-0.3, 0}, {0.3, 0}, 0.2), 0, -0.19).count, 0);
}

// Whatever lies on a straight floor is pushed up and never aside, wherever the joints are.
TEST(ChainSegmentTest, OnAStraightLineTheNormalIsAlwaysItsOwn) {
  const unsigned seed = 3;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-2.5, 2.5), depth(-0.01, 0.01);
  const Convex<double> others[] = {circle(0.5),   box(1, 1),  box(0.8, 0.8, 0.1), capsule({-0.4, 0}, {0.4, 0}, 0.5),
                                   box(0.004, 1), circle(0.5)};
  int contacts = 0;
  for (int i = 0; i < 20000; ++i) {
    const Convex<double>& other = others[i % 6];
    const auto m = touch(flat(), other, place(random), 0.5 + depth(random));
    contacts += m.count;
    if (m.count == 0) continue;
    EXPECT_NEAR(m.normal.y(), 1, 1e-12);
  }
  EXPECT_GT(contacts, 5000);
}

// Two segments that make a valley: beside the joint each pushes along its own normal, none along what is between.
TEST(ChainSegmentTest, AtAConcaveJointOnlyFacesPush) {
  const Convex<double> right = segment({2, 1}, {1, 0.5}, {0, 0}, {-1, 0.5}),
                       left = segment({1, 0.5}, {0, 0}, {-1, 0.5}, {-2, 1});
  for (double x = -0.6; x <= 0.6; x += 0.01) {
    for (const Convex<double>* s : {&right, &left}) {
      for (const Convex<double>& other : {box(0.5, 0.5), circle(0.3), capsule({-0.3, 0}, {0.3, 0}, 0.2)}) {
        const auto m = touch(*s, other, x, 0.3 + 0.5 * std::abs(x));
        if (m.count == 0) continue;
        EXPECT_NEAR(dot<double>(m.normal, s->normals[0]), 1, 1e-12) << x;
      }
    }
  }
}

// A ridge: a disc rolls over it with one contact at a time, and its normal turns without a jump.
TEST(ChainSegmentTest, AtAConvexJointADiscHasOneContact) {
  const Convex<double> right = segment({2, -1}, {1, -0.5}, {0, 0}, {-1, -0.5}),
                       left = segment({1, -0.5}, {0, 0}, {-1, -0.5}, {-2, -1});
  for (double turn = -0.9; turn <= 0.9; turn += 0.003) {
    const Vec2 up(std::sin(turn), std::cos(turn));
    // Half a metre from the ridge along a direction that lies on a face or in the region of the joint.
    const double slope = std::atan2(0.5, 1.0);
    const Vec2 at =
        std::abs(turn) <= slope
            ? Vec2(0.5 * up)
            : Vec2(0.5 * Vec2(std::copysign(std::sin(slope), turn), std::cos(slope)) +
                   std::tan(std::abs(turn) - slope) * Vec2(std::copysign(std::cos(slope), turn), -std::sin(slope)));
    const auto a = touch(right, circle(0.5), at.x(), at.y()), b = touch(left, circle(0.5), at.x(), at.y());
    ASSERT_EQ(a.count + b.count, 1) << turn;
    const auto& m = a.count > 0 ? a : b;
    EXPECT_NEAR(m.points[0].separation, 0, 1e-9);
    EXPECT_NEAR(m.normal.x(), std::sin(std::clamp(turn, -slope, slope)), 1e-9);
  }
}

// The ends of an open chain are corners of a right angle.
TEST(ChainSegmentTest, ADiscRollsAroundAnEnd) {
  const Convex<double> only = segment({1, -2}, {1, 0}, {-1, 0}, {-1, -2}, kConvexChainEnd);
  const auto right = touch(only, circle(0.5), 1.3, 0.4), left = touch(only, circle(0.5), -1.3, 0.4);
  ASSERT_EQ(right.count, 1);
  ASSERT_EQ(left.count, 1);
  EXPECT_NEAR(right.normal.x(), 0.6, 1e-12);
  EXPECT_NEAR(left.normal.x(), -0.6, 1e-12);
  EXPECT_EQ(touch(only, circle(0.5), 1.3, -0.1).count, 0);
}

TEST(ChainSegmentTest, FloatFindsWhatDoubleFinds) {
  const Convex<float> s = cast_to<float>(flat());
  Convex<float> with_ghosts = s;
  with_ghosts.flags = kConvexChainSegment;
  with_ghosts.vertices[2] = {2, 0};
  with_ghosts.vertices[3] = {-2, 0};
  const auto m = collide(with_ghosts, cast_to<float>(box(1, 1)), Transform<float>{{0.1f, 0.499f}, {}}, 0.02f,
                         NarrowPhaseKind::kSat);
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(m.points[0].separation, -0.001, 1e-6);
}

}  // namespace
}  // namespace urto

#include "physics/narrow_phase/manifold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "physics/convex_shapes.h"
#include "physics/narrow_phase/gjk.h"
#include "physics/narrow_phase/nearest_vertices.h"

namespace urto {
namespace {

template <class S>
Convex<S> box(S half_width, S half_height) {
  Convex<S> c;
  const Vec<S> corners[4] = {
      {-half_width, -half_height}, {half_width, -half_height}, {half_width, half_height}, {-half_width, half_height}};
  const Vec<S> normals[4] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  c.count = 4;
  for (int i = 0; i < 4; ++i) {
    c.vertices[i] = corners[i];
    c.normals[i] = normals[i];
  }
  return c;
}

template <class S>
Convex<S> disc(S radius) {
  Convex<S> c;
  c.count = 1;
  c.radius = radius;
  return c;
}

template <class S>
Transform<S> at(S x, S y, S angle = 0) {
  return {Vec<S>(x, y), Rotation<S>::from_angle(angle)};
}

template <class S>
class ManifoldTest : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ManifoldTest, Scalars);

constexpr NarrowPhaseKind kBoth[] = {NarrowPhaseKind::kSat, NarrowPhaseKind::kGjk};

TYPED_TEST(ManifoldTest, EdgeOnEdgeHasTwoPointsMidway) {
  using S = TypeParam;
  for (NarrowPhaseKind kind : kBoth) {
    const auto m = collide<S>(box<S>(1, 0.5), box<S>(0.5, 0.5), at<S>(S(0.2), S(0.9)), S(0.02), kind);
    ASSERT_EQ(m.count, 2);
    EXPECT_NEAR(m.normal.y(), 1, 1e-6);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(m.points[i].separation, -0.1, 1e-6);
      EXPECT_NEAR(m.points[i].p.y(), 0.45, 1e-6);
    }
    EXPECT_NEAR(std::abs(m.points[0].p.x() - m.points[1].p.x()), 1, 1e-6);
    EXPECT_NE(m.points[0].id, m.points[1].id);
  }
}

TYPED_TEST(ManifoldTest, CornerOnEdgeHasItsDeepestPointAtTheCorner) {
  using S = TypeParam;
  const S quarter = S(0.78539816339744831);
  const S reach = S(0.02);
  for (NarrowPhaseKind kind : kBoth) {
    const auto m =
        collide<S>(box<S>(2, 0.5), box<S>(0.5, 0.5), at<S>(S(0.3), S(0.5 + 0.70710678 - 0.01), quarter), reach, kind);
    ASSERT_GE(m.count, 1);
    int deepest = m.count == 2 && m.points[1].separation < m.points[0].separation ? 1 : 0;
    EXPECT_NEAR(m.points[deepest].p.x(), 0.3, 1e-3);
    EXPECT_NEAR(m.points[deepest].separation, -0.01, 1e-5);
    EXPECT_NEAR(m.normal.y(), 1, 1e-6);
  }
}

TYPED_TEST(ManifoldTest, CirclesTouchOnTheLineOfTheirCentres) {
  using S = TypeParam;
  const auto m =
      collide<S>(disc<S>(1), disc<S>(S(0.5)), at<S>(S(0.84), S(1.12)), S(0), NarrowPhaseKind::kSat);  // 1.4 apart
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].separation, -0.1, 1e-6);
  EXPECT_NEAR(m.normal.x(), 0.6, 1e-6);
  EXPECT_NEAR(m.normal.y(), 0.8, 1e-6);
  EXPECT_NEAR(m.points[0].p.x(), 0.6 * 0.95, 1e-6);
  // The thesis printed the condition for no contact: apart they must not touch.
  EXPECT_EQ((collide<S>(disc<S>(1), disc<S>(S(0.5)), at<S>(2, 0), S(0), NarrowPhaseKind::kSat)).count, 0);
}

TYPED_TEST(ManifoldTest, CircleMeetsFaceCornerAndInside) {
  using S = TypeParam;
  const Convex<S> b = box<S>(1, 1);
  const auto face = collide<S>(b, disc<S>(S(0.5)), at<S>(S(1.4), S(0.3)), S(0), NarrowPhaseKind::kSat);
  ASSERT_EQ(face.count, 1);
  EXPECT_NEAR(face.points[0].separation, -0.1, 1e-6);
  EXPECT_NEAR(face.normal.x(), 1, 1e-6);
  const auto corner = collide<S>(b, disc<S>(S(0.5)), at<S>(S(1.3), S(1.3)), S(0), NarrowPhaseKind::kSat);
  ASSERT_EQ(corner.count, 1);
  EXPECT_NEAR(corner.points[0].separation, 0.3 * 1.41421356 - 0.5, 1e-6);
  EXPECT_NEAR(corner.normal.x(), 0.70710678, 1e-6);
  const auto inside = collide<S>(b, disc<S>(S(0.5)), at<S>(S(0.9), S(0)), S(0), NarrowPhaseKind::kSat);
  ASSERT_EQ(inside.count, 1);
  EXPECT_NEAR(inside.points[0].separation, -0.6, 1e-6);
}

// The normal always points from a to b, whoever is first (the thesis left it as the axis came out).
TYPED_TEST(ManifoldTest, SwappingShapesTurnsTheNormalAround) {
  using S = TypeParam;
  const unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.2, 1.2), turn(-3, 3);
  for (int i = 0; i < 2000; ++i) {
    const Convex<S> shapes[] = {box<S>(S(0.7), S(0.4)), disc<S>(S(0.5))};
    const Convex<S>&a = shapes[i % 2], &b = shapes[i / 2 % 2];
    const Transform<S> x = at<S>(S(place(random)), S(place(random)), S(turn(random)));
    const Transform<S> back = x.inverse_times(Transform<S>{});
    const auto ab = collide<S>(a, b, x, S(0), NarrowPhaseKind::kSat),
               ba = collide<S>(b, a, back, S(0), NarrowPhaseKind::kSat);
    ASSERT_EQ(ab.count > 0, ba.count > 0);
    if (ab.count == 0) continue;
    const Vec<S> turned = x.q.apply(ba.normal);
    const S agreement = dot<S>(turned, ab.normal);
    // Two faces may overlap equally deep; then each order may take its own.
    if (std::abs(ab.points[0].separation - ba.points[0].separation) < S(1e-5)) {
      EXPECT_LT(agreement, S(0.72));
    }
    EXPECT_GT(dot<S>(ab.normal, x.p), S(-0.8));
  }
}

// SAT and GJK answer the same question: depth and normal agree to rounding when both polygons overlap.
TYPED_TEST(ManifoldTest, SatAndGjkAgreeOnDepth) {
  using S = TypeParam;
  const unsigned seed = 17;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.5, 1.5), turn(-3, 3);
  int overlapping = 0;
  for (int i = 0; i < 5000; ++i) {
    const Convex<S> a = box<S>(S(0.7), S(0.4)), b = box<S>(S(0.3), S(0.9));
    const Transform<S> x = at<S>(S(place(random)), S(place(random)), S(turn(random)));
    const Convex<S> moved = placed(b, x);
    const S sat = std::max(max_face_separation(a, moved).separation, max_face_separation(moved, a).separation);
    const S gjk = gjk_distance(a, b, x).separation;
    if (sat > S(0)) {
      EXPECT_GE(gjk, sat - S(1e-5));
      continue;
    }
    ++overlapping;
    EXPECT_NEAR(sat, gjk, 1e-5);
  }
  EXPECT_GT(overlapping, 1000);
}

// Cornerwise separated polygons: the normal is the direction of least distance, not a face's.
TYPED_TEST(ManifoldTest, CornersApartHaveTheDirectionOfLeastDistance) {
  using S = TypeParam;
  const auto m = collide<S>(box<S>(1, 1), box<S>(1, 1), at<S>(S(2.003), S(2.004)), S(0.02), NarrowPhaseKind::kSat);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].separation, 0.005, 1e-5);
  EXPECT_NEAR(m.normal.x(), 0.6, 1e-3);
  EXPECT_NEAR(m.normal.y(), 0.8, 1e-3);
}

// The rule of the thesis: one nearest point for a corner, two for a face that lies flat.
TYPED_TEST(ManifoldTest, NearestVerticesFindOnePointOrTwo) {
  using S = TypeParam;
  const Convex<S> a = box<S>(2, 0.5), b = box<S>(0.5, 0.5);
  const auto flat = nearest_vertices<S>(a, placed(b, at<S>(S(0.3), S(0.99))));
  EXPECT_EQ(flat.count, 2);
  const auto corner = nearest_vertices<S>(a, placed(b, at<S>(S(0.3), S(1.2), S(0.7))));
  ASSERT_EQ(corner.count, 1);
}

// Shapes with a radius whose cores are apart: the deepest point is as deep as GJK says, along GJK's normal.
TYPED_TEST(ManifoldTest, RoundedShapesAgreeWithTheirDistance) {
  using S = TypeParam;
  const unsigned seed = 23;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-2, 2), turn(-3, 3), unit(0, 1);
  int touching = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto make = [&] {
      const auto count = static_cast<std::uint32_t>(std::uniform_int_distribution<int>(1, 8)(random));
      return testing_shapes::random_polygon(random, count, 0.8, 0.1 + 0.4 * unit(random));
    };
    const Convex<S> a = testing_shapes::cast_to<S>(make()), b = testing_shapes::cast_to<S>(make());
    const Transform<S> x = at<S>(S(place(random)), S(place(random)), S(turn(random)));
    const Distance<S> d = gjk_distance(a, b, x);
    if (d.separation > S(0.02) || d.separation + a.radius + b.radius < S(1e-3)) continue;
    for (NarrowPhaseKind kind : kBoth) {
      const auto m = collide<S>(a, b, x, S(0.03), kind);
      ASSERT_GE(m.count, 1) << "case " << i;
      S deepest = m.points[0].separation;
      if (m.count > 1) deepest = min_of(deepest, m.points[1].separation);
      EXPECT_NEAR(deepest, d.separation, 2e-4) << "case " << i;
      EXPECT_GT(dot<S>(m.normal, d.normal), S(0.99)) << "case " << i;
    }
    ++touching;
  }
  EXPECT_GT(touching, 3000);
}

TYPED_TEST(ManifoldTest, ACapsuleLiesOnTwoPointsAndStandsOnOne) {
  using S = TypeParam;
  const Convex<S> floor = box<S>(2, 0.5),
                  lying = testing_shapes::cast_to<S>(testing_shapes::capsule({-0.5, 0}, {0.5, 0}, 0.25));
  const auto flat = collide<S>(floor, lying, at<S>(S(0.3), S(0.74)), S(0.02), NarrowPhaseKind::kSat);
  ASSERT_EQ(flat.count, 2);
  EXPECT_NEAR(flat.points[0].separation, -0.01, 1e-6);
  EXPECT_NEAR(std::abs(flat.points[0].p.x() - flat.points[1].p.x()), 1, 1e-6);
  const auto upright =
      collide<S>(floor, lying, at<S>(S(0.3), S(1.24), S(1.5707963267948966)), S(0.02), NarrowPhaseKind::kSat);
  ASSERT_EQ(upright.count, 1);
  EXPECT_NEAR(upright.points[0].separation, -0.01, 1e-6);
  EXPECT_NEAR(upright.points[0].p.x(), 0.3, 1e-6);
}

// A disc that rolls around the end of a capsule keeps its id, and with it what it carries.
TYPED_TEST(ManifoldTest, ADiscAroundACapsuleKeepsItsId) {
  using S = TypeParam;
  const Convex<S> capsule = testing_shapes::cast_to<S>(testing_shapes::capsule({-0.5, 0}, {0.5, 0}, 0.25));
  for (double turn = -3; turn < 3; turn += 0.01) {
    const Vec2 end(std::cos(turn) > 0 ? 0.5 : -0.5, 0), center = end + 0.74 * Vec2(std::cos(turn), std::sin(turn));
    const auto m =
        collide<S>(capsule, disc<S>(S(0.5)), at<S>(S(center.x()), S(center.y())), S(0.02), NarrowPhaseKind::kSat);
    ASSERT_EQ(m.count, 1);
    EXPECT_EQ(m.points[0].id, 0u);
    EXPECT_NEAR(m.points[0].separation, -0.01, 1e-6);
    EXPECT_NEAR(m.normal.y(), std::sin(turn), 1e-6);
  }
}

}  // namespace
}  // namespace urto

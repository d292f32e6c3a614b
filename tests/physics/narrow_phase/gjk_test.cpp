#include "physics/narrow_phase/gjk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "physics/brute_force.h"
#include "physics/convex_shapes.h"

namespace urto {
namespace {

using testing_shapes::box;
using testing_shapes::brute_force;
using testing_shapes::capsule;
using testing_shapes::cast_pose;
using testing_shapes::cast_to;
using testing_shapes::circle;
using testing_shapes::least_vertex_edge_distance;
using testing_shapes::mirror;
using testing_shapes::placed;
using testing_shapes::pose_of;
using testing_shapes::random_polygon;
using testing_shapes::random_shape;
using testing_shapes::separation_along;

Transform<double> inverse(const Transform<double>& pose) { return pose.inverse_times(Transform<double>{}); }

// The distance of a point from the surface of a shape, 0 on it.
double surface_distance(const Convex<double>& shape, const Transform<double>& pose, const Vec2& p) {
  return std::abs(least_vertex_edge_distance({p}, placed(shape, pose)) - shape.radius);
}

template <class S>
double slack_of(double size) {
  // The kernel's own slack (8 roundings of the size) twice, for the rounding of the input pose and the radii.
  return 32 * size * static_cast<double>(std::numeric_limits<S>::epsilon());
}

template <class S>
class GjkTest : public testing::Test {
 public:
  // Everything the contract says, against brute force.
  static void expect_right(const Convex<double>& a64, const Convex<double>& b64, const Transform<double>& pose64,
                           double size) {
    const Convex<S> a = cast_to<S>(a64), b = cast_to<S>(b64);
    const Transform<S> pose = cast_pose<S>(pose64);
    const Distance<S> d = gjk_distance(a, b, pose);
    // What the scalar sees: its own rounded input.
    const Convex<double> ar = cast_to<double>(a), br = cast_to<double>(b);
    const Transform<double> pr = cast_pose<double>(pose);
    const double tolerance = slack_of<S>(size);
    const double expected = brute_force(ar, br, pr);
    EXPECT_NEAR(d.separation, expected, tolerance);
    const Vec2 n = d.normal.template cast<double>();
    EXPECT_NEAR(n.norm(), 1, 4 * static_cast<double>(std::numeric_limits<S>::epsilon()));
    // Along the normal the shapes are that far apart, whatever direction it is.
    EXPECT_NEAR(separation_along(n, placed(ar, {}), placed(br, pr)) - ar.radius - br.radius, d.separation, tolerance);
    const Vec2 on_a = d.point_a.template cast<double>(), on_b = d.point_b.template cast<double>();
    EXPECT_NEAR((on_b - on_a - d.separation * n).norm(), 0, tolerance);
    EXPECT_LE(surface_distance(ar, {}, on_a), tolerance);
    EXPECT_LE(surface_distance(br, pr, on_b), tolerance);
    EXPECT_LE(d.iterations, 40);
    const Transform<double> back64 = inverse(pose64);
    const Distance<S> swapped = gjk_distance(b, a, cast_pose<S>(back64));
    EXPECT_NEAR(swapped.separation, d.separation, 2 * tolerance);
    const Distance<S> mirrored = gjk_distance(mirror(a), mirror(b), mirror(pose));
    EXPECT_NEAR(mirrored.separation, d.separation, tolerance);
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(GjkTest, Scalars);

TYPED_TEST(GjkTest, BoxesApartFaceToFace) {
  using S = TypeParam;
  const auto d = gjk_distance(cast_to<S>(box(2, 2)), cast_to<S>(box(1, 1)), cast_pose<S>(pose_of(3, 0.25, 0)));
  EXPECT_EQ(d.separation, S(1.5));
  EXPECT_EQ(d.normal, Vec<S>(1, 0));
  EXPECT_EQ(d.point_a.x(), S(1));
  EXPECT_EQ(d.point_b.x(), S(2.5));
  EXPECT_EQ(d.point_a.y(), d.point_b.y());
}

TYPED_TEST(GjkTest, BoxesOverlappingAlongEachAxis) {
  using S = TypeParam;
  const auto a = cast_to<S>(box(2, 2)), b = cast_to<S>(box(1, 1));
  const Vec<S> directions[] = {Vec<S>(1, 0), Vec<S>(-1, 0), Vec<S>(0, 1), Vec<S>(0, -1)};
  for (const Vec<S>& direction : directions) {
    Transform<S> pose;
    pose.p = S(1.25) * direction;
    const auto d = gjk_distance(a, b, pose);
    EXPECT_EQ(d.separation, S(-0.25));
    EXPECT_EQ(d.normal, direction);  // from a to b, unlike the thesis's, whose sign depends on the edge order
  }
}

TYPED_TEST(GjkTest, CirclesOverlapWhenTheDistanceIsBelowTheSumOfTheRadii) {
  using S = TypeParam;
  const auto a = cast_to<S>(circle(2)), b = cast_to<S>(circle(1));
  const auto apart = gjk_distance(a, b, cast_pose<S>(pose_of(3, 4, 1)));
  EXPECT_NEAR(apart.separation, S(2), 8 * std::numeric_limits<S>::epsilon());
  EXPECT_NEAR(apart.normal.x(), S(0.6), std::numeric_limits<S>::epsilon());
  EXPECT_NEAR(apart.normal.y(), S(0.8), std::numeric_limits<S>::epsilon());
  EXPECT_LT(gjk_distance(a, b, cast_pose<S>(pose_of(0, 2.99, 0))).separation, S(0));
  EXPECT_GT(gjk_distance(a, b, cast_pose<S>(pose_of(0, 3.01, 0))).separation, S(0));
}

TYPED_TEST(GjkTest, RandomShapesAgreeWithBruteForce) {
  int overlaps = 0, distances = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const double reach = 3 * std::abs(unit(random));
    const Convex<double> a = random_shape(random, 1), b = random_shape(random, std::exp(2 * unit(random)));
    const Transform<double> pose = pose_of(reach * unit(random), reach * unit(random), 4 * unit(random));
    const bool overlap = brute_force(a, b, pose) < 0;
    (overlap ? overlaps : distances)++;
    TestFixture::expect_right(a, b, pose, 20);
    if (this->HasFailure()) return;
  }
  EXPECT_GT(overlaps, 4000);
  EXPECT_GT(distances, 4000);
}

TYPED_TEST(GjkTest, ShapesFarApartAndOfVeryDifferentSize) {
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const double size_a = std::pow(10, 3 * unit(random)), size_b = std::pow(10, 3 * unit(random));
    const double reach = 2 * std::max(size_a, size_b);
    const Convex<double> a = random_shape(random, size_a), b = random_shape(random, size_b);
    const Transform<double> pose = pose_of(reach * unit(random), reach * unit(random), 4 * unit(random));
    TestFixture::expect_right(a, b, pose, 4 * reach);
    if (this->HasFailure()) return;
  }
}

// Grids: faces, edges and corners that touch exactly, parallel edges, shapes on each other.
TYPED_TEST(GjkTest, AlignedBoxesOnAGrid) {
  for (int ix = -8; ix <= 8; ++ix) {
    for (int iy = -8; iy <= 8; ++iy) {
      for (const double radius : {0.0, 0.25}) {
        for (const double angle : {0.0, 0.7853981633974483, 1.5707963267948966, 3.141592653589793}) {
          SCOPED_TRACE(testing::Message() << ix << " " << iy << " " << radius << " " << angle);
          TestFixture::expect_right(box(2, 1), box(1, 2, radius), pose_of(0.25 * ix, 0.25 * iy, angle), 4);
        }
      }
    }
  }
}

TYPED_TEST(GjkTest, DegenerateShapes) {
  const Convex<double> shapes[] = {circle(0),
                                   circle(0.5),
                                   circle(0.5, {0.25, 0}),
                                   capsule({-1, 0}, {1, 0}, 0),
                                   capsule({0, 0}, {0, 1}, 0.25),
                                   box(1e-3, 2),
                                   box(2, 1e-3),
                                   box(1, 1)};
  for (const auto& a : shapes) {
    for (const auto& b : shapes) {
      for (int ix = -4; ix <= 4; ++ix) {
        for (int iy = -4; iy <= 4; ++iy) {
          SCOPED_TRACE(testing::Message() << a.count << " " << b.count << " at " << ix << " " << iy);
          for (const double angle : {0.0, 1.5707963267948966, 0.3}) {
            TestFixture::expect_right(a, b, pose_of(0.5 * ix, 0.5 * iy, angle), 4);
          }
        }
      }
    }
  }
}

TYPED_TEST(GjkTest, IdenticalShapesAtTheSamePlace) {
  using S = TypeParam;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Convex<double> shape = random_shape(random, 1);
    TestFixture::expect_right(shape, shape, {}, 4);
    const auto d = gjk_distance(cast_to<S>(shape), cast_to<S>(shape), Transform<S>{});
    EXPECT_LE(d.separation, S(0));
  }
}

// Corners within a few roundings of each other: no direction can be told from their difference.
TYPED_TEST(GjkTest, CornersNearlyTouching) {
  using S = TypeParam;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const Convex<double> a = random_polygon(random, 3 + seed % 6, 1), b = random_polygon(random, 3 + seed % 5, 1);
    const double angle = 3 * unit(random);
    const Vec2 meet = a.vertices[seed % a.count] - pose_of(0, 0, angle).apply(b.vertices[seed % b.count]);
    const double ulp = static_cast<double>(std::numeric_limits<S>::epsilon());
    const double shift = ulp * std::pow(10, 3 * std::abs(unit(random)));
    TestFixture::expect_right(a, b, pose_of(meet.x() + shift * unit(random), meet.y() + shift * unit(random), angle),
                              4);
    if (this->HasFailure()) return;
  }
}

TYPED_TEST(GjkTest, SameInputSameBits) {
  using S = TypeParam;
  std::mt19937_64 random(3);
  const auto a = cast_to<S>(random_polygon(random, 8, 1)), b = cast_to<S>(random_polygon(random, 7, 1));
  const auto first = gjk_distance(a, b, cast_pose<S>(pose_of(0.3, 0.2, 0.1)));
  const auto second = gjk_distance(a, b, cast_pose<S>(pose_of(0.3, 0.2, 0.1)));
  EXPECT_EQ(first.separation, second.separation);
  EXPECT_EQ(first.normal, second.normal);
  EXPECT_EQ(first.point_a, second.point_a);
}

}  // namespace
}  // namespace urto

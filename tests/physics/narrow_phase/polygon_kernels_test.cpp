#include "physics/narrow_phase/polygon_kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "physics/convex_shapes.h"
#include "physics/narrow_phase/manifold.h"

namespace urto {
namespace {

using namespace testing_shapes;

// Every lane has a pair of its own, triangles to octagons side by side: the answers of the general routine, but where
// the kernel asks for it. Pairs whose answer hangs on rounding (two faces that separate equally well) are left out.
template <class S>
void compare_random_polygons(double tolerance) {
  const unsigned seed = 4;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const S reach = S(0.1);
  int touching = 0, asked = 0, apart = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<Convex<S>> convexes;
    std::vector<Transform<S>> poses;
    std::vector<Place<S>> places;
    std::vector<OutlineRows<S>> outlines;
    std::uint32_t a[kLanes<S>], b[kLanes<S>];
    for (std::uint32_t i = 0; i < 2 * static_cast<std::uint32_t>(kLanes<S>); ++i) {
      const auto count = static_cast<std::uint32_t>(std::uniform_int_distribution<int>(3, 8)(random));
      convexes.push_back(cast_to<S>(random_polygon(random, count, 1)));
      poses.push_back(cast_pose<S>(pose_of(uniform(-1, 1), uniform(-1, 1), uniform(-3, 3))));
      outlines.push_back(outline_of(convexes.back()));
      places.push_back(place_of(convexes.back(), poses.back(), reach));
      (i % 2 == 0 ? a : b)[i / 2] = i;
    }
    ManifoldLanes<S> lanes{};
    polygon_kernels<S>().collide(places.data(), outlines.data(), a, b, lanes);
    for (int lane = 0; lane < kLanes<S>; ++lane) {
      const Transform<S> b_in_a = poses[a[lane]].inverse_times(poses[b[lane]]);
      const Convex<S>&ca = convexes[a[lane]], cb = placed(convexes[b[lane]], b_in_a);
      const S fa = max_face_separation(ca, cb).separation, fb = max_face_separation(cb, ca).separation;
      if (absolute(fa - fb) < S(2e-3) || absolute(max_of(fa, fb) - reach) < S(1e-3)) continue;
      const auto expected = collide(ca, convexes[b[lane]], b_in_a, reach, NarrowPhaseKind::kSat);
      if (lanes.count[lane] == S(kAskGeneral)) {
        ++asked;
        continue;
      }
      ASSERT_EQ(static_cast<int>(lanes.count[lane]), expected.count) << "round " << round << ", lane " << lane;
      ++(expected.count > 0 ? touching : apart);
      if (expected.count == 0) continue;
      const Vec<S> normal = poses[a[lane]].q.apply(expected.normal);
      ASSERT_NEAR(double(lanes.nx[lane]), double(normal.x()), tolerance) << "round " << round << ", lane " << lane;
      ASSERT_NEAR(double(lanes.ny[lane]), double(normal.y()), tolerance);
      for (int i = 0; i < expected.count; ++i) {
        const Vec<S> p = poses[a[lane]].q.apply(expected.points[i].p);
        ASSERT_NEAR(double(lanes.x[i][lane]), double(p.x()), tolerance) << "round " << round << ", lane " << lane;
        ASSERT_NEAR(double(lanes.y[i][lane]), double(p.y()), tolerance);
        ASSERT_NEAR(double(lanes.separation[i][lane]), double(expected.points[i].separation), tolerance);
        ASSERT_EQ(static_cast<std::uint32_t>(lanes.id[i][lane]), expected.points[i].id);
      }
    }
  }
  EXPECT_GT(touching, 5000);
  EXPECT_GT(apart, 1000);
  EXPECT_LT(asked, touching / 4);
}

TEST(PolygonKernelsTest, AgreesWithTheGeneralRoutineInFloat) { compare_random_polygons<float>(1e-4); }
TEST(PolygonKernelsTest, AgreesWithTheGeneralRoutineInDouble) { compare_random_polygons<double>(1e-11); }

}  // namespace
}  // namespace urto

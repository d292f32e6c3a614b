#include "physics/narrow_phase/rounded_kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "physics/convex_shapes.h"
#include "physics/narrow_phase/manifold.h"
#include "physics/solver/contact_kernels.h"

namespace urto {
namespace {

using namespace testing_shapes;

// The pairs of a block, one in each lane.
template <class S>
struct Pairs {
  std::vector<Convex<S>> convexes;
  std::vector<Transform<S>> poses;
  std::vector<Place<S>> places;
  std::vector<OutlineRows<S>> outlines;
  std::uint32_t a[kLanes<S>], b[kLanes<S>];

  void set(int lane, const Convex<S>& shape_a, const Transform<S>& pose_a, const Convex<S>& shape_b,
           const Transform<S>& pose_b, S reach) {
    a[lane] = add(shape_a, pose_a, reach);
    b[lane] = add(shape_b, pose_b, reach);
  }
  ManifoldLanes<S> collide() const {
    ManifoldLanes<S> lanes{};
    rounded_kernels<S>().collide(places.data(), outlines.data(), a, b, lanes);
    return lanes;
  }
  LocalManifold<S> general(int lane, S reach) const {
    return urto::collide(convexes[a[lane]], convexes[b[lane]], poses[a[lane]].inverse_times(poses[b[lane]]), reach,
                         NarrowPhaseKind::kSat);
  }

 private:
  std::uint32_t add(const Convex<S>& shape, const Transform<S>& pose, S reach) {
    convexes.push_back(shape);
    poses.push_back(pose);
    outlines.push_back(outline_of(shape));
    places.push_back(place_of(shape, pose, reach));
    return static_cast<std::uint32_t>(convexes.size() - 1);
  }
};

template <class S>
void expect_same(const ManifoldLanes<S>& lanes, int lane, const LocalManifold<S>& expected, const Rotation<S>& turn,
                 double tolerance) {
  ASSERT_EQ(static_cast<int>(lanes.count[lane]), expected.count);
  if (expected.count == 0) return;
  const Vec<S> normal = turn.apply(expected.normal);
  ASSERT_NEAR(double(lanes.nx[lane]), double(normal.x()), tolerance);
  ASSERT_NEAR(double(lanes.ny[lane]), double(normal.y()), tolerance);
  for (int i = 0; i < expected.count; ++i) {
    const Vec<S> p = turn.apply(expected.points[i].p);
    ASSERT_NEAR(double(lanes.x[i][lane]), double(p.x()), tolerance);
    ASSERT_NEAR(double(lanes.y[i][lane]), double(p.y()), tolerance);
    ASSERT_NEAR(double(lanes.separation[i][lane]), double(expected.points[i].separation), tolerance);
    ASSERT_EQ(static_cast<std::uint32_t>(lanes.id[i][lane]), expected.points[i].id);
  }
}

// Pairs whose answer hangs on rounding: a small change of the reach, of the radius or of the place changes what kind
// of contact it is.
template <class S>
bool hangs_on_rounding(const Pairs<S>& pairs, int lane, S reach, S change) {
  const Convex<S>&a = pairs.convexes[pairs.a[lane]], &b = pairs.convexes[pairs.b[lane]];
  const Transform<S> b_in_a = pairs.poses[pairs.a[lane]].inverse_times(pairs.poses[pairs.b[lane]]);
  const auto expected = collide(a, b, b_in_a, reach, NarrowPhaseKind::kSat);
  const auto same = [&](const LocalManifold<S>& other) {
    if (other.count != expected.count) return false;
    for (int i = 0; i < expected.count; ++i)
      if (other.points[i].id != expected.points[i].id) return false;
    return expected.count == 0 || length<S>(other.normal - expected.normal) < S(100) * change;
  };
  for (S more : {-change, change}) {
    if (!same(collide(a, b, b_in_a, reach + more, NarrowPhaseKind::kSat))) return true;
    for (Vec<S> way : {Vec<S>(more, S(0)), Vec<S>(S(0), more)}) {
      Transform<S> moved = b_in_a;
      moved.p += way;
      if (!same(collide(a, b, moved, reach, NarrowPhaseKind::kSat))) return true;
    }
    Transform<S> turned = b_in_a;
    turned.q = Rotation<S>{S(1), more}.times(turned.q);
    if (!same(collide(a, b, turned, reach, NarrowPhaseKind::kSat))) return true;
  }
  return false;
}

// Every lane has a pair of its own, points to octagons with all radii side by side.
template <class S>
void compare_random_shapes(double tolerance, S change) {
  const unsigned seed = 11;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const S reach = S(0.1);
  int touching = 0, asked = 0, apart = 0, corners = 0;
  for (int round = 0; round < 2000; ++round) {
    Pairs<S> pairs;
    for (int lane = 0; lane < kLanes<S>; ++lane) {
      const auto shape = [&] { return cast_to<S>(random_shape(random, 0.6)); };
      const auto pose = [&] { return cast_pose<S>(pose_of(uniform(-1, 1), uniform(-1, 1), uniform(-3, 3))); };
      const Convex<S> a = shape(), b = shape();
      const Transform<S> pose_a = pose(), pose_b = pose();
      pairs.set(lane, a, pose_a, b, pose_b, reach);
    }
    const ManifoldLanes<S> lanes = pairs.collide();
    for (int lane = 0; lane < kLanes<S>; ++lane) {
      if (lanes.count[lane] == S(kAskGeneral)) {
        ++asked;
        continue;
      }
      if (hangs_on_rounding(pairs, lane, reach, change)) continue;
      const LocalManifold<S> expected = pairs.general(lane, reach);
      SCOPED_TRACE("round " + std::to_string(round) + ", lane " + std::to_string(lane));
      ASSERT_NO_FATAL_FAILURE(expect_same(lanes, lane, expected, pairs.poses[pairs.a[lane]].q, tolerance));
      ++(expected.count > 0 ? touching : apart);
      corners += expected.count == 1 && expected.points[0].id == ManifoldIds::kCorners;
    }
  }
  EXPECT_GT(touching, 5000);
  EXPECT_GT(apart, 1000);
  EXPECT_GT(corners, 500);
  EXPECT_LT(asked, touching / 50);
}

TEST(RoundedKernelsTest, AgreesWithTheGeneralRoutineInFloat) { compare_random_shapes<float>(1e-4, 3e-5F); }
TEST(RoundedKernelsTest, AgreesWithTheGeneralRoutineInDouble) { compare_random_shapes<double>(1e-10, 1e-9); }

// Every instruction set that this machine has.
TEST(RoundedKernelsTest, EveryWidthGivesTheSameBits) {
  const unsigned seed = 12;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const float reach = 0.1F;
  for (int round = 0; round < 200; ++round) {
    Pairs<float> pairs;
    for (int lane = 0; lane < kLanes<float>; ++lane) {
      const Convex<float> a = cast_to<float>(random_shape(random, 0.6)), b = cast_to<float>(random_shape(random, 0.6));
      pairs.set(lane, a, cast_pose<float>(pose_of(unit(random), unit(random), 3 * unit(random))), b,
                cast_pose<float>(pose_of(unit(random), unit(random), 3 * unit(random))), reach);
    }
    const ManifoldLanes<float> widest = pairs.collide();
    for (const SimdTarget& target : simd_targets()) {
      use_simd_target(target.id);
      const ManifoldLanes<float> lanes = pairs.collide();
      for (int lane = 0; lane < kLanes<float>; ++lane) {
        ASSERT_EQ(lanes.count[lane], widest.count[lane]) << target.name << ", round " << round << ", lane " << lane;
        if (lanes.count[lane] <= 0) continue;
        ASSERT_EQ(lanes.nx[lane], widest.nx[lane]) << target.name;
        ASSERT_EQ(lanes.ny[lane], widest.ny[lane]) << target.name;
        for (int i = 0; i < static_cast<int>(lanes.count[lane]); ++i) {
          ASSERT_EQ(lanes.x[i][lane], widest.x[i][lane]) << target.name;
          ASSERT_EQ(lanes.y[i][lane], widest.y[i][lane]) << target.name;
          ASSERT_EQ(lanes.separation[i][lane], widest.separation[i][lane]) << target.name;
          ASSERT_EQ(lanes.id[i][lane], widest.id[i][lane]) << target.name;
        }
      }
    }
    use_simd_target(0);
  }
}

// What has no direction of its own gets one: concentric circles, and a circle whose centre is on a corner.
TEST(RoundedKernelsTest, CirclesOnAPointHaveANormal) {
  const double reach = 0.1;
  const Transform<double> here = pose_of(0.25, -0.5, 0.5), corner = pose_of(0.75, 0, 0);
  Pairs<double> pairs;
  for (int lane = 0; lane < kLanes<double>; ++lane) {
    if (lane % 2 == 0) {
      pairs.set(lane, circle(0.5), here, circle(0.25), here, reach);
    } else {
      pairs.set(lane, box(1, 1), pose_of(0.25, -0.5, 0), circle(0.25), corner, reach);
    }
  }
  const ManifoldLanes<double> lanes = pairs.collide();
  for (int lane = 0; lane < kLanes<double>; ++lane) {
    SCOPED_TRACE(lane);
    EXPECT_NE(lanes.count[lane], 0);
    expect_same(lanes, lane, pairs.general(lane, reach), pairs.poses[pairs.a[lane]].q, 1e-12);
  }
}

}  // namespace
}  // namespace urto

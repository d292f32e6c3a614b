#include "physics/narrow_phase/box_kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "physics/convex_shapes.h"
#include "physics/narrow_phase/manifold.h"
#include "physics/solver/contact_kernels.h"

namespace urto {
namespace {

template <class S>
struct TestBox {
  Convex<S> convex;
  Transform<S> pose;
  Place<S> place;
};

template <class S>
TestBox<S> make_box(S half_width, S half_height, const Vec<S>& center, S angle, S reach) {
  TestBox<S> box;
  box.convex.count = 4;
  const Vec<S> corners[4] = {
      {-half_width, -half_height}, {half_width, -half_height}, {half_width, half_height}, {-half_width, half_height}};
  const Vec<S> normals[4] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  for (int i = 0; i < 4; ++i) {
    box.convex.vertices[i] = corners[i];
    box.convex.normals[i] = normals[i];
  }
  box.pose.p = center;
  box.pose.q = Rotation<S>::from_angle(angle);
  box.place.x = center.x();
  box.place.y = center.y();
  box.place.c = box.pose.q.c;
  box.place.s = box.pose.q.s;
  box.place.half_width = half_width;
  box.place.half_height = half_height;
  box.place.reach = reach;
  box.place.box = S(1);
  return box;
}

template <class S>
class BoxKernelsTest : public ::testing::Test {
 protected:
  // Lane 0 of the kernel beside the general routine, in the world frame.
  void compare(const TestBox<S>& a, const TestBox<S>& b, S reach) {
    const std::vector<Place<S>> places{a.place, b.place};
    std::uint32_t first[kLanes<S>] = {}, second[kLanes<S>] = {};
    for (int i = 0; i < kLanes<S>; ++i) second[i] = 1;
    box_kernels<S>().collide(places.data(), first, second, lanes_);
    expected_ = collide(a.convex, b.convex, a.pose.inverse_times(b.pose), reach, NarrowPhaseKind::kSat);
    ASSERT_EQ(static_cast<int>(lanes_.count[0]), expected_.count);
    if (expected_.count == 0) return;
    const Vec<S> normal = a.pose.q.apply(expected_.normal);
    EXPECT_NEAR(double(lanes_.nx[0]), double(normal.x()), tolerance());
    EXPECT_NEAR(double(lanes_.ny[0]), double(normal.y()), tolerance());
    for (int i = 0; i < expected_.count; ++i) {
      const Vec<S> p = a.pose.q.apply(expected_.points[i].p);
      EXPECT_NEAR(double(lanes_.x[i][0]), double(p.x()), tolerance());
      EXPECT_NEAR(double(lanes_.y[i][0]), double(p.y()), tolerance());
      EXPECT_NEAR(double(lanes_.separation[i][0]), double(expected_.points[i].separation), tolerance());
      EXPECT_EQ(static_cast<std::uint32_t>(lanes_.id[i][0]), expected_.points[i].id);
    }
  }
  static double tolerance() { return sizeof(S) == 4 ? 2e-5 : 1e-12; }

  ManifoldLanes<S> lanes_{};
  LocalManifold<S> expected_;
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(BoxKernelsTest, Scalars);

// Deep, shallow, corner to corner and apart: the same normals, points, depths and feature ids as the general routine.
// Cases in which two answers are equally good (two faces or two edges within rounding of each other) are left out by
// asking for angles and places away from them.
TYPED_TEST(BoxKernelsTest, AgreesWithTheGeneralRoutine) {
  using S = TypeParam;
  const unsigned seed = 20;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return S(std::uniform_real_distribution<double>(low, high)(random));
  };
  int touching = 0, corners = 0;
  const S reach = S(0.5);  // wide, so that corners meet often
  for (int i = 0; i < 20000; ++i) {
    const auto a =
        make_box<S>(uniform(0.2, 2), uniform(0.2, 2), {uniform(-5, 5), uniform(-5, 5)}, uniform(-3, 3), reach);
    const S distance = uniform(0.3, 4), direction = uniform(-3, 3);
    const auto way = Rotation<S>::from_angle(direction).apply(Vec<S>(distance, S(0)));
    const auto b = make_box<S>(uniform(0.2, 2), uniform(0.2, 2), Vec<S>(a.pose.p + way), uniform(-3, 3), reach);
    const Convex<S> moved = placed(b.convex, a.pose.inverse_times(b.pose));
    const S fa = max_face_separation(a.convex, moved).separation, fb = max_face_separation(moved, a.convex).separation;
    const S margin = S(1e-3);
    if (absolute(fa - fb) < margin || absolute(max_of(fa, fb) - reach) < margin) continue;
    this->compare(a, b, reach);
    if (this->HasFatalFailure() || this->HasNonfatalFailure()) FAIL() << "case " << i;
    touching += this->expected_.count > 0;
    corners += this->expected_.count == 1 && this->expected_.points[0].id == 0x8000u;
  }
  EXPECT_GT(touching, 3000);
  EXPECT_GT(corners, 10);
}

TYPED_TEST(BoxKernelsTest, ABoxRestsOnTwoPoints) {
  using S = TypeParam;
  this->compare(make_box<S>(2, 1, {0, 0}, 0, S(0.02)), make_box<S>(S(0.5), S(0.5), {S(0.25), S(1.49)}, 0, S(0.02)),
                S(0.02));
  EXPECT_EQ(this->expected_.count, 2);
}

// Where the boxes overlap by next to nothing, the lanes take the face that the general routine takes.
TYPED_TEST(BoxKernelsTest, OverlapOfACornerOnly) {
  using S = TypeParam;
  const auto slider = make_box<S>(S(0.5), S(0.5), {S(-0.499), S(1.0 + 0.4999)}, 0, S(0.02));
  const auto plate = make_box<S>(2, 1, {2, 0}, 0, S(0.02));
  this->compare(slider, plate, S(0.02));
  this->compare(plate, slider, S(0.02));
}

}  // namespace
}  // namespace urto

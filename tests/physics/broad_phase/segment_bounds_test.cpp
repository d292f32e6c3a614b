#include "physics/broad_phase/segment_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace urto {
namespace {

template <class S>
class SegmentBoundsTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SegmentBoundsTest, Scalars);

TYPED_TEST(SegmentBoundsTest, GrazesCornersAndEdges) {
  using V = Vec<TypeParam>;
  const Aabb<TypeParam> box{V(0, 0), V(2, 1)};
  EXPECT_TRUE(SegmentBounds<TypeParam>(V(-1, 1), V(4, 0)).meets(box));                // along an edge
  EXPECT_TRUE(SegmentBounds<TypeParam>(V(-1, 2), V(2, -2)).meets(box));               // through the corner (0, 1)
  EXPECT_TRUE(SegmentBounds<TypeParam>(V(-1, 0), V(1, 0)).meets(box));                // ends at the corner (0, 0)
  EXPECT_FALSE(SegmentBounds<TypeParam>(V(-1, TypeParam(0.1)), V(2, 2)).meets(box));  // past the corner (0, 1)
  EXPECT_FALSE(SegmentBounds<TypeParam>(V(3, 0), V(0, 1)).meets(box));
}

// What trees rely on: a box that contains a box which meets the segment meets it too, whatever is rounded.
TYPED_TEST(SegmentBoundsTest, LargerBoxMeetsWhateverSmallerMeets) {
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  const auto uniform = [&](double low, double high) {
    return static_cast<TypeParam>(std::uniform_real_distribution<double>(low, high)(random));
  };
  int met = 0;
  for (int round = 0; round < 200000; ++round) {
    const TypeParam scale = static_cast<TypeParam>(std::pow(10.0, uniform(0, 7)));
    using V = Vec<TypeParam>;
    const V origin(uniform(-1, 1) * scale, uniform(-1, 1) * scale), to(uniform(-1, 1) * scale, uniform(-1, 1) * scale);
    const V translation = to - origin;
    // A tiny box about a point of the segment: it grazes within rounding, or nearly.
    const TypeParam part = uniform(0, 1), half = round % 2 == 0 ? TypeParam(0) : uniform(0, 1e-6) * scale;
    const V at = origin + part * translation;
    const Aabb<TypeParam> small{V(at.x() - half, at.y() - half), V(at.x() + half, at.y() + half)};
    const SegmentBounds<TypeParam> segment(origin, translation);
    if (!segment.meets(small)) continue;
    ++met;
    const Aabb<TypeParam> large{V(small.lower.x() - uniform(0, 1) * scale, small.lower.y()),
                                V(small.upper.x(), small.upper.y() + uniform(0, 1) * scale)};
    ASSERT_TRUE(segment.meets(large)) << "seed " << kSeed << ", round " << round;
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace urto

#include "physics/narrow_phase/closing_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "physics/constants.h"
#include "physics/simd/lanes.h"
#include "physics/solver/contact_kernels.h"

namespace urto {
namespace {

template <class S>
bool closes_in_fast(const Place<S>& a, const Place<S>& b) {
  const S wx = b.way_x - a.way_x, wy = b.way_y - a.way_y;
  const S way = std::sqrt(wx * wx + wy * wy) + (a.turn + b.turn);
  return a.fast + b.fast > S(0) && way > S(2 * kFastFraction) * std::min(a.bound, b.bound);
}

template <class S>
void compare(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<S> way(S(-0.1), S(0.1)), turn(S(0), S(0.02)), bound(S(0.02), S(0.1));
  std::vector<Place<S>> places(40);
  for (Place<S>& place : places) {
    place.way_x = way(random);
    place.way_y = way(random);
    place.turn = turn(random);
    place.bound = bound(random);
    place.fast = random() % 2 == 0 ? S(1) : S(0);
  }
  std::uint32_t a[kLanes<S>], b[kLanes<S>], expected = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(kLanes<S>); ++i) {
    a[i] = random() % 40;
    b[i] = random() % 40;
    expected |= static_cast<std::uint32_t>(closes_in_fast(places[a[i]], places[b[i]])) << i;
  }
  EXPECT_EQ(closing_kernels<S>().closing(places.data(), a, b), expected) << "seed " << seed;
}

TEST(ClosingKernelsTest, FindsWhatClosesInFastAtEveryWidth) {
  for (const SimdTarget& target : simd_targets()) {
    use_simd_target(target.id);
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
      SCOPED_TRACE(target.name);
      compare<float>(seed);
      compare<double>(seed);
    }
  }
  use_simd_target(0);
}

}  // namespace
}  // namespace urto

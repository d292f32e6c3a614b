#include "physics/narrow_phase/closing_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "physics/constants.h"
#include "physics/simd/lanes.h"
#include "physics/solver/contact_kernels.h"

namespace urto {
namespace {

template <class S>
S way_between(const Place<S>& a, const Place<S>& b) {
  const S wx = b.way_x - a.way_x, wy = b.way_y - a.way_y;
  return std::sqrt(wx * wx + wy * wy) + (a.turn + b.turn);
}

template <class S>
bool closes_in_fast(const Place<S>& a, const Place<S>& b) {
  return a.fast + b.fast > S(0) && way_between(a, b) > S(2 * kFastFraction) * std::min(a.bound, b.bound);
}

// m, how far the shape reaches along a unit vector; infinite if it is not known.
template <class S>
S reach_along(const Place<S>& place, S nx, S ny) {
  if (place.half_height == S(0)) return std::numeric_limits<S>::infinity();
  if (place.half_height < S(0)) return -place.half_height;
  return std::abs(nx * place.c + ny * place.s) * place.half_width +
         std::abs(ny * place.c - nx * place.s) * place.half_height;
}

template <class S>
bool may_meet(const Place<S>& a, const Place<S>& b) {
  const S dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy), nx = dx / length, ny = dy / length;
  if (length == S(0)) return true;
  const S inwards = -((b.way_x - a.way_x) * nx + (b.way_y - a.way_y) * ny);
  const S near = reach_along(a, nx, ny) + reach_along(b, nx, ny) + a.turn + b.turn + std::min(a.reach, b.reach);
  return length <= S(1 + kDiscSlack) * (near + std::max(inwards, S(0)));
}

template <class S>
bool may_swing_through(const Place<S>& a, const Place<S>& b) {
  const auto thickness = [](const Place<S>& p) { return p.bound < S(kCoordinateMax) ? 2 * p.bound : S(0); };
  return S(1 + kDiscSlack) * (a.turn + b.turn) > S(kFastFraction) * (thickness(a) + thickness(b));
}

template <class S>
std::vector<Place<S>> random_places(std::mt19937& random) {
  std::uniform_real_distribution<S> at(S(-0.3), S(0.3)), way(S(-0.1), S(0.1)), turn(S(0), S(0.1));
  std::uniform_real_distribution<S> size(S(0.02), S(0.1));
  std::vector<Place<S>> places(40);
  for (Place<S>& place : places) {
    place.x = at(random);
    place.y = at(random);
    const S angle = S(40) * at(random);
    place.c = std::cos(angle);
    place.s = std::sin(angle);
    place.half_width = size(random);
    place.half_height = size(random) * (static_cast<S>(random() % 3) - S(1));  // an outline, an unknown shape, a box
    place.reach = S(0.02);
    place.way_x = way(random);
    place.way_y = way(random);
    place.turn = turn(random);
    place.bound = random() % 8 == 0 ? S(kCoordinateMax) : size(random);
    place.fast = random() % 2 == 0 ? S(1) : S(0);
  }
  return places;
}

// How often each answer was right.
struct Counts {
  int closing = 0, apart = 0, swinging = 0;
};

template <class S>
void compare(std::uint32_t seed, Counts& counts) {
  std::mt19937 random(seed);
  const std::vector<Place<S>> places = random_places<S>(random);
  std::uint32_t a[kLanes<S>], b[kLanes<S>], closing = 0, swinging = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(kLanes<S>); ++i) {
    a[i] = random() % 40;
    b[i] = random() % 40;
    const Place<S>&pa = places[a[i]], &pb = places[b[i]];
    const bool fast = closes_in_fast(pa, pb);
    closing |= static_cast<std::uint32_t>(fast && may_meet(pa, pb)) << i;
    swinging |= static_cast<std::uint32_t>(fast && may_swing_through(pa, pb)) << i;
    counts.apart += fast && !may_meet(pa, pb);
  }
  counts.closing += closing != 0;
  counts.swinging += swinging != 0;
  EXPECT_EQ(closing_kernels<S>().closing(places.data(), a, b), closing) << "seed " << seed;
  EXPECT_EQ(closing_kernels<S>().swinging(places.data(), a, b), swinging) << "seed " << seed;
}

TEST(ClosingKernelsTest, FindsWhatClosesInOrSwingsAtEveryWidth) {
  Counts counts;
  for (const SimdTarget& target : simd_targets()) {
    use_simd_target(target.id);
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
      SCOPED_TRACE(target.name);
      compare<float>(seed, counts);
      compare<double>(seed, counts);
    }
  }
  use_simd_target(0);
  EXPECT_GT(counts.closing, 20);
  EXPECT_GT(counts.apart, 20);
  EXPECT_GT(counts.swinging, 20);
}

}  // namespace
}  // namespace urto

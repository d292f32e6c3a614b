#include "physics/geometry/trigonometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace urto {
namespace {

// The references are the C library's in long double: 64 bits on x86-64, 113 on AArch64, so that their own rounding is
// below 2⁻¹⁰ ulp of a double. Where long double is no more than double, the tolerances below leave room for its ½ ulp.
using Wide = long double;

constexpr Wide kPiWide = 3.14159265358979323846264338327950288L;
constexpr double kAngleMax = 1e6;

template <class S>
Wide ulp_of(Wide value) {
  const S size = static_cast<S>(std::abs(value));
  const int exponent = size < std::numeric_limits<S>::min() ? std::numeric_limits<S>::min_exponent - 1
                                                            : static_cast<int>(std::ilogb(size));
  return std::ldexp(Wide(1), exponent - (std::numeric_limits<S>::digits - 1));
}

template <class S>
double ulps(S got, Wide expected) {
  return static_cast<double>(std::abs(static_cast<Wide>(got) - expected) / ulp_of<S>(expected));
}

// All magnitudes from 1e-5 to 1e6 alike, both signs.
template <class S>
S draw_angle(std::mt19937_64& random) {
  std::uniform_real_distribution<double> exponent(-5, 6), sign(-1, 1);
  return static_cast<S>(std::copysign(std::pow(10, exponent(random)), sign(random)));
}

// The bounds on the error in ulp: ½ for the last rounding, and what the terms before it can add. double: the sum of the
// polynomial's own rounding (a sixth of an ulp for the sine), its error of 2⁻⁵⁸ and the rounding of the tail; float:
// the polynomial's error of 2⁻²⁸ relative is a sixteenth of an ulp.
template <class S>
constexpr double kSineUlps = sizeof(S) == 8 ? 0.85 : 0.57;
template <class S>
constexpr double kAtanUlps = sizeof(S) == 8 ? 0.80 : 0.51;

template <class S>
class TrigonometryTest : public testing::Test {
 protected:
  static void expect_sin_cos(S x) {
    S sine, cosine;
    sin_cos(x, sine, cosine);
    const double sine_error = ulps(sine, std::sin(static_cast<Wide>(x)));
    const double cosine_error = ulps(cosine, std::cos(static_cast<Wide>(x)));
    ASSERT_LE(sine_error, kSineUlps<S>) << "at " << x;
    ASSERT_LE(cosine_error, kSineUlps<S>) << "at " << x;
    worst_ = std::max({worst_, sine_error, cosine_error});
  }
  double worst_seen() const { return worst_; }
  static inline double worst_ = 0;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TrigonometryTest, Scalars);

TYPED_TEST(TrigonometryTest, SineAndCosineOnADenseSweep) {
  using S = TypeParam;
  this->worst_ = 0;
  std::mt19937_64 random(1);
  for (int k = 0; k < 300000; ++k) this->expect_sin_cos(draw_angle<S>(random));
  for (int k = -40000; k <= 40000; ++k) this->expect_sin_cos(static_cast<S>(k * 1e-4));
  // A reference that agreed to the last bit would be the code under test: rounding alone makes half an ulp.
  EXPECT_GT(this->worst_seen(), 0.49);
  this->RecordProperty("worst_thousandths_of_ulp", static_cast<int>(1000 * this->worst_seen()));
}

// The scalars nearest to the multiples of π/2, where the reduction cancels all but the last parts.
TYPED_TEST(TrigonometryTest, SineAndCosineBesideEveryQuarterTurn) {
  using S = TypeParam;
  for (int k = 1; k <= 636619; k += k < 2000 ? 1 : 7) {
    const S x = static_cast<S>(k * (0.5L * kPiWide));
    for (const S y : {std::nextafter(x, S(0)), x, std::nextafter(x, S(kAngleMax))}) {
      S sine, cosine;
      sin_cos(y, sine, cosine);
      // A long double of 64 bits reduces these to about 2⁻⁶⁴ of itself by the library's own exact reduction.
      ASSERT_LE(ulps(sine, std::sin(static_cast<Wide>(y))), kSineUlps<S>) << "at " << y;
      ASSERT_LE(ulps(cosine, std::cos(static_cast<Wide>(y))), kSineUlps<S>) << "at " << y;
    }
  }
}

TYPED_TEST(TrigonometryTest, SineIsOddAndCosineEvenToTheBit) {
  using S = TypeParam;
  std::mt19937_64 random(2);
  for (int k = 0; k < 100000; ++k) {
    const S x = draw_angle<S>(random);
    S s1, c1, s2, c2;
    sin_cos(x, s1, c1);
    sin_cos(-x, s2, c2);
    ASSERT_EQ(s1, -s2) << x;
    ASSERT_EQ(c1, c2) << x;
  }
}

TYPED_TEST(TrigonometryTest, ExactWhereTheMathematicsIs) {
  using S = TypeParam;
  S sine, cosine;
  sin_cos(S(0), sine, cosine);
  EXPECT_EQ(sine, S(0));
  EXPECT_EQ(cosine, S(1));
  EXPECT_EQ(atan2_of(S(0), S(0)), S(0));
  EXPECT_EQ(atan2_of(S(0), S(2)), S(0));
  const S pi = static_cast<S>(kPiWide);
  EXPECT_EQ(atan2_of(S(0), S(-2)), pi);
  EXPECT_EQ(atan2_of(-S(0), S(-2)), pi);
  EXPECT_EQ(atan2_of(S(3), S(0)), static_cast<S>(0.5L * kPiWide));
  EXPECT_EQ(atan2_of(S(-3), S(0)), static_cast<S>(-0.5L * kPiWide));
  EXPECT_EQ(atan2_of(S(3), S(3)), static_cast<S>(0.25L * kPiWide));
  EXPECT_EQ(atan2_of(S(-3), S(-3)), static_cast<S>(-0.75L * kPiWide));
}

TYPED_TEST(TrigonometryTest, BeyondTheRangeTheErrorStaysBelowTheSpacingOfTheArgument) {
  using S = TypeParam;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(6, 15);
  for (int k = 0; k < 20000; ++k) {
    const S x = static_cast<S>(std::pow(10, exponent(random)));
    S sine, cosine;
    sin_cos(x, sine, cosine);
    // The reduction is in double whatever the scalar.
    const double tolerance = static_cast<double>(std::abs(x)) * 0x1p-53 + 2 * std::numeric_limits<S>::epsilon();
    ASSERT_NEAR(sine, static_cast<double>(std::sin(static_cast<Wide>(x))), tolerance);
    ASSERT_NEAR(cosine, static_cast<double>(std::cos(static_cast<Wide>(x))), tolerance);
    const S wrapped = wrap_angle(x);
    ASSERT_LE(std::abs(wrapped), static_cast<S>(kPiWide));
    ASSERT_NEAR(static_cast<double>(std::sin(static_cast<Wide>(wrapped))),
                static_cast<double>(std::sin(static_cast<Wide>(x))), 2 * tolerance);
  }
}

TYPED_TEST(TrigonometryTest, WhatIsNotFiniteGivesNaN) {
  using S = TypeParam;
  const S infinity = std::numeric_limits<S>::infinity(), nan = std::numeric_limits<S>::quiet_NaN();
  for (const S bad : {infinity, -infinity, nan}) {
    S sine = 0, cosine = 0;
    sin_cos(bad, sine, cosine);
    EXPECT_TRUE(std::isnan(sine) && std::isnan(cosine));
    EXPECT_TRUE(std::isnan(wrap_angle(bad)));
  }
  EXPECT_TRUE(std::isnan(atan2_of(nan, S(1))));
  EXPECT_TRUE(std::isnan(atan2_of(S(1), nan)));
  EXPECT_EQ(atan2_of(infinity, infinity), static_cast<S>(0.25L * kPiWide));
  EXPECT_EQ(atan2_of(S(1), -infinity), static_cast<S>(kPiWide));
  EXPECT_EQ(atan2_of(-infinity, S(1)), static_cast<S>(-0.5L * kPiWide));
}

TYPED_TEST(TrigonometryTest, ArcTangentOnADenseSweep) {
  using S = TypeParam;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-6, 6);
  const S pi = static_cast<S>(kPiWide);
  double worst = 0;
  const auto expect_right = [&](S y, S x) {
    const S angle = atan2_of(y, x);
    ASSERT_GT(angle, -pi);
    ASSERT_LE(angle, pi);
    const Wide expected = std::atan2(static_cast<Wide>(y), static_cast<Wide>(x));
    // Just below the negative x axis the scalar nearest to the angle is −π, and the answer is π.
    if (static_cast<S>(expected) <= -pi) {
      ASSERT_EQ(angle, pi);
      return;
    }
    const double error = ulps(angle, expected);
    ASSERT_LE(error, kAtanUlps<S>) << y << " " << x;
    worst = std::max(worst, error);
  };
  for (int k = 0; k < 300000; ++k) {
    const double scale = std::pow(10, exponent(random));
    expect_right(static_cast<S>(scale * mantissa(random)), static_cast<S>(mantissa(random)));
    if (this->HasFatalFailure()) return;
  }
  // The seams of the argument reduction, at ratios 7/16, 11/16 and 1.
  for (int k = -2000; k <= 2000; ++k) {
    for (const double ratio : {0.4375, 0.6875, 1.0}) {
      const S y = static_cast<S>(ratio * (1 + k * 1e-6));
      for (const S sign : {S(1), S(-1)}) {
        expect_right(y, sign);
        expect_right(sign, y);
        if (this->HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(worst, 0.49);
}

TYPED_TEST(TrigonometryTest, ArcTangentOfHugeAndTinySides) {
  using S = TypeParam;
  const S big = std::numeric_limits<S>::max(), tiny = std::numeric_limits<S>::min();
  for (const S size : {big, S(big / 3), tiny, S(tiny * 5)}) {
    EXPECT_EQ(atan2_of(size, size), static_cast<S>(0.25L * kPiWide));
    EXPECT_EQ(atan2_of(size, -size), static_cast<S>(0.75L * kPiWide));
  }
  EXPECT_EQ(atan2_of(tiny, big), S(0));
  EXPECT_EQ(atan2_of(big, tiny), static_cast<S>(0.5L * kPiWide));
}

TYPED_TEST(TrigonometryTest, WrappedAngleIsTheSameAngleInTheHalfOpenTurn) {
  using S = TypeParam;
  std::mt19937_64 random(5);
  const S pi = static_cast<S>(kPiWide);
  for (int k = 0; k < 300000; ++k) {
    const S x = draw_angle<S>(random);
    const S r = wrap_angle(x);
    ASSERT_GT(r, -pi) << x;
    ASSERT_LE(r, pi) << x;
    if (x > -pi && x <= pi) {
      ASSERT_EQ(r, x);
      continue;
    }
    // x − r is a whole number of turns, but for one ulp of r and the reference's own rounding, of x − r and of 2π.
    const Wide difference = static_cast<Wide>(x) - static_cast<Wide>(r);
    const Wide turns = std::round(difference / (2 * kPiWide));
    const Wide tolerance = std::abs(difference) * 0x1p-62L + ulp_of<S>(r);
    ASSERT_LE(std::abs(difference - turns * (2 * kPiWide)), tolerance) << x;
  }
}

// Odd multiples of π are where the count of turns can round to the wrong side.
TYPED_TEST(TrigonometryTest, WrappedAngleBesideHalfATurn) {
  using S = TypeParam;
  const S pi = static_cast<S>(kPiWide);
  for (int k = -159153; k <= 159153; k += 2) {
    const S x = static_cast<S>(k * kPiWide);
    for (const S y : {std::nextafter(x, S(-2e6)), x, std::nextafter(x, S(2e6))}) {
      const S r = wrap_angle(y);
      ASSERT_GT(r, -pi);
      ASSERT_LE(r, pi);
      ASSERT_NEAR(static_cast<double>(std::sin(static_cast<Wide>(r))),
                  static_cast<double>(std::sin(static_cast<Wide>(y))),
                  4 * static_cast<double>(std::numeric_limits<S>::epsilon()));
      ASSERT_LT(std::cos(static_cast<Wide>(r)), -0.9L);
    }
  }
  EXPECT_EQ(wrap_angle(pi), pi);
  // The scalar −π is a little beyond −π for float and a little short of it for double.
  EXPECT_GE(wrap_angle(-pi), std::nextafter(pi, S(0)));
  EXPECT_EQ(wrap_angle(std::nextafter(-pi, S(0))), std::nextafter(-pi, S(0)));
}

// FNV-1a over the bits of 10⁵ results each. The same on GCC and clang, every level of optimisation, x86-64 and AArch64:
// a change here is a change of every simulation, and of every saved hash.
template <class S>
std::uint64_t hash_of_results() {
  using Bits = std::conditional_t<sizeof(S) == 8, std::uint64_t, std::uint32_t>;
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](S value) {
    Bits bits = std::bit_cast<Bits>(value);
    for (std::size_t k = 0; k < sizeof(S); ++k, bits >>= 8) hash = (hash ^ (bits & 0xff)) * 0x100000001b3u;
  };
  // A generator of our own: the standard's distributions differ between libraries.
  std::uint64_t state = 88172645463325252u;
  const auto draw = [&state](double size) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<S>(size * (static_cast<double>(state >> 11) * 0x1p-52 - 1));
  };
  constexpr double kSizes[] = {1e-3, 1, 4, 100, 1e6, 1e12};
  for (int k = 0; k < 100000; ++k) {
    S sine, cosine;
    const S x = draw(kSizes[k % 6]);
    sin_cos(x, sine, cosine);
    add(sine);
    add(cosine);
    add(wrap_angle(x));
    add(atan2_of(x, draw(kSizes[k % 5])));
  }
  return hash;
}

TEST(TrigonometryGoldenTest, BitsOfDouble) { EXPECT_EQ(hash_of_results<double>(), 1622876327889689034u); }

TEST(TrigonometryGoldenTest, BitsOfFloat) { EXPECT_EQ(hash_of_results<float>(), 13520330677304509171u); }

}  // namespace
}  // namespace urto

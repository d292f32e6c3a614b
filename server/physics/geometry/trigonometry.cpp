#include "physics/geometry/trigonometry.h"

#include <cmath>
#include <limits>

namespace urto {
namespace trigonometry {
namespace {

constexpr double kTwoPi = 0x1.921fb54442d18p+2;

// x less whole turns of the nearest double to 2π. That double errs by 4e-17 of itself, so the remainder errs by less
// than half the spacing of doubles around x.
double remainder_far(double x) { return std::fmod(x, kTwoPi); }

// a·b and its exact rounding error (Dekker 1971); no overflow for |a|, |b| < 2⁴⁹⁰.
double two_product(double a, double b, double& error) {
  constexpr double kSplit = 134217729.0;  // 2²⁷ + 1 parts 53 bits into 26 and 27
  const double a_big = kSplit * a, b_big = kSplit * b;
  const double a_high = a_big - (a_big - a), a_low = a - a_high;
  const double b_high = b_big - (b_big - b), b_low = b - b_high;
  const double product = a * b;
  error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
  return product;
}

// Where the arc tangent starts: atan(0), atan(1/2), atan(1), taken as they are, from π/2 (swapped), from π (x < 0) or
// from −π/2 (both). As double and rest.
struct Base {
  double high, low;
};
constexpr Base kBase[4][3] = {
    {{0, 0}, {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56}, {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}},
    {{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54},
     {0x1.1b6e192ebbe44p+0, 0x1.b1b466a88828ep-54},
     {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}},
    {{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53},
     {0x1.56c6e7397f5aep+1, 0x1.660b64ece6f4bp-53},
     {0x1.2d97c7f3321d2p+1, 0x1.a79394c9e8a0ap-54}},
    {{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54},
     {0x1.0468a8ace4df6p+1, 0x1.0620bf7406affp-55},
     {0x1.2d97c7f3321d2p+1, 0x1.a79394c9e8a0ap-54}},
};

// What is left of an angle in [0, π] once a whole known part is taken off: atan(a/b) = atan(c) + atan(u),
// u = (a − c·b)/(b + c·a) for c in {0, ½, 1}, so that |u| ≤ 7/16. numerator is exact by Sterbenz's lemma.
struct Fraction {
  double numerator, denominator, denominator_error;
  int base;
};

Fraction reduce_fraction(double a, double b) {
  Fraction f{a, b, 0, 0};
  if (a > 0.6875 * b) {
    f.base = 2;
    f.numerator = a - b;
    f.denominator = two_sum(b, a, f.denominator_error);
  } else if (a > 0.4375 * b) {
    f.base = 1;
    f.numerator = a - 0.5 * b;
    f.denominator = two_sum(b, 0.5 * a, f.denominator_error);
  }
  return f;
}

// Remez exchange, 2⁻⁵⁸ relative for |u| ≤ 7/16.
double atan_polynomial(double z) {
  double p = -0x1.0ab2947c459ccp-6;
  p = p * z + 0x1.2b338946d50e6p-5;
  p = p * z - 0x1.97ad6841bcc5ap-5;
  p = p * z + 0x1.dde10a224eff0p-5;
  p = p * z - 0x1.10d6470735fdbp-4;
  p = p * z + 0x1.3b0f2789321f6p-4;
  p = p * z - 0x1.745cdc1d8e905p-4;
  p = p * z + 0x1.c71c6fe007a56p-4;
  p = p * z - 0x1.2492492001ec4p-3;
  p = p * z + 0x1.999999998ea96p-3;
  return p * z - 0x1.555555555550cp-2;
}

// The angle of (x, y), y ≥ 0, both finite, not both zero, and scaled so that products neither overflow nor vanish.
double atan2_upper_half(double y, double x) {
  const double width = x < 0 ? -x : x;
  const bool swapped = y > width;
  const Fraction f = swapped ? reduce_fraction(width, y) : reduce_fraction(y, width);
  const double u = f.numerator / f.denominator;
  double product_error;
  const double product = two_product(u, f.denominator, product_error);
  // What the division dropped, to first order.
  const double tail = (((f.numerator - product) - product_error) - u * f.denominator_error) / f.denominator;
  const double z = u * u;
  const double correction = tail - tail * z + u * z * atan_polynomial(z);
  const Base base = kBase[(x < 0 ? 2 : 0) + (swapped ? 1 : 0)][f.base];
  if (f.base == 0 && !swapped && !(x < 0)) return u + correction;
  // π − angle turns the sign over, and so does π/2 − angle; π/2 + angle (both) does not.
  return swapped != (x < 0) ? base.high - (u + (correction - base.low)) : base.high + (u + (correction + base.low));
}

// The powers of two keep every bit.
double scaled_atan2_upper_half(double y, double x) {
  constexpr double kBig = 0x1p+480, kSmall = 0x1p-420;
  const double size = (x < 0 ? -x : x) > y ? (x < 0 ? -x : x) : y;
  if (size > kBig) return atan2_upper_half(y * 0x1p-600, x * 0x1p-600);
  if (size < kSmall) return atan2_upper_half(y * 0x1p+600, x * 0x1p+600);
  return atan2_upper_half(y, x);
}

}  // namespace

void sin_cos_far(double x, double& sine, double& cosine) {
  if (!std::isfinite(x)) {
    sine = cosine = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  sin_cos_near(remainder_far(x), sine, cosine);
}

double wrap_angle_far(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  return remainder_turn_near(remainder_far(x));
}

}  // namespace trigonometry

template <>
double atan2_of<double>(double y, double x) {
  constexpr double pi = trigonometry::kPi<double>;
  if (x != x || y != y) return std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  if (x == infinity || x == -infinity || y == infinity || y == -infinity) {
    x = x == infinity ? 1 : (x == -infinity ? -1 : 0);
    y = y == infinity ? 1 : (y == -infinity ? -1 : 0);
  }
  if (y == 0) return x < 0 ? pi : 0;
  if (y > 0) return trigonometry::scaled_atan2_upper_half(y, x);
  const double angle = -trigonometry::scaled_atan2_upper_half(-y, x);
  return angle <= -pi ? pi : angle;
}

// Through double: what is within 1 ulp there is all but correctly rounded here.
template <>
float atan2_of<float>(float y, float x) {
  constexpr float pi = trigonometry::kPi<float>;
  const float angle = static_cast<float>(atan2_of<double>(y, x));
  return angle <= -pi ? pi : angle;
}

}  // namespace urto

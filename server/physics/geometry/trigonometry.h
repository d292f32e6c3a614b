#pragma once

#include <cstdint>

namespace urto {

// Own trigonometry: the same bits on every machine, which libm does not promise. Built on + − × ÷, exact conversions
// and std::fmod, which IEEE 754 makes exact; none of it depends on the rounding of a library. Within 1 ulp of the
// scalar for |x| ≤ 1e6 rad; beyond it the error stays below the spacing of the argument itself, |x|·2⁻⁵³.
// A NaN or an infinity gives NaN.
template <class S>
void sin_cos(S x, S& sine, S& cosine);

// In (−π, π]; atan2(0, 0) is 0, and so is that of any zero y beside a positive x; with a negative x it is π, whatever
// the sign of the zero.
template <class S>
S atan2_of(S y, S x);

// The same angle in (−π, π], where π is the scalar nearest to it.
template <class S>
S wrap_angle(S x);

namespace trigonometry {

// rad; up to here the products of the reduction below are exact: 20 bits of quarter turns times 33 bits of π/2.
inline constexpr double kReductionMax = 1e6;

// π/2 in parts of 33 bits and a rest (Cody and Waite 1980).
inline constexpr double kHalfPi1 = 0x1.921fb54400000p+0;
inline constexpr double kHalfPi2 = 0x1.0b4611a600000p-34;
inline constexpr double kHalfPi3 = 0x1.3198a2e000000p-69;
inline constexpr double kHalfPi4 = 0x1.b839a252049c1p-104;
inline constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
template <class S>
inline constexpr S kPi = S(0x1.921fb54442d18p+1);

// Beyond kReductionMax, and for what is not finite.
void sin_cos_far(double x, double& sine, double& cosine);
double wrap_angle_far(double x);

// The nearest whole number, halves away from zero; no rounding mode enters. |q| < 2³¹.
inline std::int32_t nearest_integer(double q) { return static_cast<std::int32_t>(q + (q < 0 ? -0.5 : 0.5)); }

// a + b and the exact rounding error of the sum (Knuth's TwoSum).
inline double two_sum(double a, double b, double& error) {
  const double sum = a + b;
  const double part = sum - a;
  error = (a - (sum - part)) + (b - part);
  return sum;
}

// The sine and cosine of r + tail, |r| ≤ π/4. Polynomials: Remez exchange
// (tests/physics/geometry/trigonometry_coefficients.py), errors 2⁻⁵⁸ relative and 2⁻⁶⁴ absolute.
inline void sin_cos_octant(double r, double tail, double& sine, double& cosine) {
  const double z = r * r;
  const double half_z = 0.5 * z;
  double p = 0x1.5d932f1091b80p-33;
  p = p * z - 0x1.ae5e66d4319ffp-26;
  p = p * z + 0x1.71de35787391ep-19;
  p = p * z - 0x1.a01a019c126a3p-13;
  p = p * z + 0x1.111111110f881p-7;
  p = p * z - 0x1.5555555555549p-3;
  sine = r + ((z * r * p - half_z * tail) + tail);
  double q = -0x1.8faecef5e6788p-37;
  q = q * z + 0x1.1ee9ec474474cp-29;
  q = q * z - 0x1.27e4f80a75b6ap-22;
  q = q * z + 0x1.a01a019cb26e1p-16;
  q = q * z - 0x1.6c16c16c15184p-10;
  q = q * z + 0x1.555555555554cp-5;
  const double w = 1.0 - half_z;
  cosine = w + (((1.0 - w) - half_z) + (z * z * q - r * tail));
}

// From the octant around n quarter turns to the whole circle.
template <class S>
inline void place_quadrant(std::int32_t n, S s, S c, S& sine, S& cosine) {
  const S a = (n & 1) ? c : s;
  const S b = (n & 1) ? s : c;
  sine = (n & 2) ? -a : a;
  cosine = ((n + 1) & 2) ? -b : b;
}

inline void sin_cos_near(double x, double& sine, double& cosine) {
  const std::int32_t n = nearest_integer(x * kTwoOverPi);
  const double turns = n;
  double e1, e2, s, c;
  const double r1 = two_sum(x - turns * kHalfPi1, -(turns * kHalfPi2), e1);
  const double r2 = two_sum(r1, e1 - turns * kHalfPi3, e2);
  sin_cos_octant(r2, e2 - turns * kHalfPi4, s, c);
  place_quadrant(n, s, c, sine, cosine);
}

// For float the double has bits to spare: two parts of π/2, polynomials of three terms (errors 2⁻²⁸ and 2⁻³³), and one
// rounding at the end, which is within 0.6 ulp. In ascending order.
inline constexpr double kFloatSine[] = {-0x1.555545995452bp-3, 0x1.1107604faf4b4p-7, -0x1.994eb296058cap-13};
inline constexpr double kFloatCosine[] = {0x1.55554ab3feca7p-5, -0x1.6c0c8bb674f83p-10, 0x1.9a0258e698a45p-16};

inline void sin_cos_near(float x, float& sine, float& cosine) {
  const double angle = x;
  const std::int32_t n = nearest_integer(angle * kTwoOverPi);
  const double turns = n;
  const double r = (angle - turns * kHalfPi1) - turns * kHalfPi2;
  const double z = r * r;
  const double p = (kFloatSine[2] * z + kFloatSine[1]) * z + kFloatSine[0];
  const double q = (kFloatCosine[2] * z + kFloatCosine[1]) * z + kFloatCosine[0];
  const double s = r + r * z * p;
  const double c = (1.0 - 0.5 * z) + z * z * q;
  place_quadrant(n, static_cast<float>(s), static_cast<float>(c), sine, cosine);
}

// x less whole turns, rounded once; exact products as above.
inline double less_turns(double x, double turns) {
  double error;
  const double r = two_sum(x - turns * (4 * kHalfPi1), -(turns * (4 * kHalfPi2)), error);
  return r + ((error - turns * (4 * kHalfPi3)) - turns * (4 * kHalfPi4));
}

// The remainder of x by whole turns; at most one rounding beyond ±π. |x| ≤ kReductionMax.
inline double remainder_turn_near(double x) {
  const double turns = nearest_integer(x * (0.25 * kTwoOverPi));
  const double r = less_turns(x, turns);
  // Close to half a turn the product may have been rounded to the wrong side.
  if (r > kPi<double>) return less_turns(x, turns + 1);
  if (r < -kPi<double>) return less_turns(x, turns - 1);
  return r;
}

}  // namespace trigonometry

// In the header because every body needs it in every step.
template <class S>
inline void sin_cos(S x, S& sine, S& cosine) {
  if (x <= S(trigonometry::kReductionMax) && x >= S(-trigonometry::kReductionMax)) [[likely]] {
    trigonometry::sin_cos_near(x, sine, cosine);
    return;
  }
  double s, c;
  trigonometry::sin_cos_far(x, s, c);
  sine = static_cast<S>(s);
  cosine = static_cast<S>(c);
}

template <class S>
inline S wrap_angle(S x) {
  constexpr S pi = trigonometry::kPi<S>;
  if (x > -pi && x <= pi) [[likely]]
    return x;
  const bool near = x <= S(trigonometry::kReductionMax) && x >= S(-trigonometry::kReductionMax);
  const S r = static_cast<S>(near ? trigonometry::remainder_turn_near(x) : trigonometry::wrap_angle_far(x));
  // Rounding can end on −π or one ulp beyond ±π: there π itself is as near.
  return r <= -pi || r > pi ? pi : r;
}

}  // namespace urto

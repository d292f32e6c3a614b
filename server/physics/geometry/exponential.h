#pragma once

namespace urto {

// e^(−x) for x ≥ 0, from + − × ÷ alone: the same bits on every machine. Relative error below 1e-14 where the result is
// above 1e-30; 0 beyond x = 700.
inline double exponential_of_minus(double x) {
  if (!(x < 700)) return 0;
  int halvings = 0;
  for (; x > 0.125; x *= 0.5) ++halvings;  // exact
  // The Taylor series of e^(−x) − 1 to x⁹: what is left out is below 1e-15 of x.
  double rest = 0;
  for (int n = 9; n >= 1; --n) rest = -x / n * (1 + rest);
  // (1 + r)² − 1, so that small results keep their digits.
  for (; halvings > 0; --halvings) rest = rest * (2 + rest);
  return 1 + rest;
}

}  // namespace urto

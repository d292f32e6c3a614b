#pragma once

namespace urto {

// Own trigonometry: the same bits on every machine, which libm does not promise. Accurate to about 1 ulp of the
// scalar for |x| ≤ 1e6 rad.
template <class S>
void sin_cos(S x, S& sine, S& cosine);

// In (−π, π]; atan2(0, 0) is 0.
template <class S>
S atan2_of(S y, S x);

// The same angle in (−π, π].
template <class S>
S wrap_angle(S x);

}  // namespace urto

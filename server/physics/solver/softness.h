#pragma once

namespace urto {

// A damped spring of frequency f and damping ratio ζ as a soft constraint, integrated implicitly (Catto, "Soft
// Constraints", GDC 2011). Ours differs: the spring answers to what the point carries beyond its preload P, a slow
// average of its impulse,  v + bias_rate · s = −compliance · k · (λ − P).  A plain spring has to be compressed to carry
// what lies on it, and a stack of N boxes sinks by N² of that; with the preload it carries its load uncompressed in the
// end, and still yields to sudden change. (The multiplier of an augmented Lagrangian, updated slowly enough that the
// update does not race the solver's own convergence up the stack: kPreloadTime, and kPreloadTimeFast where a load is
// found sooner.) The law holds on into the gap, until λ = 0, so that a contact that carries all by its preload does not
// rattle at s = 0.
template <class S>
struct Softness {
  S bias_rate;   // 1/s: ω / (2ζ + hω)
  S compliance;  // of the inverse mass: 1 / (hω (2ζ + hω))

  Softness(S hertz, S damping_ratio, S h) {
    const S omega = S(2 * 3.14159265358979323846) * hertz;
    bias_rate = omega / (S(2) * damping_ratio + h * omega);
    compliance = S(1) / (h * omega * (S(2) * damping_ratio + h * omega));
  }
};

}  // namespace urto

#pragma once

#include "physics/definitions.h"
#include "physics/geometry/vector.h"

namespace urto {

// A free body's place and velocity: what an integrator advances.
template <class S>
struct Flight {
  Vec<S> x, v;  // m, m/s
};

// Advances by h seconds under acceleration(x, v). Global order of error: 1, 1, 2, 4.
//   explicit Euler        x' = x + h v,  v' = v + h a(x, v)
//   semi-implicit Euler   v' = v + h a(x, v),  x' = x + h v'
//   Verlet                x' = x + h v + h²/2 a(x, v),  v' = v + h/2 (a(x, v) + a(x', v + h a(x, v)))
//                         (velocity form of x' = 2x − x₋₁ + a h², with x₋₁ = x₀ − h v₀ + h²/2 a₀; Swope et al. 1982)
//   Runge-Kutta 4         the classical four slopes with weights 1 2 2 1
template <class S, class Acceleration>
Flight<S> advance(Integrator integrator, const Flight<S>& f, S h, const Acceleration& acceleration) {
  switch (integrator) {
    case Integrator::kExplicitEuler: {
      const Vec<S> a = acceleration(f.x, f.v);
      return {f.x + f.v * h, f.v + a * h};
    }
    case Integrator::kSemiImplicitEuler: {
      const Vec<S> v = f.v + acceleration(f.x, f.v) * h;
      return {f.x + v * h, v};
    }
    case Integrator::kVerlet: {
      const Vec<S> a0 = acceleration(f.x, f.v);
      const Vec<S> x = f.x + f.v * h + a0 * (S(0.5) * h * h);
      const Vec<S> a1 = acceleration(x, Vec<S>(f.v + a0 * h));
      return {x, f.v + (a0 + a1) * (S(0.5) * h)};
    }
    case Integrator::kRungeKutta4:
      break;
  }
  const S half = S(0.5) * h;
  const Vec<S> v1 = f.v, a1 = acceleration(f.x, f.v);
  const Vec<S> v2 = f.v + a1 * half, a2 = acceleration(Vec<S>(f.x + v1 * half), v2);
  const Vec<S> v3 = f.v + a2 * half, a3 = acceleration(Vec<S>(f.x + v2 * half), v3);
  const Vec<S> v4 = f.v + a3 * h, a4 = acceleration(Vec<S>(f.x + v3 * h), v4);
  return {f.x + (v1 + (v2 + v3) * S(2) + v4) * (h / S(6)), f.v + (a1 + (a2 + a3) * S(2) + a4) * (h / S(6))};
}

}  // namespace urto

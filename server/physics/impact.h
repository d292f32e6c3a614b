#pragma once

#include "physics/geometry/rotation.h"

namespace urto {

// How two bodies move, and what moving them takes.
template <class S>
struct Twist {
  Vec<S> v = Vec<S>::Zero();  // of the centre of mass
  S w = 0;
  S inv_mass = 0, inv_inertia = 0;

  Vec<S> at(const Vec<S>& arm) const { return Vec<S>(v.x() - w * arm.y(), v.y() + w * arm.x()); }
  void push(const Vec<S>& arm, const Vec<S>& impulse) {
    v += inv_mass * impulse;
    w += inv_inertia * cross<S>(arm, impulse);
  }
};

// Where they touch, in the world's frame.
template <class S>
struct Touch {
  Vec<S> normal = Vec<S>::Zero();  // unit, from a to b
  Vec<S> arms_a[2], arms_b[2];     // m, from the centres of mass
  int count = 0;
};

// An impact at one or two points: each leaves at `restitution` times the speed at which it came (Newton), the
// tangential impulse is bounded by `friction` times the normal one (Coulomb), and no point pulls. The greatest speed of
// approach.
template <class S>
S collide_at(const Touch<S>& touch, S restitution, S friction, Twist<S>& a, Twist<S>& b);

// b's velocity against a's along the normal at the point where they close in fastest.
template <class S>
S normal_velocity(const Touch<S>& touch, const Twist<S>& a, const Twist<S>& b);

}  // namespace urto

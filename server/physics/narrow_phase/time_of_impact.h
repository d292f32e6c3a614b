#pragma once

#include "physics/geometry/convex.h"

namespace urto {

// The motion of a body over a step: its centre of mass moves on a line, its angle grows evenly.
template <class S>
struct Sweep {
  Vec<S> local_center = Vec<S>::Zero();             // of mass, body frame
  Vec<S> c0 = Vec<S>::Zero(), c1 = Vec<S>::Zero();  // world position of the centre of mass at t = 0 and t = 1
  S angle0 = 0, angle1 = 0;                         // rad, not wrapped: angle1 − angle0 is the whole turn

  // The body's frame (origin, rotation) at t in [0, 1].
  Transform<S> pose(S t) const {
    Transform<S> x;
    x.q = Rotation<S>::from_angle(angle0 + t * (angle1 - angle0));
    x.p = (c0 + t * (c1 - c0)) - x.q.apply(local_center);
    return x;
  }
};

enum class ImpactKind : unsigned char {
  kSeparated,   // never closer than target over the whole step
  kHit,         // first reach the target distance at `time`
  kOverlapped,  // nearer than the target already at t = 0
  kFailed,      // the bound on iterations was reached; `time` is a moment before any contact
};

template <class S>
struct Impact {
  ImpactKind kind = ImpactKind::kSeparated;
  S time = 1;          // [0, 1]
  int iterations = 0;  // advances made
};

// When two moving convex shapes first come within `target` (m > 0) of each other, found by conservative advancement
// (Mirtich 1996; bound of the motion by the rotating radius) so that no contact is stepped over, however fast.
// Reported times are never after the true one. Bounded work.
template <class S>
Impact<S> time_of_impact(const Convex<S>& a, const Sweep<S>& sweep_a, const Convex<S>& b, const Sweep<S>& sweep_b,
                         S target, S tolerance);

}  // namespace urto

#pragma once

#include "physics/geometry/convex.h"

namespace urto {

template <class S>
struct ShapeCast {
  bool hit = false;
  bool overlapping = false;        // they meet already at the start
  S fraction = 0;                  // of the translation, [0, 1], never after the true one
  Vec<S> normal = Vec<S>::Zero();  // unit, from a to b, a's frame; zero if overlapping
  Vec<S> point = Vec<S>::Zero();   // where they meet, a's frame; within the overlap if overlapping
  int iterations = 0;
};

// When b, moved along a translation without turning, first touches a (all in a's frame, radii included).
//
// Conservative advancement (Mirtich 1996): the plane between the nearest points parts the shapes until b has come up to
// it. For a translation that is Newton's method on a convex function from its outer side: it never passes the first
// touch, ends after a few steps on polygons, and converges quadratically on discs unless they graze each other.
template <class S>
ShapeCast<S> shape_cast(const Convex<S>& a, const Convex<S>& b, const Transform<S>& b_in_a, const Vec<S>& translation);

}  // namespace urto

#pragma once

#include "physics/geometry/convex.h"

namespace urto {

// The closest points of two convex shapes (their radii included), or how deep they overlap.
// GJK: Gilbert, Johnson, Keerthi 1988; penetration by the expanding polytope: van den Bergen 2001.
template <class S>
struct Distance {
  S separation = 0;                 // m; negative: the least translation that parts them
  Vec<S> normal = Vec<S>::Zero();   // unit, from a to b, in a's frame
  Vec<S> point_a = Vec<S>::Zero();  // on a's surface, a's frame
  Vec<S> point_b = Vec<S>::Zero();  // on b's surface, a's frame
  // Whether the nearest feature of a shape is an edge; else it is a vertex. Both for parallel edges that overlap.
  bool edge_a = false, edge_b = false;
  int iterations = 0;
};

// b_in_a: the frame of b as seen from a. Bounded work; always returns a unit normal.
template <class S>
Distance<S> gjk_distance(const Convex<S>& a, const Convex<S>& b, const Transform<S>& b_in_a);

}  // namespace urto

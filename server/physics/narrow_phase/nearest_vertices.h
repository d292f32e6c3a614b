#pragma once

#include "physics/geometry/convex.h"

namespace urto {

// Contact points as the thesis finds them: of all vertices of either polygon against all edges of the other, the
// nearest; a second one if it is nearly as near and lies elsewhere. Kept for comparison with clipping.
template <class S>
struct NearestVertices {
  Vec<S> points[2] = {Vec<S>::Zero(), Vec<S>::Zero()};  // on the edges, a's frame
  int count = 0;
};

// b_placed: b's outline in a's frame. Both have at least three vertices.
template <class S>
NearestVertices<S> nearest_vertices(const Convex<S>& a, const Convex<S>& b_placed);

}  // namespace urto

#pragma once

#include "physics/geometry/convex.h"

namespace urto {

// A convex shape as the kernels gather it: a row of four for each vertex (x, y from the centroid, m, and the normal of
// the edge that begins there). A short outline ends in copies of its first row, which change no minimum over its
// vertices. Of a power of two's size, so that the address of a row is a shift and a sum; a box fills one cache line.
template <class S>
struct alignas(16 * sizeof(S)) OutlineRows {
  S rows[kPolygonVerticesMax][4];
};

template <class S>
OutlineRows<S> outline_of(const Convex<S>& convex) {
  OutlineRows<S> out;
  for (std::uint32_t i = 0; i < kPolygonVerticesMax; ++i) {
    const std::uint32_t k = i < convex.count ? i : 0;
    const Vec<S> v = convex.vertices[k] - convex.centroid;
    out.rows[i][0] = v.x();
    out.rows[i][1] = v.y();
    out.rows[i][2] = convex.normals[k].x();
    out.rows[i][3] = convex.normals[k].y();
  }
  return out;
}

}  // namespace urto

#pragma once

#include <cstdint>

#include "physics/definitions.h"
#include "physics/geometry/aabb.h"
#include "physics/geometry/rotation.h"

namespace urto {

enum ConvexFlag : std::uint32_t {
  // A segment of a chain: it has a front, its right side. Behind its two vertices lie those before and after it.
  kConvexChainSegment = 1u << 0,
  kConvexChainEnd = 1u << 1,  // the last segment of an open chain: its second vertex is its own too
};

// A convex shape in its body's frame: a convex polygon swept by a disc. One vertex makes a circle, two a capsule, and
// with radius 0 three and more make a polygon. Vertices are counter-clockwise; normals[i] is the outward unit normal of
// the edge from vertices[i] to vertices[i + 1].
template <class S>
struct Convex {
  Vec<S> vertices[kPolygonVerticesMax];
  Vec<S> normals[kPolygonVerticesMax];
  Vec<S> centroid = Vec<S>::Zero();
  std::uint32_t count = 0;
  std::uint32_t flags = 0;  // ConvexFlag
  S radius = 0;             // m ≥ 0

  bool chain_segment() const { return (flags & kConvexChainSegment) != 0; }
  // Of a chain segment: the vertices before and after it in the chain.
  static constexpr std::uint32_t kGhostBefore = 2, kGhostAfter = 3;

  // For outlines that are filled at once and thrown away.
  struct Uninitialized {};
  explicit Convex(Uninitialized) {}
  // Eigen leaves coefficients as they are; unused ones shall be zero in the saved state.
  Convex() {
    for (std::uint32_t i = 0; i < kPolygonVerticesMax; ++i) vertices[i] = normals[i] = Vec<S>::Zero();
  }

  Aabb<S> bounds(const Transform<S>& pose) const {
    Vec<S> v = pose.apply(vertices[0]);
    Aabb<S> box{v, v};
    for (std::uint32_t i = 1; i < count; ++i) {
      v = pose.apply(vertices[i]);
      box = box.merged(Aabb<S>{v, v});
    }
    return box.expanded(radius);
  }
};

}  // namespace urto

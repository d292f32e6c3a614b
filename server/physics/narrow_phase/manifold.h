#pragma once

#include "physics/definitions.h"
#include "physics/geometry/convex.h"

namespace urto {

// Where two convex shapes touch or nearly touch, in the frame of the first.
//
//        b
//   +---------+
//   |  p0 p1  |      normal: unit, from a to b
//   +---x---x-+      points: midway between the two surfaces
//   +---x---x----+   separation: metres along the normal, negative if penetrating
//   |      a     |
struct ManifoldIds {
  static constexpr std::uint32_t kFlip = 1u << 16;     // the reference face is b's
  static constexpr std::uint32_t kCorners = 1u << 15;  // a corner against a corner: there is no face
};

template <class S>
struct LocalManifold {
  struct Point {
    Vec<S> p = Vec<S>::Zero();
    S separation = 0;
    std::uint32_t id = 0;  // reference edge, incident vertex, and which of the two is the reference
  };
  Vec<S> normal = Vec<S>::Zero();
  Point points[2];
  int count = 0;

  void add_point(const Vec<S>& p, S separation, std::uint32_t id) { points[count++] = {p, separation, id}; }
};

// Points further apart than `reach` (m ≥ 0) are left out. b_in_a: the frame of b as seen from a. With kGjk the normal
// and the depth of polygons come from GJK and the expanding polytope instead of SAT; points are clipped alike.
template <class S>
LocalManifold<S> collide(const Convex<S>& a, const Convex<S>& b, const Transform<S>& b_in_a, S reach,
                         NarrowPhaseKind kind);

// The face of a against which b (given in a's frame) is separated most, and by how much: the step of SAT.
template <class S>
struct FaceSeparation {
  std::uint32_t face = 0;
  S separation = 0;
};
template <class S>
FaceSeparation<S> max_face_separation(const Convex<S>& a, const Convex<S>& b_placed);

// Contact points of the edge of `other` that looks most against a face of `reference`, both in one frame. `flip`: the
// reference is the second of the pair, and the normal is turned to point from the first.
template <class S>
LocalManifold<S> clip_to_face(const Convex<S>& reference, std::uint32_t face, const Convex<S>& other, S reach,
                              bool flip);

// b's outline moved into a's frame.
template <class S>
Convex<S> placed(const Convex<S>& b, const Transform<S>& b_in_a);

}  // namespace urto

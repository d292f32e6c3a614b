#pragma once

#include "physics/geometry/convex.h"

namespace urto {

template <class S>
struct ConvexRayHit {
  bool hit = false;
  S fraction = 0;                  // of the translation, [0, 1]; 0 if it starts inside
  Vec<S> normal = Vec<S>::Zero();  // unit, out of the shape; zero if it starts inside
};

// The segment origin → origin + translation against a convex shape, all in the shape's body frame.
template <class S>
ConvexRayHit<S> ray_cast(const Convex<S>& shape, const Vec<S>& origin, const Vec<S>& translation);

template <class S>
bool contains_point(const Convex<S>& shape, const Vec<S>& point);

}  // namespace urto

#pragma once

#include <cstdint>

#include "physics/body.h"
#include "physics/geometry/aabb.h"
#include "physics/geometry/convex.h"

namespace urto {

// A rounded box is a polygon: what is known of boxes holds for sharp ones.
enum class ShapeKind : std::uint32_t { kCircle, kBox, kPolygon, kCapsule, kChainSegment };

enum ShapeFlag : std::uint32_t {
  kShapeAlive = 1u << 0,
  kShapeSensor = 1u << 1,
  kShapeMoved = 1u << 2,  // waits in the list of moved proxies
  // What makes a place cheap: the centroid is the body's centre of mass; the axes of a box are the body's.
  kShapeCentred = 1u << 3,
  kShapeUpright = 1u << 4,
};

// A convex shape of a body: what pairs and contacts need of it. Its outline is the Convex of the same slot.
template <class S>
struct Shape {
  std::uint32_t body = kNone;
  std::uint32_t next = kNone;  // of the same body
  std::uint32_t kind = 0;      // ShapeKind
  std::uint32_t flags = 0;
  std::uint32_t category = 1, mask = 0xffffffffu;
  S friction = 0, restitution = 0;
  S reach = 0;                        // m, speculative distance
  S margin = 0;                       // m, of the fat bounds
  S half_width = 0, half_height = 0;  // m, boxes: in the convex's own axes
  Aabb<S> fat;                        // as the broad phase knows it

  ShapeKind shape_kind() const { return static_cast<ShapeKind>(kind); }
  bool alive() const { return (flags & kShapeAlive) != 0; }
  bool sensor() const { return (flags & kShapeSensor) != 0; }
};

static_assert(sizeof(Shape<float>) == 6 * 4 + 10 * 4 && sizeof(Shape<double>) == 6 * 4 + 10 * 8);
static_assert(sizeof(Convex<float>) == 34 * 4 + 3 * 4 && sizeof(Convex<double>) == 34 * 8 + 16);

template <class S>
inline bool filters_touch(const Shape<S>& a, const Shape<S>& b) {
  return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

}  // namespace urto

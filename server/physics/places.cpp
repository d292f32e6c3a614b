#include "physics/places.h"

#include <cmath>

#include "physics/constants.h"
#include "physics/data.h"

namespace urto {
namespace {

// m, of the disc around the centroid that holds the shape; 0 if so much of the disc is empty that it says little.
template <class S>
S disc_around(const Convex<S>& convex) {
  S most2 = 0, least = convex.count > 1 ? S(kCoordinateMax) : S(0);
  for (std::uint32_t i = 0; i < convex.count; ++i) {
    const Vec<S> arm = convex.vertices[i] - convex.centroid;
    most2 = max_of(most2, dot(arm, arm));
    least = min_of(least, dot(convex.normals[i], arm));
  }
  const S disc = std::sqrt(most2) + convex.radius;
  return least + convex.radius > S(kNearlyRound) * disc ? disc : S(0);
}

template <class S>
Place<S> place_of(const WorldData<S>& world, const Body<S>& body, const Motion<S>& motion, Proxy proxy) {
  const Shape<S>& shape = world.shapes[proxy];
  const S time_step = S(world.settings.time_step);
  Place<S> place;
  place.x = body.x;
  place.y = body.y;
  if ((shape.flags & kShapeCentred) == 0) {
    const Vec<S> offset = body.rotation().apply(world.convexes[proxy].centroid - body.local_center());
    place.offset_x = offset.x();
    place.offset_y = offset.y();
    place.x += offset.x();
    place.y += offset.y();
  }
  place.reach = shape.reach;
  // What closes in by more than half a thickness is the business of continuous collision.
  place.bound = body.dynamic() ? S(0.5) * body.extent_min : S(kCoordinateMax);
  if (body.dynamic()) place.turn = absolute(motion.w) * body.extent_max * time_step;
  place.way_x = motion.vx * time_step;
  place.way_y = motion.vy * time_step;
  place.c = body.c;
  place.s = body.s;
  const bool sat = world.settings.narrow_phase == NarrowPhaseKind::kSat;
  if (shape.shape_kind() != ShapeKind::kBox) {
    const Convex<S>& convex = world.convexes[proxy];
    const bool sharp = shape.shape_kind() == ShapeKind::kPolygon && convex.radius == S(0);
    place.half_width = convex.radius;
    if (!sat || convex.chain_segment()) return place;
    place.vertices = sharp ? S(convex.count) : -S(convex.count);
    place.half_height = -disc_around(convex);
    return place;
  }
  const bool upright = (shape.flags & kShapeUpright) != 0;
  if (!upright) {
    // The box's own axis: the normal of its face to the right.
    const Vec<S> axis = body.rotation().apply(world.convexes[proxy].normals[1]);
    place.c = axis.x();
    place.s = axis.y();
  }
  place.half_width = shape.half_width;
  place.half_height = shape.half_height;
  place.box = sat ? S(1) : S(0);
  if (upright && sat) place.vertices = S(4);
  return place;
}

}  // namespace

template <class S>
void refresh_places(WorldData<S>& world, std::uint32_t slot) {
  const Body<S>& body = world.bodies[slot];
  world.places.resize(world.shapes.size());
  for (Proxy p = body.first_shape; p != kNone; p = world.shapes[p].next)
    world.places[p] = place_of(world, body, world.motions[slot], p);
}

template void refresh_places(WorldData<float>&, std::uint32_t);
template void refresh_places(WorldData<double>&, std::uint32_t);

}  // namespace urto

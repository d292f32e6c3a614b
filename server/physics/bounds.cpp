#include "physics/bounds.h"

#include "physics/contact_graph.h"

namespace urto {
namespace {

template <class S>
Aabb<S> tight_bounds(const Shape<S>& shape, const Convex<S>& convex, const Transform<S>& pose) {
  if (shape.shape_kind() != ShapeKind::kBox && shape.shape_kind() != ShapeKind::kCircle) return convex.bounds(pose);
  const Vec<S> center = pose.apply(convex.centroid);
  S ex = convex.radius, ey = convex.radius;
  if (shape.shape_kind() == ShapeKind::kBox) {
    // The box's own axis in the world: the normal of its first face, turned.
    const Vec<S> axis = pose.q.apply(convex.normals[1]);
    const S ax = absolute(axis.x()), ay = absolute(axis.y());
    ex = ax * shape.half_width + ay * shape.half_height;
    ey = ay * shape.half_width + ax * shape.half_height;
  }
  return {Vec<S>(center.x() - ex, center.y() - ey), Vec<S>(center.x() + ex, center.y() + ey)};
}

template <class S>
bool may_touch(const WorldData<S>& world, const Shape<S>& a, const Shape<S>& b) {
  if (a.body == b.body || !filters_touch(a, b)) return false;
  const Body<S>&ba = world.bodies[a.body], &bb = world.bodies[b.body];
  if (ba.dynamic() || bb.dynamic()) return true;
  return a.sensor() || b.sensor();  // a sensor also sees kinematic bodies
}

}  // namespace

template <class S>
Aabb<S> swept_bounds(const WorldData<S>& world, Proxy proxy) {
  const Shape<S>& shape = world.shapes[proxy];
  const Body<S>& body = world.bodies[shape.body];
  Aabb<S> box = tight_bounds(shape, world.convexes[proxy], body.pose());
  if (!body.awake()) return box;
  const Motion<S>& m = world.motions[shape.body];
  const S dx = m.vx * S(world.settings.time_step), dy = m.vy * S(world.settings.time_step);
  (dx < S(0) ? box.lower : box.upper).x() += dx;
  (dy < S(0) ? box.lower : box.upper).y() += dy;
  return box;
}

template <class S>
void mark_moved(WorldData<S>& world, Proxy proxy) {
  Shape<S>& shape = world.shapes[proxy];
  if (shape.flags & kShapeMoved) return;
  shape.flags |= kShapeMoved;
  world.moved.push_back(proxy);
}

template <class S>
void refresh_bounds(WorldData<S>& world, std::uint32_t slot) {
  for (Proxy proxy = world.bodies[slot].first_shape; proxy != kNone; proxy = world.shapes[proxy].next) {
    Shape<S>& shape = world.shapes[proxy];
    const Aabb<S> box = swept_bounds(world, proxy).expanded(shape.reach);
    if (shape.fat.contains(box)) continue;
    shape.fat = box.expanded(shape.margin);
    world.broad_phase->move(proxy, shape.fat);
    mark_moved(world, proxy);
  }
}

template <class S>
void reset_bounds(WorldData<S>& world, std::uint32_t slot) {
  refresh_places(world, slot);
  for (Proxy proxy = world.bodies[slot].first_shape; proxy != kNone; proxy = world.shapes[proxy].next) {
    Shape<S>& shape = world.shapes[proxy];
    shape.fat = swept_bounds(world, proxy).expanded(shape.reach + shape.margin);
    world.broad_phase->move(proxy, shape.fat);
    mark_moved(world, proxy);
  }
}

template <class S>
void update_broad_phase(WorldData<S>& world) {
  if (world.moved.empty()) return;
  world.broad_phase->find_pairs(world.moved, world.scratch.pairs);
  for (Proxy proxy : world.moved) world.shapes[proxy].flags &= ~kShapeMoved;
  world.moved.clear();
  for (const auto& [low, high] : world.scratch.pairs) {
    if (!may_touch(world, world.shapes[low], world.shapes[high])) continue;
    if (!world.pair_set.contains(low, high)) create_contact(world, low, high);
  }
}

#define URTO_INSTANTIATE(S)                                   \
  template Aabb<S> swept_bounds(const WorldData<S>&, Proxy);  \
  template void mark_moved(WorldData<S>&, Proxy);             \
  template void refresh_bounds(WorldData<S>&, std::uint32_t); \
  template void reset_bounds(WorldData<S>&, std::uint32_t);   \
  template void update_broad_phase(WorldData<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

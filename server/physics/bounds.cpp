#include "physics/bounds.h"

#include "physics/contact_graph.h"
#include "physics/joint_graph.h"

namespace urto {
namespace {

template <class S>
bool may_touch(const WorldData<S>& world, const Shape<S>& a, const Shape<S>& b) {
  if (a.body == b.body || !filters_touch(a, b)) return false;
  const Body<S>&ba = world.bodies[a.body], &bb = world.bodies[b.body];
  if (ba.first_joint != kNoJoint && bb.first_joint != kNoJoint && kept_apart(world, a.body, b.body)) return false;
  if (ba.dynamic() || bb.dynamic()) return true;
  return a.sensor() || b.sensor();  // a sensor also sees kinematic bodies
}

}  // namespace

template <class S>
Aabb<S> tight_bounds(const WorldData<S>& world, Proxy proxy) {
  const Shape<S>& shape = world.shapes[proxy];
  const Place<S>& place = world.places[proxy];
  const ShapeKind kind = shape.shape_kind();
  if (kind != ShapeKind::kBox && kind != ShapeKind::kCircle)
    return world.convexes[proxy].bounds(world.bodies[shape.body].pose());
  S ex, ey;
  if (kind == ShapeKind::kBox) {
    const S ax = absolute(place.c), ay = absolute(place.s);
    ex = ax * place.half_width + ay * place.half_height;
    ey = ay * place.half_width + ax * place.half_height;
  } else {
    ex = ey = world.convexes[proxy].radius;
  }
  return {Vec<S>(place.x - ex, place.y - ey), Vec<S>(place.x + ex, place.y + ey)};
}

template <class S>
Aabb<S> swept_bounds(const WorldData<S>& world, Proxy proxy) {
  const Place<S>& place = world.places[proxy];
  Aabb<S> box = tight_bounds(world, proxy);
  if (!world.bodies[world.shapes[proxy].body].awake()) return box;
  (place.way_x < S(0) ? box.lower : box.upper).x() += place.way_x;
  (place.way_y < S(0) ? box.lower : box.upper).y() += place.way_y;
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
void follow_body(WorldData<S>& world, std::uint32_t slot, std::vector<Proxy>& left) {
  refresh_places(world, slot);
  for (Proxy proxy = world.bodies[slot].first_shape; proxy != kNone; proxy = world.shapes[proxy].next) {
    const Shape<S>& shape = world.shapes[proxy];
    if (!shape.fat.contains(swept_bounds(world, proxy).expanded(shape.reach))) left.push_back(proxy);
  }
}

template <class S>
void refresh_bounds(WorldData<S>& world, Proxy proxy) {
  Shape<S>& shape = world.shapes[proxy];
  shape.fat = swept_bounds(world, proxy).expanded(shape.reach).expanded(shape.margin);
  world.broad_phase->move(proxy, shape.fat);
  mark_moved(world, proxy);
}

template <class S>
void reset_bounds(WorldData<S>& world, std::uint32_t slot) {
  refresh_places(world, slot);
  for (Proxy proxy = world.bodies[slot].first_shape; proxy != kNone; proxy = world.shapes[proxy].next)
    refresh_bounds(world, proxy);
}

template <class S>
void update_broad_phase(WorldData<S>& world) {
  if (world.moved.empty()) return;
  world.broad_phase->find_new_pairs(world.moved, world.scratch.pairs);
  for (Proxy proxy : world.moved) world.shapes[proxy].flags &= ~kShapeMoved;
  world.moved.clear();
  for (const auto& [low, high] : world.scratch.pairs) {
    if (!may_touch(world, world.shapes[low], world.shapes[high])) continue;
    if (!world.pair_set.contains(low, high)) create_contact(world, low, high);
  }
}

#define URTO_INSTANTIATE(S)                                                     \
  template Aabb<S> tight_bounds(const WorldData<S>&, Proxy);                    \
  template Aabb<S> swept_bounds(const WorldData<S>&, Proxy);                    \
  template void mark_moved(WorldData<S>&, Proxy);                               \
  template void follow_body(WorldData<S>&, std::uint32_t, std::vector<Proxy>&); \
  template void refresh_bounds(WorldData<S>&, Proxy);                           \
  template void reset_bounds(WorldData<S>&, std::uint32_t);                     \
  template void update_broad_phase(WorldData<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

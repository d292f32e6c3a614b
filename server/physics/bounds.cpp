#include "physics/bounds.h"

#include "physics/constants.h"
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

// Boxes and circles need no outline.
template <class S>
bool has_outline(const Shape<S>& shape) {
  return shape.shape_kind() != ShapeKind::kBox && shape.shape_kind() != ShapeKind::kCircle;
}

template <class S>
Aabb<S> bounds_around(const WorldData<S>& world, Proxy proxy, const Vec<S>& center, const Rotation<S>& axis) {
  const Place<S>& place = world.places[proxy];
  Vec<S> extent;
  if (world.shapes[proxy].shape_kind() == ShapeKind::kBox) {
    const S c = absolute(axis.c), s = absolute(axis.s);
    extent = Vec<S>(c * place.half_width + s * place.half_height, c * place.half_height + s * place.half_width);
  } else {
    extent = Vec<S>::Constant(world.convexes[proxy].radius);
  }
  return {center - extent, center + extent};
}

// Of a shape at the end of its body's motion.
template <class S>
Aabb<S> bounds_after_motion(const WorldData<S>& world, Proxy proxy) {
  const Shape<S>& shape = world.shapes[proxy];
  const Body<S>& body = world.bodies[shape.body];
  const Motion<S>& m = world.motions[shape.body];
  const Rotation<S> turn{m.c, m.s};
  const Vec<S> center(body.x + m.dx, body.y + m.dy);
  if (has_outline(shape)) {
    const Rotation<S> q = turn.times(body.rotation());
    return world.convexes[proxy].bounds({center - q.apply(body.local_center()), q});
  }
  const Place<S>& place = world.places[proxy];
  return bounds_around<S>(world, proxy, center + turn.apply(Vec<S>(place.offset_x, place.offset_y)),
                          turn.times({place.c, place.s}));
}

}  // namespace

template <class S>
Aabb<S> tight_bounds(const WorldData<S>& world, Proxy proxy) {
  const Shape<S>& shape = world.shapes[proxy];
  const Place<S>& place = world.places[proxy];
  if (has_outline(shape)) {
    return world.convexes[proxy].bounds(world.bodies[shape.body].pose());
  }
  return bounds_around<S>(world, proxy, Vec<S>(place.x, place.y), {place.c, place.s});
}

template <class S>
Aabb<S> way_bounds(const WorldData<S>& world, Proxy proxy) {
  const std::uint32_t slot = world.shapes[proxy].body;
  const Body<S>& body = world.bodies[slot];
  const Motion<S>& m = world.motions[slot];
  const S turn = absolute(m.da);
  if (turn > S(1)) {
    const Vec<S> from = body.center(), to = from + Vec<S>(m.dx, m.dy);
    return Aabb<S>{from, from}.merged(Aabb<S>{to, to}).expanded(body.extent_max);
  }
  // A point on an arc is no further from the chord than r(1 − cos(turn/2)).
  return tight_bounds(world, proxy)
      .merged(bounds_after_motion(world, proxy))
      .expanded(S(0.125) * turn * turn * body.extent_max);
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

// Whether the bounds that the broad phase knows hold the shape and its way to come, its reach included.
template <class S>
bool still_bounded(const WorldData<S>& world, const Body<S>& body, Proxy proxy) {
  const Shape<S>& shape = world.shapes[proxy];
  if (has_outline(shape) && (shape.flags & kShapeCentred) != 0) {
    // The disc around a body is known at once; most outlines need not be gone round.
    const Place<S>& place = world.places[proxy];
    const S extent = body.extent_max + shape.reach;
    const Vec<S> from(place.x, place.y), to(place.x + place.way_x, place.y + place.way_y);
    if (shape.fat.contains(Aabb<S>{from, from}.merged(Aabb<S>{to, to}).expanded(extent))) return true;
  }
  return shape.fat.contains(swept_bounds(world, proxy).expanded(shape.reach));
}

template <class S>
void fatten(WorldData<S>& world, Proxy proxy) {
  Shape<S>& shape = world.shapes[proxy];
  shape.fat = swept_bounds(world, proxy).expanded(shape.reach).expanded(shape.margin);
}

template <class S>
void follow_body(WorldData<S>& world, std::uint32_t slot, std::vector<Proxy>& left) {
  refresh_places(world, slot);
  const Body<S>& body = world.bodies[slot];
  for (Proxy proxy = body.first_shape; proxy != kNone; proxy = world.shapes[proxy].next) {
    if (still_bounded(world, body, proxy)) continue;
    fatten(world, proxy);
    left.push_back(proxy);
  }
}

template <class S>
void announce_bounds(WorldData<S>& world, Proxy proxy) {
  world.broad_phase->move(proxy, world.shapes[proxy].fat);
  mark_moved(world, proxy);
}

template <class S>
void refresh_bounds(WorldData<S>& world, Proxy proxy) {
  fatten(world, proxy);
  announce_bounds(world, proxy);
}

template <class S>
void reset_bounds(WorldData<S>& world, std::uint32_t slot) {
  refresh_places(world, slot);
  for (Proxy proxy = world.bodies[slot].first_shape; proxy != kNone; proxy = world.shapes[proxy].next)
    refresh_bounds(world, proxy);
}

// Leaves the pairs that shall have a contact and have none.
template <class S>
void drop_known_pairs(WorldData<S>& world) {
  auto& pairs = world.scratch.pairs;
  std::vector<std::uint8_t>& wanted = world.scratch.findings;
  wanted.resize(pairs.size());
  world.team->share(pairs.size(), kPairsPerShare, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [low, high] = pairs[i];
      wanted[i] = may_touch(world, world.shapes[low], world.shapes[high]) && !world.pair_set.contains(low, high);
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (wanted[i] != 0) pairs[kept++] = pairs[i];
  pairs.resize(kept);
}

template <class S>
void update_broad_phase(WorldData<S>& world) {
  if (world.moved.empty()) return;
  world.broad_phase->find_new_pairs(world.moved, world.scratch.pairs);
  for (Proxy proxy : world.moved) world.shapes[proxy].flags &= ~kShapeMoved;
  world.moved.clear();
  drop_known_pairs(world);
  for (const auto& [low, high] : world.scratch.pairs) create_contact(world, low, high);
}

#define URTO_INSTANTIATE(S)                                                     \
  template Aabb<S> tight_bounds(const WorldData<S>&, Proxy);                    \
  template Aabb<S> swept_bounds(const WorldData<S>&, Proxy);                    \
  template Aabb<S> way_bounds(const WorldData<S>&, Proxy);                      \
  template void mark_moved(WorldData<S>&, Proxy);                               \
  template void follow_body(WorldData<S>&, std::uint32_t, std::vector<Proxy>&); \
  template void announce_bounds(WorldData<S>&, Proxy);                          \
  template void refresh_bounds(WorldData<S>&, Proxy);                           \
  template void reset_bounds(WorldData<S>&, std::uint32_t);                     \
  template void update_broad_phase(WorldData<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

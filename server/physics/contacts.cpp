#include "physics/contacts.h"

#include "physics/constants.h"
#include "physics/contact_graph.h"
#include "physics/narrow_phase/manifold.h"

namespace urto {
namespace {

template <class S>
void carry_over(const ManifoldPoint<S>* old, std::uint32_t old_count, ManifoldPoint<S>& point) {
  for (std::uint32_t i = 0; i < old_count; ++i) {
    if (old[i].id != point.id) continue;
    point.normal_impulse = old[i].normal_impulse;
    point.tangent_impulse = old[i].tangent_impulse;
    point.preload = old[i].preload;
    return;
  }
}

template <class S>
void update_manifold(const WorldData<S>& world, Contact<S>& c) {
  const Body<S>&a = world.bodies[c.body_a], &b = world.bodies[c.body_b];
  const Transform<S> pose_a = a.pose(), b_in_a = pose_a.inverse_times(b.pose());
  const S reach = c.sensor() ? S(0) : reach_of(world, c);
  const LocalManifold<S> m =
      collide(world.convexes[c.shape_a], world.convexes[c.shape_b], b_in_a, reach, world.settings.narrow_phase);
  const ManifoldPoint<S> old[2] = {c.points[0], c.points[1]};
  const std::uint32_t old_count = c.count;
  const Vec<S> normal = pose_a.q.apply(m.normal);
  c.nx = normal.x();
  c.ny = normal.y();
  c.count = static_cast<std::uint32_t>(m.count);
  const S abx = b.x - a.x, aby = b.y - a.y;
  for (int i = 0; i < 2; ++i) {
    ManifoldPoint<S>& p = c.points[i];
    p = ManifoldPoint<S>{};
    if (i >= m.count) continue;
    // From a's centre of mass; b's anchor is the same world point from b's.
    const Vec<S> r = pose_a.q.apply(m.points[i].p - a.local_center());
    p.ax = r.x();
    p.ay = r.y();
    p.bx = r.x() - abx;
    p.by = r.y() - aby;
    p.separation = m.points[i].separation;
    p.id = m.points[i].id;
    carry_over(old, old_count, p);
  }
}

// m/s at which the surfaces close in at the first point.
template <class S>
S approach_speed(const WorldData<S>& world, const Contact<S>& c) {
  const Motion<S>&a = world.motions[c.body_a], &b = world.motions[c.body_b];
  const ManifoldPoint<S>& p = c.points[0];
  const S vx = (b.vx - b.w * p.by) - (a.vx - a.w * p.ay), vy = (b.vy + b.w * p.bx) - (a.vy + a.w * p.ax);
  return max_of(S(0), -(vx * c.nx + vy * c.ny));
}

template <class S>
void update_contact(WorldData<S>& world, Contact<S>& c) {
  if (world.settings.solver == SolverKind::kThesis && !c.sensor())
    return;  // it looks for itself, in every sub-iteration
  update_manifold(world, c);
  if (c.count == 0) return;
  if (!c.touching()) c.approach = approach_speed(world, c);
  if (c.sensor()) return;
  // Woken after the loop: waking makes further contacts active.
  if (!world.bodies[c.body_a].awake() && world.bodies[c.body_a].dynamic()) world.scratch.proxies.push_back(c.body_a);
  if (!world.bodies[c.body_b].awake() && world.bodies[c.body_b].dynamic()) world.scratch.proxies.push_back(c.body_b);
}

template <class S>
ContactEvent begin_event(const WorldData<S>& world, const Contact<S>& c) {
  ContactEvent event = end_event(world, c);
  event.kind = ContactEvent::Kind::kBegin;
  const Body<S>& a = world.bodies[c.body_a];
  const ManifoldPoint<S>& p =
      c.count > 1 && c.points[1].separation < c.points[0].separation ? c.points[1] : c.points[0];
  event.point = Vec2(double(a.x + p.ax), double(a.y + p.ay));
  event.normal = Vec2(double(c.nx), double(c.ny));
  event.approach_speed = double(c.approach);
  return event;
}

template <class S>
bool meets(const Contact<S>& c) {
  for (std::uint32_t i = 0; i < c.count; ++i)
    if (c.points[i].separation <= S(0) || c.points[i].total_normal_impulse > S(0)) return true;
  return false;
}

}  // namespace

template <class S>
S reach_of(const WorldData<S>& world, const Contact<S>& c) {
  const Shape<S>&a = world.shapes[c.shape_a], &b = world.shapes[c.shape_b];
  const Body<S>&ba = world.bodies[c.body_a], &bb = world.bodies[c.body_b];
  const Motion<S>&ma = world.motions[c.body_a], &mb = world.motions[c.body_b];
  const S reach = min_of(a.reach, b.reach);
  const S dvx = mb.vx - ma.vx, dvy = mb.vy - ma.vy;
  const S turning = absolute(ma.w) * ba.extent_max * S(ba.dynamic()) + absolute(mb.w) * bb.extent_max * S(bb.dynamic());
  const S way = (std::sqrt(dvx * dvx + dvy * dvy) + turning) * S(world.settings.time_step);
  // What closes in by more than half a thickness is the business of continuous collision.
  S bound = S(kCoordinateMax);
  if (ba.dynamic()) bound = min_of(bound, ba.extent_min);
  if (bb.dynamic()) bound = min_of(bound, bb.extent_min);
  return reach + min_of(way, S(0.5) * bound);
}

template <class S>
void update_contacts(WorldData<S>& world) {
  std::vector<Proxy>& to_wake = world.scratch.proxies;
  to_wake.clear();
  // Backwards: destroying swaps the last active contact into the hole, and that one has been seen.
  for (std::size_t i = world.active.size(); i-- > 0;) {
    const std::uint32_t slot = world.active[i];
    Contact<S>& c = world.contacts[slot];
    if (!world.shapes[c.shape_a].fat.overlaps(world.shapes[c.shape_b].fat)) {
      destroy_contact(world, slot);
    } else {
      update_contact(world, c);
    }
  }
  for (std::uint32_t slot : to_wake) wake_body(world, slot);
}

template <class S>
void report_contact_events(WorldData<S>& world) {
  for (std::uint32_t slot : world.active) {
    Contact<S>& c = world.contacts[slot];
    const bool meeting = meets(c);
    if (meeting == c.touching()) continue;
    c.flags ^= kContactTouching;
    world.events.push_back(meeting ? begin_event(world, c) : end_event(world, c));
  }
}

#define URTO_INSTANTIATE(S)                           \
  template void update_contacts(WorldData<S>&);       \
  template void report_contact_events(WorldData<S>&); \
  template S reach_of(const WorldData<S>&, const Contact<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

#include "physics/hits.h"

#include "physics/contact_graph.h"

namespace urto {
namespace {

// The fastest point of a blow; its speed is 0 if there is none.
template <class S>
struct Blow {
  std::uint32_t point = 0;
  S speed = 0;  // m/s

  void consider(std::uint32_t i, S closing, S impulse, S speed_min) {
    if (!(impulse > S(0)) || !(closing > speed_min) || !(closing > speed)) return;
    point = i;
    speed = closing;
  }
};

template <class S>
void report(WorldData<S>& world, std::uint32_t slot, const Blow<S>& blow) {
  std::uint32_t& flags = world.contacts[slot].flags;
  const bool again = (flags & kContactStruck) != 0;
  if (!(blow.speed > S(0))) {
    flags &= ~kContactStruck;
    return;
  }
  flags |= kContactStruck;
  if (again) return;
  const Contact<S> c = settled(world, slot);
  const Body<S>& a = world.bodies[c.body_a];
  const ManifoldPoint<S>& p = c.points[blow.point];
  ContactEvent event = end_event(world, c);
  event.kind = ContactEvent::Kind::kHit;
  // The manifold's point was midway between the surfaces when the step began; a's has come to where they met.
  event.point =
      Vec2(double(a.x + p.ax - S(0.5) * p.separation * c.nx), double(a.y + p.ay - S(0.5) * p.separation * c.ny));
  event.normal = Vec2(double(c.nx), double(c.ny));
  event.approach_speed = double(blow.speed);
  world.events.push_back(event);
}

template <class S>
void report_lanes(WorldData<S>& world, S speed_min) {
  for (auto& color : world.touching.colors) {
    for (std::size_t i = 0; i < color.blocks.size(); ++i) {
      const ContactBlock<S>& block = color.blocks[i];
      const ContactBlockRest<S>& rest = color.rest[i];
      for (std::uint32_t lane = 0; lane < block.count; ++lane) {
        Blow<S> blow;
        for (std::uint32_t k = 0; k < 2; ++k)
          blow.consider(k, -rest.approach[k][lane], block.points[k].total_normal_impulse[lane], speed_min);
        report(world, rest.contact[lane], blow);
      }
    }
  }
}

// Contacts of the precise solver have no lanes. What is known of their speed is that of the first point.
template <class S>
void report_active(WorldData<S>& world, S speed_min) {
  for (const ActiveContact& active : world.active) {
    if (active.sensor) continue;
    const Contact<S>& c = world.contacts[active.contact];
    Blow<S> blow;
    for (std::uint32_t k = 0; k < c.count; ++k)
      blow.consider(k, c.approach, c.points[k].total_normal_impulse, speed_min);
    report(world, active.contact, blow);
  }
}

}  // namespace

template <class S>
void report_hits(WorldData<S>& world) {
  const S speed_min = S(world.settings.hit_events->speed_min);
  if (world.settings.solver == SolverKind::kSoftStep) {
    report_lanes(world, speed_min);
  } else {
    report_active(world, speed_min);
  }
}

#define URTO_INSTANTIATE(S) template void report_hits(WorldData<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

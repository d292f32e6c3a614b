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

// A contact keeps the step of its last blow in its flags, so that one that is not struck need not be looked at. The
// numbers come again after three days at 60 Hz; a hit would be lost if a contact were struck just then, and then only.
constexpr std::uint32_t kStepShift = 8;
constexpr std::uint64_t kStepMask = 0xffffffu;

std::uint32_t struck_at(std::uint64_t step) {
  return kContactStruck | (static_cast<std::uint32_t>(step & kStepMask) << kStepShift);
}

// Takes note of a blow in this step; whether it is the first of it.
bool note_blow(std::uint32_t& flags, std::uint64_t step) {
  const std::uint32_t mask = struck_at(kStepMask);
  const bool goes_on = (flags & mask) == struck_at(step - 1);
  flags = (flags & ~mask) | struck_at(step);
  return !goes_on;
}

template <class S>
void report(WorldData<S>& world, std::uint32_t slot, const Blow<S>& blow) {
  if (!(blow.speed > S(0)) || !note_blow(world.contacts[slot].flags, world.step_count)) return;
  const Contact<S> c = settled(world, slot);
  const Body<S>& a = world.bodies[c.body_a];
  const ManifoldPoint<S>& p = c.points[blow.point];
  ContactEvent event = end_event(world, c);
  event.kind = ContactEvent::Kind::kHit;
  // The manifold's point was midway between the surfaces when the step began; a's has come to where they met.
  const S back = S(0.5) * p.separation;
  event.point = Vec2(double(a.x + p.ax - back * c.nx), double(a.y + p.ay - back * c.ny));
  event.normal = Vec2(double(c.nx), double(c.ny));
  event.approach_speed = double(blow.speed);
  world.events.push_back(event);
}

// Whether any lane may be struck: most blocks rest, and this is a few vector operations.
template <class S>
bool strikes(const ContactBlock<S>& block, const ContactBlockRest<S>& rest, S speed_min) {
  unsigned any = 0;
  for (int k = 0; k < 2; ++k)
    for (std::size_t lane = 0; lane < kLanes<S>; ++lane)
      any |=
          unsigned(rest.approach[k][lane] < -speed_min) & unsigned(block.points[k].total_normal_impulse[lane] > S(0));
  return any != 0;
}

template <class S>
void report_lanes(WorldData<S>& world, S speed_min) {
  for (auto& color : world.touching.colors) {
    for (std::size_t i = 0; i < color.blocks.size(); ++i) {
      const ContactBlock<S>& block = color.blocks[i];
      const ContactBlockRest<S>& rest = color.rest[i];
      if (!strikes(block, rest, speed_min)) continue;
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

#include "physics/contact_counts.h"

#include "physics/contact_set.h"

namespace urto {
namespace {

// Of all functions here: the least separation, m, or 0 if none is negative.

// Of the used lanes. A second point that is not there is far away.
template <class S>
S least_of_lanes(const ContactSet<S>& touching) {
  S least[kLanes<S>] = {};
  for (const auto& color : touching.colors)
    for (const ContactBlock<S>& block : color.blocks)
      for (const PointLanes<S>& points : block.points)
        for (std::uint32_t lane = 0; lane < block.count; ++lane)
          least[lane] = points.separation[lane] < least[lane] ? points.separation[lane] : least[lane];
  S out = S(0);
  for (const S lane : least) out = min_of(out, lane);
  return out;
}

template <class S>
S least_of_record(const Contact<S>& c) {
  S least = S(0);
  for (std::uint32_t i = 0; i < c.count && !c.sensor(); ++i) least = min_of(least, c.points[i].separation);
  return least;
}

// Of the records that `wanted` asks for.
template <class S, class Wanted>
S least_of_records(const WorldData<S>& world, const Wanted& wanted) {
  S least = S(0);
  for (const Contact<S>& c : world.contacts)
    if (c.alive() && wanted(c)) least = min_of(least, least_of_record(c));
  return least;
}

// Of the contacts that sleep: they keep their points, so it is looked for only when others sleep than before.
template <class S>
S least_at_rest(const WorldData<S>& world) {
  if (!world.resting_depth)
    world.resting_depth = least_of_records(world, [](const Contact<S>& c) { return c.index == kNone; });
  return *world.resting_depth;
}

template <class S>
S least_separation(const WorldData<S>& world) {
  if (world.settings.solver != SolverKind::kSoftStep || !world.touching.current)
    return least_of_records(world, [](const Contact<S>&) { return true; });
  return min_of(least_of_lanes(world.touching), least_at_rest(world));
}

}  // namespace

template <class S>
void count_contacts(const WorldData<S>& world, Counters& counters) {
  counters.pairs = static_cast<std::uint32_t>(world.contacts.size() - world.free_contacts.size());
  counters.contacts = world.touching_count;
  const S least = least_separation(world);
  counters.penetration_max = least < S(0) ? -double(least) : 0;
}

template void count_contacts(const WorldData<float>&, Counters&);
template void count_contacts(const WorldData<double>&, Counters&);

}  // namespace urto

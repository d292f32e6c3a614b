#include "physics/contact_counts.h"

#include "physics/contact_set.h"

namespace urto {
namespace {

// The least separation of any used lane, m, or 0 if none is negative. A second point that is not there is far away.
template <class S>
S least_separation(const ContactSet<S>& touching) {
  S least = S(0);
  for (const auto& color : touching.colors)
    for (const ContactBlock<S>& block : color.blocks)
      for (const PointLanes<S>& points : block.points)
        for (std::uint32_t lane = 0; lane < block.count; ++lane) least = min_of(least, points.separation[lane]);
  return least;
}

}  // namespace

template <class S>
void count_contacts(const WorldData<S>& world, Counters& counters) {
  counters.pairs = static_cast<std::uint32_t>(world.contacts.size() - world.free_contacts.size());
  counters.contacts = 0;
  const bool lanes_are_current = world.touching.current;
  S least = lanes_are_current ? least_separation(world.touching) : S(0);
  for (const Contact<S>& c : world.contacts) {
    if (!c.alive()) continue;
    counters.contacts += c.touching();
    if (c.sensor() || (c.has_lane() && lanes_are_current)) continue;
    for (std::uint32_t i = 0; i < c.count; ++i) least = min_of(least, c.points[i].separation);
  }
  counters.penetration_max = least < S(0) ? -double(least) : 0;
}

template void count_contacts(const WorldData<float>&, Counters&);
template void count_contacts(const WorldData<double>&, Counters&);

}  // namespace urto

#include "physics/solver/constraint.h"

#include "physics/constants.h"

namespace urto {
namespace {

constexpr std::uint32_t kMovableColors = kColorsMax / 2;  // the other half is for contacts with unmovable bodies

// A colour that neither body has yet; the last of its kind when all are taken.
std::uint32_t first_free(std::uint64_t taken, std::uint32_t begin, std::uint32_t end) {
  const std::uint64_t kind = (end < 64 ? (1ull << end) : 0ull) - (1ull << begin);
  const std::uint64_t free = ~taken & kind;
  return free == 0 ? end - 1 : static_cast<std::uint32_t>(__builtin_ctzll(free));
}

template <class S>
std::uint32_t color_of(WorldData<S>& world, const Contact<S>& c) {
  std::vector<std::uint64_t>& taken = world.scratch.colors;
  const bool movable_a = world.bodies[c.body_a].inv_mass > S(0), movable_b = world.bodies[c.body_b].inv_mass > S(0);
  const std::uint64_t both = (movable_a ? taken[c.body_a] : 0) | (movable_b ? taken[c.body_b] : 0);
  const std::uint32_t color =
      movable_a && movable_b ? first_free(both, 0, kMovableColors) : first_free(both, kMovableColors, kColorsMax);
  if (movable_a) taken[c.body_a] |= 1ull << color;
  if (movable_b) taken[c.body_b] |= 1ull << color;
  return color;
}

bool takes_what_fits_nowhere(std::uint32_t color) { return color == kMovableColors - 1 || color == kColorsMax - 1; }

// Counting sort by colour: stable, so that within a colour the order of the active list stays.
// begin: one entry past the last colour too.
template <class S>
void sort_by_color(WorldData<S>& world, ConstraintSet<S>& set, std::uint32_t (&begin)[kColorsMax + 1]) {
  world.scratch.colors.assign(world.bodies.size(), 0);
  set.touching.clear();
  set.colors.clear();
  for (std::uint32_t& b : begin) b = 0;
  for (std::uint32_t slot : world.active) {
    const Contact<S>& c = world.contacts[slot];
    if (c.count == 0 || c.sensor()) continue;
    const std::uint32_t color = color_of(world, c);
    set.touching.push_back(slot);
    set.colors.push_back(static_cast<std::uint8_t>(color));
    ++begin[color + 1];
  }
  for (std::uint32_t c = 0; c < kColorsMax; ++c) begin[c + 1] += begin[c];
  set.sorted.resize(set.touching.size());
  std::uint32_t next[kColorsMax];
  for (std::uint32_t c = 0; c < kColorsMax; ++c) next[c] = begin[c];
  for (std::size_t i = 0; i < set.touching.size(); ++i) set.sorted[next[set.colors[i]]++] = set.touching[i];
}

template <class S>
void put_point(PointLanes<S>& lanes, int lane, const ManifoldPoint<S>& p) {
  lanes.ax[lane] = p.ax;
  lanes.ay[lane] = p.ay;
  lanes.bx[lane] = p.bx;
  lanes.by[lane] = p.by;
  lanes.separation[lane] = p.separation;
  lanes.normal_impulse[lane] = p.normal_impulse;
  lanes.tangent_impulse[lane] = p.tangent_impulse;
  lanes.preload[lane] = p.preload;
  lanes.total_normal_impulse[lane] = S(0);
  lanes.total_tangent_impulse[lane] = S(0);
}

template <class S>
void put_contact(const WorldData<S>& world, ContactBlock<S>& block, std::uint32_t slot) {
  const Contact<S>& c = world.contacts[slot];
  const Body<S>&a = world.bodies[c.body_a], &b = world.bodies[c.body_b];
  const int lane = static_cast<int>(block.count++);
  block.a[lane] = c.body_a;
  block.b[lane] = c.body_b;
  block.contact[lane] = slot;
  block.movable_a[lane] = a.inv_mass > S(0);
  block.movable_b[lane] = b.inv_mass > S(0);
  block.nx[lane] = c.nx;
  block.ny[lane] = c.ny;
  block.friction[lane] = c.friction;
  block.restitution[lane] = c.restitution;
  block.inv_mass_a[lane] = a.inv_mass;
  block.inv_inertia_a[lane] = a.inv_inertia;
  block.inv_mass_b[lane] = b.inv_mass;
  block.inv_inertia_b[lane] = b.inv_inertia;
  block.two[lane] = c.count == 2 ? S(1) : S(0);
  put_point(block.points[0], lane, c.points[0]);
  put_point(block.points[1], lane, c.points[1]);
}

// Unused lanes compute on zeros and a mass of one, and are not written back.
template <class S>
void start_block(ContactBlock<S>& block) {
  block = ContactBlock<S>{};
  for (int lane = 0; lane < kLanes<S>; ++lane) block.inv_mass_a[lane] = S(1);
}

}  // namespace

template <class S>
Softness<S>::Softness(S hertz, S damping_ratio, S h) {
  const S omega = S(2 * 3.14159265358979323846) * hertz;
  bias_rate = omega / (S(2) * damping_ratio + h * omega);
  compliance = S(1) / (h * omega * (S(2) * damping_ratio + h * omega));
}

template <class S>
void gather_contacts(WorldData<S>& world, ConstraintSet<S>& set) {
  std::uint32_t begin[kColorsMax + 1];
  sort_by_color(world, set, begin);
  std::size_t used = 0;
  const auto next_block = [&]() -> ContactBlock<S>& {
    if (used == set.blocks.size()) set.blocks.emplace_back();
    start_block(set.blocks[used]);
    return set.blocks[used++];
  };
  for (std::uint32_t color = 0; color < kColorsMax; ++color) {
    const std::uint32_t lanes = takes_what_fits_nowhere(color) ? 1u : static_cast<std::uint32_t>(kLanes<S>);
    for (std::uint32_t i = begin[color]; i < begin[color + 1];) {
      ContactBlock<S>& block = next_block();
      for (; i < begin[color + 1] && block.count < lanes; ++i) put_contact(world, block, set.sorted[i]);
    }
  }
  set.blocks.resize(used);
}

template <class S>
void store_impulses(WorldData<S>& world, const ConstraintSet<S>& set) {
  for (const ContactBlock<S>& block : set.blocks) {
    for (std::uint32_t lane = 0; lane < block.count; ++lane) {
      Contact<S>& c = world.contacts[block.contact[lane]];
      for (std::uint32_t i = 0; i < c.count; ++i) {
        const PointLanes<S>& p = block.points[i];
        c.points[i].normal_impulse = p.normal_impulse[lane];
        c.points[i].tangent_impulse = p.tangent_impulse[lane];
        c.points[i].preload = p.preload[lane];
        c.points[i].total_normal_impulse = p.total_normal_impulse[lane];
        c.points[i].total_tangent_impulse = p.total_tangent_impulse[lane];
      }
    }
  }
}

#define URTO_INSTANTIATE(S)                                        \
  template struct Softness<S>;                                     \
  template void gather_contacts(WorldData<S>&, ConstraintSet<S>&); \
  template void store_impulses(WorldData<S>&, const ConstraintSet<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

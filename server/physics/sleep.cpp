#include "physics/sleep.h"

#include <algorithm>

#include "physics/constants.h"
#include "physics/contact_graph.h"

namespace urto {
namespace {

std::uint32_t find_root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

// Calls visit(body a, body b) for each contact with an awake body that has points, and for each joint with one.
template <class S, class Visit>
void for_each_bond(const WorldData<S>& world, Visit&& visit) {
  for (const auto& color : world.touching.colors)
    for (const ContactBlock<S>& block : color.blocks)
      for (std::uint32_t lane = 0; lane < block.count; ++lane) visit(block.a[lane], block.b[lane]);
  // With lanes, only sensors can touch without one.
  const bool lanes = world.settings.solver == SolverKind::kSoftStep;
  for (std::size_t i = 0; i < (lanes ? 0 : world.active.size()); ++i) {
    const ActiveContact& active = world.active[i];
    const Contact<S>& c = world.contacts[active.contact];
    if (c.count > 0 && !c.sensor()) visit(c.body_a, c.body_b);
  }
  for (const std::uint32_t slot : world.active_joints) {
    const Joint<S>& j = world.joints[slot];
    if (j.body_a != kNone) visit(j.body_a, j.body_b);
  }
}

// What an island knows of a body: static ones and sleepers part islands, whatever moves keeps its neighbours awake.
enum Rest : std::uint8_t { kStill, kRestful, kRestless };

template <class S, class Visit>
void for_each_restful(const WorldData<S>& world, Visit&& visit) {
  for (const auto& list : world.scratch.restful)
    for (const std::uint32_t slot : list) visit(slot);
}

template <class S>
void list_rest(WorldData<S>& world) {
  std::vector<std::uint8_t>& rest = world.scratch.rest;
  rest.assign(world.bodies.size(), kStill);
  for (const std::uint32_t slot : world.awake) rest[slot] = kRestless;
  for_each_restful(world, [&](std::uint32_t slot) { rest[slot] = kRestful; });
}

// Joins the restful that touch or are joined, and marks those that something restless touches. Which of them stand for
// their islands depends on no order of contacts.
template <class S>
void join_islands(WorldData<S>& world) {
  std::vector<std::uint32_t>& parent = world.scratch.parent;
  std::vector<std::uint8_t>& kept_awake = world.scratch.kept_awake;
  const std::vector<std::uint8_t>& rest = world.scratch.rest;
  parent.resize(world.bodies.size());
  kept_awake.resize(world.bodies.size());
  for_each_restful(world, [&](std::uint32_t slot) {
    parent[slot] = slot;
    kept_awake[slot] = 0;
  });
  for_each_bond(world, [&](std::uint32_t a, std::uint32_t b) {
    const int both = rest[a] | rest[b] << 2;
    if (both == (kRestful | kRestful << 2)) {
      const std::uint32_t ra = find_root(parent, a), rb = find_root(parent, b);
      parent[ra < rb ? rb : ra] = ra < rb ? ra : rb;
    } else if (both == (kRestful | kRestless << 2)) {
      kept_awake[a] = 1;
    } else if (both == (kRestless | kRestful << 2)) {
      kept_awake[b] = 1;
    }
  });
}

}  // namespace

template <class S>
void update_sleep(WorldData<S>& world) {
  const auto& lists = world.scratch.restful;
  if (std::all_of(lists.begin(), lists.end(), [](const auto& list) { return list.empty(); })) return;
  list_rest(world);
  join_islands(world);
  std::vector<std::uint32_t>& parent = world.scratch.parent;
  std::vector<std::uint8_t>& kept_awake = world.scratch.kept_awake;
  for_each_restful(world, [&](std::uint32_t slot) {
    if (kept_awake[slot] != 0) kept_awake[find_root(parent, slot)] = 1;
  });
  // An island falls asleep as a whole.
  std::vector<std::uint32_t>& tired = world.scratch.stack;
  tired.clear();
  for_each_restful(world, [&](std::uint32_t slot) {
    if (kept_awake[find_root(parent, slot)] == 0) tired.push_back(slot);
  });
  for (std::uint32_t slot : tired) put_to_sleep(world, slot);
}

template void update_sleep(WorldData<float>&);
template void update_sleep(WorldData<double>&);

}  // namespace urto

#include "physics/sleep.h"

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

template <class S>
bool restful(const Body<S>& body) {
  return body.dynamic() && body.sleep_time >= S(kSleepTime);
}

template <class S>
bool anyone_restful(const WorldData<S>& world) {
  for (std::uint32_t slot : world.awake)
    if (restful(world.bodies[slot])) return true;
  return false;
}

// Joins what touches. The smaller index becomes the root, so the grouping does not depend on the order of contacts.
template <class S>
void join_islands(WorldData<S>& world) {
  std::vector<std::uint32_t>& parent = world.scratch.parent;
  parent.resize(world.awake.size());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  for (std::uint32_t slot : world.active) {
    const Contact<S>& c = world.contacts[slot];
    if (c.count == 0 || c.sensor()) continue;
    const Body<S>&a = world.bodies[c.body_a], &b = world.bodies[c.body_b];
    if (!a.dynamic() || !b.dynamic()) continue;
    const std::uint32_t ra = find_root(parent, a.awake_index), rb = find_root(parent, b.awake_index);
    parent[ra < rb ? rb : ra] = ra < rb ? ra : rb;
  }
}

template <class S>
void mark_restless(WorldData<S>& world) {
  std::vector<std::uint8_t>& restless = world.scratch.restless;
  std::vector<std::uint32_t>& parent = world.scratch.parent;
  restless.assign(world.awake.size(), 0);
  for (std::uint32_t i = 0; i < world.awake.size(); ++i)
    if (!restful(world.bodies[world.awake[i]])) restless[find_root(parent, i)] = 1;
  for (std::uint32_t slot : world.active) {
    const Contact<S>& c = world.contacts[slot];
    if (c.count == 0 || c.sensor()) continue;
    const Body<S>&a = world.bodies[c.body_a], &b = world.bodies[c.body_b];
    if (a.dynamic() && b.body_type() == BodyType::kKinematic && b.awake())
      restless[find_root(parent, a.awake_index)] = 1;
    if (b.dynamic() && a.body_type() == BodyType::kKinematic && a.awake())
      restless[find_root(parent, b.awake_index)] = 1;
  }
}

}  // namespace

template <class S>
void update_sleep(WorldData<S>& world) {
  if (!anyone_restful(world)) return;
  join_islands(world);
  mark_restless(world);
  std::vector<std::uint32_t>& tired = world.scratch.stack;
  tired.clear();
  for (std::uint32_t i = 0; i < world.awake.size(); ++i) {
    const std::uint32_t slot = world.awake[i];
    if (world.bodies[slot].dynamic() && !world.scratch.restless[find_root(world.scratch.parent, i)])
      tired.push_back(slot);
  }
  for (std::uint32_t slot : tired) put_to_sleep(world, slot);
}

template void update_sleep(WorldData<float>&);
template void update_sleep(WorldData<double>&);

}  // namespace urto

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

// Calls visit(body a, body b) for each contact with an awake body that has points, and for each joint with one.
template <class S, class Visit>
void for_each_bond(const WorldData<S>& world, Visit&& visit) {
  for (const auto& color : world.touching.colors)
    for (const ContactBlock<S>& block : color.blocks)
      for (std::uint32_t lane = 0; lane < block.count; ++lane) visit(block.a[lane], block.b[lane]);
  for (const ActiveContact& active : world.active) {
    const Contact<S>& c = world.contacts[active.contact];
    if (c.count > 0 && !c.sensor()) visit(c.body_a, c.body_b);
  }
  for (const std::uint32_t slot : world.active_joints) {
    const Joint<S>& j = world.joints[slot];
    if (j.body_a != kNone) visit(j.body_a, j.body_b);
  }
}

// What an island knows of the bodies, by slot: the index of an awake dynamic one among the awake, or one of these.
constexpr std::uint32_t kStill = kNone, kMover = kNone - 1;  // a kinematic body moves; anything else is still

template <class S>
void list_members(WorldData<S>& world) {
  std::vector<std::uint32_t>& member = world.scratch.member;
  member.assign(world.bodies.size(), kStill);
  for (std::uint32_t i = 0; i < world.awake.size(); ++i)
    member[world.awake[i]] = world.bodies[world.awake[i]].dynamic() ? i : kMover;
}

// Joins what touches or is joined. The smaller index becomes the root, so the grouping does not depend on the order of
// contacts.
template <class S>
void join_islands(WorldData<S>& world) {
  std::vector<std::uint32_t>& parent = world.scratch.parent;
  const std::vector<std::uint32_t>& member = world.scratch.member;
  parent.resize(world.awake.size());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  for_each_bond(world, [&](std::uint32_t slot_a, std::uint32_t slot_b) {
    const std::uint32_t a = member[slot_a], b = member[slot_b];
    if (a >= kMover || b >= kMover) return;
    const std::uint32_t ra = find_root(parent, a), rb = find_root(parent, b);
    parent[ra < rb ? rb : ra] = ra < rb ? ra : rb;
  });
}

template <class S>
void mark_restless(WorldData<S>& world) {
  std::vector<std::uint8_t>& restless = world.scratch.restless;
  std::vector<std::uint32_t>& parent = world.scratch.parent;
  const std::vector<std::uint32_t>& member = world.scratch.member;
  restless.assign(world.awake.size(), 0);
  for (std::uint32_t i = 0; i < world.awake.size(); ++i)
    if (!restful(world.bodies[world.awake[i]])) restless[find_root(parent, i)] = 1;
  for_each_bond(world, [&](std::uint32_t slot_a, std::uint32_t slot_b) {
    const std::uint32_t a = member[slot_a], b = member[slot_b];
    if (a == kMover && b < kMover) restless[find_root(parent, b)] = 1;
    if (b == kMover && a < kMover) restless[find_root(parent, a)] = 1;
  });
}

}  // namespace

template <class S>
void update_sleep(WorldData<S>& world) {
  if (!anyone_restful(world)) return;
  list_members(world);
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

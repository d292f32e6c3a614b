#include "physics/contact_graph.h"

#include <cmath>

#include "physics/joint_graph.h"

namespace urto {
namespace {

template <class S>
S mix(Mixing mixing, S a, S b) {
  switch (mixing) {
    case Mixing::kGeometricMean:
      return std::sqrt(a * b);
    case Mixing::kMaximum:
      return max_of(a, b);
    case Mixing::kMinimum:
      return min_of(a, b);
    case Mixing::kAverage:
      return S(0.5) * (a + b);
  }
  return a;
}

template <class S>
void link_edge(WorldData<S>& world, std::uint32_t contact, std::uint32_t side, std::uint32_t body) {
  Contact<S>& c = world.contacts[contact];
  Body<S>& b = world.bodies[body];
  const std::uint32_t edge = contact * 2 + side;
  c.prev[side] = kNone;
  c.next[side] = b.first_contact;
  if (b.first_contact != kNone) world.contacts[b.first_contact >> 1].prev[b.first_contact & 1] = edge;
  b.first_contact = edge;
}

template <class S>
void unlink_edge(WorldData<S>& world, std::uint32_t contact, std::uint32_t side, std::uint32_t body) {
  const Contact<S>& c = world.contacts[contact];
  const std::uint32_t next = c.next[side], prev = c.prev[side];
  if (next != kNone) world.contacts[next >> 1].prev[next & 1] = prev;
  if (prev != kNone) {
    world.contacts[prev >> 1].next[prev & 1] = next;
  } else {
    world.bodies[body].first_contact = next;
  }
}

template <class S>
void enlist(WorldData<S>& world, std::uint32_t contact) {
  Contact<S>& c = world.contacts[contact];
  c.index = static_cast<std::uint32_t>(world.active.size());
  world.active.push_back({contact, c.shape_a, c.shape_b, c.sensor() ? 1u : 0u});
}

template <class S>
void delist(WorldData<S>& world, std::uint32_t contact) {
  const std::uint32_t index = world.contacts[contact].index;
  const ActiveContact last = world.active.back();
  world.active[index] = last;
  world.contacts[last.contact].index = index;
  world.active.pop_back();
  world.contacts[contact].index = kNone;
}

template <class S>
void activate(WorldData<S>& world, std::uint32_t contact) {
  const Contact<S>& c = world.contacts[contact];
  if (c.index != kNone) return;
  if (c.count > 0) world.resting_depth.reset();
  if (world.settings.solver == SolverKind::kSoftStep && c.count > 0 && !c.sensor()) {
    insert_lane(world, contact);
  } else {
    enlist(world, contact);
  }
}

template <class S>
void deactivate(WorldData<S>& world, std::uint32_t contact) {
  const Contact<S>& c = world.contacts[contact];
  if (c.has_lane()) {
    remove_lane(world, contact);
  } else if (c.index != kNone) {
    delist(world, contact);
  }
}

template <class S>
void set_resting(WorldData<S>& world, const Body<S>& body) {
  if (!world.broad_phase) return;
  for (Proxy p = body.first_shape; p != kNone; p = world.shapes[p].next)
    world.broad_phase->set_resting(p, !body.awake());
}

template <class S>
void wake_one(WorldData<S>& world, std::uint32_t slot) {
  Body<S>& body = world.bodies[slot];
  body.flags |= kBodyAwake;
  set_resting(world, body);
  body.sleep_time = 0;
  body.awake_index = static_cast<std::uint32_t>(world.awake.size());
  world.awake.push_back(slot);
  for_each_contact_of(world, slot, [&](std::uint32_t contact) { activate(world, contact); });
  activate_joints_of(world, slot);
}

}  // namespace

template <class S>
std::uint32_t create_contact(WorldData<S>& world, Proxy low, Proxy high) {
  std::uint32_t slot;
  if (!world.free_contacts.empty()) {
    slot = world.free_contacts.back();
    world.free_contacts.pop_back();
  } else {
    slot = static_cast<std::uint32_t>(world.contacts.size());
    world.contacts.emplace_back();
  }
  const Shape<S>& a = world.shapes[low];
  const Shape<S>& b = world.shapes[high];
  Contact<S>& c = world.contacts[slot];
  c = Contact<S>{};
  c.shape_a = low;
  c.shape_b = high;
  c.body_a = a.body;
  c.body_b = b.body;
  c.flags = kContactAlive | (a.sensor() || b.sensor() ? kContactSensor : 0u);
  c.friction = mix(world.settings.friction_mixing, a.friction, b.friction);
  c.restitution = mix(world.settings.restitution_mixing, a.restitution, b.restitution);
  link_edge(world, slot, 0, c.body_a);
  link_edge(world, slot, 1, c.body_b);
  world.pair_set.insert(low, high);
  if (world.bodies[c.body_a].awake() || world.bodies[c.body_b].awake()) activate(world, slot);
  return slot;
}

template <class S>
void toggle_touch(WorldData<S>& world, Contact<S>& contact) {
  contact.flags ^= kContactTouching;
  contact.touching() ? ++world.touching_count : --world.touching_count;
}

template <class S>
ContactEvent end_event(const WorldData<S>& world, const Contact<S>& contact) {
  ContactEvent event;
  event.kind = ContactEvent::Kind::kEnd;
  event.body_a = id_of(world, contact.body_a);
  event.body_b = id_of(world, contact.body_b);
  event.sensor = contact.sensor();
  return event;
}

template <class S>
void destroy_contact(WorldData<S>& world, std::uint32_t slot) {
  Contact<S>& c = world.contacts[slot];
  if (c.touching()) {
    toggle_touch(world, c);
    world.events.push_back(end_event(world, c));
  }
  if (c.index == kNone && c.count > 0) world.resting_depth.reset();
  deactivate(world, slot);
  unlink_edge(world, slot, 0, c.body_a);
  unlink_edge(world, slot, 1, c.body_b);
  world.pair_set.erase(c.shape_a, c.shape_b);
  c = Contact<S>{};
  world.free_contacts.push_back(slot);
}

template <class S>
void wake_body(WorldData<S>& world, std::uint32_t first) {
  if (world.bodies[first].body_type() == BodyType::kStatic) return;
  world.bodies[first].sleep_time = 0;
  if (world.bodies[first].awake()) return;
  std::vector<std::uint32_t>& stack = world.scratch.stack;
  stack.assign(1, first);
  wake_one(world, first);
  while (!stack.empty()) {
    const std::uint32_t slot = stack.back();
    stack.pop_back();
    // What is joined to a body moves with it, also with a kinematic one.
    for_each_joint_of(world, slot, [&](std::uint32_t joint) {
      const std::uint32_t other = other_body(world.joints[joint], slot);
      if (other == kNone || !world.bodies[other].dynamic() || world.bodies[other].awake()) return;
      wake_one(world, other);
      stack.push_back(other);
    });
    if (!world.bodies[slot].dynamic()) continue;
    for_each_contact_of(world, slot, [&](std::uint32_t contact) {
      const Contact<S>& c = world.contacts[contact];
      if (c.sensor() || c.count == 0) return;
      const std::uint32_t other = c.body_a == slot ? c.body_b : c.body_a;
      if (!world.bodies[other].dynamic() || world.bodies[other].awake()) return;
      wake_one(world, other);
      stack.push_back(other);
    });
  }
}

template <class S>
void wake_neighbours(WorldData<S>& world, std::uint32_t slot) {
  std::vector<std::uint32_t> others;
  for_each_contact_of(world, slot, [&](std::uint32_t contact) {
    const Contact<S>& c = world.contacts[contact];
    if (c.count > 0 && !c.sensor()) others.push_back(c.body_a == slot ? c.body_b : c.body_a);
  });
  for_each_joint_of(world, slot, [&](std::uint32_t joint) {
    const std::uint32_t other = other_body(world.joints[joint], slot);
    if (other != kNone) others.push_back(other);
  });
  for (std::uint32_t other : others)
    if (world.bodies[other].dynamic()) wake_body(world, other);
}

template <class S>
void put_to_sleep(WorldData<S>& world, std::uint32_t slot) {
  Body<S>& body = world.bodies[slot];
  if (!body.awake()) return;
  const std::uint32_t last = world.awake.back();
  world.awake[body.awake_index] = last;
  world.bodies[last].awake_index = body.awake_index;
  world.awake.pop_back();
  body.awake_index = kNone;
  body.flags &= ~kBodyAwake;
  set_resting(world, body);
  world.motions[slot] = Motion<S>{};
  world.resting_depth.reset();
  for_each_contact_of(world, slot, [&](std::uint32_t contact) {
    const Contact<S>& c = world.contacts[contact];
    const bool active = world.bodies[c.body_a].awake() || world.bodies[c.body_b].awake();
    // What an awake body still touches is looked at anew, so that it wakes this one again.
    if (!active) deactivate(world, contact);
    if (active && c.has_lane() && body.dynamic()) release_lane(world, contact);
  });
  deactivate_joints_of(world, slot);
  refresh_places(world, slot);
}

template <class S>
void give_lane(WorldData<S>& world, std::uint32_t contact) {
  delist(world, contact);
  insert_lane(world, contact);
}

template <class S>
void release_lane(WorldData<S>& world, std::uint32_t contact) {
  remove_lane(world, contact);
  enlist(world, contact);
}

#define URTO_INSTANTIATE(S)                                           \
  template std::uint32_t create_contact(WorldData<S>&, Proxy, Proxy); \
  template void destroy_contact(WorldData<S>&, std::uint32_t);        \
  template void wake_body(WorldData<S>&, std::uint32_t);              \
  template void wake_neighbours(WorldData<S>&, std::uint32_t);        \
  template void put_to_sleep(WorldData<S>&, std::uint32_t);           \
  template void give_lane(WorldData<S>&, std::uint32_t);              \
  template void release_lane(WorldData<S>&, std::uint32_t);           \
  template void toggle_touch(WorldData<S>&, Contact<S>&);             \
  template ContactEvent end_event(const WorldData<S>&, const Contact<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

#include "physics/joint_graph.h"

#include "physics/body_factory.h"
#include "physics/bounds.h"
#include "physics/contact_graph.h"

namespace urto {
namespace {

template <class S>
void link_edge(WorldData<S>& world, std::uint32_t joint, std::uint32_t side, std::uint32_t body) {
  if (body == kNone) return;
  Joint<S>& j = world.joints[joint];
  Body<S>& b = world.bodies[body];
  const std::uint32_t edge = joint * 2 + side + 1;
  j.prev[side] = kNoJoint;
  j.next[side] = b.first_joint;
  if (b.first_joint != kNoJoint) world.joints[(b.first_joint - 1) >> 1].prev[(b.first_joint - 1) & 1] = edge;
  b.first_joint = edge;
}

template <class S>
void unlink_edge(WorldData<S>& world, std::uint32_t joint, std::uint32_t side, std::uint32_t body) {
  if (body == kNone) return;
  const Joint<S>& j = world.joints[joint];
  const std::uint32_t next = j.next[side], prev = j.prev[side];
  if (next != kNoJoint) world.joints[(next - 1) >> 1].prev[(next - 1) & 1] = prev;
  if (prev != kNoJoint) {
    world.joints[(prev - 1) >> 1].next[(prev - 1) & 1] = next;
  } else {
    world.bodies[body].first_joint = next;
  }
}

template <class S>
bool any_awake(const WorldData<S>& world, const Joint<S>& j) {
  const auto awake = [&](std::uint32_t body) { return body != kNone && world.bodies[body].awake(); };
  return awake(j.body_a) || awake(j.body_b);
}

template <class S>
void activate(WorldData<S>& world, std::uint32_t joint) {
  Joint<S>& j = world.joints[joint];
  if (j.active_index != kNone) return;
  j.active_index = static_cast<std::uint32_t>(world.active_joints.size());
  world.active_joints.push_back(joint);
}

template <class S>
void deactivate(WorldData<S>& world, std::uint32_t joint) {
  const std::uint32_t index = world.joints[joint].active_index;
  if (index == kNone) return;
  const std::uint32_t last = world.active_joints.back();
  world.active_joints[index] = last;
  world.joints[last].active_index = index;
  world.active_joints.pop_back();
  world.joints[joint].active_index = kNone;
}

template <class S>
void set_spring(Joint<S>& j, const std::optional<JointSpring>& spring) {
  if (!spring) return;
  j.flags |= kJointSpring;
  j.hertz = S(spring->hertz);
  j.damping_ratio = S(spring->damping_ratio);
}

template <class S>
void set_limits(Joint<S>& j, const std::optional<JointLimits>& limits) {
  if (!limits) return;
  j.flags |= kJointLimited;
  j.lower = S(limits->lower);
  j.upper = S(limits->upper);
}

template <class S>
void set_motor(Joint<S>& j, const std::optional<JointMotor>& motor) {
  if (!motor) return;
  j.flags |= kJointMotor | (motor->enabled ? kJointMotorEnabled : 0u);
  j.motor_speed = S(motor->speed);
  j.motor_bound = S(motor->bound);
}

template <class S>
void set_reference(Joint<S>& j, const std::optional<double>& asked, const Body<S>& a, const Body<S>& b) {
  const S now = wrap_angle(b.angle - a.angle);
  j.reference = asked ? S(*asked) : now;
  j.angle = wrap_angle(now - j.reference);
}

template <class S>
void set_length(Joint<S>& j, const DistanceJoint& def, const Body<S>& a, const Body<S>& b) {
  const Vec<S> pa = a.center() + a.rotation().apply(Vec<S>(j.ax, j.ay));
  const Vec<S> pb = b.center() + b.rotation().apply(Vec<S>(j.bx, j.by));
  j.reference = def.length ? S(*def.length) : length<S>(pb - pa);
  set_spring(j, def.spring);
  set_limits(j, def.limits);
  if (def.spring || def.limits) return;
  j.flags |= kJointLimited;  // a rod: both limits at its length
  j.lower = j.upper = j.reference;
}

template <class S>
void set_geometry(Joint<S>& j, const JointGeometry& geometry, const Body<S>* a, const Body<S>& b) {
  if (const auto* revolute = std::get_if<RevoluteJoint>(&geometry)) {
    set_reference(j, revolute->reference_angle, *a, b);
    set_limits(j, revolute->limits);
    set_motor(j, revolute->motor);
    set_spring(j, revolute->spring);
  } else if (const auto* distance = std::get_if<DistanceJoint>(&geometry)) {
    set_length(j, *distance, *a, b);
  } else if (const auto* prismatic = std::get_if<PrismaticJoint>(&geometry)) {
    const Vec2 axis = prismatic->axis / length<double>(prismatic->axis);
    j.ux = S(axis.x());
    j.uy = S(axis.y());
    set_reference(j, prismatic->reference_angle, *a, b);
    set_limits(j, prismatic->limits);
    set_motor(j, prismatic->motor);
    set_spring(j, prismatic->spring);
  } else if (const auto* weld = std::get_if<WeldJoint>(&geometry)) {
    set_reference(j, weld->reference_angle, *a, b);
    set_spring(j, weld->linear);
    if (weld->angular) {
      j.flags |= kJointAngularSpring;
      j.angular_hertz = S(weld->angular->hertz);
      j.angular_damping_ratio = S(weld->angular->damping_ratio);
    }
  } else {
    const auto& mouse = std::get<MouseJoint>(geometry);
    j.ux = S(mouse.target.x());
    j.uy = S(mouse.target.y());
    j.motor_bound = S(mouse.force_max);
    set_spring(j, std::optional<JointSpring>(mouse.spring));
  }
}

template <class S>
std::uint32_t take_slot(WorldData<S>& world) {
  if (!world.free_joints.empty()) {
    const std::uint32_t slot = world.free_joints.back();
    world.free_joints.pop_back();
    return slot;
  }
  world.joints.emplace_back();
  return static_cast<std::uint32_t>(world.joints.size() - 1);
}

// Contacts between the two end: a joint now keeps them apart.
template <class S>
void end_contacts(WorldData<S>& world, std::uint32_t a, std::uint32_t b) {
  std::vector<std::uint32_t> contacts;
  for_each_contact_of(world, b, [&](std::uint32_t contact) {
    const Contact<S>& c = world.contacts[contact];
    if (c.body_a == a || c.body_b == a) contacts.push_back(contact);
  });
  for (std::uint32_t contact : contacts) destroy_contact(world, contact);
}

// Pairs of the body are sought anew.
template <class S>
void seek_pairs(WorldData<S>& world, std::uint32_t body) {
  for (Proxy p = world.bodies[body].first_shape; p != kNone; p = world.shapes[p].next) {
    world.broad_phase->forget(p);
    mark_moved(world, p);
  }
}

}  // namespace

template <class S>
std::uint32_t create_joint(WorldData<S>& world, const JointDef& def, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t slot = take_slot(world);
  Joint<S>& j = world.joints[slot];
  const std::uint32_t generation = j.generation;
  j = Joint<S>{};
  j.generation = generation;
  j.kind = static_cast<std::uint32_t>(def.geometry.index());
  j.flags = kJointAlive | (def.collide_connected ? kJointCollides : 0u);
  j.body_a = a;
  j.body_b = b;
  const Body<S>* body_a = a == kNone ? nullptr : &world.bodies[a];
  const Body<S>& body_b = world.bodies[b];
  if (body_a) {
    j.ax = S(def.anchor_a.x()) - body_a->local_x;
    j.ay = S(def.anchor_a.y()) - body_a->local_y;
  }
  j.bx = S(def.anchor_b.x()) - body_b.local_x;
  j.by = S(def.anchor_b.y()) - body_b.local_y;
  set_geometry(j, def.geometry, body_a, body_b);
  if (def.break_force < kUnbreakable || def.break_torque < kUnbreakable) j.flags |= kJointBreaks;
  j.break_force = S(def.break_force);
  j.break_torque = S(def.break_torque);
  link_edge(world, slot, 0, a);
  link_edge(world, slot, 1, b);
  ++world.needs.joints;
  update_model(world);
  wake_joint(world, slot);
  if (any_awake(world, j)) activate(world, slot);
  if (a != kNone && !def.collide_connected) end_contacts(world, a, b);
  return slot;
}

template <class S>
void destroy_joint(WorldData<S>& world, std::uint32_t slot) {
  wake_joint(world, slot);
  Joint<S>& j = world.joints[slot];
  deactivate(world, slot);
  unlink_edge(world, slot, 0, j.body_a);
  unlink_edge(world, slot, 1, j.body_b);
  if (j.body_a != kNone && !j.has(kJointCollides)) seek_pairs(world, j.body_b);
  const std::uint32_t generation = j.generation + 1;
  j = Joint<S>{};
  j.generation = generation;
  world.free_joints.push_back(slot);
  --world.needs.joints;
  update_model(world);
}

template <class S>
void activate_joints_of(WorldData<S>& world, std::uint32_t body) {
  for_each_joint_of(world, body, [&](std::uint32_t joint) { activate(world, joint); });
}

template <class S>
void deactivate_joints_of(WorldData<S>& world, std::uint32_t body) {
  for_each_joint_of(world, body, [&](std::uint32_t joint) {
    if (!any_awake(world, world.joints[joint])) deactivate(world, joint);
  });
}

template <class S>
void wake_joint(WorldData<S>& world, std::uint32_t slot) {
  for (const std::uint32_t body : {world.joints[slot].body_a, world.joints[slot].body_b})
    if (body != kNone && world.bodies[body].dynamic()) wake_body(world, body);
}

template <class S>
void put_joined_to_sleep(WorldData<S>& world, std::uint32_t first) {
  std::vector<std::uint32_t> stack{first};
  put_to_sleep(world, first);
  while (!stack.empty()) {
    const std::uint32_t body = stack.back();
    stack.pop_back();
    if (!world.bodies[body].dynamic()) continue;
    for_each_joint_of(world, body, [&](std::uint32_t joint) {
      const std::uint32_t other = other_body(world.joints[joint], body);
      if (other == kNone || !world.bodies[other].dynamic() || !world.bodies[other].awake()) return;
      put_to_sleep(world, other);
      stack.push_back(other);
    });
  }
}

template <class S>
S joint_angle(const WorldData<S>& world, const Joint<S>& j) {
  const S now = world.bodies[j.body_b].angle - world.bodies[j.body_a].angle - j.reference;
  if (j.has(kJointLimited)) return j.angle + wrap_angle(now - j.angle);
  return wrap_angle(now);
}

template <class S>
bool kept_apart(const WorldData<S>& world, std::uint32_t a, std::uint32_t b) {
  // Both lists at once, until the shorter one ends: a ground may have thousands of joints.
  std::uint32_t edge_a = world.bodies[a].first_joint, edge_b = world.bodies[b].first_joint;
  const auto forbids = [&](std::uint32_t& edge, std::uint32_t body, std::uint32_t other) {
    const Joint<S>& j = world.joints[(edge - 1) >> 1];
    edge = j.next[(edge - 1) & 1];
    return !j.has(kJointCollides) && other_body(j, body) == other;
  };
  while (edge_a != kNoJoint && edge_b != kNoJoint)
    if (forbids(edge_a, a, b) || forbids(edge_b, b, a)) return true;
  return false;
}

#define URTO_INSTANTIATE(S)                                                                          \
  template std::uint32_t create_joint(WorldData<S>&, const JointDef&, std::uint32_t, std::uint32_t); \
  template void destroy_joint(WorldData<S>&, std::uint32_t);                                         \
  template void activate_joints_of(WorldData<S>&, std::uint32_t);                                    \
  template void deactivate_joints_of(WorldData<S>&, std::uint32_t);                                  \
  template void wake_joint(WorldData<S>&, std::uint32_t);                                            \
  template void put_joined_to_sleep(WorldData<S>&, std::uint32_t);                                   \
  template S joint_angle(const WorldData<S>&, const Joint<S>&);                                      \
  template bool kept_apart(const WorldData<S>&, std::uint32_t, std::uint32_t);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

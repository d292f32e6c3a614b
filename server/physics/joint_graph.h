#pragma once

#include "physics/data.h"

namespace urto {

// Joints as edges between bodies. Lists keep their order across save and restore.

// `def` has been checked; `a` is kNone for a mouse joint. Wakes the bodies; contacts that the joint forbids end.
template <class S>
std::uint32_t create_joint(WorldData<S>& world, const JointDef& def, std::uint32_t a, std::uint32_t b);

// Wakes the bodies; what the joint kept apart may touch again.
template <class S>
void destroy_joint(WorldData<S>& world, std::uint32_t slot);

// Takes up the joints of a body that woke, or lays down those that no awake body is left of.
template <class S>
void activate_joints_of(WorldData<S>& world, std::uint32_t body);
template <class S>
void deactivate_joints_of(WorldData<S>& world, std::uint32_t body);

template <class S>
void wake_joint(WorldData<S>& world, std::uint32_t slot);

// Takes a body out of the awake ones, and with it what is joined to it: joined bodies sleep and wake together.
template <class S>
void put_joined_to_sleep(WorldData<S>& world, std::uint32_t body);

// rad, of b against a: what the joint's angle is now, counted on from what it was.
template <class S>
S joint_angle(const WorldData<S>& world, const Joint<S>& joint);

// Is there a joint between the two that forbids that they touch?
template <class S>
bool kept_apart(const WorldData<S>& world, std::uint32_t a, std::uint32_t b);

// Calls visit(joint slot) for each joint of a body; visit must not change the list.
template <class S, class Visit>
void for_each_joint_of(const WorldData<S>& world, std::uint32_t body, Visit&& visit) {
  std::uint32_t edge = world.bodies[body].first_joint;
  while (edge != kNoJoint) {
    const std::uint32_t joint = (edge - 1) >> 1, side = (edge - 1) & 1;
    visit(joint);
    edge = world.joints[joint].next[side];
  }
}

template <class S>
std::uint32_t other_body(const Joint<S>& joint, std::uint32_t body) {
  return joint.body_a == body ? joint.body_b : joint.body_a;
}

}  // namespace urto

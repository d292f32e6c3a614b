#pragma once

#include <cstdint>
#include <type_traits>

#include "physics/body.h"
#include "physics/joint_definitions.h"

namespace urto {

enum JointFlag : std::uint32_t {
  kJointAlive = 1u << 0,
  kJointCollides = 1u << 1,  // its bodies may touch each other
  kJointLimited = 1u << 2,
  kJointMotor = 1u << 3,
  kJointMotorEnabled = 1u << 4,
  kJointSpring = 1u << 5,
  kJointAngularSpring = 1u << 6,
  kJointBreaks = 1u << 7,
};

// No edge of a joint list. Edges are joint · 2 + side + 1.
inline constexpr std::uint32_t kNoJoint = 0;

template <class S>
struct Joint {
  S ax = 0, ay = 0, bx = 0, by = 0;  // m, anchors from the centres of mass, body frames
  S ux = 0, uy = 0;                  // prismatic: the axis, unit, in a's frame; mouse: the target in the world, m
  S reference = 0;                   // rad, of angles; m, a distance joint's length
  S lower = 0, upper = 0;            // rad or m
  S motor_speed = 0;                 // rad/s or m/s
  S motor_bound = 0;                 // N·m or N; of a mouse joint: its force
  S hertz = 0, damping_ratio = 0;
  S angular_hertz = 0, angular_damping_ratio = 0;  // weld
  S break_force = 0, break_torque = 0;             // N, N·m
  S angle = 0;                                     // rad, of b against a; with limits it counts whole turns
  // N·s of the last sub-step: warm start of the next.
  S impulse_x = 0, impulse_y = 0;              // at the anchor, world axes; prismatic: across the axis, 0
  S turn = 0;                                  // N·m·s against turning
  S spring = 0, motor = 0, low = 0, high = 0;  // along the joint's position
  S force_x = 0, force_y = 0, torque = 0;      // N, N·m on b: mean of the last step
  std::uint32_t kind = 0;                      // JointKind
  std::uint32_t flags = 0;
  std::uint32_t generation = 0;
  std::uint32_t body_a = kNone, body_b = kNone;  // slots; a mouse joint has no a
  std::uint32_t next[2] = {kNoJoint, kNoJoint};  // edges of the bodies' joint lists
  std::uint32_t prev[2] = {kNoJoint, kNoJoint};
  std::uint32_t active_index = kNone;

  JointKind joint_kind() const { return static_cast<JointKind>(kind); }
  bool alive() const { return (flags & kJointAlive) != 0; }
  bool has(std::uint32_t flag) const { return (flags & flag) != 0; }
};

static_assert(sizeof(Joint<float>) == 28 * 4 + 10 * 4 && sizeof(Joint<double>) == 28 * 8 + 10 * 4);
static_assert(std::is_trivially_copyable_v<Joint<float>>);

}  // namespace urto

#pragma once

// Joints as a user of the engine describes them. Angles in radians, counter-clockwise; anchors in the frames of their
// bodies. A joint's position is the angle of b against a (revolute), the way of b's anchor along a's axis (prismatic),
// or the distance of the anchors (distance).

#include <cstdint>
#include <limits>
#include <optional>
#include <variant>

#include "physics/definitions.h"

namespace urto {

// A joint's handle, made like a BodyId. Zero is no joint.
using JointId = std::uint64_t;

inline constexpr std::uint32_t kJointsMax = 1u << 20;
inline constexpr double kJointHertzMax = 1e3;  // of a spring
inline constexpr double kJointAngleMax = 1e3;  // rad, of a limit: many turns
inline constexpr double kDampingRatioMax = 1e2;
inline constexpr double kJointForceMax = 1e15;  // N or N·m, of a motor or a drag; above it: infinity
inline constexpr double kUnbreakable = std::numeric_limits<double>::infinity();

struct JointLimits {
  double lower = 0, upper = 0;  // rad or m, lower ≤ upper
};

struct JointMotor {
  bool enabled = true;
  double speed = 0;  // rad/s or m/s of the joint's position
  double bound = 0;  // N·m or N ≥ 0: the most it exerts
};

// A damped spring, by what one sees of it rather than by stiffness: that follows from the masses.
struct JointSpring {
  double hertz = 1;          // (0, kJointHertzMax]
  double damping_ratio = 1;  // 1: as fast as it goes without swinging
};

// Bodies turn about a common point.
struct RevoluteJoint {
  std::optional<double> reference_angle;  // rad: b's angle less a's where the joint's is 0; absent: as they are now
  std::optional<JointLimits> limits;      // rad
  std::optional<JointMotor> motor;        // rad/s, N·m
  std::optional<JointSpring> spring;      // towards 0
};

// A rod between two points; with limits alone a rope, with a spring a spring.
struct DistanceJoint {
  std::optional<double> length;       // m, of the rod, or of the spring at rest; absent: as it is now
  std::optional<JointLimits> limits;  // m ≥ 0
  std::optional<JointSpring> spring;
};

// b slides along an axis of a and does not turn against it.
struct PrismaticJoint {
  Vec2 axis{1, 0};                        // any length but 0, in a's frame
  std::optional<double> reference_angle;  // rad, as above
  std::optional<JointLimits> limits;      // m
  std::optional<JointMotor> motor;        // m/s, N
  std::optional<JointSpring> spring;      // towards 0
};

// b is held in its place against a: stiff, or by springs.
struct WeldJoint {
  std::optional<double> reference_angle;  // rad, as above
  std::optional<JointSpring> linear;      // absent: stiff
  std::optional<JointSpring> angular;     // absent: stiff
};

// b's anchor is drawn to a point of the world. There is no body a: body_a is 0.
struct MouseJoint {
  Vec2 target{0, 0};  // m
  JointSpring spring{5, 1};
  double force_max = 0;  // N ≥ 0
};

enum class JointKind : std::uint8_t { kRevolute, kDistance, kPrismatic, kWeld, kMouse };
using JointGeometry = std::variant<RevoluteJoint, DistanceJoint, PrismaticJoint, WeldJoint, MouseJoint>;

struct JointDef {
  BodyId body_a = 0, body_b = 0;        // at least one is dynamic
  Vec2 anchor_a{0, 0}, anchor_b{0, 0};  // m, body frames
  JointGeometry geometry;
  double break_force = kUnbreakable;   // N > 0: a step with more of it, in the mean, is the joint's last
  double break_torque = kUnbreakable;  // N·m > 0
  bool collide_connected = false;      // may the two bodies touch?
};

struct JointState {
  JointKind kind = JointKind::kRevolute;
  BodyId body_a = 0, body_b = 0;
  Vec2 point_a{0, 0}, point_b{0, 0};  // m, world frame: where the anchors are
  double position = 0;                // rad or m; of a weld its angle, of a mouse joint the distance to the target
  double speed = 0;                   // rad/s or m/s of the position
  Vec2 force{0, 0};                   // N on b, mean of the last step
  double torque = 0;                  // N·m on b beside that force at the anchor, mean of the last step
  JointMotor motor;                   // as it is set; without one not enabled
};

// A joint broke: it carried more than it could and is gone.
struct JointEvent {
  JointId joint = 0;
  BodyId body_a = 0, body_b = 0;
  Vec2 point{0, 0};   // m, world frame: b's anchor
  double force = 0;   // N that broke it, or
  double torque = 0;  // N·m
};

}  // namespace urto

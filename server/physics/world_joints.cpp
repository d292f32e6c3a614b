// The joints of a world: checks, then the joint graph.
#include <algorithm>
#include <cmath>

#include "physics/joint_graph.h"
#include "physics/joint_state.h"
#include "physics/validation.h"
#include "physics/world_of.h"

namespace urto {
namespace {

tl::unexpected<Error> unknown_body(const char* field, BodyId id) {
  return failure(ErrorCode::kUnknownBody, field, std::to_string(id), "there is no such body");
}

}  // namespace

template <class S>
std::uint32_t WorldOf<S>::joint_slot_of(JointId id) const {
  const std::uint64_t low = id & 0xffffffffu;
  if (low == 0 || low > data_.joints.size()) return kNone;
  const auto slot = static_cast<std::uint32_t>(low - 1);
  const Joint<S>& joint = data_.joints[slot];
  return joint.alive() && joint.generation == id >> 32 ? slot : kNone;
}

template <class S>
Status WorldOf<S>::check_joint_target(JointId id, bool right_kind, const char* message) const {
  if (joint_slot_of(id) == kNone)
    return failure(ErrorCode::kUnknownJoint, "joint", std::to_string(id), "there is no such joint");
  if (!right_kind) return failure(ErrorCode::kWrongJointKind, "joint", std::to_string(id), message);
  return {};
}

template <class S>
Status WorldOf<S>::check_joint(const JointDef& def) const {
  if (data_.settings.solver != SolverKind::kSoftStep)
    return failure(ErrorCode::kNotSupported, "solver", "", "only the soft step solver knows joints");
  return check_joint_def(def);
}

template <class S>
Status WorldOf<S>::check_joint_bodies(const JointDef& def) const {
  const std::uint32_t b = slot_of(def.body_b);
  if (b == kNone) return unknown_body("body_b", def.body_b);
  if (std::holds_alternative<MouseJoint>(def.geometry)) {
    if (def.body_a != 0)
      return failure(ErrorCode::kInvalidValue, "body_a", std::to_string(def.body_a), "a mouse joint has no body a");
    return check_target(def.body_b, true);
  }
  const std::uint32_t a = slot_of(def.body_a);
  if (a == kNone) return unknown_body("body_a", def.body_a);
  if (a == b)
    return failure(ErrorCode::kInvalidValue, "body_b", std::to_string(def.body_b), "a joint has two different bodies");
  if (!data_.bodies[a].dynamic() && !data_.bodies[b].dynamic())
    return failure(ErrorCode::kWrongBodyType, "body_b", std::to_string(def.body_b),
                   "at least one body of a joint is dynamic");
  return {};
}

template <class S>
Expected<JointId> WorldOf<S>::add_joint(const JointDef& def) {
  if (Status status = check_joint(def); !status) return tl::unexpected<Error>(status.error());
  if (Status status = check_joint_bodies(def); !status) return tl::unexpected<Error>(status.error());
  if (data_.needs.joints >= kJointsMax)
    return failure(ErrorCode::kLimitReached, "joint", std::to_string(kJointsMax), "the world is full of joints");
  const std::uint32_t a = def.body_a == 0 ? kNone : slot_of(def.body_a);
  const std::uint32_t slot = create_joint(data_, def, a, slot_of(def.body_b));
  return id_of(slot, data_.joints[slot].generation);
}

template <class S>
Status WorldOf<S>::remove_joint(JointId id) {
  if (Status status = check_joint_target(id, true, ""); !status) return status;
  destroy_joint(data_, joint_slot_of(id));
  return {};
}

template <class S>
Status WorldOf<S>::set_motor(JointId id, const JointMotor& motor) {
  const std::uint32_t slot = joint_slot_of(id);
  const JointKind kind = slot == kNone ? JointKind::kRevolute : data_.joints[slot].joint_kind();
  const bool has_motor = kind == JointKind::kRevolute || kind == JointKind::kPrismatic;
  if (Status status = check_joint_target(id, has_motor, "only revolute and prismatic joints have a motor"); !status)
    return status;
  if (Status status = check_motor(motor); !status) return status;
  Joint<S>& j = data_.joints[slot];
  j.flags |= kJointMotor;
  j.flags = motor.enabled ? j.flags | kJointMotorEnabled : j.flags & ~kJointMotorEnabled;
  j.motor_speed = S(motor.speed);
  j.motor_bound = S(motor.bound);
  if (!motor.enabled) j.motor = S(0);
  wake_joint(data_, slot);
  return {};
}

template <class S>
Status WorldOf<S>::set_target(JointId id, const Vec2& target) {
  const std::uint32_t slot = joint_slot_of(id);
  const bool mouse = slot == kNone || data_.joints[slot].joint_kind() == JointKind::kMouse;
  if (Status status = check_joint_target(id, mouse, "only mouse joints have a target"); !status) return status;
  if (Status status = check_vector("target", target, kCoordinateMax); !status) return status;
  data_.joints[slot].ux = S(target.x());
  data_.joints[slot].uy = S(target.y());
  wake_joint(data_, slot);
  return {};
}

template <class S>
Expected<JointState> WorldOf<S>::joint(JointId id) const {
  if (Status status = check_joint_target(id, true, ""); !status) return tl::unexpected<Error>(status.error());
  return joint_state_of(data_, joint_slot_of(id));
}

template <class S>
std::vector<JointId> WorldOf<S>::joints() const {
  std::vector<JointId> out;
  for (std::uint32_t slot = 0; slot < data_.joints.size(); ++slot)
    if (data_.joints[slot].alive()) out.push_back(id_of(slot, data_.joints[slot].generation));
  std::sort(out.begin(), out.end());
  return out;
}

#define URTO_INSTANTIATE(S)                                                         \
  template std::uint32_t WorldOf<S>::joint_slot_of(JointId) const;                  \
  template Status WorldOf<S>::check_joint_target(JointId, bool, const char*) const; \
  template Status WorldOf<S>::check_joint(const JointDef&) const;                   \
  template Status WorldOf<S>::check_joint_bodies(const JointDef&) const;            \
  template Expected<JointId> WorldOf<S>::add_joint(const JointDef&);                \
  template Status WorldOf<S>::remove_joint(JointId);                                \
  template Status WorldOf<S>::set_motor(JointId, const JointMotor&);                \
  template Status WorldOf<S>::set_target(JointId, const Vec2&);                     \
  template Expected<JointState> WorldOf<S>::joint(JointId) const;                   \
  template std::vector<JointId> WorldOf<S>::joints() const;
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

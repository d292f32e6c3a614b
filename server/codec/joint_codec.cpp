#include "codec/joint_codec.h"

#include <variant>

#include "codec/scene_codec.h"

namespace urto::codec {
namespace {

template <class Message>
std::optional<double> reference_from_proto(const Message& message) {
  return message.has_reference_angle() ? std::optional(message.reference_angle()) : std::nullopt;
}

template <class Message>
std::optional<JointLimits> limits_from_proto(const Message& message) {
  if (!message.has_limits()) return std::nullopt;
  return JointLimits{message.limits().lower(), message.limits().upper()};
}

template <class Message>
std::optional<JointMotor> optional_motor_from_proto(const Message& message) {
  if (!message.has_motor()) return std::nullopt;
  return motor_from_proto(message.motor());
}

JointSpring spring_from_proto(const v1::JointSpring& message) {
  return {message.hertz(), message.has_damping_ratio() ? message.damping_ratio() : JointSpring().damping_ratio};
}

std::optional<JointSpring> optional_spring_from_proto(bool present, const v1::JointSpring& message) {
  return present ? std::optional(spring_from_proto(message)) : std::nullopt;
}

JointGeometry geometry_from_proto(const v1::Joint& message) {
  switch (message.kind_case()) {
    case v1::Joint::kRevolute: {
      const auto& m = message.revolute();
      return RevoluteJoint{reference_from_proto(m), limits_from_proto(m), optional_motor_from_proto(m),
                           optional_spring_from_proto(m.has_spring(), m.spring())};
    }
    case v1::Joint::kDistance: {
      const auto& m = message.distance();
      return DistanceJoint{m.has_length() ? std::optional(m.length()) : std::nullopt, limits_from_proto(m),
                           optional_spring_from_proto(m.has_spring(), m.spring())};
    }
    case v1::Joint::kPrismatic: {
      const auto& m = message.prismatic();
      return PrismaticJoint{m.has_axis() ? vector_from_proto(m.axis()) : PrismaticJoint().axis, reference_from_proto(m),
                            limits_from_proto(m), optional_motor_from_proto(m),
                            optional_spring_from_proto(m.has_spring(), m.spring())};
    }
    case v1::Joint::kWeld: {
      const auto& m = message.weld();
      return WeldJoint{reference_from_proto(m), optional_spring_from_proto(m.has_linear(), m.linear()),
                       optional_spring_from_proto(m.has_angular(), m.angular())};
    }
    case v1::Joint::kMouse: {
      const auto& m = message.mouse();
      return MouseJoint{vector_from_proto(m.target()),
                        m.has_spring() ? spring_from_proto(m.spring()) : MouseJoint().spring, m.force_max()};
    }
    case v1::Joint::KIND_NOT_SET:
      break;  // check_message() lets none pass
  }
  return RevoluteJoint{};
}

template <class Message>
void write_reference(const std::optional<double>& angle, Message* out) {
  if (angle) out->set_reference_angle(*angle);
}

template <class Message>
void write_limits(const std::optional<JointLimits>& limits, Message* out) {
  if (!limits) return;
  out->mutable_limits()->set_lower(limits->lower);
  out->mutable_limits()->set_upper(limits->upper);
}

void write_spring(const JointSpring& spring, v1::JointSpring* out) {
  out->set_hertz(spring.hertz);
  out->set_damping_ratio(spring.damping_ratio);
}

void write_motor(const JointMotor& motor, v1::JointMotor* out) {
  out->set_enabled(motor.enabled);
  out->set_speed(motor.speed);
  out->set_bound(motor.bound);
}

struct GeometryWriter {
  v1::Joint* out;

  void operator()(const RevoluteJoint& joint) const {
    auto* message = out->mutable_revolute();
    write_reference(joint.reference_angle, message);
    write_limits(joint.limits, message);
    if (joint.motor) write_motor(*joint.motor, message->mutable_motor());
    if (joint.spring) write_spring(*joint.spring, message->mutable_spring());
  }
  void operator()(const DistanceJoint& joint) const {
    auto* message = out->mutable_distance();
    if (joint.length) message->set_length(*joint.length);
    write_limits(joint.limits, message);
    if (joint.spring) write_spring(*joint.spring, message->mutable_spring());
  }
  void operator()(const PrismaticJoint& joint) const {
    auto* message = out->mutable_prismatic();
    write_vector(joint.axis, message->mutable_axis());
    write_reference(joint.reference_angle, message);
    write_limits(joint.limits, message);
    if (joint.motor) write_motor(*joint.motor, message->mutable_motor());
    if (joint.spring) write_spring(*joint.spring, message->mutable_spring());
  }
  void operator()(const WeldJoint& joint) const {
    auto* message = out->mutable_weld();
    write_reference(joint.reference_angle, message);
    if (joint.linear) write_spring(*joint.linear, message->mutable_linear());
    if (joint.angular) write_spring(*joint.angular, message->mutable_angular());
  }
  void operator()(const MouseJoint& joint) const {
    auto* message = out->mutable_mouse();
    write_vector(joint.target, message->mutable_target());
    write_spring(joint.spring, message->mutable_spring());
    message->set_force_max(joint.force_max);
  }
};

void write_body_ref(BodyId id, const BodyRef& ref, v1::BodyRef* out) {
  if (id != 0) {
    out->set_id(id);
  } else if (const auto* name = std::get_if<std::string>(&ref)) {
    out->set_name(*name);
  } else {
    out->set_id(std::get<BodyId>(ref));
  }
}

}  // namespace

BodyRef body_ref_from_proto(const v1::BodyRef& message) {
  if (message.ref_case() == v1::BodyRef::kName) return message.name();
  return message.id();
}

JointMotor motor_from_proto(const v1::JointMotor& message) {
  return {message.has_enabled() ? message.enabled() : true, message.speed(), message.bound()};
}

JointSpec joint_from_proto(const v1::Joint& message) {
  JointSpec joint;
  joint.name = message.name();
  if (message.has_body_a()) joint.body_a = body_ref_from_proto(message.body_a());
  joint.body_b = body_ref_from_proto(message.body_b());
  joint.def.anchor_a = vector_from_proto(message.anchor_a());
  joint.def.anchor_b = vector_from_proto(message.anchor_b());
  joint.def.geometry = geometry_from_proto(message);
  if (message.has_break_force()) joint.def.break_force = message.break_force();
  if (message.has_break_torque()) joint.def.break_torque = message.break_torque();
  joint.def.collide_connected = message.collide_connected();
  return joint;
}

void write_joint(const JointSpec& joint, v1::Joint* out) {
  out->set_name(joint.name);
  if (joint.body_a) write_body_ref(joint.def.body_a, *joint.body_a, out->mutable_body_a());
  write_body_ref(joint.def.body_b, joint.body_b, out->mutable_body_b());
  write_vector(joint.def.anchor_a, out->mutable_anchor_a());
  write_vector(joint.def.anchor_b, out->mutable_anchor_b());
  std::visit(GeometryWriter{out}, joint.def.geometry);
  if (joint.def.break_force < kUnbreakable) out->set_break_force(joint.def.break_force);
  if (joint.def.break_torque < kUnbreakable) out->set_break_torque(joint.def.break_torque);
  out->set_collide_connected(joint.def.collide_connected);
}

void write_joint_info(const JointInfo& info, v1::JointInfo* out) {
  out->set_id(info.record->id);
  write_joint(info.record->spec, out->mutable_joint());
  auto* state = out->mutable_state();
  write_vector(info.state.point_a, state->mutable_point_a());
  write_vector(info.state.point_b, state->mutable_point_b());
  state->set_position(info.state.position);
  state->set_speed(info.state.speed);
  write_vector(info.state.force, state->mutable_force());
  state->set_torque(info.state.torque);
  if (info.state.motor.enabled || info.state.motor.bound > 0) write_motor(info.state.motor, state->mutable_motor());
}

}  // namespace urto::codec

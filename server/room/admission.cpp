#include "room/admission.h"

#include <charconv>
#include <cmath>
#include <utility>
#include <variant>

#include "room/batch_overlay.h"
#include "room/joint_overlay.h"

namespace urto {
namespace {

using Check = std::optional<Rejection>;

std::string text_of(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value).ptr;
  return std::string(buffer, end);
}

Rejection reject(RejectionCode code, std::string field, std::string value, std::string message) {
  return Rejection{code, 0, std::move(field), std::move(value), std::move(message)};
}

// NaN is in no range.
Check check_range(const std::string& field, double value, double lower, double upper) {
  if (value >= lower && value <= upper) return std::nullopt;
  return reject(RejectionCode::kInvalidValue, field, text_of(value),
                "A number from " + text_of(lower) + " to " + text_of(upper) + " is needed.");
}

Check check_bound(const std::string& field, double value, double bound) {
  return check_range(field, value, -bound, bound);
}

Check check_vector(const std::string& field, const Vec2& vector, double bound) {
  if (auto bad = check_bound(field + ".x", vector.x(), bound)) return bad;
  return check_bound(field + ".y", vector.y(), bound);
}

// The first bytes of a UTF-8 text, cut between characters.
std::string shortened(const std::string& text, std::size_t bytes_max) {
  std::size_t end = bytes_max;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

bool allowed_in_name(char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; }

Check check_text(const std::string& field, const std::string& text, std::size_t bytes_max) {
  if (text.size() > bytes_max) {
    return reject(RejectionCode::kInvalidValue, field, shortened(text, bytes_max),
                  "At most " + std::to_string(bytes_max) + " bytes are allowed.");
  }
  for (const char c : text) {
    if (!allowed_in_name(c)) {
      return reject(RejectionCode::kInvalidValue, field, text, "Control characters are not allowed.");
    }
  }
  return std::nullopt;
}

// One batch on its way through the checks, command by command.
class BatchCheck {
 public:
  BatchCheck(const AdmissionContext& context, const std::string& user)
      : context_(context),
        user_(user),
        overlay_(context.bodies, context.scene_bodies, context.paused),
        joints_(context.joints, context.scene_joints) {}

  Check operator()(const Spawn& command) {
    const BodySpec& spec = command.body;
    if (auto bad = check_labels(spec)) {
      bad->field = "spawn.body." + bad->field;
      return bad;
    }
    if (!spec.name.empty() && overlay_.find(BodyRef(spec.name))) {
      return reject(RejectionCode::kDuplicateName, "spawn.body.name", spec.name,
                    "A body of this name is in the room already.");
    }
    if (overlay_.body_count() >= context_.limits.bodies_max) {
      return reject(RejectionCode::kQuota, "spawn.body", std::to_string(overlay_.body_count()),
                    "The room holds as many bodies as it may: " + std::to_string(context_.limits.bodies_max) + ".");
    }
    if (overlay_.shape_count() + shape_count_of(spec.def) > context_.limits.shapes_max) {
      return reject(RejectionCode::kQuota, "spawn.body.shapes", std::to_string(overlay_.shape_count()),
                    "The room holds as many shapes as it may: " + std::to_string(context_.limits.shapes_max) + ".");
    }
    if (const Status status = context_.world.check_body(spec.def); !status) {
      return rejection_from(status.error(), "spawn.body.");
    }
    overlay_.spawn(spec);
    return std::nullopt;
  }

  Check operator()(const Despawn& command) {
    if (auto bad = check_target("despawn", command.body)) return bad;
    joints_.despawn(overlay_.find(command.body)->key);
    overlay_.despawn(command.body);
    return std::nullopt;
  }

  Check operator()(const Impulse& command) const {
    if (auto bad = check_dynamic("impulse", command.body)) return bad;
    if (auto bad = check_vector("impulse.impulse", command.impulse, kImpulseMax)) return bad;
    if (command.point) {
      if (auto bad = check_vector("impulse.point", *command.point, kCoordinateMax)) return bad;
    }
    return check_bound("impulse.angular", command.angular, kImpulseMax);
  }

  Check operator()(const Force& command) const {
    if (auto bad = check_dynamic("force", command.body)) return bad;
    if (auto bad = check_vector("force.force", command.force, kForceMax)) return bad;
    if (auto bad = check_bound("force.torque", command.torque, kForceMax)) return bad;
    if (command.duration && !(*command.duration > 0 && *command.duration <= kDurationMax)) {
      return reject(RejectionCode::kInvalidValue, "force.duration", text_of(*command.duration),
                    "A duration above 0 and up to " + text_of(kDurationMax) + " s is needed.");
    }
    return std::nullopt;
  }

  Check operator()(const SetVelocity& command) const {
    if (auto bad = check_target("set_velocity", command.body)) return bad;
    if (overlay_.find(command.body)->type == BodyType::kStatic) {
      return reject(RejectionCode::kWrongBodyType, "set_velocity.body", ref_text(command.body),
                    "A static body has no velocity.");
    }
    if (command.velocity) {
      if (auto bad = check_vector("set_velocity.velocity", *command.velocity, kSpeedMax)) return bad;
    }
    if (!command.angular_velocity) return std::nullopt;
    return check_bound("set_velocity.angular_velocity", *command.angular_velocity, kAngularSpeedMax);
  }

  Check operator()(const SetTransform& command) const {
    if (auto bad = check_target("set_transform", command.body)) return bad;
    if (command.position) {
      if (auto bad = check_vector("set_transform.position", *command.position, kCoordinateMax)) return bad;
    }
    if (!command.angle) return std::nullopt;
    return check_bound("set_transform.angle", *command.angle, kAngleMax);
  }

  Check operator()(const Pause&) {
    if (auto bad = check_control("pause")) return bad;
    overlay_.paused = true;
    return std::nullopt;
  }

  Check operator()(const Resume&) {
    if (auto bad = check_control("resume")) return bad;
    overlay_.paused = false;
    return std::nullopt;
  }

  Check operator()(const Step& command) const {
    if (auto bad = check_control("step")) return bad;
    if (command.ticks < 1 || command.ticks > context_.limits.step_ticks_max) {
      return reject(RejectionCode::kInvalidValue, "step.ticks", std::to_string(command.ticks),
                    "From 1 to " + std::to_string(context_.limits.step_ticks_max) + " ticks are allowed.");
    }
    if (!overlay_.paused) {
      return reject(RejectionCode::kNotPaused, "step", "", "Only a paused room can be stepped; pause it first.");
    }
    if (context_.steps_waiting >= context_.limits.steps_waiting_max) {
      return reject(RejectionCode::kQueueFull, "step", std::to_string(context_.steps_waiting),
                    "Too many step commands are waiting for their last tick.");
    }
    return std::nullopt;
  }

  Check operator()(const Reset&) {
    if (auto bad = check_control("reset")) return bad;
    overlay_.reset();
    joints_.reset();
    return std::nullopt;
  }

  Check operator()(const CreateJoint& command) {
    const JointSpec& spec = command.joint;
    if (auto bad = check_joint_name(spec.name)) {
      bad->field = "create_joint.joint." + bad->field;
      return bad;
    }
    if (!spec.name.empty() && joints_.find(JointRef(spec.name))) {
      return reject(RejectionCode::kDuplicateName, "create_joint.joint.name", spec.name,
                    "A joint of this name is in the room already.");
    }
    if (joints_.count() >= context_.limits.joints_max) {
      return reject(RejectionCode::kQuota, "create_joint.joint", std::to_string(joints_.count()),
                    "The room holds as many joints as it may: " + std::to_string(context_.limits.joints_max) + ".");
    }
    if (const Status status = context_.world.check_joint(spec.def); !status) {
      return rejection_from(status.error(), "create_joint.joint.");
    }
    if (auto bad = check_joint_bodies(spec)) return bad;
    std::optional<BodyRef> a;
    if (spec.body_a) a = overlay_.find(*spec.body_a)->key;
    joints_.create(spec, a, overlay_.find(spec.body_b)->key);
    return std::nullopt;
  }

  Check operator()(const DestroyJoint& command) {
    if (auto bad = check_joint("destroy_joint", command.joint)) return bad;
    joints_.destroy(command.joint);
    return std::nullopt;
  }

  Check operator()(const SetMotor& command) const {
    if (auto bad = check_joint("set_motor", command.joint)) return bad;
    const JointKind kind = *joints_.find(command.joint);
    if (kind != JointKind::kRevolute && kind != JointKind::kPrismatic) {
      return reject(RejectionCode::kWrongJointKind, "set_motor.joint", ref_text(command.joint),
                    "Only revolute and prismatic joints have a motor.");
    }
    if (auto bad = check_bound("set_motor.motor.speed", command.motor.speed, kSpeedMax)) return bad;
    return check_range("set_motor.motor.bound", command.motor.bound, 0, kJointForceMax);
  }

  Check operator()(const SetTarget& command) const {
    if (auto bad = check_joint("set_target", command.joint)) return bad;
    if (*joints_.find(command.joint) != JointKind::kMouse) {
      return reject(RejectionCode::kWrongJointKind, "set_target.joint", ref_text(command.joint),
                    "Only mouse joints have a target.");
    }
    return check_vector("set_target.target", command.target, kCoordinateMax);
  }

  Check operator()(const SetTimeScale& command) const {
    if (auto bad = check_control("set_time_scale")) return bad;
    return check_range("set_time_scale.scale", command.scale, kTimeScaleMin, kTimeScaleMax);
  }

  Check operator()(const RoomQuery& query) const {
    return std::visit([this](const auto& each) { return check_query(each); }, query);
  }

 private:
  Check check_query(const PointQuery& query) const {
    return check_vector("query.point.point", query.point, kCoordinateMax);
  }

  Check check_query(const RegionQuery& query) const {
    if (auto bad = check_vector("query.region.lower", query.lower, kCoordinateMax)) return bad;
    if (auto bad = check_vector("query.region.upper", query.upper, kCoordinateMax)) return bad;
    if (query.lower.x() <= query.upper.x() && query.lower.y() <= query.upper.y()) return std::nullopt;
    return reject(RejectionCode::kInvalidValue, "query.region.lower",
                  text_of(query.lower.x()) + ", " + text_of(query.lower.y()),
                  "The lower corner may not be above or right of the upper one.");
  }

  Check check_query(const RayQuery& query) const {
    if (auto bad = check_vector("query.ray.origin", query.origin, kCoordinateMax)) return bad;
    return check_vector("query.ray.translation", query.translation, kCoordinateMax);
  }

  Check check_query(const NearestQuery& query) const {
    if (auto bad = check_vector("query.nearest.point", query.point, kCoordinateMax)) return bad;
    if (auto bad = check_range("query.nearest.distance_max", query.distance_max, 0, kCoordinateMax)) return bad;
    return check_range("query.nearest.count_max", query.count_max, 1, kNearestCountMax);
  }

  Check check_query(const ContactsQuery&) const { return std::nullopt; }
  Check check_query(const DiagnosticsQuery&) const { return std::nullopt; }
  Check check_query(const BodyQuery& query) const { return check_target("query.body", query.body); }

  Check check_query(const JointsQuery&) const { return std::nullopt; }

  static Check refusal(const Status& status, const std::string& prefix) {
    if (status) return std::nullopt;
    return rejection_from(status.error(), prefix);
  }
  Check check_query(const CastQuery& query) const {
    return refusal(check_cast(query.shape, query.translation, query.options), "query.cast.");
  }
  Check check_query(const OverlapQuery& query) const {
    return refusal(check_overlap(query.shape, query.options), "query.overlap.");
  }
  Check check_query(const ClosestQuery& query) const {
    return refusal(check_closest(query.shape, query.distance_max, query.options), "query.closest.");
  }

  Check check_joint(const std::string& command, const JointRef& ref) const {
    if (joints_.find(ref)) return std::nullopt;
    const bool by_id = std::holds_alternative<JointId>(ref);
    return reject(RejectionCode::kUnknownJoint, command + (by_id ? ".joint.id" : ".joint.name"), ref_text(ref),
                  "No joint of this room has this " + std::string(by_id ? "id." : "name."));
  }

  // The bodies that the engine will find when the joint is made.
  Check check_joint_bodies(const JointSpec& spec) const {
    const std::string path = "create_joint.joint.";
    const bool mouse = std::holds_alternative<MouseJoint>(spec.def.geometry);
    if (mouse == spec.body_a.has_value()) {
      return reject(RejectionCode::kInvalidValue, path + "body_a", spec.body_a ? ref_text(*spec.body_a) : "",
                    mouse ? "A mouse joint has no body a." : "A joint needs a body a.");
    }
    const auto b = overlay_.find(spec.body_b);
    if (!b) return unknown_body(path + "body_b", spec.body_b);
    bool dynamic = b->type == BodyType::kDynamic;
    if (spec.body_a) {
      const auto a = overlay_.find(*spec.body_a);
      if (!a) return unknown_body(path + "body_a", *spec.body_a);
      dynamic |= a->type == BodyType::kDynamic;
      if (a->key == b->key) {
        return reject(RejectionCode::kInvalidValue, path + "body_b", ref_text(spec.body_b),
                      "A joint has two different bodies.");
      }
    }
    if (dynamic) return std::nullopt;
    return reject(RejectionCode::kWrongBodyType, path + "body_b", ref_text(spec.body_b),
                  "At least one body of a joint is dynamic.");
  }

  static Rejection unknown_body(const std::string& path, const BodyRef& ref) {
    const bool by_id = std::holds_alternative<BodyId>(ref);
    return reject(RejectionCode::kUnknownBody, path + (by_id ? ".id" : ".name"), ref_text(ref),
                  "No body of this room has this " + std::string(by_id ? "id." : "name."));
  }

  Check check_target(const std::string& command, const BodyRef& ref) const {
    if (overlay_.find(ref)) return std::nullopt;
    const bool by_id = std::holds_alternative<BodyId>(ref);
    return reject(RejectionCode::kUnknownBody, command + (by_id ? ".body.id" : ".body.name"), ref_text(ref),
                  "No body of this room has this " + std::string(by_id ? "id." : "name."));
  }

  Check check_dynamic(const std::string& command, const BodyRef& ref) const {
    if (auto bad = check_target(command, ref)) return bad;
    if (overlay_.find(ref)->type == BodyType::kDynamic) return std::nullopt;
    return reject(RejectionCode::kWrongBodyType, command + ".body", ref_text(ref),
                  "Only dynamic bodies can be pushed.");
  }

  Check check_control(const std::string& command) const {
    if (context_.roles.may_control(user_)) return std::nullopt;
    return reject(RejectionCode::kNotPermitted, command, user_, "This user may not control the room's time.");
  }

  const AdmissionContext& context_;
  const std::string& user_;
  BatchOverlay overlay_;
  JointOverlay joints_;
};

RejectionCode code_from(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidValue:
      return RejectionCode::kInvalidValue;
    case ErrorCode::kUnknownBody:
      return RejectionCode::kUnknownBody;
    case ErrorCode::kDegenerateShape:
      return RejectionCode::kDegenerateShape;
    case ErrorCode::kWrongBodyType:
      return RejectionCode::kWrongBodyType;
    case ErrorCode::kUnknownJoint:
      return RejectionCode::kUnknownJoint;
    case ErrorCode::kWrongJointKind:
      return RejectionCode::kWrongJointKind;
    case ErrorCode::kNotSupported:
      return RejectionCode::kNotSupported;
    case ErrorCode::kLimitReached:
      return RejectionCode::kQuota;
    case ErrorCode::kCorruptState:
      return RejectionCode::kInvalidValue;
  }
  return RejectionCode::kInvalidValue;
}

}  // namespace

// A body's reference or a joint's: both are an id or a name.
std::string ref_text(const BodyRef& ref) {
  if (const auto* id = std::get_if<BodyId>(&ref)) return std::to_string(*id);
  return std::get<std::string>(ref);
}

bool Roles::may_control(const std::string& user) const {
  switch (control) {
    case Control::kEveryone:
      return true;
    case Control::kOwners:
      return owners.contains(user);
    case Control::kNobody:
      return false;
  }
  return false;
}

Rejection rejection_from(const Error& error, const std::string& prefix) {
  return reject(code_from(error.code), prefix + error.field, error.value, error.message);
}

std::optional<Rejection> check_joint_name(const std::string& name) { return check_text("name", name, kNameBytesMax); }

std::optional<Rejection> check_labels(const BodySpec& spec) {
  if (auto bad = check_text("name", spec.name, kNameBytesMax)) return bad;
  if (spec.tags.size() > kTagsMax) {
    return reject(RejectionCode::kInvalidValue, "tags", std::to_string(spec.tags.size()),
                  "At most " + std::to_string(kTagsMax) + " tags are allowed.");
  }
  for (std::size_t i = 0; i < spec.tags.size(); ++i) {
    const std::string field = "tags[" + std::to_string(i) + "]";
    if (spec.tags[i].empty()) return reject(RejectionCode::kInvalidValue, field, "", "A tag may not be empty.");
    if (auto bad = check_text(field, spec.tags[i], kTagBytesMax)) return bad;
  }
  if (spec.color && *spec.color > kColorMax) {
    return reject(RejectionCode::kInvalidValue, "color", std::to_string(*spec.color),
                  "A colour is 0xRRGGBB, at most " + std::to_string(kColorMax) + ".");
  }
  return std::nullopt;
}

std::optional<Rejection> check_batch(const AdmissionContext& context, const std::string& user,
                                     const CommandBatch& batch) {
  const std::size_t count = batch.commands.size();
  if (count == 0) return reject(RejectionCode::kInvalidValue, "commands", "0", "A batch needs at least one command.");
  if (count > context.limits.batch_commands_max) {
    return reject(RejectionCode::kQuota, "commands", std::to_string(count),
                  "A batch holds at most " + std::to_string(context.limits.batch_commands_max) + " commands.");
  }
  BatchCheck check(context, user);
  for (std::size_t i = 0; i < count; ++i) {
    auto bad = std::visit(check, batch.commands[i]);
    if (!bad && std::holds_alternative<Step>(batch.commands[i]) && i + 1 < count) {
      bad = reject(RejectionCode::kInvalidValue, "step", "", "Step has to be the last command of its batch.");
    }
    if (bad) {
      bad->index = static_cast<std::uint32_t>(i);
      return bad;
    }
  }
  return std::nullopt;
}

}  // namespace urto

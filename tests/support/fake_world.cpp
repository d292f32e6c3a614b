#include "support/fake_world.h"

#include <cmath>

namespace urto::testing {

Status FakeWorld::find(BodyId id, const std::string& caller) {
  if (caller == refuse) return failure(ErrorCode::kInvalidValue, caller, "", "The test wants it so.");
  if (contains(id)) return {};
  return failure(ErrorCode::kUnknownBody, "id", std::to_string(id), "No such body.");
}

Expected<BodyId> FakeWorld::add_body(const BodyDef& def) {
  if (Status status = check_body(def); !status) return tl::unexpected<Error>(status.error());
  bodies_[++last_id_] = {def, {def.type, def.position, def.angle, def.velocity, def.angular_velocity, def.awake}};
  return last_id_;
}

Status FakeWorld::check_body(const BodyDef& def) const {
  for (std::size_t i = 0; i < def.shapes.size(); ++i) {
    const auto* box = std::get_if<Box>(&def.shapes[i].geometry);
    if (box == nullptr || box->width > 0) continue;
    return failure(ErrorCode::kInvalidValue, "shapes[" + std::to_string(i) + "].box.width", std::to_string(box->width),
                   "A width above zero is needed.");
  }
  return {};
}

Status FakeWorld::remove_body(BodyId id) {
  if (Status status = find(id, "remove_body"); !status) return status;
  bodies_.erase(id);
  std::erase_if(joints_,
                [id](const auto& entry) { return entry.second.def.body_a == id || entry.second.def.body_b == id; });
  return {};
}

Status FakeWorld::check_joint(const JointDef& def) const {
  if (def.break_force > 0) return {};
  return failure(ErrorCode::kInvalidValue, "break_force", std::to_string(def.break_force),
                 "A force above 0 is needed.");
}

Expected<JointId> FakeWorld::add_joint(const JointDef& def) {
  if (Status status = check_joint(def); !status) return tl::unexpected<Error>(status.error());
  for (const BodyId body : {def.body_a, def.body_b})
    if (body != 0 && !contains(body))
      return failure(ErrorCode::kUnknownBody, "body", std::to_string(body), "No such body.");
  FakeJoint& made = joints_[++last_joint_];
  made.def = def;
  made.state.kind = static_cast<JointKind>(def.geometry.index());
  made.state.body_a = def.body_a;
  made.state.body_b = def.body_b;
  return last_joint_;
}

Status FakeWorld::remove_joint(JointId id) {
  if (joints_.erase(id) > 0) return {};
  return failure(ErrorCode::kUnknownJoint, "joint", std::to_string(id), "No such joint.");
}

Status FakeWorld::set_motor(JointId id, const JointMotor& motor) {
  if (!contains_joint(id)) return failure(ErrorCode::kUnknownJoint, "joint", std::to_string(id), "No such joint.");
  joints_[id].state.motor = motor;
  return {};
}

Status FakeWorld::set_target(JointId id, const Vec2& target) {
  if (!contains_joint(id)) return failure(ErrorCode::kUnknownJoint, "joint", std::to_string(id), "No such joint.");
  joints_[id].state.point_a = target;
  return {};
}

Expected<JointState> FakeWorld::joint(JointId id) const {
  if (!contains_joint(id)) return failure(ErrorCode::kUnknownJoint, "joint", std::to_string(id), "No such joint.");
  return joints_.at(id).state;
}

std::vector<JointId> FakeWorld::joints() const {
  std::vector<JointId> out;
  for (const auto& [id, joint] : joints_) out.push_back(id);
  return out;
}

Expected<BodyState> FakeWorld::body(BodyId id) const {
  const auto it = bodies_.find(id);
  if (it == bodies_.end()) return failure(ErrorCode::kUnknownBody, "id", std::to_string(id), "No such body.");
  return it->second.state;
}

Expected<MassProperties> FakeWorld::mass_properties(BodyId id) const {
  if (!contains(id)) return failure(ErrorCode::kUnknownBody, "id", std::to_string(id), "No such body.");
  return MassProperties{bodies_.at(id).def.mass.value_or(1), 1, {0, 0}};
}

Status FakeWorld::apply_impulse(BodyId id, const Vec2& impulse, const Vec2&) {
  return apply_impulse_to_center(id, impulse);
}

Status FakeWorld::apply_impulse_to_center(BodyId id, const Vec2& impulse) {
  if (Status status = find(id, "apply_impulse_to_center"); !status) return status;
  bodies_[id].state.velocity += impulse / bodies_[id].def.mass.value_or(1);
  return {};
}

Status FakeWorld::apply_angular_impulse(BodyId id, double impulse) {
  if (Status status = find(id, "apply_angular_impulse"); !status) return status;
  bodies_[id].state.angular_velocity += impulse;
  return {};
}

Status FakeWorld::set_force(BodyId id, const Vec2& force, double, bool) {
  if (Status status = find(id, "set_force"); !status) return status;
  bodies_[id].force = force;
  return {};
}

Status FakeWorld::set_velocity(BodyId id, const Vec2& velocity, double angular_velocity) {
  if (Status status = find(id, "set_velocity"); !status) return status;
  bodies_[id].state.velocity = velocity;
  bodies_[id].state.angular_velocity = angular_velocity;
  return {};
}

Status FakeWorld::set_transform(BodyId id, const Vec2& position, double angle) {
  if (Status status = find(id, "set_transform"); !status) return status;
  bodies_[id].state.position = position;
  bodies_[id].state.angle = angle;
  return {};
}

Status FakeWorld::set_awake(BodyId id, bool awake) {
  if (Status status = find(id, "set_awake"); !status) return status;
  bodies_[id].state.awake = awake;
  return {};
}

void FakeWorld::step() {
  ++step_count_;
  contact_events_ = std::move(next_contacts);
  next_contacts.clear();
  joint_events_.clear();
  for (const JointId id : next_breaks) {
    joint_events_.push_back({id, joints_.at(id).def.body_a, joints_.at(id).def.body_b, Vec2(0, 0), 1, 0});
    joints_.erase(id);
  }
  next_breaks.clear();
  const double h = settings_.time_step;
  for (auto& [id, body] : bodies_) {
    if (body.def.type == BodyType::kDynamic) body.state.velocity += h / body.def.mass.value_or(1) * body.force;
    body.state.position += h * body.state.velocity;
    body.state.angle += h * body.state.angular_velocity;
  }
}

void FakeWorld::capture(BodyColumns& out, bool include_static) const {
  out = {};
  for (const auto& [id, body] : bodies_) {
    if (body.def.type == BodyType::kStatic && !include_static) continue;
    out.id.push_back(id);
    out.x.push_back(body.state.position.x());
    out.y.push_back(body.state.position.y());
    out.angle.push_back(body.state.angle);
    out.velocity_x.push_back(body.state.velocity.x());
    out.velocity_y.push_back(body.state.velocity.y());
    out.angular_velocity.push_back(body.state.angular_velocity);
    out.awake.push_back(body.state.awake ? 1 : 0);
  }
}

Counters FakeWorld::counters() const {
  Counters counters;
  counters.bodies = static_cast<std::uint32_t>(bodies_.size());
  return counters;
}

Expected<std::vector<BodyId>> FakeWorld::query_point(const Vec2& point) const { return query_aabb(point, point); }

Expected<std::vector<BodyId>> FakeWorld::query_aabb(const Vec2& lower, const Vec2& upper) const {
  std::vector<BodyId> ids;
  for (const auto& [id, body] : bodies_) {
    const Vec2& p = body.state.position;
    if ((p.array() >= lower.array()).all() && (p.array() <= upper.array()).all()) ids.push_back(id);
  }
  return ids;
}

}  // namespace urto::testing

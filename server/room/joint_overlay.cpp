#include "room/joint_overlay.h"

#include <variant>

namespace urto {

JointOverlay::JointOverlay(const JointRegistry& now, const JointRegistry& after_reset)
    : base_(&now), after_reset_(&after_reset), count_(now.count()) {}

const JointOverlay::Made* JointOverlay::made(const JointRef& ref) const {
  const auto* name = std::get_if<std::string>(&ref);
  if (name == nullptr || name->empty()) return nullptr;
  for (const Made& joint : made_)
    if (joint.name == *name) return &joint;
  return nullptr;
}

std::optional<JointKind> JointOverlay::find(const JointRef& ref) const {
  if (const Made* joint = made(ref)) return joint->kind;
  const JointRecordPtr record = base_->find(ref);
  if (!record || removed_.contains(record->id)) return std::nullopt;
  return static_cast<JointKind>(record->spec.def.geometry.index());
}

void JointOverlay::create(const JointSpec& spec, const std::optional<BodyRef>& a, const BodyRef& b) {
  made_.push_back({spec.name, static_cast<JointKind>(spec.def.geometry.index()), a, b});
  ++count_;
}

void JointOverlay::destroy(const JointRef& ref) {
  --count_;
  if (const Made* joint = made(ref)) {
    made_.erase(made_.begin() + (joint - made_.data()));
    return;
  }
  removed_.insert(base_->find(ref)->id);
}

void JointOverlay::despawn(const BodyRef& body) {
  count_ -= std::erase_if(made_, [&](const Made& joint) { return joint.b == body || joint.a == body; });
  const auto* id = std::get_if<BodyId>(&body);
  if (id == nullptr) return;
  for (const JointId joint : base_->joints_of(*id)) count_ -= removed_.insert(joint).second ? 1 : 0;
}

void JointOverlay::reset() {
  base_ = after_reset_;
  removed_.clear();
  made_.clear();
  count_ = base_->count();
}

}  // namespace urto

#include "room/joint_registry.h"

#include <utility>

namespace urto {

void JointRegistry::add(JointRecordPtr record) {
  const JointId id = record->id;
  if (!record->spec.name.empty()) by_name_[record->spec.name] = id;
  for (const BodyId body : {record->spec.def.body_a, record->spec.def.body_b})
    if (body != 0) by_body_[body].insert(id);
  by_id_[id] = std::move(record);
}

void JointRegistry::remove(JointId id) {
  const auto it = by_id_.find(id);
  if (it == by_id_.end()) return;
  for (const BodyId body : {it->second->spec.def.body_a, it->second->spec.def.body_b}) {
    const auto joints = by_body_.find(body);
    if (joints == by_body_.end()) continue;
    joints->second.erase(id);
    if (joints->second.empty()) by_body_.erase(joints);
  }
  by_name_.erase(it->second->spec.name);
  by_id_.erase(it);
}

void JointRegistry::remove_joints_of(BodyId body) {
  for (const JointId id : joints_of(body)) remove(id);
}

std::set<JointId> JointRegistry::joints_of(BodyId body) const {
  const auto it = by_body_.find(body);
  return it == by_body_.end() ? std::set<JointId>() : it->second;
}

JointRecordPtr JointRegistry::find(const JointRef& ref) const {
  JointId id = 0;
  if (const auto* name = std::get_if<std::string>(&ref)) {
    const auto named = by_name_.find(*name);
    if (named == by_name_.end()) return nullptr;
    id = named->second;
  } else {
    id = std::get<JointId>(ref);
  }
  const auto it = by_id_.find(id);
  return it == by_id_.end() ? nullptr : it->second;
}

}  // namespace urto

#include "room/body_registry.h"

#include <utility>

namespace urto {

void BodyRegistry::add(BodyRecordPtr record) {
  const BodyId id = record->id;
  if (!record->spec.name.empty()) by_name_[record->spec.name] = id;
  shape_count_ += shape_count_of(record->spec.def);
  by_id_[id] = std::move(record);
}

void BodyRegistry::remove(BodyId id) {
  const auto it = by_id_.find(id);
  if (it == by_id_.end()) return;
  shape_count_ -= shape_count_of(it->second->spec.def);
  by_name_.erase(it->second->spec.name);
  by_id_.erase(it);
}

BodyRecordPtr BodyRegistry::find(BodyId id) const {
  const auto it = by_id_.find(id);
  return it == by_id_.end() ? nullptr : it->second;
}

BodyRecordPtr BodyRegistry::find(const std::string& name) const {
  const auto it = by_name_.find(name);
  return it == by_name_.end() ? nullptr : find(it->second);
}

BodyRecordPtr BodyRegistry::find(const BodyRef& ref) const {
  if (const auto* id = std::get_if<BodyId>(&ref)) return find(*id);
  return find(std::get<std::string>(ref));
}

}  // namespace urto

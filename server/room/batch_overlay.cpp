#include "room/batch_overlay.h"

#include <variant>

namespace urto {

BatchOverlay::BatchOverlay(const BodyRegistry& now, const BodyRegistry& after_reset, bool is_paused)
    : paused(is_paused),
      base_(&now),
      after_reset_(&after_reset),
      body_count_(now.body_count()),
      shape_count_(now.shape_count()) {}

std::optional<BatchOverlay::Target> BatchOverlay::find(const BodyRef& ref) const {
  if (const auto* name = std::get_if<std::string>(&ref)) {
    if (const auto it = by_name_.find(*name); it != by_name_.end()) {
      if (!it->second) return std::nullopt;
      return Target{it->second->type, *name};
    }
  }
  const BodyRecordPtr record = base_->find(ref);
  if (!record || removed_.contains(record->id)) return std::nullopt;
  return Target{record->spec.def.type, record->id};
}

void BatchOverlay::spawn(const BodySpec& spec) {
  ++body_count_;
  shape_count_ += shape_count_of(spec.def);
  if (!spec.name.empty()) by_name_[spec.name] = Spawned{spec.def.type, shape_count_of(spec.def)};
}

void BatchOverlay::despawn(const BodyRef& ref) {
  --body_count_;
  if (const auto* name = std::get_if<std::string>(&ref)) {
    if (const auto it = by_name_.find(*name); it != by_name_.end()) {
      shape_count_ -= it->second->shape_count;
      it->second.reset();
      return;
    }
  }
  const BodyRecordPtr record = base_->find(ref);
  shape_count_ -= shape_count_of(record->spec.def);
  removed_.insert(record->id);
}

void BatchOverlay::reset() {
  base_ = after_reset_;
  removed_.clear();
  by_name_.clear();
  body_count_ = base_->body_count();
  shape_count_ = base_->shape_count();
}

}  // namespace urto

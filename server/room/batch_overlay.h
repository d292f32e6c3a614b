#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "room/body_registry.h"

namespace urto {

// The room as it will be while a batch is being applied: the bodies that are there, with what the commands so far will
// have added and removed. Nothing is copied and nothing is changed.
class BatchOverlay {
 public:
  // `after_reset` are the bodies that a reset brings back.
  BatchOverlay(const BodyRegistry& now, const BodyRegistry& after_reset, bool paused);

  struct Target {
    BodyType type = BodyType::kDynamic;
    BodyRef key = BodyId{0};  // its id, or its name if this batch spawns it
  };
  std::optional<Target> find(const BodyRef& ref) const;

  void spawn(const BodySpec& spec);
  void despawn(const BodyRef& ref);  // of a body that find() finds
  void reset();

  std::size_t body_count() const { return body_count_; }
  std::size_t shape_count() const { return shape_count_; }

  bool paused = false;

 private:
  struct Spawned {
    BodyType type = BodyType::kDynamic;
    std::size_t shape_count = 0;
  };

  const BodyRegistry* base_;
  const BodyRegistry* after_reset_;
  std::set<BodyId> removed_;                               // of base_
  std::map<std::string, std::optional<Spawned>> by_name_;  // named in this batch; absent value: removed
  std::size_t body_count_;
  std::size_t shape_count_;
};

}  // namespace urto

#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "physics/world.h"
#include "room/command.h"

namespace urto {

// A body as the room knows it. It never changes, so threads may share it.
struct BodyRecord {
  BodyId id = 0;
  BodySpec spec;     // as it was spawned
  std::string user;  // who spawned it; empty: the scene
  MassProperties mass;
};
using BodyRecordPtr = std::shared_ptr<const BodyRecord>;

// The room's bodies by id and by name. Copies share their records.
class BodyRegistry {
 public:
  void add(BodyRecordPtr record);
  void remove(BodyId id);

  // Null if there is none.
  BodyRecordPtr find(BodyId id) const;
  BodyRecordPtr find(const std::string& name) const;
  BodyRecordPtr find(const BodyRef& ref) const;

  std::size_t body_count() const { return by_id_.size(); }
  std::size_t shape_count() const { return shape_count_; }
  const std::map<BodyId, BodyRecordPtr>& all() const { return by_id_; }

 private:
  std::map<BodyId, BodyRecordPtr> by_id_;
  std::map<std::string, BodyId> by_name_;
  std::size_t shape_count_ = 0;
};

}  // namespace urto

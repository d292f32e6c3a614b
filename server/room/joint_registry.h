#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "room/command.h"

namespace urto {

// A joint as the room knows it. It never changes, so threads may share it.
struct JointRecord {
  JointId id = 0;
  JointSpec spec;    // as it was made, with the bodies' ids
  std::string user;  // who made it; empty: the scene
};
using JointRecordPtr = std::shared_ptr<const JointRecord>;

// The room's joints by id, by name and by body. Copies share their records.
class JointRegistry {
 public:
  void add(JointRecordPtr record);
  void remove(JointId id);
  void remove_joints_of(BodyId body);

  JointRecordPtr find(const JointRef& ref) const;  // null if there is none
  std::size_t count() const { return by_id_.size(); }
  std::set<JointId> joints_of(BodyId body) const;
  const std::map<JointId, JointRecordPtr>& all() const { return by_id_; }

 private:
  std::map<JointId, JointRecordPtr> by_id_;
  std::map<std::string, JointId> by_name_;
  std::map<BodyId, std::set<JointId>> by_body_;
};

}  // namespace urto

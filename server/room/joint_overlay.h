#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "room/joint_registry.h"

namespace urto {

// The room's joints as they will be while a batch is being applied (see BatchOverlay). Bodies are told apart by their
// id, or by their name if the batch spawns them.
class JointOverlay {
 public:
  JointOverlay(const JointRegistry& now, const JointRegistry& after_reset);

  std::optional<JointKind> find(const JointRef& ref) const;

  void create(const JointSpec& spec, const std::optional<BodyRef>& a, const BodyRef& b);
  void destroy(const JointRef& ref);  // of a joint that find() finds
  void despawn(const BodyRef& body);
  void reset();

  std::size_t count() const { return count_; }

 private:
  struct Made {
    std::string name;
    JointKind kind = JointKind::kRevolute;
    std::optional<BodyRef> a;
    BodyRef b;
  };

  const Made* made(const JointRef& ref) const;

  const JointRegistry* base_;
  const JointRegistry* after_reset_;
  std::set<JointId> removed_;  // of base_
  std::vector<Made> made_;     // in this batch
  std::size_t count_;
};

}  // namespace urto

#include "room/roster.h"

namespace urto {

bool Roster::join(const Member& member) {
  if (members_.size() >= members_max_) return false;
  return members_.insert(member).second;
}

}  // namespace urto

#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "physics/world.h"
#include "room/body_registry.h"
#include "room/joint_registry.h"

namespace urto {

struct BodyAdded {
  BodyRecordPtr body;
  std::uint64_t layout = 0;  // the layout that it begins
};
struct BodyRemoved {
  BodyId id = 0;
  std::uint64_t layout = 0;
  std::string user;
};
struct JointAdded {
  JointRecordPtr joint;
};
struct JointRemoved {
  JointId id = 0;
  std::string user;
};
struct MemberJoined {
  std::string user, session;
};
struct MemberLeft {
  std::string user, session;
};
struct RoomPaused {
  std::string user;
};
struct RoomResumed {
  std::string user;
};
// The bodies of the scene are back, all others are gone, ids start anew.
struct RoomReset {
  std::string user;
  std::uint32_t epoch = 0;
};
struct TimeScaleChanged {
  std::string user;
  double scale = 1;
};
// A batch that was sent without asking for an answer and was rejected.
struct BatchRejected {
  std::string user;
  std::uint64_t sequence = 0;
  std::string reason;
};
// Events beyond the room's limit per tick were left out.
struct EventsDropped {
  std::uint32_t count = 0;
};

using Event =
    std::variant<ContactEvent, BodyAdded, BodyRemoved, MemberJoined, MemberLeft, RoomPaused, RoomResumed, RoomReset,
                 TimeScaleChanged, BatchRejected, EventsDropped, JointAdded, JointRemoved, JointEvent>;

}  // namespace urto

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "room/body_registry.h"
#include "room/command.h"
#include "room/frame.h"
#include "room/joint_registry.h"

namespace urto {

// The codes of proto/urto/v1/command.proto, by the same numbers.
enum class RejectionCode : std::uint8_t {
  kMalformed = 1,
  kInvalidValue = 2,
  kUnknownBody = 3,
  kDuplicateName = 4,
  kDegenerateShape = 5,
  kWrongBodyType = 6,
  kNotPermitted = 7,
  kQuota = 8,
  kQueueFull = 9,
  kNotPaused = 10,
  kCancelled = 11,
  kUnknownJoint = 12,
  kWrongJointKind = 13,
  kNotSupported = 14,
};

// Why a batch was not done.
struct Rejection {
  RejectionCode code = RejectionCode::kMalformed;
  std::uint32_t index = 0;  // of the command in the batch
  std::string field;        // e.g. "spawn.body.shapes[0].box.width"
  std::string value;        // what was sent there, as text
  std::string message;      // one sentence for people
};

// A body with what the world says of it now.
struct BodyInfo {
  BodyRecordPtr record;
  BodyState state;
};

// A joint with what the world says of it now.
struct JointInfo {
  JointRecordPtr record;
  JointState state;
};

struct BodyHit {
  BodyId id = 0;
  Vec2 point{0, 0};        // m, world frame
  Vec2 normal{0, 0};       // unit, out of the body (ray, cast, nearest and closest)
  double fraction = 0;     // of the translation of a ray or a cast
  double distance = 0;     // m (of the way of a ray or a cast; nearest; closest: negative if they overlap)
  Vec2 query_point{0, 0};  // m, world frame, of the query's shape (closest)
};

struct Diagnostics {
  std::uint64_t tick = 0;
  double sim_time = 0;  // s
  std::uint64_t state_hash = 0;
  Statistics statistics;
};

struct QueryResult {
  std::vector<BodyHit> hits;
  bool truncated = false;  // cast, overlap and closest: more bodies were found
  std::optional<std::vector<ContactPoint>> contacts;
  std::optional<Diagnostics> diagnostics;
  std::optional<BodyInfo> body;
  std::optional<std::vector<JointInfo>> joints;
};

struct CommandResult {
  BodyId id = 0;                          // spawn, create_joint
  std::optional<QueryResult> query;       // query
  std::shared_ptr<const Frame> snapshot;  // step
};

struct BatchReply {
  std::uint64_t sequence = 0;
  std::uint32_t epoch = 0;
  std::uint64_t tick = 0;  // ticks done when the commands took effect or were rejected
  std::vector<CommandResult> results;
  std::optional<Rejection> rejection;
};

// A reply on its way to the one who holds the ticket.
struct Answer {
  Ticket ticket = kNoAnswer;
  BatchReply reply;
};

}  // namespace urto

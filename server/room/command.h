#pragma once

// What a member asks of a room. The structs mirror proto/urto/v1/command.proto; units and frames are said there and
// here.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "physics/query_shape.h"
#include "room/scene.h"

namespace urto {

// A joint of the room: by id, or by the name it was made with (also earlier in the same batch).
using JointRef = std::variant<JointId, std::string>;

struct Spawn {
  BodySpec body;
};

struct Despawn {
  BodyRef body;
};

struct Impulse {
  BodyRef body;
  Vec2 impulse{0, 0};                        // N·s
  std::optional<Vec2> point = std::nullopt;  // m; absent: the centre of mass
  bool in_body_frame = false;                // of impulse and point
  double angular = 0;                        // N·m·s, added about the centre of mass
};

struct Force {
  BodyRef body;
  Vec2 force{0, 0};                               // N at the centre of mass
  double torque = 0;                              // N·m
  bool in_body_frame = false;                     // turns with the body
  std::optional<double> duration = std::nullopt;  // s of simulated time > 0; absent: until changed
};

// Absent parts stay as they are.
struct SetVelocity {
  BodyRef body;
  std::optional<Vec2> velocity = std::nullopt;            // m/s, world frame, of the centre of mass
  std::optional<double> angular_velocity = std::nullopt;  // rad/s
};

// Absent parts stay as they are.
struct SetTransform {
  BodyRef body;
  std::optional<Vec2> position = std::nullopt;  // m, world frame
  std::optional<double> angle = std::nullopt;   // rad
};

struct CreateJoint {
  JointSpec joint;
};
struct DestroyJoint {
  JointRef joint;
};
struct SetMotor {
  JointRef joint;
  JointMotor motor;
};
struct SetTarget {
  JointRef joint;
  Vec2 target{0, 0};  // m, world frame
};

struct Pause {};
struct Resume {};
struct Step {
  std::uint32_t ticks = 1;
};
struct Reset {};
struct SetTimeScale {
  double scale = 1;  // simulated seconds per second of the room's clock
};

struct PointQuery {
  Vec2 point{0, 0};  // m, world frame
};
struct RegionQuery {
  Vec2 lower{0, 0}, upper{0, 0};  // m, world frame
};
struct RayQuery {
  Vec2 origin{0, 0}, translation{0, 0};  // m, world frame
};
struct NearestQuery {
  Vec2 point{0, 0};             // m, world frame
  double distance_max = 0;      // m
  std::uint32_t count_max = 1;  // 1 to kNearestCountMax
};
struct ContactsQuery {};
struct DiagnosticsQuery {};
struct BodyQuery {
  BodyRef body;
};
struct JointsQuery {};
struct CastQuery {
  QueryShape shape;
  Vec2 translation{0, 0};  // m
  QueryOptions options;
};
struct OverlapQuery {
  QueryShape shape;
  QueryOptions options;
};
struct ClosestQuery {
  QueryShape shape;
  double distance_max = 0;  // m
  QueryOptions options;
};
using RoomQuery = std::variant<PointQuery, RegionQuery, RayQuery, NearestQuery, ContactsQuery, DiagnosticsQuery,
                               BodyQuery, JointsQuery, CastQuery, OverlapQuery, ClosestQuery>;

using Command = std::variant<Spawn, Despawn, Impulse, Force, SetVelocity, SetTransform, Pause, Resume, Step, Reset,
                             SetTimeScale, CreateJoint, DestroyJoint, SetMotor, SetTarget, RoomQuery>;

// Commands that take effect together: at one tick, in order, or none of them.
struct CommandBatch {
  std::uint64_t sequence = 0;  // chosen by the sender, echoed in the answer
  std::vector<Command> commands;
};

// Names the one who waits for an answer. The room hands it back and knows no more about it.
using Ticket = std::uint64_t;
inline constexpr Ticket kNoAnswer = 0;

// A batch on its way into the room.
struct Submission {
  std::string user;
  Ticket ticket = kNoAnswer;
  CommandBatch batch;
  std::size_t bytes = 0;  // size on the wire, which counts against the queue's bounds
};

}  // namespace urto

#include "codec/command_codec.h"

#include <google/protobuf/arena.h>

#include <optional>
#include <utility>

#include "codec/check_message.h"
#include "codec/joint_codec.h"
#include "codec/room_codec.h"
#include "codec/scene_codec.h"
#include "codec/snapshot_codec.h"
#include "urto/v1/command.pb.h"

namespace urto::codec {
namespace {

static_assert(v1::REJECTION_CODE_MALFORMED == static_cast<int>(RejectionCode::kMalformed));
static_assert(v1::REJECTION_CODE_INVALID_VALUE == static_cast<int>(RejectionCode::kInvalidValue));
static_assert(v1::REJECTION_CODE_UNKNOWN_BODY == static_cast<int>(RejectionCode::kUnknownBody));
static_assert(v1::REJECTION_CODE_DUPLICATE_NAME == static_cast<int>(RejectionCode::kDuplicateName));
static_assert(v1::REJECTION_CODE_DEGENERATE_SHAPE == static_cast<int>(RejectionCode::kDegenerateShape));
static_assert(v1::REJECTION_CODE_WRONG_BODY_TYPE == static_cast<int>(RejectionCode::kWrongBodyType));
static_assert(v1::REJECTION_CODE_NOT_PERMITTED == static_cast<int>(RejectionCode::kNotPermitted));
static_assert(v1::REJECTION_CODE_QUOTA == static_cast<int>(RejectionCode::kQuota));
static_assert(v1::REJECTION_CODE_QUEUE_FULL == static_cast<int>(RejectionCode::kQueueFull));
static_assert(v1::REJECTION_CODE_NOT_PAUSED == static_cast<int>(RejectionCode::kNotPaused));
static_assert(v1::REJECTION_CODE_CANCELLED == static_cast<int>(RejectionCode::kCancelled));
static_assert(v1::REJECTION_CODE_UNKNOWN_JOINT == static_cast<int>(RejectionCode::kUnknownJoint));
static_assert(v1::REJECTION_CODE_WRONG_JOINT_KIND == static_cast<int>(RejectionCode::kWrongJointKind));
static_assert(v1::REJECTION_CODE_NOT_SUPPORTED == static_cast<int>(RejectionCode::kNotSupported));

constexpr std::uint32_t kEveryBit = 0xffffffffu;

Rejection rejection_from(const FieldIssue& issue) {
  const auto code =
      issue.kind == FieldIssue::Kind::kMalformed ? RejectionCode::kMalformed : RejectionCode::kInvalidValue;
  return Rejection{code, 0, issue.field, issue.value, issue.message};
}

// Of a cast, an overlap or a closest-point query.
template <class Query>
QueryOptions options_from(const Query& message) {
  QueryOptions options;
  if (message.has_filter()) {
    const v1::QueryFilter& filter = message.filter();
    options.filter =
        Filter{filter.has_category() ? filter.category() : kEveryBit, filter.has_mask() ? filter.mask() : kEveryBit};
  }
  if (message.count_max() != 0) options.count_max = message.count_max();
  return options;
}

// Reads one command. What is missing is noted in `missing`, the first only.
class CommandReader {
 public:
  std::optional<std::string> missing;  // field path

  Command read(const v1::Command& message) {
    switch (message.command_case()) {
      case v1::Command::kSpawn:
        return read(message.spawn());
      case v1::Command::kDespawn:
        return Despawn{target(message.despawn().has_body(), message.despawn().body(), "despawn")};
      case v1::Command::kImpulse:
        return read(message.impulse());
      case v1::Command::kForce:
        return read(message.force());
      case v1::Command::kSetVelocity:
        return read(message.set_velocity());
      case v1::Command::kSetTransform:
        return read(message.set_transform());
      case v1::Command::kPause:
        return Pause{};
      case v1::Command::kResume:
        return Resume{};
      case v1::Command::kStep:
        return Step{message.step().ticks()};
      case v1::Command::kReset:
        return Reset{};
      case v1::Command::kSetTimeScale:
        return SetTimeScale{message.set_time_scale().scale()};
      case v1::Command::kQuery:
        return read(message.query());
      case v1::Command::kCreateJoint:
        return read(message.create_joint());
      case v1::Command::kDestroyJoint:
        return DestroyJoint{
            joint(message.destroy_joint().has_joint(), message.destroy_joint().joint(), "destroy_joint")};
      case v1::Command::kSetMotor:
        need(message.set_motor().has_motor(), "set_motor.motor");
        return SetMotor{joint(message.set_motor().has_joint(), message.set_motor().joint(), "set_motor"),
                        motor_from_proto(message.set_motor().motor())};
      case v1::Command::kSetTarget:
        need(message.set_target().has_target(), "set_target.target");
        return SetTarget{joint(message.set_target().has_joint(), message.set_target().joint(), "set_target"),
                         vector_from_proto(message.set_target().target())};
      case v1::Command::COMMAND_NOT_SET:
        break;  // check_message() lets none pass
    }
    need(false, "command");
    return Pause{};
  }

 private:
  void need(bool present, const std::string& field) {
    if (!present && !missing) missing = field;
  }

  BodyRef target(bool present, const v1::BodyRef& ref, const std::string& command) {
    need(present, command + ".body");
    return body_ref_from_proto(ref);
  }

  JointRef joint(bool present, const v1::JointRef& ref, const std::string& command) {
    need(present, command + ".joint");
    if (ref.ref_case() == v1::JointRef::kName) return ref.name();
    return ref.id();
  }

  CreateJoint read(const v1::CreateJoint& message) {
    need(message.has_joint(), "create_joint.joint");
    need(message.joint().has_body_b(), "create_joint.joint.body_b");
    return CreateJoint{joint_from_proto(message.joint())};
  }

  Spawn read(const v1::Spawn& message) {
    need(message.has_body(), "spawn.body");
    return Spawn{body_from_proto(message.body())};
  }

  Impulse read(const v1::Impulse& message) {
    Impulse command;
    command.body = target(message.has_body(), message.body(), "impulse");
    command.impulse = vector_from_proto(message.impulse());
    if (message.has_point()) command.point = vector_from_proto(message.point());
    command.in_body_frame = message.frame() == v1::FRAME_BODY;
    command.angular = message.angular();
    return command;
  }

  Force read(const v1::Force& message) {
    Force command;
    command.body = target(message.has_body(), message.body(), "force");
    command.force = vector_from_proto(message.force());
    command.torque = message.torque();
    command.in_body_frame = message.frame() == v1::FRAME_BODY;
    if (message.has_duration()) command.duration = message.duration();
    return command;
  }

  SetVelocity read(const v1::SetVelocity& message) {
    SetVelocity command;
    command.body = target(message.has_body(), message.body(), "set_velocity");
    if (message.has_velocity()) command.velocity = vector_from_proto(message.velocity());
    if (message.has_angular_velocity()) command.angular_velocity = message.angular_velocity();
    return command;
  }

  SetTransform read(const v1::SetTransform& message) {
    SetTransform command;
    command.body = target(message.has_body(), message.body(), "set_transform");
    if (message.has_position()) command.position = vector_from_proto(message.position());
    if (message.has_angle()) command.angle = message.angle();
    return command;
  }

  RoomQuery read(const v1::Query& message) {
    switch (message.query_case()) {
      case v1::Query::kPoint:
        return PointQuery{vector_from_proto(message.point().point())};
      case v1::Query::kRegion:
        need(message.region().has_lower(), "query.region.lower");
        need(message.region().has_upper(), "query.region.upper");
        return RegionQuery{vector_from_proto(message.region().lower()), vector_from_proto(message.region().upper())};
      case v1::Query::kRay:
        return RayQuery{vector_from_proto(message.ray().origin()), vector_from_proto(message.ray().translation())};
      case v1::Query::kNearest:
        return NearestQuery{vector_from_proto(message.nearest().point()), message.nearest().distance_max(),
                            message.nearest().count_max() == 0 ? 1 : message.nearest().count_max()};
      case v1::Query::kContacts:
        return ContactsQuery{};
      case v1::Query::kDiagnostics:
        return DiagnosticsQuery{};
      case v1::Query::kBody:
        return BodyQuery{target(message.body().has_body(), message.body().body(), "query.body")};
      case v1::Query::kJoints:
        return JointsQuery{};
      case v1::Query::kCast:
        need(message.cast().has_shape(), "query.cast.shape");
        return CastQuery{query_shape_from_proto(message.cast().shape()),
                         vector_from_proto(message.cast().translation()), options_from(message.cast())};
      case v1::Query::kOverlap:
        need(message.overlap().has_shape(), "query.overlap.shape");
        return OverlapQuery{query_shape_from_proto(message.overlap().shape()), options_from(message.overlap())};
      case v1::Query::kClosest:
        need(message.closest().has_shape(), "query.closest.shape");
        return ClosestQuery{query_shape_from_proto(message.closest().shape()), message.closest().distance_max(),
                            options_from(message.closest())};
      case v1::Query::QUERY_NOT_SET:
        break;  // check_message() lets none pass
    }
    return ContactsQuery{};
  }
};

tl::expected<Command, Rejection> command_from_proto(const v1::Command& message) {
  if (const auto issue = check_message(message)) return tl::unexpected<Rejection>(rejection_from(*issue));
  CommandReader reader;
  Command command = reader.read(message);
  if (reader.missing) {
    return tl::unexpected<Rejection>(
        Rejection{RejectionCode::kMalformed, 0, *reader.missing, "", "This field is needed."});
  }
  return command;
}

tl::unexpected<DecodeFailure> refused(std::uint64_t sequence, Rejection rejection) {
  return tl::unexpected<DecodeFailure>(DecodeFailure{sequence, std::move(rejection)});
}

void write_result(const CommandResult& result, v1::CommandResult* out) {
  if (result.id != 0) out->set_id(result.id);
  if (result.query) write_query_result(*result.query, out->mutable_query());
  if (result.snapshot) write_snapshot(*result.snapshot, out->mutable_snapshot());
}

void write_rejection(const Rejection& rejection, v1::Rejection* out) {
  out->set_code(static_cast<v1::RejectionCode>(rejection.code));
  out->set_index(rejection.index);
  out->set_field(rejection.field);
  out->set_value(rejection.value);
  out->set_message(rejection.message);
}

}  // namespace

tl::expected<CommandBatch, DecodeFailure> decode_batch(std::string_view bytes, const Limits& limits) {
  if (bytes.size() > limits.message_bytes_max) {
    return refused(0, {RejectionCode::kQuota, 0, "", std::to_string(bytes.size()),
                       "A batch has at most " + std::to_string(limits.message_bytes_max) + " bytes."});
  }
  google::protobuf::Arena arena;
  auto& message = *google::protobuf::Arena::CreateMessage<v1::CommandBatch>(&arena);
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return refused(0, {RejectionCode::kMalformed, 0, "", std::to_string(bytes.size()) + " bytes",
                       "This is not an urto.v1.CommandBatch."});
  }
  if (static_cast<std::uint32_t>(message.commands_size()) > limits.batch_commands_max) {
    return refused(message.sequence(),
                   {RejectionCode::kQuota, 0, "commands", std::to_string(message.commands_size()),
                    "A batch holds at most " + std::to_string(limits.batch_commands_max) + " commands."});
  }
  CommandBatch batch;
  batch.sequence = message.sequence();
  batch.commands.reserve(static_cast<std::size_t>(message.commands_size()));
  for (int i = 0; i < message.commands_size(); ++i) {
    auto command = command_from_proto(message.commands(i));
    if (!command) {
      command.error().index = static_cast<std::uint32_t>(i);
      return refused(batch.sequence, std::move(command.error()));
    }
    batch.commands.push_back(std::move(*command));
  }
  return batch;
}

std::string encode_reply(const BatchReply& reply) {
  google::protobuf::Arena arena;
  auto& message = *google::protobuf::Arena::CreateMessage<v1::CommandReply>(&arena);
  message.set_sequence(reply.sequence);
  message.set_epoch(reply.epoch);
  message.set_tick(reply.tick);
  for (const CommandResult& result : reply.results) write_result(result, message.add_results());
  if (reply.rejection) write_rejection(*reply.rejection, message.mutable_rejection());
  return message.SerializeAsString();
}

}  // namespace urto::codec

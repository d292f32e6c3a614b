// How the room carries out what its members ask: Room::apply_commands and what it calls.

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "physics/geometry/trigonometry.h"
#include "room/admission.h"
#include "room/answer_query.h"
#include "room/build_scene.h"
#include "room/room.h"

namespace urto {
namespace {

// A duration of so small a part of a tick more than a whole number of them is that whole number: 0.1 s are 6 ticks of
// 1/60 s, though 0.1 / (1/60) rounds to more than 6.
constexpr double kTickRounding = 1e-9;

std::uint64_t ticks_of(double duration, double time_step) {
  return static_cast<std::uint64_t>(std::max(1.0, std::ceil(duration / time_step - kTickRounding)));
}

// A value that a body has come to by moving, brought into the range that the engine lets be set.
double bounded(double value, double bound) { return std::isfinite(value) ? std::clamp(value, -bound, bound) : 0; }
Vec2 bounded(const Vec2& vector, double bound) { return {bounded(vector.x(), bound), bounded(vector.y(), bound)}; }

Vec2 rotated(const Vec2& vector, double angle) {
  double sine = 0, cosine = 1;
  sin_cos(angle, sine, cosine);
  return {cosine * vector.x() - sine * vector.y(), sine * vector.x() + cosine * vector.y()};
}

}  // namespace

// Carries out the commands of one batch that admission let pass.
class Room::Applier {
 public:
  using Done = Expected<CommandResult>;

  Applier(Room& room, const Submission& submission, TickResult& result)
      : room_(room), user_(submission.user), result_(result) {}

  Done operator()(const Spawn& command) {
    const auto id = world().add_body(command.body.def);
    if (!id) return tl::unexpected<Error>(id.error());
    const auto mass = world().mass_properties(*id);
    if (!mass) return tl::unexpected<Error>(mass.error());
    const auto record = std::make_shared<BodyRecord>(BodyRecord{*id, command.body, user_, *mass});
    room_.bodies_.add(record);
    room_.log(BodyAdded{record, ++room_.layout_});
    CommandResult done;
    done.id = *id;
    return done;
  }

  Done operator()(const Despawn& command) {
    const BodyId id = target(command.body);
    if (Status status = world().remove_body(id); !status) return tl::unexpected<Error>(status.error());
    room_.bodies_.remove(id);
    room_.joints_.remove_joints_of(id);
    room_.force_ends_.erase(id);
    room_.log(BodyRemoved{id, ++room_.layout_, user_});
    return CommandResult{};
  }

  Done operator()(const Impulse& command) {
    const BodyId id = target(command.body);
    const auto body = world().body(id);
    if (!body) return tl::unexpected<Error>(body.error());
    const double angle = bounded(body->angle, kAngleMax);
    Vec2 impulse = command.impulse;
    if (command.in_body_frame) impulse = rotated(impulse, angle);
    Status status;
    if (command.point) {
      Vec2 point = *command.point;
      if (command.in_body_frame) point = body->position + rotated(point, angle);
      status = world().apply_impulse(id, impulse, bounded(point, kCoordinateMax));
    } else {
      status = world().apply_impulse_to_center(id, impulse);
    }
    if (status && command.angular != 0) status = world().apply_angular_impulse(id, command.angular);
    return done(status);
  }

  Done operator()(const Force& command) {
    const BodyId id = target(command.body);
    room_.force_ends_.erase(id);
    if (command.duration) {
      room_.force_ends_[id] = room_.tick_ + ticks_of(*command.duration, room_.scene_.world.time_step);
    }
    return done(world().set_force(id, command.force, command.torque, command.in_body_frame));
  }

  Done operator()(const SetVelocity& command) {
    const BodyId id = target(command.body);
    const auto body = world().body(id);
    if (!body) return tl::unexpected<Error>(body.error());
    return done(
        world().set_velocity(id, command.velocity.value_or(bounded(body->velocity, kSpeedMax)),
                             command.angular_velocity.value_or(bounded(body->angular_velocity, kAngularSpeedMax))));
  }

  Done operator()(const SetTransform& command) {
    const BodyId id = target(command.body);
    const auto body = world().body(id);
    if (!body) return tl::unexpected<Error>(body.error());
    return done(world().set_transform(id, command.position.value_or(bounded(body->position, kCoordinateMax)),
                                      command.angle.value_or(bounded(body->angle, kAngleMax))));
  }

  Done operator()(const Pause&) {
    if (!room_.paused_) room_.log(RoomPaused{user_});
    room_.paused_ = true;
    return CommandResult{};
  }

  Done operator()(const Resume&) {
    if (room_.paused_) room_.log(RoomResumed{user_});
    room_.paused_ = false;
    return CommandResult{};
  }

  // The ticks come later: see Room::apply_batch.
  Done operator()(const Step&) { return CommandResult{}; }

  Done operator()(const Reset&) {
    auto built = build_scene(room_.scene_, room_.settings_.limits, room_.make_world_);
    if (!built) return tl::unexpected<Error>(built.error());
    auto cancelled = room_.cancel_steps("A reset overtook this step; the commands before it in its batch were done.");
    std::move(cancelled.begin(), cancelled.end(), std::back_inserter(result_.answers));
    room_.world_ = std::move(built->world);
    room_.bodies_ = std::move(built->bodies);
    room_.joints_ = std::move(built->joints);
    room_.force_ends_.clear();
    ++room_.epoch_;
    ++room_.layout_;
    room_.tick_ = 0;
    room_.log(RoomReset{user_, room_.epoch_});
    const std::lock_guard lock(room_.shared_mutex_);
    room_.shared_epoch_ = room_.epoch_;
    room_.shared_tick_ = 0;
    return CommandResult{};
  }

  Done operator()(const CreateJoint& command) {
    JointSpec spec = command.joint;
    if (spec.body_a) spec.def.body_a = target(*spec.body_a);
    spec.def.body_b = target(spec.body_b);
    const auto id = world().add_joint(spec.def);
    if (!id) return tl::unexpected<Error>(id.error());
    const auto record = std::make_shared<JointRecord>(JointRecord{*id, std::move(spec), user_});
    room_.joints_.add(record);
    ++room_.layout_;
    room_.log(JointAdded{record});
    CommandResult done;
    done.id = *id;
    return done;
  }

  Done operator()(const DestroyJoint& command) {
    const JointId id = joint(command.joint);
    if (Status status = world().remove_joint(id); !status) return tl::unexpected<Error>(status.error());
    room_.joints_.remove(id);
    ++room_.layout_;
    room_.log(JointRemoved{id, user_});
    return CommandResult{};
  }

  Done operator()(const SetMotor& command) { return done(world().set_motor(joint(command.joint), command.motor)); }
  Done operator()(const SetTarget& command) { return done(world().set_target(joint(command.joint), command.target)); }

  Done operator()(const SetTimeScale& command) {
    if (room_.time_scale_ != command.scale) room_.log(TimeScaleChanged{user_, command.scale});
    room_.time_scale_ = command.scale;
    return CommandResult{};
  }

  Done operator()(const RoomQuery& query) {
    const auto diagnostics = [this] {
      return Diagnostics{room_.tick_, room_.sim_time(), world().state_hash(), room_.statistics()};
    };
    auto answer = answer_query({world(), room_.bodies_, room_.joints_, diagnostics}, query);
    if (!answer) return tl::unexpected<Error>(answer.error());
    CommandResult done;
    done.query = std::move(*answer);
    return done;
  }

 private:
  World& world() { return *room_.world_; }
  BodyId target(const BodyRef& ref) const { return room_.bodies_.find(ref)->id; }

  JointId joint(const JointRef& ref) const { return room_.joints_.find(ref)->id; }

  static Done done(const Status& status) {
    if (!status) return tl::unexpected<Error>(status.error());
    return CommandResult{};
  }

  Room& room_;
  const std::string& user_;
  TickResult& result_;
};

Expected<std::unique_ptr<Room>> Room::create(RoomSettings settings, SceneDef scene, WorldFactory make_world) {
  std::unique_ptr<Room> room(new Room(std::move(settings), std::move(scene), std::move(make_world)));
  auto built = build_scene(room->scene_, room->settings_.limits, room->make_world_);
  if (!built) return tl::unexpected<Error>(built.error());
  room->world_ = std::move(built->world);
  room->bodies_ = std::move(built->bodies);
  room->scene_bodies_ = room->bodies_;
  room->joints_ = std::move(built->joints);
  room->scene_joints_ = room->joints_;
  return room;
}

void Room::apply_commands(TickResult& result) {
  std::vector<Submission> batches = queue_.drain(turn_);
  if (paused_ && !batches.empty()) ++turn_;  // else a paused room would favour the same member every time
  for (Submission& submission : batches) apply_batch(submission, result);
}

void Room::apply_batch(Submission& submission, TickResult& result) {
  const CommandBatch& batch = submission.batch;
  const AdmissionContext context{settings_.limits, settings_.roles, *world_,
                                 bodies_,          scene_bodies_,   joints_,
                                 scene_joints_,    paused_,         waiting_steps_.size()};
  if (auto bad = check_batch(context, submission.user, batch)) {
    reject_batch(submission, std::move(*bad), result);
    return;
  }
  BatchReply reply;
  reply.sequence = batch.sequence;
  Applier apply(*this, submission, result);
  for (const Command& command : batch.commands) {
    auto done = std::visit(apply, command);
    if (!done) {
      Rejection broken = rejection_from(done.error(), "");
      broken.index = static_cast<std::uint32_t>(reply.results.size());
      broken.message =
          "The engine refused what it had let pass, and the commands before it were done: " + broken.message;
      reject_batch(submission, std::move(broken), result);
      return;
    }
    if (!std::holds_alternative<RoomQuery>(command)) changed_ = true;
    reply.results.push_back(std::move(*done));
  }
  reply.epoch = epoch_;
  reply.tick = tick_;
  if (const auto* step = std::get_if<Step>(&batch.commands.back())) {
    const std::uint64_t begin = waiting_steps_.empty() ? tick_ : waiting_steps_.back().last_tick;
    waiting_steps_.push_back({submission.ticket, std::move(reply), begin + step->ticks});
  } else if (submission.ticket != kNoAnswer) {
    result.answers.push_back({submission.ticket, std::move(reply)});
  }
}

void Room::reject_batch(const Submission& submission, Rejection rejection, TickResult& result) {
  if (submission.ticket == kNoAnswer) {
    report_rejection(submission.user, submission.batch.sequence, rejection);
    return;
  }
  result.answers.push_back({submission.ticket, {submission.batch.sequence, epoch_, tick_, {}, std::move(rejection)}});
}

}  // namespace urto

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "physics/world.h"
#include "room/admission.h"
#include "room/body_registry.h"
#include "room/build_scene.h"
#include "room/command_queue.h"
#include "room/event_log.h"
#include "room/frame.h"
#include "room/limits.h"
#include "room/reply.h"
#include "room/roster.h"
#include "room/scene.h"

namespace urto {

struct RoomSettings {
  Limits limits;
  Roles roles;
  bool paused = false;
  double time_scale = 1;         // kTimeScaleMin to kTimeScaleMax
  double snapshot_rate_hz = 60;  // > 0: frames per simulated second, at most one a tick
  bool publish_hash = false;     // state hash in every frame
};

// What one call of Room::tick brought about.
struct TickResult {
  bool stepped = false;                // the world advanced by one time step
  std::vector<Answer> answers;         // in the order in which they were settled
  EventSlice events;                   // since the last call
  std::shared_ptr<const Frame> frame;  // null if none is due
};

// What a late joiner needs, or who asks what the room is. Nothing in it changes any more.
struct RoomView {
  std::uint32_t epoch = 0;
  std::uint64_t tick = 0;
  bool paused = false;
  double time_scale = 1;
  std::uint64_t state_hash = 0;
  std::vector<Member> members;
  std::vector<Feature> model;
  Statistics statistics;
  // The rest is there only if asked for.
  std::vector<BodyInfo> bodies;        // ascending id
  std::vector<JointInfo> joints;       // ascending id
  std::shared_ptr<const Frame> frame;  // full
  std::vector<std::byte> saved_state;
};

struct ViewParts {
  bool state = false;  // bodies and frame
  bool saved_state = false;
};

// One shared world with its members, commands and ticks. It has no clock, no bytes and no network.
// One thread owns it; only submit() and report_rejection() may be called by others.
class Room {
 public:
  // Errors: of the scene's settings ("world.…"), of its bodies ("bodies[3].…"), of its limits.
  static Expected<std::unique_ptr<Room>> create(RoomSettings settings, SceneDef scene, WorldFactory make_world);

  // Any thread. Queues a batch for its tick; a rejection (the queue is full) is the answer, and nothing was queued.
  std::optional<BatchReply> submit(Submission submission);
  // Any thread. A batch whose sender waits for no answer was rejected outside the room; the members hear of it.
  void report_rejection(const std::string& user, std::uint64_t sequence, const Rejection& rejection);

  // Any thread. The answer to a batch that was rejected outside the room.
  BatchReply rejected(std::uint64_t sequence, Rejection rejection) const;

  // Applies what is queued and, if the room runs or owes ticks, advances it by one time step.
  TickResult tick();

  bool paused() const { return paused_; }
  double time_scale() const { return time_scale_; }
  std::uint32_t ticks_per_snapshot() const { return ticks_per_snapshot_; }
  std::uint64_t ticks_owed() const;  // to step commands
  bool has_work() const;             // a paused room needs a tick() now

  void join(const Member& member);
  void leave(const Member& member);
  void add_overruns(std::uint64_t ticks) { overrun_count_ += ticks; }

  // Answers with kCancelled whatever still waits; for the end of the room.
  std::vector<Answer> close();

  Expected<RoomView> view(const ViewParts& parts) const;
  EventSlice events_since(std::uint64_t sequence, std::size_t count_max) const;

  const SceneDef& scene() const { return scene_; }
  const RoomSettings& settings() const { return settings_; }
  const World& world() const { return *world_; }
  const Roster& roster() const { return roster_; }

 private:
  struct WaitingStep {
    Ticket ticket = kNoAnswer;
    BatchReply reply;
    std::uint64_t last_tick = 0;
  };
  struct Refusal {
    std::string user;
    std::uint64_t sequence = 0;
    std::string reason;
  };
  class Applier;

  Room(RoomSettings settings, SceneDef scene, WorldFactory make_world);

  Status build_world();
  void apply_commands(TickResult& result);
  void apply_batch(Submission& submission, TickResult& result);
  void reject_batch(const Submission& submission, Rejection rejection, TickResult& result);
  std::vector<Answer> cancel_steps(const std::string& reason);
  void step_world();
  void end_forces();
  void log_contacts();
  void log_broken_joints();
  void log_refusals();
  void answer_steps(TickResult& result);
  void capture_frame(TickResult& result);

  void log(Event event) { events_.append(epoch_, tick_, std::move(event)); }
  bool frame_is_due(bool stepped) const;
  std::shared_ptr<const Frame> make_frame(bool full) const;
  Statistics statistics() const;
  double sim_time() const { return static_cast<double>(tick_) * scene_.world.time_step; }

  const RoomSettings settings_;
  const SceneDef scene_;
  const WorldFactory make_world_;
  const std::uint32_t ticks_per_snapshot_;

  std::unique_ptr<World> world_;
  BodyRegistry bodies_;
  BodyRegistry scene_bodies_;  // as they are after every reset: the world gives the same ids again
  JointRegistry joints_;
  JointRegistry scene_joints_;                  // likewise
  std::map<BodyId, std::uint64_t> force_ends_;  // the tick after which a force ends

  CommandQueue queue_;
  Roster roster_;
  EventLog events_;
  std::vector<WaitingStep> waiting_steps_;  // ascending last_tick

  std::uint32_t epoch_ = 1;
  std::uint64_t tick_ = 0;
  std::uint64_t layout_ = 1;
  std::uint64_t turn_ = 0;               // of the queue's round-robin
  std::uint64_t reported_sequence_ = 0;  // of the last event handed out by tick()
  std::uint64_t overrun_count_ = 0;
  bool paused_ = false;
  double time_scale_ = 1;
  bool changed_ = false;  // by a command, since the last frame

  mutable std::mutex shared_mutex_;  // guards what submit() and report_rejection() touch beside the queue
  std::vector<Refusal> refusals_;
  std::uint32_t refusals_dropped_ = 0;
  std::uint32_t shared_epoch_ = 1;
  std::uint64_t shared_tick_ = 0;
};

}  // namespace urto

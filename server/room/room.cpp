#include "room/room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "room/answer_query.h"

namespace urto {
namespace {

std::uint32_t snapshot_interval(double rate_hz, double time_step) {
  constexpr double kTicksMax = 1e9;
  const double ticks = 1 / (rate_hz * time_step);
  if (!std::isfinite(ticks)) return 1;  // of a time step that the engine will refuse
  return static_cast<std::uint32_t>(std::clamp(std::round(ticks), 1.0, kTicksMax));
}

}  // namespace

Room::Room(RoomSettings settings, SceneDef scene, WorldFactory make_world)
    : settings_(std::move(settings)),
      scene_(std::move(scene)),
      make_world_(std::move(make_world)),
      ticks_per_snapshot_(snapshot_interval(settings_.snapshot_rate_hz, scene_.world.time_step)),
      queue_(settings_.limits),
      roster_(settings_.limits.members_max),
      events_(settings_.limits.events_kept_max),
      paused_(settings_.paused),
      time_scale_(settings_.time_scale),
      changed_(true) {}

std::optional<BatchReply> Room::submit(Submission submission) {
  const std::string user = submission.user;
  const std::uint64_t sequence = submission.batch.sequence;
  const bool wants_answer = submission.ticket != kNoAnswer;
  auto rejection = queue_.push(std::move(submission));
  if (!rejection) return std::nullopt;
  if (!wants_answer) report_rejection(user, sequence, *rejection);
  return rejected(sequence, std::move(*rejection));
}

BatchReply Room::rejected(std::uint64_t sequence, Rejection rejection) const {
  const std::lock_guard lock(shared_mutex_);
  return BatchReply{sequence, shared_epoch_, shared_tick_, {}, std::move(rejection)};
}

void Room::report_rejection(const std::string& user, std::uint64_t sequence, const Rejection& rejection) {
  const std::lock_guard lock(shared_mutex_);
  if (refusals_.size() >= settings_.limits.refusals_per_tick_max) {
    ++refusals_dropped_;
    return;
  }
  const std::string where = rejection.field.empty() ? "" : rejection.field + ": ";
  refusals_.push_back({user, sequence, where + rejection.message});
}

TickResult Room::tick() {
  TickResult result;
  apply_commands(result);
  log_refusals();
  if (!paused_ || ticks_owed() > 0) {
    step_world();
    result.stepped = true;
  }
  answer_steps(result);
  capture_frame(result);
  result.events = events_.since(reported_sequence_ + 1, std::numeric_limits<std::size_t>::max());
  reported_sequence_ = events_.last_sequence();
  return result;
}

std::uint64_t Room::ticks_owed() const { return waiting_steps_.empty() ? 0 : waiting_steps_.back().last_tick - tick_; }

bool Room::has_work() const {
  if (ticks_owed() > 0 || !queue_.empty()) return true;
  const std::lock_guard lock(shared_mutex_);
  return !refusals_.empty() || refusals_dropped_ > 0;
}

void Room::step_world() {
  world_->step();
  ++tick_;
  ++turn_;
  end_forces();
  log_contacts();
  log_broken_joints();
  const std::lock_guard lock(shared_mutex_);
  shared_tick_ = tick_;
}

void Room::end_forces() {
  std::erase_if(force_ends_, [this](const auto& entry) {
    if (entry.second > tick_) return false;
    // The body is there: what removes one removes its entry here.
    (void)world_->set_force(entry.first, Vec2(0, 0), 0, false);
    return true;
  });
}

void Room::log_contacts() {
  const auto contacts = world_->contact_events();
  const std::size_t kept = std::min<std::size_t>(contacts.size(), settings_.limits.contact_events_per_tick_max);
  for (const ContactEvent& contact : contacts.first(kept)) log(contact);
  if (kept < contacts.size()) log(EventsDropped{static_cast<std::uint32_t>(contacts.size() - kept)});
}

void Room::log_broken_joints() {
  for (const JointEvent& broken : world_->joint_events()) {
    joints_.remove(broken.joint);
    ++layout_;
    log(broken);
  }
}

void Room::log_refusals() {
  std::vector<Refusal> refusals;
  std::uint32_t dropped = 0;
  {
    const std::lock_guard lock(shared_mutex_);
    refusals.swap(refusals_);
    std::swap(dropped, refusals_dropped_);
  }
  for (Refusal& refusal : refusals) {
    log(BatchRejected{std::move(refusal.user), refusal.sequence, std::move(refusal.reason)});
  }
  if (dropped > 0) log(EventsDropped{dropped});
}

void Room::answer_steps(TickResult& result) {
  std::shared_ptr<const Frame> frame;  // shared by all that end at this tick
  std::size_t done = 0;
  for (; done < waiting_steps_.size() && waiting_steps_[done].last_tick <= tick_; ++done) {
    WaitingStep& step = waiting_steps_[done];
    if (step.ticket == kNoAnswer) continue;
    if (!frame) frame = make_frame(true);
    step.reply.results.back().snapshot = frame;
    result.answers.push_back({step.ticket, std::move(step.reply)});
  }
  waiting_steps_.erase(waiting_steps_.begin(), waiting_steps_.begin() + static_cast<std::ptrdiff_t>(done));
}

std::vector<Answer> Room::cancel_steps(const std::string& reason) {
  std::vector<Answer> answers;
  for (WaitingStep& step : waiting_steps_) {
    if (step.ticket == kNoAnswer) continue;
    const auto index = static_cast<std::uint32_t>(step.reply.results.size() - 1);
    step.reply.results.clear();
    step.reply.epoch = epoch_;
    step.reply.tick = tick_;
    step.reply.rejection = Rejection{RejectionCode::kCancelled, index, "step", "", reason};
    answers.push_back({step.ticket, std::move(step.reply)});
  }
  waiting_steps_.clear();
  return answers;
}

std::vector<Answer> Room::close() {
  std::vector<Answer> answers = cancel_steps("The room is closing; the commands before it in its batch were done.");
  while (!queue_.empty()) {
    for (const Submission& submission : queue_.drain(turn_)) {
      if (submission.ticket == kNoAnswer) continue;
      Rejection rejection{RejectionCode::kCancelled, 0, "", "", "The room is closing."};
      answers.push_back({submission.ticket, {submission.batch.sequence, epoch_, tick_, {}, std::move(rejection)}});
    }
  }
  return answers;
}

void Room::capture_frame(TickResult& result) {
  if (!frame_is_due(result.stepped)) return;
  result.frame = make_frame(false);
  changed_ = false;
}

// Every n-th tick; in a paused room whatever shows a change, and the last tick that was owed.
bool Room::frame_is_due(bool stepped) const {
  if (!stepped) return changed_;
  return tick_ % ticks_per_snapshot_ == 0 || (paused_ && ticks_owed() == 0);
}

std::shared_ptr<const Frame> Room::make_frame(bool full) const {
  auto frame = std::make_shared<Frame>();
  frame->epoch = epoch_;
  frame->tick = tick_;
  frame->sim_time = sim_time();
  frame->layout = layout_;
  frame->precision = scene_.world.precision;
  world_->capture(frame->bodies, full);
  frame->full = full;
  frame->paused = paused_;
  frame->event_sequence = events_.last_sequence();
  if (settings_.publish_hash) frame->state_hash = world_->state_hash();
  frame->statistics = statistics();
  return frame;
}

Statistics Room::statistics() const {
  return Statistics{world_->counters(), world_->profile(), world_->energy(), overrun_count_,
                    static_cast<std::uint32_t>(roster_.members().size())};
}

void Room::join(const Member& member) {
  if (roster_.join(member)) log(MemberJoined{member.user, member.session});
}

void Room::leave(const Member& member) {
  if (roster_.leave(member)) log(MemberLeft{member.user, member.session});
}

Expected<RoomView> Room::view(const ViewParts& parts) const {
  RoomView view;
  view.epoch = epoch_;
  view.tick = tick_;
  view.paused = paused_;
  view.time_scale = time_scale_;
  view.state_hash = world_->state_hash();
  view.members.assign(roster_.members().begin(), roster_.members().end());
  view.model = world_->model();
  view.statistics = statistics();
  if (parts.saved_state) view.saved_state = world_->save();
  if (!parts.state) return view;
  view.frame = make_frame(true);
  view.bodies.reserve(bodies_.body_count());
  for (const auto& [id, record] : bodies_.all()) {
    auto info = body_info(*world_, record);
    if (!info) return tl::unexpected<Error>(info.error());
    view.bodies.push_back(std::move(*info));
  }
  auto joints = joint_infos(*world_, joints_);
  if (!joints) return tl::unexpected<Error>(joints.error());
  view.joints = std::move(*joints);
  return view;
}

EventSlice Room::events_since(std::uint64_t sequence, std::size_t count_max) const {
  return events_.since(sequence, count_max);
}

}  // namespace urto

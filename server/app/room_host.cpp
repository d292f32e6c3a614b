#include "app/room_host.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace urto::app {

std::optional<std::uint64_t> Trouble::due(std::uint64_t now_ns) {
  const std::uint64_t count = count_;
  if (count == reported_ || (last_ns_ && now_ns < *last_ns_ + kTroublePeriodNs)) return std::nullopt;
  last_ns_ = now_ns;
  return count - std::exchange(reported_, count);
}

RoomHost::RoomHost(std::unique_ptr<Room> room, Hooks hooks) : room_(std::move(room)), hooks_(std::move(hooks)) {}

std::optional<std::uint64_t> RoomHost::run_once(std::uint64_t now_ns) {
  if (!start_ns_) start_ns_ = now_ns;
  update_members();
  run_ticks(now_ns);
  serve_requests(now_ns);
  report_trouble(now_ns);
  return next_time(now_ns);
}

void RoomHost::update_members() {
  std::map<Member, bool> changes;
  {
    const std::lock_guard lock(inbox_mutex_);
    changes.swap(membership_);
  }
  for (const auto& [member, present] : changes) {
    if (present) {
      room_->join(member);
    } else {
      room_->leave(member);
    }
    room_changed_ = true;  // its events are published, though nothing moves
  }
}

void RoomHost::run_ticks(std::uint64_t now_ns) {
  if (room_->paused()) {
    schedule_.restart(now_ns);
    // One tick a call, so that a long step neither keeps others from being heard nor waits for the clock.
    if (room_->has_work() || room_changed_) tick();
    return;
  }
  const TickSchedule::Due due = schedule_.advance(now_ns, period());
  overruns_.add(due.overruns);
  room_->add_overruns(due.overruns);
  for (std::uint32_t i = 0; i < due.ticks && !room_->paused(); ++i) tick();
}

void RoomHost::tick() {
  room_changed_ = false;
  TickResult result = room_->tick();
  for (Answer& answer : result.answers) send(std::move(answer));
  if (!result.events.events.empty() && !events.push(std::move(result.events))) {
    unpublished_.add();
  }
  if (result.frame) frames.push(std::move(result.frame));
}

void RoomHost::serve_requests(std::uint64_t now_ns) {
  if (last_view_ns_ && now_ns < *last_view_ns_ + kViewPeriodNs) return;
  std::vector<Request> requests;
  {
    const std::lock_guard lock(inbox_mutex_);
    requests.swap(requests_);
  }
  if (requests.empty()) return;
  last_view_ns_ = now_ns;
  std::vector<ViewRequest> views;
  for (const Request& request : requests) {
    if (const auto* view = std::get_if<ViewRequest>(&request)) {
      views.push_back(*view);
    } else {
      const auto& wanted = std::get<EventsRequest>(request);
      send(EventsReply{wanted.ticket, room_->events_since(wanted.from, kEventsPerRecoveryMax)});
    }
  }
  if (!views.empty()) serve_views(views, now_ns);
}

void RoomHost::serve_views(const std::vector<ViewRequest>& requests, std::uint64_t now_ns) {
  ViewParts parts;
  for (const ViewRequest& request : requests) {
    parts.state |= request.state;
    parts.saved_state |= request.saved_state;
  }
  auto view = room_->view(parts);
  if (!view) {
    for (const ViewRequest& request : requests) send(ErrorReply{request.ticket, view.error().message});
    return;
  }
  const auto shared = std::make_shared<const RoomView>(std::move(*view));
  const double uptime = static_cast<double>(now_ns - *start_ns_) / 1e9;
  for (const ViewRequest& request : requests) {
    send(ViewReply{request.ticket, request.state, request.saved_state, uptime, shared});
  }
}

void RoomHost::report_trouble(std::uint64_t now_ns) {
  if (const auto count = overruns_.due(now_ns)) {
    spdlog::warn(
        "The room cannot keep pace: {} ticks were given up ({} since the start). The last step took {:.2f} ms.", *count,
        overruns_.count(), room_->world().profile().step_ms);
  }
  if (const auto count = unpublished_.due(now_ns)) {
    spdlog::warn("The events of {} ticks were not published, because their queue was full; clients can ask for them.",
                 *count);
  }
  if (const auto count = dropped_answers_.due(now_ns)) {
    spdlog::warn("{} answers were dropped: too many were waiting to be sent.", *count);
  }
  if (const auto count = unnoted_members_.due(now_ns)) {
    spdlog::warn("{} times a member came or went unnoted: too many did at once.", *count);
  }
}

std::optional<std::uint64_t> RoomHost::next_time(std::uint64_t now_ns) const {
  std::optional<std::uint64_t> next;
  if (!room_->paused()) {
    next = schedule_.next_ns(period());
  } else if (room_->has_work()) {
    next = now_ns;
  }
  const std::lock_guard lock(inbox_mutex_);
  if (!requests_.empty() && last_view_ns_) {
    const std::uint64_t view = *last_view_ns_ + kViewPeriodNs;
    next = next ? std::min(*next, view) : view;
  }
  return next;
}

void RoomHost::close() {
  for (Answer& answer : room_->close()) send(std::move(answer));
  frames.close();
  events.close();
  replies.close();
}

void RoomHost::submit(Submission submission) {
  const Ticket ticket = submission.ticket;
  if (auto refused = room_->submit(std::move(submission))) {
    if (ticket != kNoAnswer) send(Answer{ticket, std::move(*refused)});
  }
  hooks_.wake();
}

void RoomHost::refuse(const std::string& user, Ticket ticket, std::uint64_t sequence, Rejection rejection) {
  if (ticket == kNoAnswer) {
    room_->report_rejection(user, sequence, rejection);
    hooks_.wake();
    return;
  }
  send(Answer{ticket, room_->rejected(sequence, std::move(rejection))});
}

void RoomHost::set_member(const Member& member, bool present) {
  {
    const std::lock_guard lock(inbox_mutex_);
    if (membership_.size() >= kMembershipChangesMax && !membership_.contains(member)) {
      unnoted_members_.add();
      return;
    }
    membership_[member] = present;
  }
  hooks_.wake();
}

void RoomHost::request_view(Ticket ticket, bool state, bool saved_state) {
  add_request(ticket, ViewRequest{ticket, state, saved_state});
}

void RoomHost::request_events(Ticket ticket, std::uint64_t from) { add_request(ticket, EventsRequest{ticket, from}); }

void RoomHost::add_request(Ticket ticket, Request request) {
  {
    const std::lock_guard lock(inbox_mutex_);
    if (requests_.size() < kRequestsMax) {
      requests_.push_back(std::move(request));
      ticket = kNoAnswer;
    }
  }
  if (ticket != kNoAnswer) send(ErrorReply{ticket, "Too many questions are waiting; ask again later."});
  hooks_.wake();
}

void RoomHost::send(OutgoingReply reply) {
  const Ticket ticket = std::visit([](const auto& each) { return each.ticket; }, reply);
  if (replies.push(std::move(reply))) return;
  hooks_.on_dropped(ticket);
  dropped_answers_.add();
}

}  // namespace urto::app

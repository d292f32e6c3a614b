#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/bounded_fifo.h"
#include "app/tick_schedule.h"
#include "room/room.h"

namespace urto::app {

// What is on its way from the tick thread to those who asked.
struct ViewReply {
  Ticket ticket = kNoAnswer;
  bool state = false;  // else info alone
  bool saved_state = false;
  double uptime = 0;                     // s
  std::shared_ptr<const RoomView> view;  // shared by all who asked at the same time
};
struct EventsReply {
  Ticket ticket = kNoAnswer;
  EventSlice events;
};
struct ErrorReply {
  Ticket ticket = kNoAnswer;
  std::string message;
};
using OutgoingReply = std::variant<Answer, ViewReply, EventsReply, ErrorReply>;

// What a queue holds before it refuses more. Replies: more than all queues of the room together may hold at their
// usual sizes; an answer beyond is dropped, and its sender told so at once.
inline constexpr std::size_t kRepliesMax = 65'536;
// Slices of events, one a tick at most: four seconds at 60 Hz. Beyond, receivers see a gap and ask for what they miss.
inline constexpr std::size_t kEventSlicesMax = 256;
inline constexpr std::size_t kRequestsMax = 256;            // for info, state and events, waiting for the tick thread
inline constexpr std::size_t kMembershipChangesMax = 4096;  // waiting for the tick thread
inline constexpr std::size_t kEventsPerMessageMax = 1024;
inline constexpr std::size_t kEventsPerRecoveryMax = 4096;
// A view copies the state of all bodies, so it is made at most this often, for all who wait.
inline constexpr std::uint64_t kViewPeriodNs = 5'000'000;
inline constexpr std::uint64_t kTroublePeriodNs = 10'000'000'000;  // between reports in the log of one kind of trouble

// Counts one kind of trouble on any thread, and says now and then how often it came.
class Trouble {
 public:
  void add(std::uint64_t count = 1) { count_ += count; }
  std::uint64_t count() const { return count_; }
  // The number since the last report, if there is one to be made.
  std::optional<std::uint64_t> due(std::uint64_t now_ns);

 private:
  std::atomic<std::uint64_t> count_ = 0;
  std::uint64_t reported_ = 0;
  std::optional<std::uint64_t> last_ns_;
};

// Runs a room by a clock that is handed in. One thread calls run_once(); whatever else is said to be for any thread
// only enqueues. What comes out goes into queues that other threads empty: the tick thread waits for nobody.
class RoomHost {
 public:
  struct Hooks {
    std::function<void()> wake;              // run_once() has something to do before its time
    std::function<void(Ticket)> on_dropped;  // this answer found no place in `replies`
  };
  RoomHost(std::unique_ptr<Room> room, Hooks hooks);

  // Tick thread. Does what is due at `now_ns` of a monotonic clock, and says when to come back without being woken.
  std::optional<std::uint64_t> run_once(std::uint64_t now_ns);
  // Tick thread. Answers all that waits and closes the queues.
  void close();

  // Any thread.
  void submit(Submission submission);
  void refuse(const std::string& user, Ticket ticket, std::uint64_t sequence, Rejection rejection);
  void set_member(const Member& member, bool present);
  void request_view(Ticket ticket, bool state, bool saved_state);
  void request_events(Ticket ticket, std::uint64_t from);

  const Room& room() const { return *room_; }

  LatestSlot<std::shared_ptr<const Frame>> frames;
  BoundedFifo<EventSlice> events{kEventSlicesMax};
  BoundedFifo<OutgoingReply> replies{kRepliesMax};

 private:
  struct ViewRequest {
    Ticket ticket = kNoAnswer;
    bool state = false;
    bool saved_state = false;
  };
  struct EventsRequest {
    Ticket ticket = kNoAnswer;
    std::uint64_t from = 0;
  };
  using Request = std::variant<ViewRequest, EventsRequest>;

  void update_members();
  void run_ticks(std::uint64_t now_ns);
  void tick();
  void serve_requests(std::uint64_t now_ns);
  void serve_views(const std::vector<ViewRequest>& requests, std::uint64_t now_ns);
  void report_trouble(std::uint64_t now_ns);
  std::optional<std::uint64_t> next_time(std::uint64_t now_ns) const;

  void add_request(Ticket ticket, Request request);
  void send(OutgoingReply reply);
  double period() const { return room_->scene().world.time_step / room_->time_scale(); }  // s between ticks

  const std::unique_ptr<Room> room_;
  const Hooks hooks_;
  TickSchedule schedule_;
  std::optional<std::uint64_t> start_ns_;
  std::optional<std::uint64_t> last_view_ns_;
  Trouble overruns_;
  Trouble unpublished_;  // slices of events
  Trouble dropped_answers_;
  Trouble unnoted_members_;
  bool room_changed_ = true;  // tick a paused room once more

  mutable std::mutex inbox_mutex_;
  std::map<Member, bool> membership_;
  std::vector<Request> requests_;
};

}  // namespace urto::app

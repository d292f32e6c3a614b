#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "room/event.h"

namespace urto {

struct EventRecord {
  std::uint32_t epoch = 0;
  std::uint64_t tick = 0;
  Event event;
};

// Events in order, without gaps: events[i] has the sequence number first_sequence + i.
struct EventSlice {
  std::uint32_t epoch = 0;  // of the first event; a RoomReset among them says the next
  std::uint64_t first_sequence = 0;
  std::uint64_t oldest_sequence = 0;  // that the room still has
  std::vector<EventRecord> events;
};

// The room's recent past. When it is full the oldest event goes.
class EventLog {
 public:
  explicit EventLog(std::size_t kept_max) : kept_max_(kept_max) {}

  void append(std::uint32_t epoch, std::uint64_t tick, Event event);

  // Up to count_max events from `sequence` on, or from the oldest kept if that one is gone.
  EventSlice since(std::uint64_t sequence, std::size_t count_max) const;

  std::uint64_t last_sequence() const { return first_ + records_.size() - 1; }  // 0 if none ever was

 private:
  std::size_t kept_max_;
  std::deque<EventRecord> records_;
  std::uint64_t first_ = 1;  // sequence number of records_.front()
};

}  // namespace urto

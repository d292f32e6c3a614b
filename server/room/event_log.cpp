#include "room/event_log.h"

#include <algorithm>
#include <utility>

namespace urto {

void EventLog::append(std::uint32_t epoch, std::uint64_t tick, Event event) {
  records_.push_back({epoch, tick, std::move(event)});
  if (records_.size() > kept_max_) {
    records_.pop_front();
    ++first_;
  }
}

EventSlice EventLog::since(std::uint64_t sequence, std::size_t count_max) const {
  const std::uint64_t from = std::clamp(sequence, first_, last_sequence() + 1);
  const std::size_t offset = from - first_;
  const std::size_t count = std::min(records_.size() - offset, count_max);
  EventSlice slice;
  slice.first_sequence = from;
  slice.oldest_sequence = first_;
  const auto begin = records_.begin() + static_cast<std::ptrdiff_t>(offset);
  slice.events.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  if (!slice.events.empty()) slice.epoch = slice.events.front().epoch;
  return slice;
}

}  // namespace urto

#pragma once

#include <cstdint>

namespace urto::app {

// How many ticks a room that has fallen behind makes up for at once. More of them would come as a jump, and each would
// put it further behind; so the rest is given up, and counted.
inline constexpr std::uint32_t kCatchUpTicksMax = 5;

// The fixed-step accumulator: which ticks are due, given the time that has passed.
class TickSchedule {
 public:
  struct Due {
    std::uint32_t ticks = 0;     // to be done now, at most kCatchUpTicksMax
    std::uint64_t overruns = 0;  // given up
  };

  // ns: times of one monotonic clock. period: s between ticks, > 0; it may change from call to call.
  Due advance(std::uint64_t now_ns, double period);

  // Forgets the time that passed since the last call: the room was paused.
  void restart(std::uint64_t now_ns);

  // When the next tick is due.
  std::uint64_t next_ns(double period) const;

 private:
  std::uint64_t last_ns_ = 0;
  bool started_ = false;
  double accumulated_ = 0;  // s that passed and were not yet turned into ticks
};

}  // namespace urto::app

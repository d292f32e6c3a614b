#pragma once

#include <cstdint>
#include <vector>

#include "physics/world.h"

namespace urto {

// What the last tick cost and held.
struct Statistics {
  Counters counters;
  Profile profile;
  Energy energy;
  std::uint64_t overrun_count = 0;  // ticks given up since the start because the room could not keep pace
  std::uint32_t member_count = 0;
};

// The state of the bodies after a tick.
struct Frame {
  std::uint32_t epoch = 0;   // grows with each reset
  std::uint64_t tick = 0;    // ticks done since the start or the reset
  double sim_time = 0;       // s, tick · time step
  std::uint64_t layout = 0;  // grows whenever a body or a joint is added or removed
  Precision precision = Precision::kFloat;
  BodyColumns bodies;
  bool full = false;  // static bodies are in it
  bool paused = false;
  std::uint64_t event_sequence = 0;  // of the last event before this frame
  std::uint64_t state_hash = 0;      // 0 unless the room publishes hashes
  Statistics statistics;
};

}  // namespace urto

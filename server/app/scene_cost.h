#pragma once

#include <cstdint>
#include <string>

#include "room/room.h"

namespace urto::app {

inline constexpr std::uint32_t kCostStepsMax = 300;  // five seconds at 60 Hz: most scenes fall, meet and settle in them
inline constexpr double kCostMsMax = 3000;           // of all steps together: a huge scene is given fewer

// What each phase of a step takes, in the mean of the steps with anybody awake, or of all if there is none: a scene
// that has gone to sleep costs nothing, and would hide what it cost before.
struct SceneCost {
  std::uint32_t steps = 0, awake_steps = 0;
  Profile mean;
  Profile longest;  // each phase in the step in which it took longest
  Counters last;    // after the last step
};

// Steps a room that runs and has a clock in its world; the room is of no other use afterwards.
SceneCost measure_cost(Room& room);

// As text for people, a line a phase.
std::string cost_text(const SceneCost& cost, unsigned threads);

}  // namespace urto::app

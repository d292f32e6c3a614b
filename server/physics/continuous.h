#pragma once

#include <vector>

#include "physics/constants.h"
#include "physics/data.h"

namespace urto {

// Continuous collision. The solver has decided how each body moves in this step; one that goes further than its own
// half-thickness might pass through something. It is swept against static, kinematic and dynamic bodies alike, all on
// their way, and the earliest impacts are taken first: a fast body stops where it touches, keeps its velocity, and
// the contact of the next step does the rest. No speed is too high, and slow bodies pay nothing.

template <class S>
bool moves_fast(const Body<S>& body, const Motion<S>& motion) {
  if (!body.dynamic()) return false;
  const S turning = absolute(motion.da) * body.extent_max;
  const S way = std::sqrt(motion.dx * motion.dx + motion.dy * motion.dy) + turning;
  return way > S(kFastFraction) * body.extent_min;
}

// The phase. Shortens the motions of fast bodies that would hit; leaves their slots in world.scratch.fast, because
// their bounds in the broad phase are stretched over their way and want setting anew.
template <class S>
void collide_continuously(WorldData<S>& world);

}  // namespace urto

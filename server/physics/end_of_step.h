#pragma once

#include "physics/data.h"

namespace urto {

// Ends the step of all awake bodies: they take over the way that the solver gave them, and their places and bounds
// follow. Lists the dynamic ones that have been slow for long enough to sleep (Scratch::restful).
template <class S>
void end_motions(WorldData<S>& world);

}  // namespace urto

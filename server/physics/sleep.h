#pragma once

#include "physics/data.h"

namespace urto {

// The phase: groups awake bodies into islands of touching contacts and puts those to sleep in which every body has
// been slow for kSleepTime. A kinematic body that moves keeps what it touches awake.
template <class S>
void update_sleep(WorldData<S>& world);

}  // namespace urto

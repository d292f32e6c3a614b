#pragma once

#include "physics/data.h"

namespace urto {

// After the solve, in worlds that ask for it: an event for each contact, not of sensors, that is struck in this step.
// It is if at one of its points an impulse flows and the surfaces closed in faster than the setting's speed when the
// step began; the event is of the point where they did so fastest. A blow that is spread over steps that follow each
// other is one hit: a contact is not struck again before a step has passed in which it was not.
template <class S>
void report_hits(WorldData<S>& world);

}  // namespace urto

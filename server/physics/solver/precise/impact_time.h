#pragma once

#include "physics/solver/precise/path.h"

namespace urto {

// When two shapes on their paths first come together within a span of the step, by conservative advancement on GJK
// distances: the distance along the normal, which turns with the body whose edge is nearest, is bounded from below by
// its slope and a bound of its curvature over the span, so that no contact is stepped over and the search converges
// quadratically. Unlike narrow_phase/time_of_impact it follows parabolas and ends at the surface, not before it.
//
// Shapes that touch and part again are followed until they come back. Times are in seconds into the step.
struct Encounter {
  bool meets = false;
  double time = 0;
};
Encounter first_encounter(const WorldData<double>& world, const Contact<double>& contact, const Path& path_a,
                          const Path& path_b, double from, double to);

}  // namespace urto

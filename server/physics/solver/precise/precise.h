#pragma once

#include <memory>

#include "physics/data.h"

namespace urto {

class PreciseStep;

// The precise solver: a choice of the scene for double precision. A step is flown, not stepped through:
//
//   fly              every body follows its exact path (path.h) until something happens to it
//   settle           bodies that touch share forces that are found to rounding (contact_problem.h, newton.h)
//   meet             the earliest encounter of two bodies is found (impact_time.h), they collide (collision.h), and
//                    the bodies that touch there are settled anew for the rest of the step
//
// Work is bounded (tolerances.h). What is left out by a bound: bodies stop where they touch and go on in the next step.
class PreciseSolver {
 public:
  PreciseSolver();
  ~PreciseSolver();
  void solve(WorldData<double>& world);

 private:
  std::unique_ptr<PreciseStep> step_;  // its buffers are kept from step to step
};

}  // namespace urto

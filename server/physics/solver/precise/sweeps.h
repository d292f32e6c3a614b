#pragma once

#include "physics/solver/precise/contact_problem.h"

namespace urto {

// Projected Gauss-Seidel on the impulses at hand: point after point, each solved exactly with its friction while the
// others stand, forwards and backwards in turn. Slow where loads have far to go, but it knows no states to run in a
// circle over: where the direct methods find no end, what many points violate a little is left of it and not what one
// violates by all. Ends when the largest violation is within the tolerance, or after so many sweeps.
ProblemAnswer solve_by_sweeps(ContactProblem& problem, int sweeps_max);

}  // namespace urto

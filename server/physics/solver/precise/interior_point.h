#pragma once

#include "physics/solver/precise/newton.h"

namespace urto {

// A primal-dual interior-point method (Mehrotra 1992) for the contact problem in terms of the two edges of each
// friction wedge, d± = n ± μ t:  λ = α₊ d₊ + α₋ d₋ with α ≥ 0,  w± = d±·v − target + μ |t·v| ≥ 0,  α± w± = 0. The term
// μ |t·v| (De Saxcé and Feng 1998) keeps sliding bodies from parting; it is brought up to date in each round. A round
// costs one factorisation of M + Σ (α/w) d dᵀ, and the count of rounds hardly grows with the count of bodies or the
// ratio of their masses. It always ends, near the answer but not at it: Newton's method polishes.
void solve_by_interior_point(ContactProblem& problem, ProblemWorkspace& work);

}  // namespace urto

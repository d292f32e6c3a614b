#pragma once

#include "physics/data.h"
#include "physics/solver/joint_set.h"

namespace urto {

// The default solver: sub-stepped soft contacts with warm start, friction, restitution and a relaxation pass, after
// "Soft Step" of Box2D v3 (Catto, "Solver2D", 2024). Ours differs in that
// - impulses act at one world point for both bodies while they drift, so angular momentum is conserved
//   (but for bodies that race past each other, kDriftFraction);
// - the soft contacts have a preload, so that stacks do not stay sunk under their weight (softness.h);
// - two points of a manifold are solved together, so that a stack does not creep sideways;
// - restitution acts in each sub-step, at the speed of the impact;
// - colours are taken forwards and backwards in turn, so that a pile does not lean over to one side.
//
// Per sub-step: integrate velocities, warm start, solve with bias, integrate positions, relax (solve without bias),
// restitute. The warm start goes over the contacts in the first sub-step alone; later ones have its sums by body, which
// the relaxation before has made (Kick). Works on the lanes of the contact set in place; joints come before contacts in
// each pass, so that contacts are firmest. `joints` is a buffer that keeps its capacity between steps.
template <class S>
void solve_soft_step(WorldData<S>& world, JointSet<S>& joints);

}  // namespace urto

#pragma once

#include "physics/solver/joint_set.h"

namespace urto {

// The passes of the soft step over what joints have besides the points of revolute joints, one joint after the other:
// springs, motors and limits along a joint's position, the two rows of a prismatic joint, the three of a weld, and
// the pull of a mouse joint.

template <class S>
void warm_start_rows(WorldData<S>& world, JointSet<S>& set);

// With bias: closes gaps, and lets springs act.
template <class S>
void solve_rows(WorldData<S>& world, JointSet<S>& set, const JointSettings<S>& settings);

// Without; also keeps the totals.
template <class S>
void relax_rows(WorldData<S>& world, JointSet<S>& set, const JointSettings<S>& settings);

}  // namespace urto

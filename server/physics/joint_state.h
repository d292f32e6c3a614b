#pragma once

#include "physics/data.h"

namespace urto {

// What a joint is doing, for its reader.
template <class S>
JointState joint_state_of(const WorldData<S>& world, std::uint32_t slot);

// Removes the joints that carried more in this step than they can, with an event each.
template <class S>
void break_joints(WorldData<S>& world);

}  // namespace urto

#pragma once

#include "physics/data.h"

namespace urto {

// Continuous collision. The solver has decided how each body moves in this step. A pair that closes in by more than
// the thinner one's thickness allows might pass through each other: such pairs, static, kinematic and dynamic alike,
// are swept against each other along their ways, and their impacts are taken in the order of time.
//
// Two that fly freely bounce there and then, with the restitution and friction of their contact, and use the rest of
// the step for the way back. A body that others hold (it touches something, or has joints) is not ours to push: what
// is fast gives way, which means that it moves on without closing in, keeps its velocity, and the contact of the next
// step does the rest. No speed is too high, and slow bodies pay nothing.
//
// The phase. Shapes whose bounds in the broad phase were stretched over their ways are left in world.scratch.stretched:
// they want setting anew.
template <class S>
void collide_continuously(WorldData<S>& world);

}  // namespace urto

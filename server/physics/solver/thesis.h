#pragma once

#include "physics/data.h"

namespace urto {

// The method of the thesis that Urto grew from, kept as a choice for comparison. The time step is cut into n
// sub-iterations; each moves every body by the scene's integrator, looks at every pair whose bounds overlap, pushes
// overlapping bodies apart by the depth (half each, all of it for one against an unmovable one), and gives each
// contact point the impulse
//   j = −(1+e) v·n / (1/m_A + 1/m_B + (r_A×n)²/I_A + (r_B×n)²/I_B) / points
// if the bodies approach there, then a Coulomb friction impulse bounded by μ j (which the thesis did not have).
// No warm start, no sleep.
template <class S>
void solve_thesis(WorldData<S>& world);

}  // namespace urto

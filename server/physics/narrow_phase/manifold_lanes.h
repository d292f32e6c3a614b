#pragma once

#include "physics/simd/lanes.h"

namespace urto {

// Where the two shapes of each lane touch.
template <class S>
struct alignas(64) ManifoldLanes {
  S nx[kLanes<S>], ny[kLanes<S>];                // unit normal from a to b, world frame
  S between_x[kLanes<S>], between_y[kLanes<S>];  // m, from a's centre of mass to b's, world axes
  S x[2][kLanes<S>], y[2][kLanes<S>];            // m, from a's centre of mass, world axes
  S separation[2][kLanes<S>];                    // m
  S id[2][kLanes<S>];                            // small whole numbers
  S count[kLanes<S>];                            // 0, 1 or 2 points
};

// A count that says: this lane is a case for the general routine of manifold.h.
inline constexpr double kAskGeneral = -1;

}  // namespace urto

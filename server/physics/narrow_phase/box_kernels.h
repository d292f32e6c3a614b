#pragma once

#include <cstdint>

#include "physics/places.h"
#include "physics/simd/lanes.h"

namespace urto {

// Where the two boxes of each lane touch: SAT, clipping and the rules for seams and corners of manifold.h, for as many
// pairs side by side as a block has lanes.
template <class S>
struct alignas(64) ManifoldLanes {
  S nx[kLanes<S>], ny[kLanes<S>];                // unit normal from a to b, world frame
  S between_x[kLanes<S>], between_y[kLanes<S>];  // m, from a's centre of mass to b's, world axes
  S x[2][kLanes<S>], y[2][kLanes<S>];            // m, from a's centre of mass, world axes
  S separation[2][kLanes<S>];                    // m
  S id[2][kLanes<S>];                            // small whole numbers
  S count[kLanes<S>];                            // 0, 1 or 2 points
};

template <class S>
struct BoxKernels {
  // Of the pairs (a[i], b[i]) of proxies, all lanes.
  void (*collide)(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b, ManifoldLanes<S>& out);
};

template <class S>
const BoxKernels<S>& box_kernels();

}  // namespace urto

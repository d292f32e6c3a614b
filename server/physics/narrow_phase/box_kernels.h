#pragma once

#include <cstdint>

#include "physics/narrow_phase/manifold_lanes.h"
#include "physics/places.h"

namespace urto {

// SAT, clipping and the rule for corners of manifold.h, for as many pairs of sharp boxes side by side as a block has
// lanes.
template <class S>
struct BoxKernels {
  // Of the pairs (a[i], b[i]) of proxies, all lanes.
  void (*collide)(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b, ManifoldLanes<S>& out);
};

template <class S>
const BoxKernels<S>& box_kernels();

}  // namespace urto

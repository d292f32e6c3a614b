#pragma once

#include <cstdint>

#include "physics/narrow_phase/manifold_lanes.h"
#include "physics/narrow_phase/outline.h"
#include "physics/places.h"

namespace urto {

// The manifolds of manifold.h for as many pairs of outlines with a radius side by side as a block has lanes: circles,
// capsules, rounded boxes and polygons, and sharp ones among them. What is rare is left to the general routine:
// kAskGeneral.
template <class S>
struct RoundedKernels {
  // Of the pairs (a[i], b[i]) of proxies, all lanes.
  void (*collide)(const Place<S>* places, const OutlineRows<S>* outlines, const std::uint32_t* a,
                  const std::uint32_t* b, ManifoldLanes<S>& out);
};

template <class S>
const RoundedKernels<S>& rounded_kernels();

}  // namespace urto

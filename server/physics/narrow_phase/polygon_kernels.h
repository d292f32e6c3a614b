#pragma once

#include <cstdint>

#include "physics/narrow_phase/manifold_lanes.h"
#include "physics/narrow_phase/outline.h"
#include "physics/places.h"

namespace urto {

// SAT and clipping of manifold.h for as many pairs of sharp polygons side by side as a block has lanes. What is rare
// (corners that meet corners) is left to the general routine: kAskGeneral.
template <class S>
struct PolygonKernels {
  // Of the pairs (a[i], b[i]) of proxies, all lanes.
  void (*collide)(const Place<S>* places, const OutlineRows<S>* outlines, const std::uint32_t* a,
                  const std::uint32_t* b, ManifoldLanes<S>& out);
};

template <class S>
const PolygonKernels<S>& polygon_kernels();

}  // namespace urto

#pragma once

#include <cstdint>

#include "physics/places.h"

namespace urto {

// Which pairs close in so fast in a step that the contact between them might miss it: a first look at as many pairs
// side by side as a block has lanes, for continuous collision to look closer at those few. Of the pairs (a[i], b[i]) of
// proxies, a bit each; of all lanes. Ways and turns must be those of the step at hand.
template <class S>
struct ClosingKernels {
  // Of pairs without a lane: those that may meet, by their gap along the line between their centroids.
  std::uint32_t (*closing)(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b);
  // Of pairs with one, which do not close in where they touch: those that may swing through each other around there.
  std::uint32_t (*swinging)(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b);
};

template <class S>
const ClosingKernels<S>& closing_kernels();

}  // namespace urto

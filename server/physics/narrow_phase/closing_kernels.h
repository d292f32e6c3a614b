#pragma once

#include <cstdint>

#include "physics/places.h"

namespace urto {

// Which pairs close in so fast in a step that the contact between them might miss it: a first look at as many pairs
// side by side as a block has lanes, for continuous collision to look closer at those few.
template <class S>
struct ClosingKernels {
  // Of the pairs (a[i], b[i]) of proxies, a bit each; of all lanes. Ways and turns must be those of the step at hand.
  std::uint32_t (*closing)(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b);
};

template <class S>
const ClosingKernels<S>& closing_kernels();

}  // namespace urto

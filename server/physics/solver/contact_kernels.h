#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "physics/solver/constraint.h"

namespace urto {

// The passes of the soft step over blocks of contacts, in vectors as wide as the machine has. Compiled once for each
// instruction set and chosen at run time (Highway); every width gives the same bits.

template <class S>
struct PassSettings {
  S inv_h;      // 1/s
  S bias_rate;  // 1/s
  S compliance;
  S preload_rate;  // share of the way to the impulse per sub-step
  S threshold;     // m/s, of restitution
  bool friction;
};

// One pass over all blocks, in order. Motions are by body slot.
template <class S>
struct ContactPasses {
  using Pass = void (*)(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count,
                        const PassSettings<S>& settings);
  Pass prepare;     // masses, coupling and approach speeds from anchors and velocities
  Pass warm_start;  // applies the impulses of the last sub-step
  Pass solve;       // with bias: pushes overlap apart
  Pass relax;       // without; also keeps the totals and the preload
  Pass restitute;
};

template <class S>
const ContactPasses<S>& contact_passes();

// For tests and benchmarks: the instruction sets that this machine can run, best first, and the choice of one of them
// for all worlds from now on (0: the best).
struct SimdTarget {
  std::int64_t id;
  std::string name;
};
std::vector<SimdTarget> simd_targets();
void use_simd_target(std::int64_t id);

}  // namespace urto

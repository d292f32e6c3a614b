#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "physics/body.h"
#include "physics/contact_block.h"
#include "physics/narrow_phase/box_kernels.h"

namespace urto {

// The passes of the soft step over blocks of contacts, in vectors as wide as the machine has. Compiled once for each
// instruction set and chosen at run time (Highway); every width gives the same bits.

template <class S>
struct PassSettings {
  S inv_h;      // 1/s
  S bias_rate;  // 1/s
  S compliance;
  S sub_step_share;     // of a step: 1 / sub-steps
  S preload_rate;       // share of the way to the mean impulse per step
  S preload_rate_more;  // on top of it, at most
  S threshold;          // m/s, of restitution
  bool friction;
  Kick<S>* kicks;  // by body slot
};

template <class S>
struct ContactPasses {
  using Pass = void (*)(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count,
                        const PassSettings<S>& settings);
  // Takes over new manifolds: impulses are carried over by feature id; masses, coupling and approach speeds follow.
  // Before bodies have moved in the step.
  void (*take)(const Motion<S>* motions, const ManifoldLanes<S>& manifolds, ContactBlock<S>& block,
               ContactBlockRest<S>& rest);
  Pass warm_start;   // applies the impulses of the last step
  Pass solve_first;  // with bias: pushes overlap apart. In the first sub-step, before bodies have moved
  Pass solve;        // in the others
  Pass relax;        // without; also keeps the totals, and adds to the kicks
  Pass relax_last;   // in the last sub-step, which gives no kicks: lets the preloads follow instead
  // Before forces act and after: finds how fast points that close in have to leave.
  using Note = void (*)(const Motion<S>* motions, ContactBlock<S>* blocks, ContactBlockRest<S>* rest, std::size_t count,
                        const PassSettings<S>& settings);
  Note note_approach, note_bounce;
  // Takes back the kicks of what bounces, if there are any.
  void (*restitute)(Motion<S>* motions, ContactBlock<S>* blocks, const ContactBlockRest<S>* rest, std::size_t count,
                    Kick<S>* kicks);
  // Bit mask of the used lanes whose surfaces meet or push. A point that is not there does neither.
  std::uint32_t (*meeting)(const ContactBlock<S>& block, const ContactBlockRest<S>& rest);
};

template <class S>
const ContactPasses<S>& contact_passes();
// The same for blocks of which at most half the lanes are used: where a vector takes a whole block, these are of half
// the width, and cost half as much.
template <class S>
const ContactPasses<S>& half_passes();

// For tests and benchmarks: the instruction sets that this machine can run, best first, and the choice of one of them
// for all worlds from now on (0: the best).
struct SimdTarget {
  std::int64_t id;
  std::string name;
};
std::vector<SimdTarget> simd_targets();
void use_simd_target(std::int64_t id);

}  // namespace urto

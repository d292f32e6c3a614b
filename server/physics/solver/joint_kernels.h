#pragma once

#include <cstddef>

#include "physics/solver/joint_set.h"

namespace urto {

// The passes of the soft step over the points of revolute joints, in vectors as wide as the machine has (see
// contact_kernels.h). One pass goes over all blocks in order; motions are by body slot.
template <class S>
struct PointPasses {
  using Pass = void (*)(Motion<S>* motions, PointBlock<S>* blocks, std::size_t count, const JointSettings<S>& settings);
  Pass prepare;     // arms, gap and masses from where the bodies are
  Pass warm_start;  // applies the impulses of the last sub-step
  Pass solve;       // with bias: closes the gap
  Pass relax;       // the bodies have moved: prepares anew, then solves without bias and keeps the totals
};

template <class S>
const PointPasses<S>& point_passes();

}  // namespace urto

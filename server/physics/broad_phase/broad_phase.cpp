#include "physics/broad_phase/broad_phase.h"

#include "physics/broad_phase/brute_force.h"
#include "physics/broad_phase/bvh.h"
#include "physics/broad_phase/quadtree.h"

namespace urto {

template <class S>
std::unique_ptr<BroadPhase<S>> BroadPhase<S>::create(BroadPhaseKind kind) {
  switch (kind) {
    case BroadPhaseKind::kBruteForce:
      return std::make_unique<BruteForce<S>>();
    case BroadPhaseKind::kQuadtree:
      return std::make_unique<Quadtree<S>>();
    case BroadPhaseKind::kBvh:
      return std::make_unique<Bvh<S>>();
    case BroadPhaseKind::kAuto:
      break;
  }
  return nullptr;
}

template <class S>
void BroadPhase<S>::set_resting(Proxy, bool) {}

template class BroadPhase<float>;
template class BroadPhase<double>;

}  // namespace urto

#include "physics/broad_phase/broad_phase.h"

#include <limits>

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

template <class S>
void BroadPhase<S>::find_new_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) {
  find_pairs(moved, pairs);
  std::erase_if(pairs, [this](const auto& pair) { return knows(pair.first, pair.second); });
  settle(moved);
}

template <class S>
void BroadPhase<S>::forget(Proxy proxy) {
  constexpr S kInfinity = std::numeric_limits<S>::infinity();
  noted_[proxy].before = {Vec<S>(kInfinity, kInfinity), Vec<S>(-kInfinity, -kInfinity)};  // overlaps nothing
}

template <class S>
void BroadPhase<S>::note(Proxy proxy, const Aabb<S>& bounds) {
  noted_[proxy].now = bounds;
}

template <class S>
void BroadPhase<S>::note_new(Proxy proxy, const Aabb<S>& bounds) {
  if (proxy >= noted_.size()) noted_.resize(proxy + 1);
  noted_[proxy].now = bounds;
  forget(proxy);
}

template <class S>
void BroadPhase<S>::settle(std::span<const Proxy> moved) {
  for (const Proxy proxy : moved) noted_[proxy].before = noted_[proxy].now;
}

template class BroadPhase<float>;
template class BroadPhase<double>;

}  // namespace urto

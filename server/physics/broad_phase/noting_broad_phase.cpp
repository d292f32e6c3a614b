#include "physics/broad_phase/noting_broad_phase.h"

namespace urto {

template <class S>
void NotingBroadPhase<S>::find_new_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) {
  this->find_pairs(moved, pairs);
  std::erase_if(pairs,
                [this](const auto& pair) { return noted_[pair.first].before.overlaps(noted_[pair.second].before); });
  for (const Proxy proxy : moved) noted_[proxy].before = noted_[proxy].now;
}

template <class S>
void NotingBroadPhase<S>::forget(Proxy proxy) {
  noted_[proxy].before = nowhere<S>();
}

template <class S>
void NotingBroadPhase<S>::note_new(Proxy proxy, const Aabb<S>& bounds) {
  if (proxy >= noted_.size()) noted_.resize(proxy + 1);
  noted_[proxy] = {nowhere<S>(), bounds};
}

template <class S>
void NotingBroadPhase<S>::note(Proxy proxy, const Aabb<S>& bounds) {
  noted_[proxy].now = bounds;
}

template class NotingBroadPhase<float>;
template class NotingBroadPhase<double>;

}  // namespace urto

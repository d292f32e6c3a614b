#pragma once

#include <vector>

#include "physics/broad_phase/broad_phase.h"

namespace urto {

// Finds new pairs for structures that find all: it notes the bounds of every proxy, and drops the pairs whose bounds
// overlapped when new pairs were last sought.
template <class S>
class NotingBroadPhase : public BroadPhase<S> {
 public:
  void find_new_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) override;
  void forget(Proxy proxy) override;

 protected:
  // Every insert and move tells of the bounds here.
  void note_new(Proxy proxy, const Aabb<S>& bounds);
  void note(Proxy proxy, const Aabb<S>& bounds);

 private:
  struct Noted {
    Aabb<S> before, now;  // when new pairs were last sought; at this time
  };
  std::vector<Noted> noted_;  // by proxy
};

}  // namespace urto

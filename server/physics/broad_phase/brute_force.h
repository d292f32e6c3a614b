#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "physics/broad_phase/box4.h"
#include "physics/broad_phase/noting_broad_phase.h"
#include "physics/broad_phase/pair_sorter.h"

namespace urto {

// Every proxy against every other, with the thesis's two preliminary checks: still against still is skipped, and boxes
// that do not overlap are. Best for small rooms. The boxes of four neighbouring proxies share a block.
template <class S>
class BruteForce final : public NotingBroadPhase<S> {
 public:
  void insert(Proxy proxy, const Aabb<S>& bounds, bool still) override;
  void remove(Proxy proxy) override;
  void move(Proxy proxy, const Aabb<S>& bounds) override;
  void find_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) const override;
  void query(const Aabb<S>& box, std::vector<Proxy>& out) const override;
  void query_segment(const Vec<S>& origin, const Vec<S>& translation, std::vector<Proxy>& out) const override;

 private:
  std::vector<Box4<S>> blocks_;          // block k: proxies 4k to 4k + 3; absent ones are empty
  std::vector<std::uint8_t> not_still_;  // one bit a lane
  // Scratch of find_pairs, all zeros between calls.
  mutable std::vector<std::uint8_t> moved_;  // one bit a lane
  mutable PairSorter sorter_;
};

}  // namespace urto

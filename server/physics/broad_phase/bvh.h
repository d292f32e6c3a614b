#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "physics/broad_phase/broad_phase.h"
#include "physics/broad_phase/packed_tree.h"
#include "physics/broad_phase/pair_sorter.h"

namespace urto {

// Two packed trees, one of still proxies and one of the others. Pairs come from joining the second with itself and with
// the first: whole groups of neighbours are tested against each other, so that nothing is searched from the root, and
// branches without a moved proxy are left out. The default for more than a handful of bodies.
//
// The trees are brought up to date by the first question after a change; const calls may not run side by side.
template <class S>
class Bvh final : public BroadPhase<S> {
 public:
  void insert(Proxy proxy, const Aabb<S>& bounds, bool still) override;
  void remove(Proxy proxy) override;
  void move(Proxy proxy, const Aabb<S>& bounds) override;
  void find_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) const override;
  void find_pairs_where(std::span<const Proxy> moved, const typename BroadPhase<S>::PairFilter& wanted,
                        std::vector<std::pair<Proxy, Proxy>>& pairs) const override;
  void find_new_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) override;
  void query(const Aabb<S>& box, std::vector<Proxy>& out) const override;
  void query_segment(const Vec<S>& origin, const Vec<S>& translation, std::vector<Proxy>& out) const override;

 private:
  PackedTree<S>& tree_of(Proxy proxy) const { return still_[proxy] != 0 ? still_tree_ : moving_tree_; }
  void refresh() const;
  // Hands overlapping pairs to the sorter, of which one has moved and which `wanted` lets pass.
  template <class Wanted>
  void join(std::span<const Proxy> moved, const Wanted& wanted) const;

  std::vector<std::uint8_t> still_;  // by proxy
  // Caches of the bounds; see above.
  mutable PackedTree<S> still_tree_, moving_tree_;
  mutable PairSorter sorter_;
};

}  // namespace urto

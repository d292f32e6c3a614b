#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "physics/broad_phase/broad_phase.h"
#include "physics/broad_phase/packed_tree.h"
#include "physics/broad_phase/pair_sorter.h"

namespace urto {

// Three packed trees: of proxies that move, of those that rest, and of those that are still. Pairs come from joining
// each with itself and with the others: whole groups of neighbours are tested against each other, so that nothing is
// searched from the root, and branches without a moved proxy are left out, as whole trees are. So what rests costs next
// to nothing. The default for more than a handful of bodies.
//
// The trees are brought up to date by the first question after a change; const calls may not run side by side.
template <class S>
class Bvh final : public BroadPhase<S> {
 public:
  void insert(Proxy proxy, const Aabb<S>& bounds, bool still) override;
  void remove(Proxy proxy) override;
  void move(Proxy proxy, const Aabb<S>& bounds) override;
  void set_resting(Proxy proxy, bool resting) override;
  void find_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) const override;
  void find_new_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) override;
  void forget(Proxy proxy) override;
  void query(const Aabb<S>& box, std::vector<Proxy>& out) const override;
  void query_segment(const Vec<S>& origin, const Vec<S>& translation, std::vector<Proxy>& out) const override;

 private:
  enum Group : std::uint8_t { kMoving, kResting, kStill, kAbsent };

  PackedTree<S>& tree_of(Proxy proxy) const { return trees_[groups_[proxy]]; }
  void refresh() const;
  // Hands overlapping pairs to the sorter, of which one has moved; `fresh`: the new ones alone.
  void join(std::span<const Proxy> moved, bool fresh) const;
  void join(const PackedTree<S>& a, const PackedTree<S>& b, bool fresh) const;

  // Calls whole(tree) for each tree all of whose proxies have moved, and one(tree, proxy) for each that has in the
  // others. How many have in each tree.
  template <class Whole, class One>
  std::array<std::uint32_t, 3> for_moved(std::span<const Proxy> moved, const Whole& whole, const One& one) const;

  std::vector<Group> groups_;  // by proxy
  // Caches of the bounds; see above.
  mutable std::array<PackedTree<S>, 3> trees_;  // by group
  mutable PairSorter sorter_;
  mutable std::vector<PairSorter> sorters_;  // by part of a search that is shared out
};

}  // namespace urto

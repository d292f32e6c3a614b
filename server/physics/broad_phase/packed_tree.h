#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "physics/broad_phase/box4.h"
#include "physics/broad_phase/broad_phase.h"
#include "physics/broad_phase/tree_kernels.h"

namespace urto {

// The bounds of a proxy: as they are, and as they were when new pairs were last sought; at first, nowhere.
template <class S>
struct Bounds {
  Aabb<S> now, before = nowhere<S>();
};

// A four-way tree of boxes without pointers: the children of node j of a level are nodes 4j to 4j + 3 of the level
// below, and the lanes of level 0 are the proxies themselves.
//
//   level 2                [ 0 ]                          one node of four boxes = one cache line (float)
//   level 1      [ 0 ]  [ 1 ]  [ 2 ]  [ 3 ]
//   level 0     [0][1][2][3] …            [15]            lane = proxy
//
// Proxies are packed along a Hilbert curve (Kamel and Faloutsos, "Hilbert R-tree", VLDB 1994). Unlike there, moves
// only refit the boxes, and the whole tree is packed anew when refitting has made it loose.
template <class S>
class PackedTree {
 public:
  using Node = Box4<S>;

  void insert(Proxy proxy, const Bounds<S>& bounds);
  void remove(Proxy proxy);
  void move(Proxy proxy, const Aabb<S>& bounds);
  Bounds<S> bounds(Proxy proxy) const;

  // Brings the inner nodes up to date. Everything below needs that after a change.
  void refresh();

  bool empty() const { return count_ == 0; }
  std::uint32_t size() const { return count_; }
  std::uint32_t top_level() const { return static_cast<std::uint32_t>(levels_.size()) - 1; }
  std::uint32_t nodes(std::uint32_t level) const { return static_cast<std::uint32_t>(levels_[level].nodes.size()); }
  const Node& node(std::uint32_t level, std::uint32_t index) const { return levels_[level].nodes[index]; }
  Proxy proxy(std::uint32_t group, int lane) const { return proxies_[group * 4 + static_cast<std::uint32_t>(lane)]; }

  // Marks of proxies, seen from every node above them: bit i of a node's marks is set if something under lane i is
  // marked. All clear between searches.
  void mark(Proxy proxy);
  void unmark(Proxy proxy);
  void mark_all();  // not of an empty tree
  void unmark_all();
  std::uint32_t marks(std::uint32_t level, std::uint32_t index) const { return levels_[level].marks[index]; }

  // New pairs have been sought: bounds are from now on what they were before.
  void settle(Proxy proxy);
  void settle_all();
  // They were nowhere: all pairs of the proxy are new.
  void forget(Proxy proxy);
  Nodes<S> nodes_at(std::uint32_t level) const {
    return {levels_[level].nodes.data(), before_.data(), levels_[level].marks.data()};
  }

  // Calls visit(proxy, bounds) for each proxy under boxes that `mask_of(node)` selects, by a bit a lane.
  template <class MaskOf, class Visit>
  void visit(MaskOf&& mask_of, Visit&& visit_proxy) const;

 private:
  struct Level {
    std::vector<Node> nodes;
    std::vector<std::uint8_t> marks;
  };
  struct Item {
    Aabb<S> now, before;
    Proxy proxy;
  };

  void append_group();
  void touch(std::uint32_t group);
  void pack();
  void sort_along_curve();
  void refit_all();
  void refit_path(std::uint32_t group);

  std::vector<Level> levels_;
  std::vector<Node> before_;                 // by group: boxes of level 0 when new pairs were last sought
  std::vector<Proxy> proxies_;               // by slot = 4 · group + lane
  std::vector<std::uint32_t> slot_of_;       // by proxy
  std::vector<std::uint32_t> dirty_groups_;  // each once
  std::vector<std::uint8_t> is_dirty_;       // by group
  std::uint32_t slots_end_ = 0;              // the next free slot
  std::uint32_t count_ = 0;
  std::uint32_t appended_ = 0, removed_ = 0;  // since the tree was packed
  double cost_ = 0, packed_cost_ = 0;         // sum of the half perimeters of the inner boxes: now, and when packed

  // Scratch of pack().
  std::vector<Item> items_;
  std::vector<std::uint32_t> keys_, keys_sorted_, order_, order_sorted_;
};

template <class S>
template <class MaskOf, class Visit>
void PackedTree<S>::visit(MaskOf&& mask_of, Visit&& visit_proxy) const {
  if (empty()) return;
  // At most three siblings wait a level, and 4^16 lanes are more than there are proxies.
  struct Entry {
    std::uint32_t level, index;
  };
  Entry stack[3 * 16 + 1];
  int waiting = 0;
  stack[waiting++] = {top_level(), 0};
  while (waiting != 0) {
    const Entry entry = stack[--waiting];
    const Node& boxes = node(entry.level, entry.index);
    for (std::uint32_t hits = mask_of(boxes); hits != 0; hits &= hits - 1) {
      const int lane = std::countr_zero(hits);
      if (entry.level == 0) {
        visit_proxy(proxy(entry.index, lane), boxes, lane);
      } else {
        stack[waiting++] = {entry.level - 1, entry.index * 4 + static_cast<std::uint32_t>(lane)};
      }
    }
  }
}

}  // namespace urto

#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "physics/broad_phase/noting_broad_phase.h"
#include "physics/broad_phase/pair_sorter.h"

namespace urto {

// A loose quadtree. A cell is a square; its loose bounds reach half a cell further on every side. A proxy lies in the
// deepest node there is whose cell holds its centre and whose loose bounds contain it:
//
//   ┌───────┬───────┐
//   │       │ ┌───┐ │   A leaf that holds more than kLeafProxiesMax is split into four, down to a least size.
//   │    ┌──┼─┼─┐ │ │   A split node with few proxies left under it becomes a leaf again.
//   │    │  │ └─┼─┘ │   The root doubles away from its middle until it contains what is inserted.
//   ├────┼──┼───┼───┤
//   │    └──┼───┘   │
//   └───────┴───────┘
//
// The proxies of a node are a linked list through proxy slots.
template <class S>
class Quadtree final : public NotingBroadPhase<S> {
 public:
  Quadtree();
  void insert(Proxy proxy, const Aabb<S>& bounds, bool still) override;
  void remove(Proxy proxy) override;
  void move(Proxy proxy, const Aabb<S>& bounds) override;
  void find_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) const override;
  void query(const Aabb<S>& box, std::vector<Proxy>& out) const override;
  void query_segment(const Vec<S>& origin, const Vec<S>& translation, std::vector<Proxy>& out) const override;

 private:
  using Index = std::uint32_t;
  static constexpr Index kNone = 0xffffffffu;

  struct Node {
    double center_x = 0, center_y = 0, half = 1;  // of the cell; powers of two, hence exact
    Index parent = kNone;
    Index children = kNone;   // the first of four in a row: (−x −y), (+x −y), (−x +y), (+x +y)
    Proxy first = kNone;      // of its own proxies
    std::uint32_t own = 0;    // their count
    std::uint32_t under = 0;  // own, and those of all descendants
  };
  struct Entry {
    Aabb<S> bounds;
    Index node = kNone;
    Proxy previous = kNone, next = kNone;
    bool still = false;
    bool moved = false;  // scratch of find_pairs, false between calls
  };

  // The proxy's centre lies in the cell, and the loose bounds contain all of it.
  static bool holds(const Node& node, const Aabb<S>& bounds);
  static bool loosely_contains(const Node& node, const Aabb<S>& bounds);
  static bool loosely_overlaps(const Node& node, const Aabb<S>& bounds);
  static int quadrant_of(const Node& node, const Aabb<S>& bounds);
  Node child_of(Index parent, int quadrant) const;

  void place(Proxy proxy);
  void unplace(Proxy proxy);
  void link(Index node, Proxy proxy);
  void unlink(Proxy proxy);
  void grow_root(const Aabb<S>& bounds);
  bool can_split(const Node& node) const;
  Index allocate_children();
  void split(Index node);
  void collapse(Index node);
  // Calls visit(proxy, entry) for each proxy in nodes whose loose bounds meet the box.
  template <class Visit>
  void visit_near(const Aabb<S>& box, Visit&& visit) const;

  std::vector<Node> nodes_;             // the root first
  std::vector<Index> free_children_;    // rows of four
  mutable std::vector<Entry> entries_;  // by proxy
  mutable std::vector<Index> stack_;
  mutable PairSorter sorter_;
};

}  // namespace urto

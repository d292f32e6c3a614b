#include "physics/broad_phase/quadtree.h"

#include <algorithm>

#include "physics/broad_phase/segment_bounds.h"

namespace urto {
namespace {

// A leaf with more proxies is split …
constexpr std::uint32_t kLeafProxiesMax = 8;
// … and a node with no more than this under it is made a leaf again; well below, so that it does not flicker.
constexpr std::uint32_t kCollapseMax = 4;
// Half the side of the smallest cell, in metres: bodies are rarely smaller, and crowds in one point do not split on.
constexpr double kHalfMin = 1.0 / 64;
// The root grows no further than this; what does not fit then (a body of a world that blew up) lies in the root.
constexpr double kRootHalfMax = 1e100;
// Levels under the root, so that the centres of all cells are exact in double (53 bits).
constexpr double kRootToLeafMax = 1ull << 48;

}  // namespace

template <class S>
Quadtree<S>::Quadtree() : nodes_(1) {}

template <class S>
bool Quadtree<S>::loosely_contains(const Node& node, const Aabb<S>& bounds) {
  const double reach = 2 * node.half;
  return node.center_x - reach <= bounds.lower.x() && bounds.upper.x() <= node.center_x + reach &&
         node.center_y - reach <= bounds.lower.y() && bounds.upper.y() <= node.center_y + reach;
}

template <class S>
bool Quadtree<S>::holds(const Node& node, const Aabb<S>& bounds) {
  const Vec<S> center = bounds.center();
  return node.center_x - node.half <= center.x() && center.x() <= node.center_x + node.half &&
         node.center_y - node.half <= center.y() && center.y() <= node.center_y + node.half &&
         loosely_contains(node, bounds);
}

template <class S>
bool Quadtree<S>::loosely_overlaps(const Node& node, const Aabb<S>& bounds) {
  const double reach = 2 * node.half;
  return node.center_x - reach <= bounds.upper.x() && bounds.lower.x() <= node.center_x + reach &&
         node.center_y - reach <= bounds.upper.y() && bounds.lower.y() <= node.center_y + reach;
}

template <class S>
int Quadtree<S>::quadrant_of(const Node& node, const Aabb<S>& bounds) {
  const Vec<S> center = bounds.center();
  return (center.x() >= node.center_x ? 1 : 0) + (center.y() >= node.center_y ? 2 : 0);
}

template <class S>
typename Quadtree<S>::Node Quadtree<S>::child_of(Index parent, int quadrant) const {
  Node child;
  child.half = nodes_[parent].half / 2;
  child.center_x = nodes_[parent].center_x + ((quadrant & 1) != 0 ? child.half : -child.half);
  child.center_y = nodes_[parent].center_y + ((quadrant & 2) != 0 ? child.half : -child.half);
  child.parent = parent;
  return child;
}

template <class S>
void Quadtree<S>::insert(Proxy proxy, const Aabb<S>& bounds, bool still) {
  this->note_new(proxy, bounds);
  if (proxy >= entries_.size()) entries_.resize(proxy + 1);
  entries_[proxy] = Entry{};
  entries_[proxy].bounds = bounds;
  entries_[proxy].still = still;
  place(proxy);
}

template <class S>
void Quadtree<S>::remove(Proxy proxy) {
  unplace(proxy);
}

template <class S>
void Quadtree<S>::move(Proxy proxy, const Aabb<S>& bounds) {
  this->note(proxy, bounds);
  Entry& entry = entries_[proxy];
  const Node& node = nodes_[entry.node];
  // It stays where it is as long as place() would put it there.
  const bool stays =
      holds(node, bounds) &&
      (node.children == kNone || !loosely_contains(nodes_[node.children + quadrant_of(node, bounds)], bounds));
  if (stays) {
    entry.bounds = bounds;
    return;
  }
  unplace(proxy);
  entry.bounds = bounds;
  place(proxy);
}

// Puts a proxy into the deepest node that contains it, and splits that if it is too full.
template <class S>
void Quadtree<S>::place(Proxy proxy) {
  const Aabb<S> bounds = entries_[proxy].bounds;
  grow_root(bounds);
  Index node = 0;
  for (;;) {
    ++nodes_[node].under;
    if (nodes_[node].children == kNone) break;
    const Index child = nodes_[node].children + static_cast<Index>(quadrant_of(nodes_[node], bounds));
    if (!loosely_contains(nodes_[child], bounds)) break;
    node = child;
  }
  link(node, proxy);
  if (nodes_[node].children == kNone && nodes_[node].own > kLeafProxiesMax && can_split(nodes_[node])) split(node);
}

template <class S>
void Quadtree<S>::unplace(Proxy proxy) {
  Index highest = kNone;  // the highest node that became sparse
  const Index from = entries_[proxy].node;
  unlink(proxy);
  for (Index node = from; node != kNone; node = nodes_[node].parent) {
    --nodes_[node].under;
    if (nodes_[node].children != kNone && nodes_[node].under <= kCollapseMax) highest = node;
  }
  if (highest != kNone) collapse(highest);
}

template <class S>
void Quadtree<S>::link(Index node, Proxy proxy) {
  Entry& entry = entries_[proxy];
  entry.node = node;
  entry.previous = kNone;
  entry.next = nodes_[node].first;
  if (entry.next != kNone) entries_[entry.next].previous = proxy;
  nodes_[node].first = proxy;
  ++nodes_[node].own;
}

template <class S>
void Quadtree<S>::unlink(Proxy proxy) {
  Entry& entry = entries_[proxy];
  (entry.previous != kNone ? entries_[entry.previous].next : nodes_[entry.node].first) = entry.next;
  if (entry.next != kNone) entries_[entry.next].previous = entry.previous;
  --nodes_[entry.node].own;
}

// The old root becomes one quarter of a root twice as large, which lies towards the proxy.
template <class S>
void Quadtree<S>::grow_root(const Aabb<S>& bounds) {
  while (!holds(nodes_[0], bounds) && nodes_[0].half < kRootHalfMax) {
    const Vec<S> toward = bounds.center();
    const Node old = nodes_[0];
    Node root;
    root.half = old.half * 2;
    root.center_x = old.center_x + (toward.x() >= old.center_x ? old.half : -old.half);
    root.center_y = old.center_y + (toward.y() >= old.center_y ? old.half : -old.half);
    root.under = old.under;
    if (old.under == 0 && old.children == kNone) {  // nothing to keep
      nodes_[0] = root;
      continue;
    }
    const Index children = allocate_children();
    nodes_[0] = root;
    nodes_[0].children = children;
    for (int quadrant = 0; quadrant < 4; ++quadrant) nodes_[children + quadrant] = child_of(0, quadrant);
    // The old root lies opposite to where the new middle went.
    const Index kept = children + (old.center_x > root.center_x ? 1 : 0) + (old.center_y > root.center_y ? 2 : 0);
    const Node place_of_old = nodes_[kept];
    nodes_[kept] = old;
    nodes_[kept].parent = place_of_old.parent;
    if (old.children != kNone) {
      for (Index child = old.children; child < old.children + 4; ++child) nodes_[child].parent = kept;
    }
    for (Proxy proxy = old.first; proxy != kNone; proxy = entries_[proxy].next) entries_[proxy].node = kept;
  }
}

template <class S>
bool Quadtree<S>::can_split(const Node& node) const {
  return node.half > kHalfMin && node.half > nodes_[0].half / kRootToLeafMax;
}

template <class S>
typename Quadtree<S>::Index Quadtree<S>::allocate_children() {
  if (!free_children_.empty()) {
    const Index children = free_children_.back();
    free_children_.pop_back();
    return children;
  }
  const auto children = static_cast<Index>(nodes_.size());
  nodes_.resize(nodes_.size() + 4);
  return children;
}

// Splits a leaf, and those of the new leaves that are too full themselves.
template <class S>
void Quadtree<S>::split(Index leaf) {
  const Index children = allocate_children();
  for (int quadrant = 0; quadrant < 4; ++quadrant) nodes_[children + quadrant] = child_of(leaf, quadrant);
  nodes_[leaf].children = children;
  Proxy proxy = nodes_[leaf].first;
  while (proxy != kNone) {
    const Proxy next = entries_[proxy].next;
    const Aabb<S>& bounds = entries_[proxy].bounds;
    const Index child = children + static_cast<Index>(quadrant_of(nodes_[leaf], bounds));
    if (loosely_contains(nodes_[child], bounds)) {
      unlink(proxy);
      link(child, proxy);
      ++nodes_[child].under;
    }
    proxy = next;
  }
  for (Index child = children; child < children + 4; ++child) {
    if (nodes_[child].own > kLeafProxiesMax && can_split(nodes_[child])) split(child);
  }
}

// Makes a node a leaf: what is under it moves up.
template <class S>
void Quadtree<S>::collapse(Index node) {
  const Index children = nodes_[node].children;
  for (Index child = children; child < children + 4; ++child) {
    if (nodes_[child].children != kNone) collapse(child);
    while (nodes_[child].first != kNone) {
      const Proxy proxy = nodes_[child].first;
      unlink(proxy);
      link(node, proxy);
    }
  }
  nodes_[node].children = kNone;
  free_children_.push_back(children);
}

template <class S>
template <class Visit>
void Quadtree<S>::visit_near(const Aabb<S>& box, Visit&& visit) const {
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const Node& node = nodes_[stack_.back()];
    stack_.pop_back();
    for (Proxy proxy = node.first; proxy != kNone; proxy = entries_[proxy].next) visit(proxy, entries_[proxy]);
    if (node.children == kNone) continue;
    for (Index child = node.children; child < node.children + 4; ++child) {
      if (nodes_[child].under != 0 && loosely_overlaps(nodes_[child], box)) stack_.push_back(child);
    }
  }
}

template <class S>
void Quadtree<S>::find_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) const {
  for (const Proxy proxy : moved) entries_[proxy].moved = true;
  sorter_.clear();
  for (const Proxy proxy : moved) {
    const Entry& own = entries_[proxy];
    visit_near(own.bounds, [&](Proxy other, const Entry& entry) {
      if (!entry.bounds.overlaps(own.bounds) || (own.still && entry.still)) return;
      // Of two that both moved the lower one reports the pair, and none reports itself.
      if (entry.moved && other <= proxy) return;
      sorter_.add(proxy, other);
    });
  }
  for (const Proxy proxy : moved) entries_[proxy].moved = false;
  sorter_.sort_into(static_cast<std::uint32_t>(entries_.size()), pairs);
}

template <class S>
void Quadtree<S>::query(const Aabb<S>& box, std::vector<Proxy>& out) const {
  out.clear();
  visit_near(box, [&](Proxy proxy, const Entry& entry) {
    if (entry.bounds.overlaps(box)) out.push_back(proxy);
  });
  std::sort(out.begin(), out.end());
}

template <class S>
void Quadtree<S>::query_segment(const Vec<S>& origin, const Vec<S>& translation, std::vector<Proxy>& out) const {
  const SegmentBounds<S> segment(origin, translation);
  out.clear();
  visit_near(segment.bounds(), [&](Proxy proxy, const Entry& entry) {
    if (segment.meets(entry.bounds)) out.push_back(proxy);
  });
  std::sort(out.begin(), out.end());
}

template class Quadtree<float>;
template class Quadtree<double>;

}  // namespace urto

#include "physics/broad_phase/bvh.h"

#include <algorithm>

#include "physics/broad_phase/segment_bounds.h"

namespace urto {
namespace {

// A search in a smaller tree takes some microseconds, and is not worth a second thread.
constexpr std::uint32_t kProxiesToShare = 256;
// Tasks of a shared search: so many nodes for each part, so that parts are about equal.
constexpr std::uint32_t kNodesPerPart = 4;
constexpr std::size_t kTasksPerShare = 4;

// Finds the overlapping pairs, of which one is marked, within a tree or between two. Pairs of nodes that may hold some
// wait by level until there are many, and are looked at side by side; what they lead to waits a level below.
template <class S>
class TreeJoin {
 public:
  using Tree = PackedTree<S>;

  // What is found goes to `pairs`; `fresh`: of new pairs alone.
  TreeJoin(const Tree& a, const Tree& b, bool fresh, PairSorter& pairs)
      : a_(a), b_(b), sought_(fresh ? Sought::kNewPairs : Sought::kPairs), pairs_(pairs) {}

  void all() {
    begin();
    look_at_all();
  }
  // The part that lies under these pairs of nodes of a level.
  void run(std::uint32_t level, const NodePair* begin, const NodePair* end) {
    for (; begin != end; ++begin) wait(level, begin->x, begin->y);
    look_at_all();
  }
  // All pairs of nodes of this level, at or below both roots, that may hold pairs.
  std::vector<NodePair> list(std::uint32_t level) {
    std::vector<NodePair> out;
    listed_level_ = level;
    listed_ = &out;
    begin();
    look_at_all();
    listed_ = nullptr;
    return out;
  }

 private:
  static constexpr std::size_t kWaitingMax = 256, kLevelsMax = 17;  // 4^17 lanes are more than there are proxies
  struct Waiting {
    std::size_t count = 0;
    NodePair pairs[kWaitingMax];
  };

  void begin() {
    const std::uint32_t a = a_.top_level(), b = b_.top_level();
    if (a >= b) {
      descend(a_, a, 0, b_, b, [&](std::uint32_t x) { wait(b, x, 0); });
    } else {
      descend(b_, b, 0, a_, a, [&](std::uint32_t y) { wait(a, 0, y); });
    }
  }

  // Calls visit(node) for those of the level of the lower tree's root, under a node of the higher one, that may hold
  // partners.
  template <class Visit>
  static void descend(const Tree& tree, std::uint32_t level, std::uint32_t index, const Tree& other, std::uint32_t top,
                      const Visit& visit) {
    if (level == top) return visit(index);
    std::uint32_t hits = tree.node(level, index).overlap_mask(other.node(top, 0).bounds());
    if (other.marks(top, 0) == 0) hits &= tree.marks(level, index);
    for (; hits != 0; hits &= hits - 1)
      descend(tree, level - 1, child(index, std::countr_zero(hits)), other, top, visit);
  }

  static std::uint32_t child(std::uint32_t index, int lane) { return index * 4 + static_cast<std::uint32_t>(lane); }

  void wait(std::uint32_t level, std::uint32_t x, std::uint32_t y) {
    if (listed_ != nullptr && level == listed_level_) return listed_->push_back({x, y});
    Waiting& waiting = waiting_[level];
    waiting.pairs[waiting.count++] = {x, y};
    if (waiting.count == kWaitingMax) look_at(level);
  }

  void look_at_all() {
    for (std::uint32_t level = kLevelsMax; level-- > 0;)
      if (waiting_[level].count != 0) look_at(level);
  }

  void look_at(std::uint32_t level) {
    Waiting& waiting = waiting_[level];
    NodeHit hits[kWaitingMax];
    const std::size_t found =
        tree_kernels<S>().meet(a_.nodes_at(level), b_.nodes_at(level), level == 0 ? sought_ : Sought::kBranches,
                               waiting.pairs, waiting.count, hits);
    waiting.count = 0;
    for (std::size_t k = 0; k < found; ++k) take(level, hits[k]);
  }

  void take(std::uint32_t level, const NodeHit& hit) {
    for (std::uint32_t lanes = hit.lanes; lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes), i = lane / 4, j = lane % 4;
      if (level == 0) {
        pairs_.add(a_.proxy(hit.nodes.x, i), b_.proxy(hit.nodes.y, j));
      } else {
        wait(level - 1, child(hit.nodes.x, i), child(hit.nodes.y, j));
      }
    }
  }

  const Tree& a_;
  const Tree& b_;
  const Sought sought_;
  PairSorter& pairs_;
  std::uint32_t listed_level_ = 0;
  std::vector<NodePair>* listed_ = nullptr;
  Waiting waiting_[kLevelsMax];
};

// The highest level with nodes enough for all parts of a shared search to be about equal.
template <class S>
std::uint32_t task_level(const PackedTree<S>& tree, std::uint32_t nodes_min) {
  std::uint32_t level = tree.top_level();
  while (level > 0 && tree.nodes(level) < nodes_min) --level;
  return level;
}

}  // namespace

template <class S>
void Bvh<S>::insert(Proxy proxy, const Aabb<S>& bounds, bool still) {
  if (proxy >= groups_.size()) groups_.resize(proxy + 1, kAbsent);
  groups_[proxy] = still ? kStill : kMoving;
  tree_of(proxy).insert(proxy, {bounds});
}

template <class S>
void Bvh<S>::remove(Proxy proxy) {
  tree_of(proxy).remove(proxy);
  groups_[proxy] = kAbsent;
}

template <class S>
void Bvh<S>::move(Proxy proxy, const Aabb<S>& bounds) {
  tree_of(proxy).move(proxy, bounds);
}

template <class S>
void Bvh<S>::set_resting(Proxy proxy, bool resting) {
  const Group group = resting ? kResting : kMoving;
  if (proxy >= groups_.size() || groups_[proxy] >= kStill || groups_[proxy] == group) return;
  const Bounds<S> bounds = tree_of(proxy).bounds(proxy);
  tree_of(proxy).remove(proxy);
  groups_[proxy] = group;
  tree_of(proxy).insert(proxy, bounds);
}

template <class S>
void Bvh<S>::refresh() const {
  for (PackedTree<S>& tree : trees_) tree.refresh();
}

template <class S>
void Bvh<S>::find_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) const {
  join(moved, false);
  sorter_.sort_into(static_cast<std::uint32_t>(groups_.size()), pairs);
}

template <class S>
void Bvh<S>::find_new_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) {
  join(moved, true);
  sorter_.sort_into(static_cast<std::uint32_t>(groups_.size()), pairs);
  for_moved(
      moved, [](PackedTree<S>& tree) { tree.settle_all(); },
      [](PackedTree<S>& tree, Proxy proxy) { tree.settle(proxy); });
}

template <class S>
void Bvh<S>::forget(Proxy proxy) {
  tree_of(proxy).forget(proxy);
}

template <class S>
template <class Whole, class One>
std::array<std::uint32_t, 3> Bvh<S>::for_moved(std::span<const Proxy> moved, const Whole& whole, const One& one) const {
  std::array<std::uint32_t, 3> counts{};
  for (const Proxy proxy : moved) ++counts[groups_[proxy]];
  for (const Group group : {kMoving, kResting, kStill})
    if (counts[group] != 0 && counts[group] == trees_[group].size()) whole(trees_[group]);
  for (const Proxy proxy : moved)
    if (counts[groups_[proxy]] != tree_of(proxy).size()) one(tree_of(proxy), proxy);
  return counts;
}

template <class S>
void Bvh<S>::join(std::span<const Proxy> moved, bool fresh) const {
  refresh();
  sorter_.clear();
  using Tree = PackedTree<S>;
  const auto marked = for_moved(
      moved, [](Tree& tree) { tree.mark_all(); }, [](Tree& tree, Proxy proxy) { tree.mark(proxy); });
  for (const Group a : {kMoving, kResting}) {
    if (trees_[a].empty()) continue;
    if (marked[a] != 0) join(trees_[a], trees_[a], fresh);
    for (const Group b : {kResting, kStill}) {
      if (b <= a || trees_[b].empty() || marked[a] + marked[b] == 0) continue;
      join(trees_[a], trees_[b], fresh);
    }
  }
  for_moved(
      moved, [](Tree& tree) { tree.unmark_all(); }, [](Tree& tree, Proxy proxy) { tree.unmark(proxy); });
}

template <class S>
void Bvh<S>::join(const PackedTree<S>& a, const PackedTree<S>& b, bool fresh) const {
  TreeJoin<S> whole(a, b, fresh, sorter_);
  const unsigned parts = this->team() ? this->team()->parts_max() : 1;
  if (parts == 1 || a.size() < kProxiesToShare) return whole.all();
  const std::uint32_t level = std::min(task_level(a, kNodesPerPart * parts), b.top_level());
  const std::vector<NodePair> tasks = whole.list(level);
  if (sorters_.size() < parts) sorters_.resize(parts);
  for (PairSorter& sorter : sorters_) sorter.clear();
  this->team()->share(tasks.size(), kTasksPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
    TreeJoin<S>(a, b, fresh, sorters_[part]).run(level, tasks.data() + begin, tasks.data() + end);
  });
  for (const PairSorter& sorter : sorters_) sorter_.add_all(sorter);
}

template <class S>
void Bvh<S>::query(const Aabb<S>& box, std::vector<Proxy>& out) const {
  refresh();
  out.clear();
  for (const PackedTree<S>& tree : trees_) {
    tree.visit([&](const Box4<S>& boxes) { return boxes.overlap_mask(box); },
               [&](Proxy proxy, const Box4<S>&, int) { out.push_back(proxy); });
  }
  std::sort(out.begin(), out.end());
}

template <class S>
void Bvh<S>::query_segment(const Vec<S>& origin, const Vec<S>& translation, std::vector<Proxy>& out) const {
  refresh();
  const SegmentBounds<S> segment(origin, translation);
  out.clear();
  const auto mask_of = [&](const Box4<S>& boxes) {
    std::uint32_t met = boxes.overlap_mask(segment.bounds());
    for (std::uint32_t rest = met; rest != 0; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      if (!segment.meets(boxes.get(lane))) met &= ~(1u << lane);
    }
    return met;
  };
  for (const PackedTree<S>& tree : trees_) {
    tree.visit(mask_of, [&](Proxy proxy, const Box4<S>&, int) { out.push_back(proxy); });
  }
  std::sort(out.begin(), out.end());
}

template class Bvh<float>;
template class Bvh<double>;

}  // namespace urto

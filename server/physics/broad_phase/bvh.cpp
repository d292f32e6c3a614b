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

// A part of a tree, or of two that are to be joined: under node x of tree a alone, or under x and under node y of b.
template <class S>
struct Branch {
  std::uint32_t level, index;
  Aabb<S> bounds;
};
template <class S>
struct JoinTask {
  Branch<S> x, y;
  bool within;  // y says nothing
};

// Finds the overlapping pairs, of which one is marked, within a tree or between two. What lies at or below the level of
// tasks can be left to be done later, by several side by side. Leaves that may hold pairs are gathered, and looked at
// many at a time.
template <class S>
class TreeJoin {
 public:
  using Tree = PackedTree<S>;
  using Node = Box4<S>;
  using Task = JoinTask<S>;

  TreeJoin(const Tree& a, const Tree& b, bool fresh, PairSorter& pairs) : a_(a), b_(b), fresh_(fresh), pairs_(pairs) {}

  // Lists what lies at or below this level, which is all of the join.
  void list_tasks(std::uint32_t level, std::vector<Task>& tasks) {
    task_level_ = level;
    tasks_ = &tasks;
    descend_all();
    tasks_ = nullptr;
  }
  void run(const Task* begin, const Task* end) {
    for (; begin != end; ++begin) begin->within ? within(begin->x.level, begin->x.index) : between(begin->x, begin->y);
    look_at_leaves();
  }

  // All pairs of the join.
  void all() {
    descend_all();
    look_at_leaves();
  }

 private:
  using Branch = urto::Branch<S>;
  static constexpr std::size_t kLeavesMax = 256;  // gathered at a time

  void descend_all() { &a_ == &b_ ? within(a_.top_level(), 0) : all_between(); }

  // Pairs under one node of tree a.
  void within(std::uint32_t level, std::uint32_t index) {
    if (tasks_ && level <= task_level_) return tasks_->push_back({{level, index, {}}, {}, true});
    if (level == 0) return add_leaves(index, index);
    const Node& boxes = a_.node(level, index);
    const std::uint32_t marks = a_.marks(level, index);
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t later = Node::kAll & ~((2u << i) - 1);
      const std::uint32_t wanted = (marks >> i & 1u) != 0 ? Node::kAll : marks;
      for (std::uint32_t hits = boxes.overlap_mask(boxes, i) & later & wanted; hits != 0; hits &= hits - 1) {
        const int j = std::countr_zero(hits);
        between({level - 1, child(index, i), boxes.get(i)}, {level - 1, child(index, j), boxes.get(j)});
      }
      if ((marks >> i & 1u) != 0) within(level - 1, child(index, i));
    }
  }

  // Pairs of one proxy of tree a and one of tree b.
  void all_between() {
    const std::uint32_t a = a_.top_level(), b = b_.top_level();
    between({a, 0, a_.node(a, 0).bounds()}, {b, 0, b_.node(b, 0).bounds()});
  }

  static std::uint32_t child(std::uint32_t index, int lane) { return index * 4 + static_cast<std::uint32_t>(lane); }

  // Pairs under node x of tree a and node y of tree b, of which one holds a mark.
  void between(const Branch& x, const Branch& y) {
    if (x.level > y.level) return descend(a_, x, b_, y, [&](const Branch& part) { between(part, y); });
    if (y.level > x.level) return descend(b_, y, a_, x, [&](const Branch& part) { between(x, part); });
    if (tasks_ && x.level <= task_level_) return tasks_->push_back({x, y, false});
    if (x.level == 0) return add_leaves(x.index, y.index);
    const Node& boxes_x = a_.node(x.level, x.index);
    const Node& boxes_y = b_.node(y.level, y.index);
    const std::uint32_t marks_x = a_.marks(x.level, x.index), marks_y = b_.marks(y.level, y.index);
    const std::uint32_t near_x = boxes_y.overlap_mask(x.bounds);
    for (std::uint32_t parts = boxes_x.overlap_mask(y.bounds); parts != 0; parts &= parts - 1) {
      const int i = std::countr_zero(parts);
      const std::uint32_t wanted = (marks_x >> i & 1u) != 0 ? near_x : near_x & marks_y;
      if (wanted == 0) continue;
      for (std::uint32_t hits = boxes_y.overlap_mask(boxes_x, i) & wanted; hits != 0; hits &= hits - 1) {
        const int j = std::countr_zero(hits);
        between({x.level - 1, child(x.index, i), boxes_x.get(i)}, {y.level - 1, child(y.index, j), boxes_y.get(j)});
      }
    }
  }

  // Calls next for each branch under `high` that may hold partners of `low`.
  template <class Next>
  static void descend(const Tree& tree, const Branch& high, const Tree& other, const Branch& low, Next&& next) {
    const Node& boxes = tree.node(high.level, high.index);
    std::uint32_t hits = boxes.overlap_mask(low.bounds);
    if (other.marks(low.level, low.index) == 0) hits &= tree.marks(high.level, high.index);
    for (; hits != 0; hits &= hits - 1) {
      const int i = std::countr_zero(hits);
      next(Branch{high.level - 1, child(high.index, i), boxes.get(i)});
    }
  }

  void add_leaves(std::uint32_t x, std::uint32_t y) {
    leaves_[leaf_count_++] = {x, y};
    if (leaf_count_ == kLeavesMax) look_at_leaves();
  }

  void look_at_leaves() {
    LeafHit hits[kLeavesMax];
    const std::size_t found = tree_kernels<S>().meet(a_.leaves(), b_.leaves(), fresh_, leaves_, leaf_count_, hits);
    leaf_count_ = 0;
    for (std::size_t k = 0; k < found; ++k) {
      for (std::uint32_t lanes = hits[k].lanes; lanes != 0; lanes &= lanes - 1) {
        const int lane = std::countr_zero(lanes);
        pairs_.add(a_.proxy(hits[k].leaves.x, lane / 4), b_.proxy(hits[k].leaves.y, lane % 4));
      }
    }
  }

  const Tree& a_;
  const Tree& b_;
  const bool fresh_;
  PairSorter& pairs_;
  std::uint32_t task_level_ = 0;
  std::vector<Task>* tasks_ = nullptr;
  LeafPair leaves_[kLeavesMax];
  std::size_t leaf_count_ = 0;
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
  std::vector<JoinTask<S>> tasks;
  whole.list_tasks(task_level(a, kNodesPerPart * parts), tasks);
  if (sorters_.size() < parts) sorters_.resize(parts);
  for (PairSorter& sorter : sorters_) sorter.clear();
  this->team()->share(tasks.size(), kTasksPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
    TreeJoin<S>(a, b, fresh, sorters_[part]).run(tasks.data() + begin, tasks.data() + end);
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

#include "physics/broad_phase/packed_tree.h"

#include <algorithm>
#include <array>

namespace urto {
namespace {

// The tree is packed anew when its inner boxes have grown by this much since. Packing costs about as much as five
// refits; measured on a gas and on a pile, 1.1 to 1.5 differ by little.
constexpr double kLoosenessMax = 1.25;
// … or when this many proxies were appended out of order: some, and a share of all.
constexpr std::uint32_t kAppendedMax = 16;
constexpr std::uint32_t kAppendedShare = 64;
// … or when more lanes were emptied than this, and half of the tree.
constexpr std::uint32_t kRemovedMax = 16;
// Above one dirty group in so many, refitting everything is cheaper than refitting paths.
constexpr std::uint32_t kRefitShare = 8;
// The cell of the curve's grid is chosen by the median size of so many proxies.
constexpr std::size_t kSamplesMax = 255;
constexpr int kCurveBits = 16;  // a coordinate

// Where the cell (x, y) lies on the Hilbert curve.
std::uint32_t hilbert(std::uint32_t x, std::uint32_t y) {
  // A state is a rotation of the curve: [state][quadrant x·2 + y] → position on it and the state within.
  static constexpr std::uint8_t kPosition[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 3, 1, 0}, {2, 1, 3, 0}};
  static constexpr std::uint8_t kNext[4][4] = {{1, 0, 3, 0}, {0, 2, 1, 1}, {2, 1, 2, 3}, {3, 3, 0, 2}};
  std::uint32_t position = 0, state = 0;
  for (int bit = kCurveBits - 1; bit >= 0; --bit) {
    const std::uint32_t quadrant = (x >> bit & 1u) * 2 + (y >> bit & 1u);
    position = position << 2 | kPosition[state][quadrant];
    state = kNext[state][quadrant];
  }
  return position;
}

template <class T>
T median(std::vector<T>& samples) {
  std::nth_element(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2), samples.end());
  return samples[samples.size() / 2];
}

// The grid over which the curve runs. Medians, because one body that fell out of the world, or one giant, must not
// coarsen it for the crowd; what lies outside is clamped to the rim, which costs speed alone.
template <class S>
class CurveGrid {
 public:
  template <class Items>
  explicit CurveGrid(const Items& items) {
    const std::size_t stride = items.size() / kSamplesMax + 1;
    std::vector<S> xs, ys, sizes;
    for (std::size_t i = 0; i < items.size(); i += stride) {
      const Aabb<S>& box = items[i].now;
      xs.push_back(box.center().x());
      ys.push_back(box.center().y());
      sizes.push_back(max_of(box.upper.x() - box.lower.x(), box.upper.y() - box.lower.y()));
    }
    middle_x_ = median(xs);
    middle_y_ = median(ys);
    const double size = median(sizes);
    cells_per_metre_ = size > 0 ? 2 / size : 1;
  }
  std::uint32_t key(const Aabb<S>& box) const {
    const Vec<S> center = box.center();
    return hilbert(cell(center.x() - middle_x_), cell(center.y() - middle_y_));
  }

 private:
  std::uint32_t cell(double offset) const {
    constexpr double kHalf = 1 << (kCurveBits - 1);
    const double scaled = offset * cells_per_metre_;
    if (!(scaled > -kHalf)) return 0;  // NaN too
    return static_cast<std::uint32_t>((scaled < kHalf - 1 ? scaled : kHalf - 1) + kHalf);
  }
  double middle_x_, middle_y_, cells_per_metre_;
};

}  // namespace

template <class S>
void PackedTree<S>::insert(Proxy proxy, const Bounds<S>& bounds) {
  if (proxy >= slot_of_.size()) slot_of_.resize(proxy + 1);
  const std::uint32_t slot = slots_end_++;
  if (slot % 4 == 0) append_group();
  proxies_[slot] = proxy;
  slot_of_[proxy] = slot;
  levels_[0].nodes[slot / 4].set(static_cast<int>(slot % 4), bounds.now);
  before_[slot / 4].set(static_cast<int>(slot % 4), bounds.before);
  ++count_;
  ++appended_;
  touch(slot / 4);
}

template <class S>
void PackedTree<S>::remove(Proxy proxy) {
  const std::uint32_t slot = slot_of_[proxy];
  levels_[0].nodes[slot / 4].clear(static_cast<int>(slot % 4));
  before_[slot / 4].clear(static_cast<int>(slot % 4));
  --count_;
  ++removed_;
  touch(slot / 4);
}

template <class S>
void PackedTree<S>::move(Proxy proxy, const Aabb<S>& bounds) {
  const std::uint32_t slot = slot_of_[proxy];
  levels_[0].nodes[slot / 4].set(static_cast<int>(slot % 4), bounds);
  touch(slot / 4);
}

template <class S>
Bounds<S> PackedTree<S>::bounds(Proxy proxy) const {
  const std::uint32_t slot = slot_of_[proxy];
  const int lane = static_cast<int>(slot % 4);
  return {levels_[0].nodes[slot / 4].get(lane), before_[slot / 4].get(lane)};
}

template <class S>
void PackedTree<S>::settle(Proxy proxy) {
  const std::uint32_t slot = slot_of_[proxy];
  const int lane = static_cast<int>(slot % 4);
  before_[slot / 4].set(lane, levels_[0].nodes[slot / 4].get(lane));
}

template <class S>
void PackedTree<S>::settle_all() {
  before_ = levels_[0].nodes;
}

template <class S>
void PackedTree<S>::forget(Proxy proxy) {
  const std::uint32_t slot = slot_of_[proxy];
  before_[slot / 4].clear(static_cast<int>(slot % 4));
}

template <class S>
void PackedTree<S>::mark(Proxy proxy) {
  std::uint32_t child = slot_of_[proxy];
  for (Level& level : levels_) {
    std::uint8_t& marks = level.marks[child / 4];
    const bool marked = marks != 0;
    marks = static_cast<std::uint8_t>(marks | 1u << (child % 4));
    if (marked) return;
    child /= 4;
  }
}

template <class S>
void PackedTree<S>::unmark(Proxy proxy) {
  std::uint32_t child = slot_of_[proxy];
  for (Level& level : levels_) {
    std::uint8_t& marks = level.marks[child / 4];
    if (marks == 0) return;
    marks = 0;
    child /= 4;
  }
}

template <class S>
void PackedTree<S>::mark_all() {
  std::size_t children = slots_end_;
  for (Level& level : levels_) {
    std::fill(level.marks.begin(), level.marks.end(), std::uint8_t{Node::kAll});
    // The last node may have fewer than four.
    level.marks.back() = static_cast<std::uint8_t>(Node::kAll >> (3 - (children - 1) % 4));
    children = level.nodes.size();
  }
}

template <class S>
void PackedTree<S>::unmark_all() {
  for (Level& level : levels_) std::fill(level.marks.begin(), level.marks.end(), std::uint8_t{0});
}

// Adds an empty group at the end of level 0, and the nodes that it needs above.
template <class S>
void PackedTree<S>::append_group() {
  if (levels_.empty()) levels_.emplace_back();
  std::size_t nodes = levels_[0].nodes.size() + 1;
  proxies_.resize(nodes * 4);
  before_.resize(nodes);
  is_dirty_.resize(nodes, 0);
  for (std::size_t level = 0;; ++level) {
    levels_[level].nodes.resize(nodes);
    levels_[level].marks.resize(nodes, 0);
    if (nodes == 1) return;
    nodes = (nodes + 3) / 4;
    if (level + 1 == levels_.size()) {
      levels_.emplace_back();
      levels_.back().nodes.emplace_back().set(0, levels_[level].nodes[0].bounds());
    }
  }
}

template <class S>
void PackedTree<S>::touch(std::uint32_t group) {
  if (is_dirty_[group] != 0) return;
  is_dirty_[group] = 1;
  dirty_groups_.push_back(group);
}

template <class S>
void PackedTree<S>::refresh() {
  if (dirty_groups_.empty()) return;
  const bool disordered = appended_ > kAppendedMax + count_ / kAppendedShare || removed_ > kRemovedMax + slots_end_ / 2;
  if (!disordered) {
    if (dirty_groups_.size() > is_dirty_.size() / kRefitShare) {
      refit_all();
    } else {
      for (const std::uint32_t group : dirty_groups_) refit_path(group);
    }
  }
  for (const std::uint32_t group : dirty_groups_) is_dirty_[group] = 0;
  dirty_groups_.clear();
  if (disordered || cost_ > packed_cost_ * kLoosenessMax) pack();
}

template <class S>
void PackedTree<S>::refit_all() {
  cost_ = 0;
  for (std::uint32_t level = 1; level < levels_.size(); ++level) {
    const std::vector<Node>& children = levels_[level - 1].nodes;
    cost_ += tree_kernels<S>().refit(children.data(), children.size(), levels_[level].nodes.data());
  }
}

template <class S>
void PackedTree<S>::refit_path(std::uint32_t group) {
  std::uint32_t child = group;
  for (std::uint32_t level = 1; level < levels_.size(); ++level) {
    const Aabb<S> bounds = levels_[level - 1].nodes[child].bounds();
    Node& parent = levels_[level].nodes[child / 4];
    const int lane = static_cast<int>(child % 4);
    const Aabb<S> before = parent.get(lane);
    if (before.lower == bounds.lower && before.upper == bounds.upper) return;
    cost_ -= parent.half_perimeter(lane);
    parent.set(lane, bounds);
    cost_ += parent.half_perimeter(lane);
    child /= 4;
  }
}

// Takes all proxies out and lays them down again along the curve.
template <class S>
void PackedTree<S>::pack() {
  items_.clear();
  for (std::uint32_t slot = 0; slot < slots_end_; ++slot) {
    const Node& boxes = levels_[0].nodes[slot / 4];
    const int lane = static_cast<int>(slot % 4);
    if (!boxes.is_empty(lane)) items_.push_back({boxes.get(lane), before_[slot / 4].get(lane), proxies_[slot]});
  }
  const auto groups = static_cast<std::uint32_t>((items_.size() + 3) / 4);
  slots_end_ = static_cast<std::uint32_t>(items_.size());
  appended_ = removed_ = 0;
  proxies_.resize(groups * 4);
  before_.assign(groups, Node());
  is_dirty_.assign(groups, 0);
  levels_.clear();
  if (groups == 0) return;
  for (std::uint32_t nodes = groups;; nodes = (nodes + 3) / 4) {
    levels_.push_back({std::vector<Node>(nodes), std::vector<std::uint8_t>(nodes, 0)});
    if (nodes == 1) break;
  }
  sort_along_curve();
  for (std::uint32_t slot = 0; slot < slots_end_; ++slot) {
    const Item& item = items_[order_[slot]];
    proxies_[slot] = item.proxy;
    slot_of_[item.proxy] = slot;
    levels_[0].nodes[slot / 4].set(static_cast<int>(slot % 4), item.now);
    before_[slot / 4].set(static_cast<int>(slot % 4), item.before);
  }
  refit_all();
  packed_cost_ = cost_;
}

// Leaves in order_ the indices of items_ along the curve: a radix sort of 11 bits a pass.
template <class S>
void PackedTree<S>::sort_along_curve() {
  constexpr int kDigitBits = 11, kPasses = 3;
  constexpr std::uint32_t kDigits = 1u << kDigitBits;
  const CurveGrid<S> grid(items_);
  const std::size_t count = items_.size();
  for (auto* scratch : {&keys_, &keys_sorted_, &order_, &order_sorted_}) scratch->resize(count);
  std::array<std::array<std::uint32_t, kDigits>, kPasses> starts{};
  for (std::size_t i = 0; i < count; ++i) {
    keys_[i] = grid.key(items_[i].now);
    order_[i] = static_cast<std::uint32_t>(i);
    for (int pass = 0; pass < kPasses; ++pass) ++starts[pass][keys_[i] >> (pass * kDigitBits) & (kDigits - 1)];
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    std::uint32_t start = 0;
    for (std::uint32_t& entry : starts[pass]) {
      const std::uint32_t digit_count = entry;
      entry = start;
      start += digit_count;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t place = starts[pass][keys_[i] >> (pass * kDigitBits) & (kDigits - 1)]++;
      keys_sorted_[place] = keys_[i];
      order_sorted_[place] = order_[i];
    }
    keys_.swap(keys_sorted_);
    order_.swap(order_sorted_);
  }
}

template class PackedTree<float>;
template class PackedTree<double>;

}  // namespace urto

#include "physics/broad_phase/tree_kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "physics/solver/contact_kernels.h"

namespace urto {
namespace {

constexpr std::uint32_t kNodeCount = 12;

// Nodes with boxes here and there, some lanes empty, some marked.
template <class S>
struct RandomNodes {
  std::vector<Box4<S>> now = std::vector<Box4<S>>(kNodeCount), before = now;
  std::vector<std::uint8_t> marks;

  explicit RandomNodes(std::mt19937& random) {
    for (std::uint32_t node = 0; node < kNodeCount; ++node) {
      marks.push_back(static_cast<std::uint8_t>(random() % 16));
      for (int lane = 0; lane < 4; ++lane) {
        if (random() % 8 != 0) now[node].set(lane, box(random));
        if (random() % 8 != 0) before[node].set(lane, random() % 2 == 0 ? now[node].get(lane) : box(random));
      }
    }
  }
  // On a coarse grid, so that many boxes just touch.
  static Aabb<S> box(std::mt19937& random) {
    const auto at = [&] { return S(random() % 8) / S(4); };
    const Vec<S> low(at(), at());
    return {low, low + Vec<S>(at() / 2, at() / 2)};
  }
  Nodes<S> view() const { return {now.data(), before.data(), marks.data()}; }
  bool marked(std::uint32_t node, int lane) const { return (marks[node] >> lane & 1) != 0; }
};

using Found = std::set<std::tuple<std::uint32_t, std::uint32_t, int, int>>;

template <class S>
Found expected(const RandomNodes<S>& a, const RandomNodes<S>& b, Sought sought, const NodePair& pair) {
  Found out;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (&a == &b && pair.x == pair.y && (j < i || (j == i && sought != Sought::kBranches))) continue;
      if (!a.marked(pair.x, i) && !b.marked(pair.y, j)) continue;
      if (!a.now[pair.x].get(i).overlaps(b.now[pair.y].get(j))) continue;
      if (sought == Sought::kNewPairs && a.before[pair.x].get(i).overlaps(b.before[pair.y].get(j))) continue;
      out.emplace(pair.x, pair.y, i, j);
    }
  }
  return out;
}

template <class S>
std::size_t compare(const RandomNodes<S>& a, const RandomNodes<S>& b, Sought sought) {
  std::vector<NodePair> pairs;
  Found wanted, found;
  for (std::uint32_t x = 0; x < kNodeCount; ++x) {
    for (std::uint32_t y = &a == &b ? x : 0; y < kNodeCount; ++y) {
      pairs.push_back({x, y});
      wanted.merge(expected(a, b, sought, pairs.back()));
    }
  }
  std::vector<NodeHit> hits(pairs.size());
  hits.resize(tree_kernels<S>().meet(a.view(), b.view(), sought, pairs.data(), pairs.size(), hits.data()));
  for (const NodeHit& hit : hits) {
    EXPECT_NE(hit.lanes, 0u);
    for (int lane = 0; lane < 16; ++lane)
      if ((hit.lanes >> lane & 1u) != 0) found.emplace(hit.nodes.x, hit.nodes.y, lane / 4, lane % 4);
  }
  EXPECT_EQ(found, wanted) << "sought " << static_cast<int>(sought);
  return wanted.size();
}

template <class S>
std::size_t compare_all(std::uint32_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const RandomNodes<S> a(random), b(random);
  std::size_t met = 0;
  for (const Sought sought : {Sought::kBranches, Sought::kPairs, Sought::kNewPairs})
    met += compare(a, a, sought) + compare(a, b, sought);
  return met;
}

template <class S>
void compare_refit(std::uint32_t seed, std::size_t count) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::vector<Box4<S>> children(count), parents((count + 3) / 4), expected = parents;
  for (Box4<S>& child : children)
    for (int lane = 0; lane < 4; ++lane)
      if (random() % 3 != 0) child.set(lane, RandomNodes<S>::box(random));
  double cost = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Aabb<S> box = children[k].bounds();
    expected[k / 4].set(static_cast<int>(k % 4), box);
    if (box.lower.x() <= box.upper.x()) cost += double(box.perimeter()) / 2;
  }
  EXPECT_NEAR(tree_kernels<S>().refit(children.data(), count, parents.data()), cost, 1e-6 * cost);
  for (std::size_t k = 0; k < 4 * parents.size(); ++k) {
    const int lane = static_cast<int>(k % 4);
    const Aabb<S> box = parents[k / 4].get(lane), wanted = expected[k / 4].get(lane);
    EXPECT_EQ(box.lower, wanted.lower) << "lane " << k << " of " << 4 * parents.size();
    EXPECT_EQ(box.upper, wanted.upper) << "lane " << k << " of " << 4 * parents.size();
  }
}

TEST(TreeKernelsTest, RefitBoxesAroundNodesAtEveryWidth) {
  for (const SimdTarget& target : simd_targets()) {
    use_simd_target(target.id);
    SCOPED_TRACE(target.name);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      compare_refit<float>(seed, seed);
      compare_refit<double>(seed, seed);
    }
  }
  use_simd_target(0);
}

TEST(TreeKernelsTest, FindWhatMeetsAtEveryWidth) {
  std::size_t met = 0;
  for (const SimdTarget& target : simd_targets()) {
    use_simd_target(target.id);
    SCOPED_TRACE(target.name);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) met += compare_all<float>(seed) + compare_all<double>(seed);
  }
  use_simd_target(0);
  EXPECT_GT(met, 1000u);
}

}  // namespace
}  // namespace urto

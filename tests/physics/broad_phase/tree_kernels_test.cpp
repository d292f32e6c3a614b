#include "physics/broad_phase/tree_kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "physics/solver/contact_kernels.h"

namespace urto {
namespace {

constexpr std::uint32_t kLeafCount = 12;

// Leaves with boxes here and there, some lanes empty, some marked.
template <class S>
struct RandomLeaves {
  std::vector<Box4<S>> now = std::vector<Box4<S>>(kLeafCount), before = now;
  std::vector<std::uint8_t> marks;

  explicit RandomLeaves(std::mt19937& random) {
    for (std::uint32_t leaf = 0; leaf < kLeafCount; ++leaf) {
      marks.push_back(static_cast<std::uint8_t>(random() % 16));
      for (int lane = 0; lane < 4; ++lane) {
        if (random() % 8 != 0) now[leaf].set(lane, box(random));
        if (random() % 8 != 0) before[leaf].set(lane, random() % 2 == 0 ? now[leaf].get(lane) : box(random));
      }
    }
  }
  // On a coarse grid, so that many boxes just touch.
  static Aabb<S> box(std::mt19937& random) {
    const auto at = [&] { return S(random() % 8) / S(4); };
    const Vec<S> low(at(), at());
    return {low, low + Vec<S>(at() / 2, at() / 2)};
  }
  Leaves<S> view() const { return {now.data(), before.data(), marks.data()}; }
  bool marked(std::uint32_t leaf, int lane) const { return (marks[leaf] >> lane & 1) != 0; }
};

using Found = std::set<std::tuple<std::uint32_t, std::uint32_t, int, int>>;

template <class S>
Found expected(const RandomLeaves<S>& a, const RandomLeaves<S>& b, bool fresh, const LeafPair& pair) {
  Found out;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (&a == &b && pair.x == pair.y && j <= i) continue;
      if (!a.marked(pair.x, i) && !b.marked(pair.y, j)) continue;
      if (!a.now[pair.x].get(i).overlaps(b.now[pair.y].get(j))) continue;
      if (fresh && a.before[pair.x].get(i).overlaps(b.before[pair.y].get(j))) continue;
      out.emplace(pair.x, pair.y, i, j);
    }
  }
  return out;
}

template <class S>
std::size_t compare(const RandomLeaves<S>& a, const RandomLeaves<S>& b, bool fresh) {
  std::vector<LeafPair> pairs;
  Found wanted, found;
  for (std::uint32_t x = 0; x < kLeafCount; ++x) {
    for (std::uint32_t y = &a == &b ? x : 0; y < kLeafCount; ++y) {
      pairs.push_back({x, y});
      wanted.merge(expected(a, b, fresh, pairs.back()));
    }
  }
  std::vector<LeafHit> hits(pairs.size());
  hits.resize(tree_kernels<S>().meet(a.view(), b.view(), fresh, pairs.data(), pairs.size(), hits.data()));
  for (const LeafHit& hit : hits) {
    EXPECT_NE(hit.lanes, 0u);
    for (int lane = 0; lane < 16; ++lane)
      if ((hit.lanes >> lane & 1u) != 0) found.emplace(hit.leaves.x, hit.leaves.y, lane / 4, lane % 4);
  }
  EXPECT_EQ(found, wanted) << (fresh ? "new pairs" : "all pairs");
  return wanted.size();
}

template <class S>
std::size_t compare_all(std::uint32_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const RandomLeaves<S> a(random), b(random);
  std::size_t met = 0;
  for (const bool fresh : {false, true}) met += compare(a, a, fresh) + compare(a, b, fresh);
  return met;
}

template <class S>
void compare_refit(std::uint32_t seed, std::size_t count) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::vector<Box4<S>> children(count), parents((count + 3) / 4), expected = parents;
  for (Box4<S>& child : children)
    for (int lane = 0; lane < 4; ++lane)
      if (random() % 3 != 0) child.set(lane, RandomLeaves<S>::box(random));
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

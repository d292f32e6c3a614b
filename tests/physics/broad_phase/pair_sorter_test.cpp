#include "physics/broad_phase/pair_sorter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace urto {
namespace {

using Pairs = std::vector<std::pair<Proxy, Proxy>>;

// Distinct random pairs of proxies below `end`, in no order.
std::set<std::pair<Proxy, Proxy>> random_pairs(unsigned seed, Proxy end, std::size_t count) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Proxy> proxy(0, end - 1);
  std::set<std::pair<Proxy, Proxy>> pairs;
  while (pairs.size() < count) {
    const Proxy a = proxy(random), b = proxy(random);
    if (a != b) pairs.emplace(std::min(a, b), std::max(a, b));
  }
  return pairs;
}

void expect_sorted(unsigned seed, Proxy end, std::size_t count) {
  const auto expected = random_pairs(seed, end, count);
  Pairs shuffled(expected.begin(), expected.end());
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(seed + 1));
  PairSorter sorter;
  Pairs sorted{{9, 9}};
  for (int use = 0; use < 2; ++use) {  // the second use must not remember the first
    sorter.clear();
    bool turned = false;
    for (const auto& [low, high] : shuffled) {
      turned ? sorter.add(high, low) : sorter.add(low, high);
      turned = !turned;
    }
    sorter.sort_into(end, sorted);
    ASSERT_EQ(sorted, Pairs(expected.begin(), expected.end())) << "seed " << seed;
  }
}

TEST(PairSorterTest, FewPairsOfManyProxies) { expect_sorted(1, 100000, 50); }
TEST(PairSorterTest, ManyPairsOfFewProxies) { expect_sorted(2, 60, 1500); }
TEST(PairSorterTest, AsManyPairsAsProxies) { expect_sorted(3, 1000, 1000); }

TEST(PairSorterTest, OneProxyWithEveryOther) {
  PairSorter sorter;
  Pairs expected, sorted;
  for (Proxy other = 5000; other > 7; --other) sorter.add(other, 7);
  for (Proxy other = 8; other <= 5000; ++other) expected.emplace_back(7, other);
  sorter.sort_into(5001, sorted);
  EXPECT_EQ(sorted, expected);
}

TEST(PairSorterTest, NothingGivesNothing) {
  PairSorter sorter;
  Pairs sorted{{1, 2}};
  sorter.sort_into(10, sorted);
  EXPECT_TRUE(sorted.empty());
}

}  // namespace
}  // namespace urto

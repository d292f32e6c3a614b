#include "physics/pair_set.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace urto {
namespace {

TEST(PairSetTest, AgreesWithAnOrderedSet) {
  const unsigned seed = 9;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  PairSet set;
  std::set<std::pair<std::uint32_t, std::uint32_t>> reference;
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t a = random() % 60, b = a + 1 + random() % 60;
    ASSERT_EQ(set.contains(a, b), reference.count({a, b}) == 1);
    if (reference.count({a, b})) {
      if (random() % 2) set.erase(a, b), reference.erase({a, b});
    } else {
      set.insert(a, b), reference.insert({a, b});
    }
  }
  for (const auto& [a, b] : reference) EXPECT_TRUE(set.contains(a, b));
}

}  // namespace
}  // namespace urto

// Every structure against a plain reference: the pairs and hits computed straight from the definition.
#include "physics/broad_phase/broad_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>

namespace urto {
namespace {

constexpr BroadPhaseKind kKinds[] = {BroadPhaseKind::kBruteForce, BroadPhaseKind::kQuadtree, BroadPhaseKind::kBvh};
using Pairs = std::vector<std::pair<Proxy, Proxy>>;

std::string name_of(BroadPhaseKind kind) {
  return kind == BroadPhaseKind::kBruteForce ? "brute force" : kind == BroadPhaseKind::kQuadtree ? "quadtree" : "bvh";
}

// The definition of the answers, and all structures beside it.
template <class S>
class Compared {
 public:
  struct Entry {
    Aabb<S> bounds;
    bool still;
  };

  Compared() {
    for (const BroadPhaseKind kind : kKinds) structures_.push_back(BroadPhase<S>::create(kind));
  }
  void insert(Proxy proxy, const Aabb<S>& bounds, bool still) {
    entries_[proxy] = {bounds, still};
    for (auto& structure : structures_) structure->insert(proxy, bounds, still);
  }
  void remove(Proxy proxy) {
    entries_.erase(proxy);
    for (auto& structure : structures_) structure->remove(proxy);
  }
  void move(Proxy proxy, const Aabb<S>& bounds) {
    entries_[proxy].bounds = bounds;
    for (auto& structure : structures_) structure->move(proxy, bounds);
  }
  void set_resting(Proxy proxy, bool resting) {
    for (auto& structure : structures_) structure->set_resting(proxy, resting);
  }
  const std::map<Proxy, Entry>& entries() const { return entries_; }
  std::vector<Proxy> proxies() const {
    std::vector<Proxy> out;
    for (const auto& [proxy, entry] : entries_) out.push_back(proxy);
    return out;
  }

  void expect_equal_pairs(const std::vector<Proxy>& moved) const {
    Pairs expected;
    for (auto a = entries_.begin(); a != entries_.end(); ++a) {
      for (auto b = std::next(a); b != entries_.end(); ++b) {
        const bool wanted =
            std::count(moved.begin(), moved.end(), a->first) + std::count(moved.begin(), moved.end(), b->first) > 0;
        if (wanted && !(a->second.still && b->second.still) && overlap(a->second.bounds, b->second.bounds)) {
          expected.emplace_back(a->first, b->first);
        }
      }
    }
    for (std::size_t i = 0; i < structures_.size(); ++i) {
      Pairs found{{7, 7}};  // must be cleared
      structures_[i]->find_pairs(moved, found);
      ASSERT_EQ(found, expected) << name_of(kKinds[i]);
    }
  }
  void expect_equal_query(const Aabb<S>& box) const {
    std::vector<Proxy> expected;
    for (const auto& [proxy, entry] : entries_) {
      if (overlap(entry.bounds, box)) expected.push_back(proxy);
    }
    for (std::size_t i = 0; i < structures_.size(); ++i) {
      std::vector<Proxy> found{7};
      structures_[i]->query(box, found);
      ASSERT_EQ(found, expected) << name_of(kKinds[i]);
    }
  }
  // Which proxies a segment meets is a matter of rounding where it grazes: all structures must say the same, and
  // agree with exact arithmetic where the answer is clear.
  void expect_equal_segment(const Vec<S>& origin, const Vec<S>& translation) const {
    std::vector<Proxy> first;
    structures_[0]->query_segment(origin, translation, first);
    for (std::size_t i = 1; i < structures_.size(); ++i) {
      std::vector<Proxy> found{7};
      structures_[i]->query_segment(origin, translation, found);
      ASSERT_EQ(found, first) << name_of(kKinds[i]);
    }
    for (const auto& [proxy, entry] : entries_) {
      const bool found = std::binary_search(first.begin(), first.end(), proxy);
      for (int part = 0; part <= 16; ++part) {
        const S fraction = S(part) / S(16);
        const S x = origin.x() + fraction * translation.x(), y = origin.y() + fraction * translation.y();
        const Aabb<S>& box = entry.bounds;
        const S margin = S(1e-3) * (S(1) + std::abs(x) + std::abs(y));
        const bool inside = box.lower.x() + margin < x && x < box.upper.x() - margin && box.lower.y() + margin < y &&
                            y < box.upper.y() - margin;
        if (inside && !found) FAIL() << "missed " << proxy;
      }
    }
  }

 private:
  static bool overlap(const Aabb<S>& a, const Aabb<S>& b) {
    return !(a.upper.x() < b.lower.x() || b.upper.x() < a.lower.x() || a.upper.y() < b.lower.y() ||
             b.upper.y() < a.lower.y());
  }

  std::map<Proxy, Entry> entries_;
  std::vector<std::unique_ptr<BroadPhase<S>>> structures_;
};

template <class S>
Aabb<S> box_at(double x, double y, double half_width, double half_height) {
  return {Vec<S>(S(x - half_width), S(y - half_height)), Vec<S>(S(x + half_width), S(y + half_height))};
}

// Boxes as rooms have them, and as they should not: crowds, giants, points, lines, twins, and far away.
template <class S>
class RandomBoxes {
 public:
  explicit RandomBoxes(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }
  void shuffle(std::vector<Proxy>& proxies) { std::shuffle(proxies.begin(), proxies.end(), random_); }

  Aabb<S> next() {
    const double kind = uniform(0, 1);
    const double x = uniform(-20, 20), y = uniform(-10, 10);
    if (kind < 0.6) return box_at<S>(x, y, uniform(0.1, 1), uniform(0.1, 1));
    if (kind < 0.7) return box_at<S>(x, y, 0, 0);                                 // a point
    if (kind < 0.75) return box_at<S>(x, y, uniform(0, 30), 0);                   // a line
    if (kind < 0.85) return box_at<S>(3, 4, 0.5, 0.5);                            // one of many twins
    if (kind < 0.9) return box_at<S>(std::round(x), std::round(y), 0.5, 0.5);     // edges touch exactly
    if (kind < 0.93) return box_at<S>(x, y, uniform(10, 1e5), uniform(10, 1e5));  // a giant
    return box_at<S>(uniform(-1e7, 1e7), chance(0.5) ? y : 1e7, 0.5, 0.5);        // far away
  }

 private:
  std::mt19937 random_;
};

template <class S>
class BroadPhaseTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BroadPhaseTest, Scalars);

template <class S>
void run_random_operations(unsigned seed, std::size_t proxies_max, int rounds) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomBoxes<S> boxes(seed);
  Compared<S> compared;
  std::vector<Proxy> free(proxies_max);
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = static_cast<Proxy>(i);
  boxes.shuffle(free);
  for (int round = 0; round < rounds; ++round) {
    // Every few rounds the crowd is filled up or thinned out, else a few come, go and move.
    const double inserted_share = round % 7 == 0 ? 0.8 : 0.05, removed_share = round % 11 == 10 ? 0.9 : 0.05;
    const double moved_share = round % 3 == 0 ? 1 : 0.02;
    for (const Proxy proxy : compared.proxies()) {
      if (!boxes.chance(removed_share)) continue;
      compared.remove(proxy);
      free.push_back(proxy);
    }
    std::vector<Proxy> moved;
    for (const Proxy proxy : compared.proxies()) {
      if (!boxes.chance(moved_share)) continue;
      compared.move(proxy, boxes.next());
      moved.push_back(proxy);
    }
    std::vector<Proxy> still_free;
    for (const Proxy proxy : free) {
      if (!boxes.chance(inserted_share)) {
        still_free.push_back(proxy);
        continue;
      }
      compared.insert(proxy, boxes.next(), boxes.chance(0.2));
      if (boxes.chance(0.9)) moved.push_back(proxy);  // not every new proxy need be asked about
    }
    free = still_free;
    boxes.shuffle(moved);
    compared.expect_equal_pairs(moved);
    for (int i = 0; i < 3; ++i) {
      compared.expect_equal_query(boxes.next());
      const Vec<S> origin = boxes.next().center();
      compared.expect_equal_segment(origin, Vec<S>(boxes.next().center() - origin));
    }
    if (testing::Test::HasFatalFailure()) return;
  }
}

TYPED_TEST(BroadPhaseTest, StructuresAgreeOnRandomOperations) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    run_random_operations<TypeParam>(seed, 40, 40);
    run_random_operations<TypeParam>(seed, 300, 12);
    if (this->HasFatalFailure()) return;
  }
}

// What overlaps now and did not when new pairs were last sought, and nothing that does not overlap.
TYPED_TEST(BroadPhaseTest, NewPairsAreThoseThatHaveJustMet) {
  using S = TypeParam;
  constexpr unsigned kSeed = 8;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  for (BroadPhaseKind kind : {BroadPhaseKind::kBruteForce, BroadPhaseKind::kQuadtree, BroadPhaseKind::kBvh}) {
    RandomBoxes<S> boxes(kSeed);
    const auto structure = BroadPhase<S>::create(kind);
    std::vector<Proxy> all;
    for (Proxy proxy = 0; proxy < 120; ++proxy) {
      structure->insert(proxy, boxes.next(), proxy % 9 == 0);
      all.push_back(proxy);
    }
    Pairs before, now, met;
    structure->find_new_pairs(all, met);
    structure->find_pairs(all, before);
    EXPECT_EQ(met, before) << "of new proxies all pairs are new";
    std::size_t met_in_all = 0;
    for (int round = 0; round < 30; ++round) {
      std::vector<Proxy> moved;
      for (Proxy proxy : all) {
        if (!boxes.chance(0.3)) continue;
        structure->move(proxy, boxes.next());
        moved.push_back(proxy);
      }
      structure->find_pairs(all, now);
      structure->find_new_pairs(moved, met);
      Pairs expected;
      std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(expected));
      ASSERT_EQ(met, expected) << "round " << round;
      met_in_all += met.size();
      before = now;
    }
    EXPECT_GT(met_in_all, 100u);
    structure->forget(all[1]);
    structure->find_new_pairs(std::vector<Proxy>{all[1]}, met);
    const auto with_it = std::count_if(before.begin(), before.end(),
                                       [&](const auto& pair) { return pair.first == all[1] || pair.second == all[1]; });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(met.size()), with_it) << "a forgotten proxy meets all of its neighbours anew";
  }
}

TYPED_TEST(BroadPhaseTest, DriftingCrowdStaysRight) {
  // Boxes that wander a little each round: the case of refitted trees that grow loose.
  constexpr unsigned kSeed = 5;
  RandomBoxes<TypeParam> boxes(kSeed);
  Compared<TypeParam> compared;
  std::vector<std::pair<double, double>> places;
  for (Proxy proxy = 0; proxy < 250; ++proxy) {
    places.emplace_back(boxes.uniform(0, 12), boxes.uniform(0, 12));
    compared.insert(proxy, box_at<TypeParam>(places[proxy].first, places[proxy].second, 0.4, 0.4), proxy % 10 == 0);
  }
  compared.expect_equal_pairs(compared.proxies());
  for (int round = 0; round < 60; ++round) {
    std::vector<Proxy> moved;
    for (Proxy proxy = 0; proxy < 250; ++proxy) {
      if (round % 2 == 0 && proxy % 40 != 0) continue;
      places[proxy].first += boxes.uniform(-1, 1);
      places[proxy].second += boxes.uniform(-1, 1);
      compared.move(proxy, box_at<TypeParam>(places[proxy].first, places[proxy].second, 0.4, 0.4));
      moved.push_back(proxy);
      compared.set_resting(proxy, boxes.chance(0.5));  // also of what has moved and not been asked for
    }
    compared.expect_equal_pairs(moved);
    if (this->HasFatalFailure()) FAIL() << "seed " << kSeed << ", round " << round;
  }
}

TYPED_TEST(BroadPhaseTest, ManyIdenticalBoxesGiveAllPairs) {
  for (const BroadPhaseKind kind : kKinds) {
    const auto structure = BroadPhase<TypeParam>::create(kind);
    std::vector<Proxy> moved;
    for (Proxy proxy = 0; proxy < 200; ++proxy) {
      structure->insert(proxy, box_at<TypeParam>(1e7, -1e7, 0, 0), false);
      moved.push_back(proxy);
    }
    Pairs pairs;
    structure->find_pairs(moved, pairs);
    EXPECT_EQ(pairs.size(), 200u * 199u / 2) << name_of(kind);
    structure->find_pairs(std::vector<Proxy>{17}, pairs);
    EXPECT_EQ(pairs.size(), 199u) << name_of(kind);
  }
}

TYPED_TEST(BroadPhaseTest, StillAgainstStillIsNeverAPair) {
  for (const BroadPhaseKind kind : kKinds) {
    const auto structure = BroadPhase<TypeParam>::create(kind);
    structure->insert(0, box_at<TypeParam>(0, 0, 5, 1), true);
    structure->insert(1, box_at<TypeParam>(1, 0, 5, 1), true);
    structure->insert(2, box_at<TypeParam>(20, 0, 1, 1), false);
    Pairs pairs;
    structure->find_pairs(std::vector<Proxy>{1, 0, 2}, pairs);
    EXPECT_TRUE(pairs.empty()) << name_of(kind);
    // A still one that is moved onto another body meets it.
    structure->move(1, box_at<TypeParam>(18, 0, 1, 1));
    structure->find_pairs(std::vector<Proxy>{1}, pairs);
    EXPECT_EQ(pairs, (Pairs{{1, 2}})) << name_of(kind);
  }
}

TYPED_TEST(BroadPhaseTest, TouchingCountsAndAHairApartDoesNot) {
  for (const BroadPhaseKind kind : kKinds) {
    const auto structure = BroadPhase<TypeParam>::create(kind);
    const TypeParam one = 1, above_one = std::nextafter(one, TypeParam(2));
    structure->insert(0, {Vec<TypeParam>(0, 0), Vec<TypeParam>(1, 1)}, false);
    structure->insert(1, {Vec<TypeParam>(one, 1), Vec<TypeParam>(2, 2)}, false);
    structure->insert(2, {Vec<TypeParam>(above_one, 0), Vec<TypeParam>(2, TypeParam(0.5))}, false);
    Pairs pairs;
    structure->find_pairs(std::vector<Proxy>{0, 1, 2}, pairs);
    EXPECT_EQ(pairs, (Pairs{{0, 1}})) << name_of(kind);
  }
}

TYPED_TEST(BroadPhaseTest, SegmentMissesTheCornerItPassesBy) {
  for (const BroadPhaseKind kind : kKinds) {
    const auto structure = BroadPhase<TypeParam>::create(kind);
    structure->insert(4, box_at<TypeParam>(0, 0, 1, 1), false);
    std::vector<Proxy> found;
    structure->query_segment(Vec<TypeParam>(0, 3), Vec<TypeParam>(3, -3), found);  // bounds overlap, the line does not
    EXPECT_TRUE(found.empty()) << name_of(kind);
    structure->query_segment(Vec<TypeParam>(0, TypeParam(1.5)), Vec<TypeParam>(TypeParam(1.5), TypeParam(-1.5)), found);
    EXPECT_EQ(found, std::vector<Proxy>{4}) << name_of(kind);
    structure->query_segment(Vec<TypeParam>(-5, 0), Vec<TypeParam>(3, 0), found);  // ends before
    EXPECT_TRUE(found.empty()) << name_of(kind);
    structure->query_segment(Vec<TypeParam>(0, 0), Vec<TypeParam>(0, 0), found);  // a point inside
    EXPECT_EQ(found, std::vector<Proxy>{4}) << name_of(kind);
  }
}

TYPED_TEST(BroadPhaseTest, EmptyStructuresAnswerNothing) {
  for (const BroadPhaseKind kind : kKinds) {
    const auto structure = BroadPhase<TypeParam>::create(kind);
    Pairs pairs{{1, 2}};
    std::vector<Proxy> found{1};
    structure->find_pairs({}, pairs);
    EXPECT_TRUE(pairs.empty());
    structure->query(box_at<TypeParam>(0, 0, 1, 1), found);
    EXPECT_TRUE(found.empty());
    structure->insert(3, box_at<TypeParam>(0, 0, 1, 1), false);
    structure->remove(3);
    structure->find_pairs({}, pairs);
    structure->query(box_at<TypeParam>(0, 0, 1, 1), found);
    EXPECT_TRUE(pairs.empty() && found.empty()) << name_of(kind);
  }
}

TEST(BroadPhaseCreateTest, AutoIsNotAStructure) {
  EXPECT_EQ(BroadPhase<float>::create(BroadPhaseKind::kAuto), nullptr);
  EXPECT_EQ(BroadPhase<double>::create(BroadPhaseKind::kAuto), nullptr);
}

}  // namespace
}  // namespace urto

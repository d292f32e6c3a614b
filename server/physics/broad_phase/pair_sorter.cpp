#include "physics/broad_phase/pair_sorter.h"

#include <algorithm>

namespace urto {
namespace {

// With fewer pairs than this share of the proxies a comparison sort is cheaper than a pass over all buckets.
constexpr std::uint32_t kProxiesPerPairMax = 8;
// Buckets up to this length are sorted by insertion.
constexpr std::uint32_t kInsertionSortMax = 24;

void insertion_sort(Proxy* begin, Proxy* end) {
  for (Proxy* next = begin + 1; next < end; ++next) {
    const Proxy value = *next;
    Proxy* hole = next;
    for (; hole != begin && value < hole[-1]; --hole) *hole = hole[-1];
    *hole = value;
  }
}

}  // namespace

void PairSorter::sort_into(std::uint32_t proxies_end, std::vector<std::pair<Proxy, Proxy>>& pairs) {
  pairs.clear();
  if (keys_.empty()) return;
  if (keys_.size() >= proxies_end / kProxiesPerPairMax) return sort_by_buckets(proxies_end, pairs);
  std::sort(keys_.begin(), keys_.end());
  pairs.reserve(keys_.size());
  for (const std::uint64_t key : keys_) pairs.emplace_back(static_cast<Proxy>(key >> 32), static_cast<Proxy>(key));
}

// A counting sort by the low proxy; the few partners of each are then sorted where they are.
void PairSorter::sort_by_buckets(std::uint32_t proxies_end, std::vector<std::pair<Proxy, Proxy>>& pairs) {
  ends_.assign(proxies_end + 1, 0);
  for (const std::uint64_t key : keys_) ++ends_[(key >> 32) + 1];
  for (std::uint32_t proxy = 0; proxy < proxies_end; ++proxy) ends_[proxy + 1] += ends_[proxy];
  // ends_[p] is now where bucket p begins; filling it moves that to where it ends.
  highs_.resize(keys_.size());
  for (const std::uint64_t key : keys_) highs_[ends_[key >> 32]++] = static_cast<Proxy>(key);
  pairs.resize(keys_.size());
  std::uint32_t begin = 0;
  for (Proxy low = 0; low < proxies_end; ++low) {
    const std::uint32_t end = ends_[low];
    if (end - begin <= kInsertionSortMax) {
      insertion_sort(highs_.data() + begin, highs_.data() + end);
    } else {
      std::sort(highs_.data() + begin, highs_.data() + end);
    }
    for (; begin < end; ++begin) pairs[begin] = {low, highs_[begin]};
  }
}

}  // namespace urto

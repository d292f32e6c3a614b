#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "physics/broad_phase/broad_phase.h"

namespace urto {

// Collects pairs in any order and hands them out sorted by (low, high). The buffers are kept from call to call.
class PairSorter {
 public:
  void clear() { keys_.clear(); }
  void add(Proxy a, Proxy b) { keys_.push_back(a < b ? (std::uint64_t{a} << 32 | b) : (std::uint64_t{b} << 32 | a)); }
  void add_all(const PairSorter& other) { keys_.insert(keys_.end(), other.keys_.begin(), other.keys_.end()); }
  // `proxies_end`: above every proxy that was added.
  void sort_into(std::uint32_t proxies_end, std::vector<std::pair<Proxy, Proxy>>& pairs);

 private:
  void sort_by_buckets(std::uint32_t proxies_end, std::vector<std::pair<Proxy, Proxy>>& pairs);

  std::vector<std::uint64_t> keys_;  // low · 2³² + high
  std::vector<std::uint32_t> ends_;  // of each low proxy's bucket
  std::vector<Proxy> highs_;
};

}  // namespace urto

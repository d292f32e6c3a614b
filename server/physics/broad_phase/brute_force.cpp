#include "physics/broad_phase/brute_force.h"

#include <bit>

#include "physics/broad_phase/segment_bounds.h"

namespace urto {

template <class S>
void BruteForce<S>::insert(Proxy proxy, const Aabb<S>& bounds, bool still) {
  this->note_new(proxy, bounds);
  const std::size_t block = proxy / 4;
  if (block >= blocks_.size()) {
    blocks_.resize(block + 1);
    not_still_.resize(block + 1, 0);
    moved_.resize(block + 1, 0);
  }
  blocks_[block].set(static_cast<int>(proxy % 4), bounds);
  const auto bit = static_cast<std::uint8_t>(1u << (proxy % 4));
  not_still_[block] = static_cast<std::uint8_t>(still ? not_still_[block] & ~bit : not_still_[block] | bit);
}

template <class S>
void BruteForce<S>::remove(Proxy proxy) {
  blocks_[proxy / 4].clear(static_cast<int>(proxy % 4));
}

template <class S>
void BruteForce<S>::move(Proxy proxy, const Aabb<S>& bounds) {
  this->note(proxy, bounds);
  blocks_[proxy / 4].set(static_cast<int>(proxy % 4), bounds);
}

template <class S>
void BruteForce<S>::find_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) const {
  for (const Proxy proxy : moved) moved_[proxy / 4] |= static_cast<std::uint8_t>(1u << (proxy % 4));
  sorter_.clear();
  for (const Proxy proxy : moved) {
    const Box4<S>& own = blocks_[proxy / 4];
    const int lane = static_cast<int>(proxy % 4);
    const std::uint32_t partners = (not_still_[proxy / 4] >> lane & 1u) != 0 ? Box4<S>::kAll : 0;
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      std::uint32_t hits = blocks_[block].overlap_mask(own, lane) & (partners | not_still_[block]);
      // Of two that both moved the lower one reports the pair, and none reports itself.
      if (block < proxy / 4) hits &= ~std::uint32_t{moved_[block]};
      if (block == proxy / 4) hits &= ~(std::uint32_t{moved_[block]} & ((2u << lane) - 1));
      for (; hits != 0; hits &= hits - 1) sorter_.add(proxy, static_cast<Proxy>(block * 4 + std::countr_zero(hits)));
    }
  }
  for (const Proxy proxy : moved) moved_[proxy / 4] = 0;
  sorter_.sort_into(static_cast<std::uint32_t>(blocks_.size() * 4), pairs);
}

template <class S>
void BruteForce<S>::query(const Aabb<S>& box, std::vector<Proxy>& out) const {
  out.clear();
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    for (std::uint32_t hits = blocks_[block].overlap_mask(box); hits != 0; hits &= hits - 1) {
      out.push_back(static_cast<Proxy>(block * 4 + std::countr_zero(hits)));
    }
  }
}

template <class S>
void BruteForce<S>::query_segment(const Vec<S>& origin, const Vec<S>& translation, std::vector<Proxy>& out) const {
  const SegmentBounds<S> segment(origin, translation);
  out.clear();
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    for (std::uint32_t hits = blocks_[block].overlap_mask(segment.bounds()); hits != 0; hits &= hits - 1) {
      const int lane = std::countr_zero(hits);
      if (segment.meets(blocks_[block].get(lane))) out.push_back(static_cast<Proxy>(block * 4 + lane));
    }
  }
}

template class BruteForce<float>;
template class BruteForce<double>;

}  // namespace urto

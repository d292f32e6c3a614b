#pragma once

#include <cstdint>
#include <vector>

namespace urto {

// A set of pairs (low, high) of small numbers: open addressing with linear probing, deletion by shifting back. It is
// never iterated, so its layout cannot reach the results.
class PairSet {
 public:
  bool contains(std::uint32_t low, std::uint32_t high) const {
    if (slots_.empty()) return false;
    const std::uint64_t key = key_of(low, high);
    for (std::size_t i = home(key);; i = (i + 1) & mask()) {
      if (slots_[i] == key) return true;
      if (slots_[i] == kEmpty) return false;
    }
  }

  void insert(std::uint32_t low, std::uint32_t high) {
    if ((count_ + 1) * 2 > slots_.size()) grow();
    place(key_of(low, high));
    ++count_;
  }

  void erase(std::uint32_t low, std::uint32_t high) {
    const std::uint64_t key = key_of(low, high);
    std::size_t hole = home(key);
    while (slots_[hole] != key) {
      if (slots_[hole] == kEmpty) return;
      hole = (hole + 1) & mask();
    }
    for (std::size_t i = (hole + 1) & mask(); slots_[i] != kEmpty; i = (i + 1) & mask()) {
      // Move back what may not stay behind a hole: its home lies cyclically at or before the hole.
      if (((i - home(slots_[i])) & mask()) >= ((i - hole) & mask())) {
        slots_[hole] = slots_[i];
        hole = i;
      }
    }
    slots_[hole] = kEmpty;
    --count_;
  }

  void clear() {
    slots_.clear();
    count_ = 0;
  }

 private:
  static constexpr std::uint64_t kEmpty = ~0ull;
  static constexpr std::size_t kSlotsMin = 64;

  static std::uint64_t key_of(std::uint32_t low, std::uint32_t high) {
    return (static_cast<std::uint64_t>(low) << 32) | high;
  }
  std::size_t mask() const { return slots_.size() - 1; }
  std::size_t home(std::uint64_t key) const {
    // Fibonacci hashing (Knuth, TAOCP 3, 6.4) after folding the halves.
    key ^= key >> 29;
    return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ull) >> 32) & mask();
  }
  void place(std::uint64_t key) {
    std::size_t i = home(key);
    while (slots_[i] != kEmpty) i = (i + 1) & mask();
    slots_[i] = key;
  }
  void grow() {
    std::vector<std::uint64_t> old;
    old.swap(slots_);
    slots_.assign(old.empty() ? kSlotsMin : old.size() * 2, kEmpty);
    for (std::uint64_t key : old)
      if (key != kEmpty) place(key);
  }

  std::vector<std::uint64_t> slots_;
  std::size_t count_ = 0;
};

}  // namespace urto

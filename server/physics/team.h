#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace urto {

// A few threads that share out loops whose parts do not touch each other: the caller is one of them. Parts are
// contiguous and depend on the counts alone, and nothing is ever reduced in the order in which threads finish, so the
// results are those of one thread.
//
// Each member has parts of its own, the same in loops of the same length, so that what it works on stays in its cache.
// Whoever is done takes over parts that others have not begun: a member that is not awake, or whose processor does
// something else, holds nobody up but for the part that it is in the middle of. Where that costs more than the team
// brings, the caller works alone for a while.
//
// A step has some hundred such loops of a few microseconds each, so between loops the members spin for a moment before
// they sleep. Not for several callers at a time.
class Team {
 public:
  explicit Team(unsigned members);  // 1: everything runs on the caller
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  unsigned members() const { return static_cast<unsigned>(threads_.size()) + 1; }
  // No loop has more parts.
  unsigned parts_max() const { return members() == 1 ? 1 : members() * kPartsPerMember; }

  // Calls work(part, begin, end) for each part of [0, count), numbered in their order, and returns when all are done. A
  // loop of less than two grains is not worth sharing.
  template <class Work>
  void share(std::size_t count, std::size_t grain, const Work& work) {
    if (members() == 1 || count < 2 * grain || works_alone()) {
      work(0u, std::size_t{0}, count);
      return;
    }
    const auto parts = static_cast<unsigned>(count / grain < parts_max() ? count / grain : parts_max());
    const auto do_part = [&](unsigned part) { work(part, count * part / parts, count * (part + 1) / parts); };
    run([](const void* job, unsigned part) { (*static_cast<const decltype(do_part)*>(job))(part); }, &do_part, parts);
  }

 private:
  static constexpr unsigned kPartsPerMember = 4;

  using Job = void (*)(const void* job, unsigned part);

  // The parts that a member begins with: from `next` to before `end`, 16 bits each, and above them the number of the
  // loop, so that nobody takes a part of a loop that is over.
  struct alignas(64) Range {
    std::atomic<std::uint64_t> state{0};
  };

  void run(Job job, const void* argument, unsigned parts);
  void serve(unsigned member);
  unsigned work_off(unsigned member);  // all parts that are left, its own first; how many it did
  void wait_for(std::uint32_t others);
  bool works_alone();

  std::vector<std::thread> threads_;
  std::unique_ptr<Range[]> ranges_;  // by member
  // Written by the caller before the ranges are; read by who has taken a part.
  Job job_ = nullptr;
  const void* argument_ = nullptr;
  // Of the caller alone.
  std::uint32_t alone_ = 0;    // loops to come without the others
  std::uint32_t caution_ = 0;  // that many the next time they hold the caller up
  alignas(64) std::atomic<std::uint32_t> round_{0};
  std::atomic<std::uint32_t> asleep_{0};
  std::atomic<bool> over_{false};
  alignas(64) std::atomic<std::uint32_t> finished_{0};  // parts of this loop, by others than the caller
};

}  // namespace urto

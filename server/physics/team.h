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
// Each member has parts of its own, the same in loops of the same length, so that what it works on stays in its cache:
// a line that another has written costs as much as dozens of operations, and hundreds if the two share no cache.
// Whoever is done takes over parts that others have not begun, from the other end than they do: so two members go
// towards each other, and where they meet moves little from loop to loop, however fast each is. A member whose
// processor does something else holds nobody up but for the part that it is in the middle of. Where that costs more
// than the team brings, the caller works alone for a while.
//
// A step has some hundred such loops of a few microseconds each, so between loops the members spin before they sleep.
// Not for several callers at a time.
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
    const std::size_t most = grain < kPartsPerGrain ? count : count * kPartsPerGrain / grain;
    const auto parts = static_cast<unsigned>(most < parts_max() ? most : parts_max());
    const auto do_part = [&](unsigned part) { work(part, count * part / parts, count * (part + 1) / parts); };
    run([](const void* job, unsigned part) { (*static_cast<const decltype(do_part)*>(job))(part); }, &do_part, parts);
  }

  // There will be no loop for some time.
  void rest() { resting_.store(true, std::memory_order_relaxed); }

 private:
  static constexpr unsigned kPartsPerMember = 8;
  // What is worth sharing is worth parts so small that the members are done at about the same time.
  static constexpr unsigned kPartsPerGrain = 4;

  using Job = void (*)(const void* job, unsigned part);

  // The parts of a member that nobody has begun: from `begin` to before `end`, 16 bits each, and above them the number
  // of the loop, so that nobody takes a part of a loop that is over. Whoever comes first sets it up.
  struct alignas(64) Range {
    std::atomic<std::uint64_t> state{0};
  };

  void run(Job job, const void* argument, unsigned parts);
  void serve(unsigned member);
  std::uint64_t wait_for_call(std::uint64_t seen);  // a call after that one
  // Does parts of a member of the call until none is left. How many they were.
  unsigned work_off(unsigned member, std::uint64_t call, bool own);
  unsigned take_over(unsigned member, std::uint64_t call);
  void finish(unsigned parts);
  std::uint64_t untouched(unsigned member, std::uint64_t call) const;
  std::uint64_t left_of(unsigned member, std::uint64_t call);
  void let_begin(unsigned member, std::uint64_t call);  // waits a moment for its first part to be taken
  void wait_for(std::uint32_t finished);
  bool works_alone();
  void work_alone_for_a_while();
  void note_absence(bool absent);

  std::vector<std::thread> threads_;
  std::unique_ptr<Range[]> ranges_;  // by member
  // Of the caller alone.
  std::uint32_t alone_ = 0;     // loops to come without the others
  std::uint32_t caution_ = 0;   // that many the next time they hold the caller up
  std::uint32_t expected_ = 0;  // of finished_, when this loop is over
  std::uint32_t absences_ = 0;  // loops in a row that it did without them though they were awake
  std::uint32_t awakened_ = 0;  // of sleeps_, when the sleepers were last called
  // What a loop is, side by side because the members wait for it: its number and above 32 bits, how many parts it has.
  // Job and argument are written before, and read by who has taken a part.
  alignas(64) std::atomic<std::uint64_t> call_{0};
  Job job_ = nullptr;
  const void* argument_ = nullptr;
  std::atomic<std::uint32_t> round_{0};  // the number alone, to sleep on
  std::atomic<bool> resting_{false}, over_{false};
  alignas(64) std::atomic<std::uint32_t> asleep_{0};    // members that sleep, or are waking up
  std::atomic<std::uint32_t> sleeps_{0};                // how often one has fallen asleep
  alignas(64) std::atomic<std::uint32_t> finished_{0};  // parts ever, by others than the caller
};

}  // namespace urto

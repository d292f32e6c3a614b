#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace urto {

// A few threads that share out loops whose parts do not touch each other: the caller is one of them. Shares are
// contiguous and depend on the counts alone, and nothing is ever reduced in the order in which threads finish, so the
// results are those of one thread.
//
// A step has some hundred such loops of a few microseconds each, so between loops the members spin for a moment before
// they sleep. Not for several callers at a time.
class Team {
 public:
  explicit Team(unsigned members);  // 1: everything runs on the caller
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  unsigned size() const { return static_cast<unsigned>(threads_.size()) + 1; }

  // Calls work(member, begin, end) for each member's share of [0, count), and returns when all have. A loop of less
  // than two grains is not worth sharing.
  template <class Work>
  void share(std::size_t count, std::size_t grain, const Work& work) {
    const std::size_t members = count < 2 * grain ? 1 : size();
    if (members == 1) {
      work(0u, std::size_t{0}, count);
      return;
    }
    const auto part = [&](unsigned member) { work(member, count * member / members, count * (member + 1) / members); };
    run([](const void* job, unsigned member) { (*static_cast<const decltype(part)*>(job))(member); }, &part);
  }

 private:
  using Job = void (*)(const void* job, unsigned member);

  void run(Job job, const void* argument);
  void serve(unsigned member);

  std::vector<std::thread> threads_;
  // Written by the caller before round_ moves, read by the members after.
  Job job_ = nullptr;
  const void* argument_ = nullptr;
  bool over_ = false;
  alignas(64) std::atomic<std::uint32_t> round_{0};
  alignas(64) std::atomic<std::uint32_t> working_{0};
};

}  // namespace urto

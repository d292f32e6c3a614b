#include "physics/team.h"

namespace urto {
namespace {

// About as long as the gaps between the loops of a step: after that a member sleeps until it is called.
constexpr int kSpins = 2000;
// The caller's wait for the others: where there are more threads than processors, spinning would keep them away.
constexpr int kSpinsBeforeYield = 200;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

}  // namespace

Team::Team(unsigned members) {
  for (unsigned member = 1; member < members; ++member) threads_.emplace_back([this, member] { serve(member); });
}

Team::~Team() {
  over_ = true;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Team::run(Job job, const void* argument) {
  job_ = job;
  argument_ = argument;
  working_.store(static_cast<std::uint32_t>(threads_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  job(argument, 0);
  for (int spins = 0; working_.load(std::memory_order_acquire) != 0; ++spins) {
    if (spins < kSpinsBeforeYield) {
      pause();
    } else {
      std::this_thread::yield();
    }
  }
}

void Team::serve(unsigned member) {
  std::uint32_t seen = 0;
  for (;;) {
    for (int spins = 0; spins < kSpins && round_.load(std::memory_order_acquire) == seen; ++spins) pause();
    round_.wait(seen, std::memory_order_acquire);
    ++seen;
    if (over_) return;
    job_(argument_, member);
    working_.fetch_sub(1, std::memory_order_release);
  }
}

}  // namespace urto

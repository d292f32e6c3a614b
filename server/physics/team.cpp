#include "physics/team.h"

#include <algorithm>

namespace urto {
namespace {

// About as long as the gaps between the loops of a step: after that a member sleeps until it is called.
constexpr int kSpins = 2000;
// The caller's wait for parts that others are in the middle of: some tenths of a millisecond, longer than a part of the
// longest loops takes. What lasts longer is a member without a processor, and one that the caller does not occupy may
// be its next.
constexpr int kSpinsOfCaller = 20000;
// Loops that the caller does alone after a wait that long; twice as many each time, less one for each loop without.
// The most are about a tenth of a second: then a machine with other work loses some per cent to what is tried in vain.
constexpr std::uint32_t kCautionMin = 32, kCautionMax = 16384;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

constexpr std::uint64_t kNext = 1, kPartMask = 0xffff;
constexpr unsigned kEndShift = 16, kRoundShift = 32;

}  // namespace

Team::Team(unsigned members) : ranges_(new Range[members]) {
  for (unsigned member = 1; member < members; ++member) threads_.emplace_back([this, member] { serve(member); });
}

Team::~Team() {
  over_.store(true);
  round_.fetch_add(1);
  round_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

bool Team::works_alone() {
  if (alone_ == 0) return false;
  --alone_;
  return true;
}

void Team::run(Job job, const void* argument, unsigned parts) {
  job_ = job;
  argument_ = argument;
  finished_.store(0, std::memory_order_relaxed);
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1;
  for (unsigned member = 0; member < members(); ++member) {
    const std::uint64_t begin = parts * member / members(), end = parts * (member + 1) / members();
    ranges_[member].state.store(std::uint64_t{round} << kRoundShift | end << kEndShift | begin,
                                std::memory_order_release);
  }
  round_.store(round);
  if (asleep_.load() != 0 && asleep_.exchange(0) != 0) round_.notify_all();
  wait_for(parts - work_off(0));
}

unsigned Team::work_off(unsigned member) {
  unsigned done = 0;
  for (unsigned i = 0; i < members(); ++i) {
    std::atomic<std::uint64_t>& state = ranges_[(member + i) % members()].state;
    std::uint64_t seen = state.load(std::memory_order_acquire);
    for (;;) {
      const auto part = static_cast<unsigned>(seen & kPartMask);
      if (part >= (seen >> kEndShift & kPartMask)) break;
      if (!state.compare_exchange_weak(seen, seen + kNext, std::memory_order_acq_rel, std::memory_order_acquire))
        continue;
      job_(argument_, part);
      ++done;
      seen = state.load(std::memory_order_acquire);
    }
  }
  return done;
}

void Team::wait_for(std::uint32_t others) {
  for (int spins = 0; spins < kSpinsOfCaller; ++spins) {
    if (finished_.load(std::memory_order_acquire) == others) {
      if (caution_ > 0) --caution_;
      return;
    }
    pause();
  }
  caution_ = std::clamp(2 * caution_, kCautionMin, kCautionMax);
  alone_ = caution_;
  for (;;) {
    const std::uint32_t finished = finished_.load(std::memory_order_acquire);
    if (finished == others) return;
    finished_.wait(finished, std::memory_order_acquire);
  }
}

void Team::serve(unsigned member) {
  std::uint32_t seen = 0;
  for (;;) {
    for (int spins = 0; spins < kSpins && round_.load(std::memory_order_acquire) == seen; ++spins) pause();
    while (round_.load() == seen) {
      asleep_.fetch_add(1);
      round_.wait(seen);
    }
    seen = round_.load(std::memory_order_acquire);
    if (over_.load()) return;
    if (const unsigned done = work_off(member); done > 0) {
      finished_.fetch_add(done, std::memory_order_release);
      finished_.notify_one();
    }
  }
}

}  // namespace urto

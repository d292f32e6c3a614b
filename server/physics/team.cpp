#include "physics/team.h"

#include <algorithm>

namespace urto {
namespace {

// How long a member spins for the next loop before it sleeps until it is called: in a step, longer than what one thread
// does between loops takes, half a millisecond; after it, about as long as a caller that steps on at once needs.
constexpr int kSpinsInStep = 20000, kSpinsAtRest = 2000;
// How long whoever is done waits for a member that has not begun, before it takes over its parts: a quarter of a
// microsecond, which a call may take to reach it.
constexpr int kPatience = 10;
// The caller's wait for parts that others are in the middle of: some tenths of a millisecond, longer than a part of the
// longest loops takes. What lasts longer is a member without a processor, and one that the caller does not occupy may
// be its next.
constexpr int kSpinsOfCaller = 20000;
// So many loops in a row without a part done by others show that they have no processor.
constexpr std::uint32_t kAbsencesMax = 16;
// Loops that the caller does alone after such a wait; twice as many each time, less one for each loop without.
// The most are about a tenth of a second: then a machine with other work loses some per cent to what is tried in vain.
constexpr std::uint32_t kCautionMin = 32, kCautionMax = 16384;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// Of a call: parts and the number of the loop. Of a range: begin, end and the number of the loop.
constexpr std::uint64_t kPartMask = 0xffff, kBegin = 1, kEnd = 1 << 16;
constexpr unsigned kEndShift = 16, kRoundShift = 32;

std::uint32_t round_of(std::uint64_t word) { return static_cast<std::uint32_t>(word >> kRoundShift); }
unsigned begin_of(std::uint64_t range) { return static_cast<unsigned>(range & kPartMask); }
unsigned end_of(std::uint64_t range) { return static_cast<unsigned>(range >> kEndShift & kPartMask); }

}  // namespace

Team::Team(unsigned members) : ranges_(new Range[members]) {
  for (unsigned member = 1; member < members; ++member) threads_.emplace_back([this, member] { serve(member); });
}

Team::~Team() {
  over_.store(true);
  call_.fetch_add(std::uint64_t{1} << kRoundShift);
  round_.fetch_add(1);
  round_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

// The caller ------------------------------------------------------------------------------------------------------

bool Team::works_alone() {
  if (alone_ == 0) return false;
  --alone_;
  return true;
}

void Team::work_alone_for_a_while() {
  caution_ = std::clamp(2 * caution_, kCautionMin, kCautionMax);
  alone_ = caution_;
}

// Who sleeps has been called only now.
void Team::note_absence(bool absent) {
  absences_ = absent && asleep_.load(std::memory_order_relaxed) == 0 ? absences_ + 1 : 0;
  if (absences_ < kAbsencesMax) return;
  absences_ = 0;
  work_alone_for_a_while();
}

void Team::run(Job job, const void* argument, unsigned parts) {
  job_ = job;
  argument_ = argument;
  resting_.store(false, std::memory_order_relaxed);
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1;
  const std::uint64_t call = std::uint64_t{round} << kRoundShift | parts;
  call_.store(call, std::memory_order_release);
  round_.store(round);
  if (const std::uint32_t sleeps = sleeps_.load(); sleeps != awakened_) {
    awakened_ = sleeps;
    round_.notify_all();
  }
  const unsigned done = work_off(0, call, true) + take_over(0, call);
  note_absence(done == parts);
  expected_ += parts - done;
  wait_for(expected_);
}

void Team::wait_for(std::uint32_t finished) {
  for (int spins = 0; spins < kSpinsOfCaller; ++spins) {
    if (finished_.load(std::memory_order_acquire) == finished) {
      if (caution_ > 0) --caution_;
      return;
    }
    pause();
  }
  work_alone_for_a_while();
  for (;;) {
    const std::uint32_t seen = finished_.load(std::memory_order_acquire);
    if (seen == finished) return;
    finished_.wait(seen, std::memory_order_acquire);
  }
}

// Parts -----------------------------------------------------------------------------------------------------------

std::uint64_t Team::untouched(unsigned member, std::uint64_t call) const {
  const std::uint64_t parts = call & kPartMask;
  const std::uint64_t begin = parts * member / members(), end = parts * (member + 1) / members();
  return std::uint64_t{round_of(call)} << kRoundShift | end << kEndShift | begin;
}

// What is left of a member's parts of the call; nothing if that is over.
std::uint64_t Team::left_of(unsigned member, std::uint64_t call) {
  std::atomic<std::uint64_t>& state = ranges_[member].state;
  std::uint64_t seen = state.load(std::memory_order_acquire);
  // Numbers of loops are compared by their distance, since they begin again at 0 some day.
  while (static_cast<std::int32_t>(round_of(seen) - round_of(call)) < 0) {
    const std::uint64_t fresh = untouched(member, call);
    if (state.compare_exchange_weak(seen, fresh, std::memory_order_acq_rel, std::memory_order_acquire)) return fresh;
  }
  return round_of(seen) == round_of(call) ? seen : 0;
}

// Members of even number go forwards, the others backwards, and who takes over the other way round.
unsigned Team::work_off(unsigned member, std::uint64_t call, bool own) {
  const bool forwards = (member % 2 == 0) == own;
  unsigned done = 0;
  for (std::uint64_t left = left_of(member, call); begin_of(left) < end_of(left);) {
    const unsigned part = forwards ? begin_of(left) : end_of(left) - 1;
    if (!ranges_[member].state.compare_exchange_strong(left, forwards ? left + kBegin : left - kEnd,
                                                       std::memory_order_acq_rel, std::memory_order_acquire)) {
      left = left_of(member, call);
      continue;
    }
    job_(argument_, part);
    ++done;
    left = left_of(member, call);
  }
  return done;
}

void Team::let_begin(unsigned member, std::uint64_t call) {
  for (int spins = 0; spins < kPatience && left_of(member, call) == untouched(member, call); ++spins) pause();
}

unsigned Team::take_over(unsigned member, std::uint64_t call) {
  unsigned done = 0;
  for (unsigned i = 1; i < members(); ++i) {
    const unsigned other = (member + i) % members();
    let_begin(other, call);
    done += work_off(other, call, false);
  }
  return done;
}

// The others ------------------------------------------------------------------------------------------------------

std::uint64_t Team::wait_for_call(std::uint64_t seen) {
  for (int spins = 0; call_.load(std::memory_order_acquire) == seen; ++spins) {
    if (spins > kSpinsAtRest && (spins > kSpinsInStep || resting_.load(std::memory_order_relaxed))) break;
    pause();
  }
  if (call_.load(std::memory_order_acquire) == seen) {
    asleep_.fetch_add(1);
    sleeps_.fetch_add(1);
    while (round_.load() == round_of(seen)) round_.wait(round_of(seen));
    asleep_.fetch_sub(1);
  }
  return call_.load(std::memory_order_acquire);
}

void Team::serve(unsigned member) {
  for (std::uint64_t call = 0;;) {
    call = wait_for_call(call);
    if (over_.load()) return;
    // Its own at once: the caller may wait for them alone.
    finish(work_off(member, call, true));
    finish(take_over(member, call));
  }
}

void Team::finish(unsigned parts) {
  if (parts == 0) return;
  finished_.fetch_add(parts, std::memory_order_release);
  finished_.notify_one();
}

}  // namespace urto

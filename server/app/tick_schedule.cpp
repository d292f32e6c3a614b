#include "app/tick_schedule.h"

#include <algorithm>
#include <cmath>

namespace urto::app {
namespace {

constexpr double kSecond = 1e9;  // ns
// A tick is due when all but this part of its period has passed: the sum of many differences, each rounded to
// nanoseconds, may otherwise miss it by one.
constexpr double kPeriodRounding = 1e-6;

}  // namespace

TickSchedule::Due TickSchedule::advance(std::uint64_t now_ns, double period) {
  if (!started_) restart(now_ns);
  if (now_ns > last_ns_) {
    accumulated_ += static_cast<double>(now_ns - last_ns_) / kSecond;
    last_ns_ = now_ns;
  }
  const double due = std::floor(accumulated_ / period + kPeriodRounding);
  accumulated_ = std::max(0.0, accumulated_ - due * period);
  Due result;
  result.ticks = static_cast<std::uint32_t>(std::min<double>(due, kCatchUpTicksMax));
  result.overruns = static_cast<std::uint64_t>(due) - result.ticks;
  return result;
}

void TickSchedule::restart(std::uint64_t now_ns) {
  last_ns_ = now_ns;
  started_ = true;
  accumulated_ = 0;
}

std::uint64_t TickSchedule::next_ns(double period) const {
  return last_ns_ + static_cast<std::uint64_t>(std::llround(std::max(0.0, period - accumulated_) * kSecond));
}

}  // namespace urto::app

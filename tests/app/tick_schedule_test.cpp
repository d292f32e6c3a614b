#include "app/tick_schedule.h"

#include <gtest/gtest.h>

namespace urto::app {
namespace {

constexpr double kPeriod = 0.01;
constexpr std::uint64_t kMs = 1'000'000;

TEST(TickSchedule, OneTickAPeriod) {
  TickSchedule schedule;
  EXPECT_EQ(schedule.advance(5 * kMs, kPeriod).ticks, 0u);  // the first call starts the clock
  EXPECT_EQ(schedule.next_ns(kPeriod), 15 * kMs);
  EXPECT_EQ(schedule.advance(14 * kMs, kPeriod).ticks, 0u);
  EXPECT_EQ(schedule.next_ns(kPeriod), 15 * kMs);
  EXPECT_EQ(schedule.advance(15 * kMs, kPeriod).ticks, 1u);
  EXPECT_EQ(schedule.next_ns(kPeriod), 25 * kMs);
}

TEST(TickSchedule, LateCallsDoNotShiftTheRhythm) {
  TickSchedule schedule;
  schedule.advance(0, kPeriod);
  EXPECT_EQ(schedule.advance(13 * kMs, kPeriod).ticks, 1u);
  EXPECT_EQ(schedule.next_ns(kPeriod), 20 * kMs);
  EXPECT_EQ(schedule.advance(41 * kMs, kPeriod).ticks, 3u);
  EXPECT_EQ(schedule.next_ns(kPeriod), 50 * kMs);
}

TEST(TickSchedule, CatchUpIsBoundedAndTheRestIsCounted) {
  TickSchedule schedule;
  schedule.advance(0, kPeriod);
  const TickSchedule::Due due = schedule.advance(1234 * kMs, kPeriod);
  EXPECT_EQ(due.ticks, kCatchUpTicksMax);
  EXPECT_EQ(due.overruns, 123 - kCatchUpTicksMax);
  EXPECT_EQ(schedule.advance(1234 * kMs, kPeriod).ticks, 0u);
  EXPECT_EQ(schedule.next_ns(kPeriod), 1240 * kMs);
}

TEST(TickSchedule, NoTickIsLostOrMadeOverADay) {
  TickSchedule schedule;
  constexpr double kOdd = 1.0 / 60.0;  // no whole number of nanoseconds
  std::uint64_t now = 0, ticks = 0;
  schedule.advance(now, kOdd);
  while (ticks < 60u * 3600u * 24u) {
    now = schedule.next_ns(kOdd);
    const TickSchedule::Due due = schedule.advance(now, kOdd);
    ASSERT_EQ(due.ticks, 1u) << ticks;
    ticks += due.ticks;
  }
  EXPECT_NEAR(static_cast<double>(now) * 1e-9, 24 * 3600, 1e-3);
}

TEST(TickSchedule, PauseIsNotMadeUpFor) {
  TickSchedule schedule;
  schedule.advance(0, kPeriod);
  schedule.restart(5000 * kMs);
  EXPECT_EQ(schedule.advance(5009 * kMs, kPeriod).ticks, 0u);
  EXPECT_EQ(schedule.advance(5010 * kMs, kPeriod).ticks, 1u);
}

TEST(TickSchedule, PeriodMayChange) {
  TickSchedule schedule;
  schedule.advance(0, kPeriod);
  EXPECT_EQ(schedule.advance(10 * kMs, 2 * kPeriod).ticks, 0u);
  EXPECT_EQ(schedule.next_ns(2 * kPeriod), 20 * kMs);
  EXPECT_EQ(schedule.advance(20 * kMs, kPeriod / 2).ticks, 4u);
}

TEST(TickSchedule, ClockThatGoesBackDoesNoHarm) {
  TickSchedule schedule;
  schedule.advance(100 * kMs, kPeriod);
  EXPECT_EQ(schedule.advance(50 * kMs, kPeriod).ticks, 0u);
  EXPECT_EQ(schedule.advance(110 * kMs, kPeriod).ticks, 1u);
}

}  // namespace
}  // namespace urto::app

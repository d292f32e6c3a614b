#include "room/event_log.h"

#include <gtest/gtest.h>

namespace urto {
namespace {

TEST(EventLog, GivesWhatIsAskedForUpToTheCount) {
  EventLog log(100);
  for (int i = 1; i <= 10; ++i) log.append(1, i, RoomPaused{std::to_string(i)});
  EXPECT_EQ(log.last_sequence(), 10u);
  const EventSlice slice = log.since(4, 3);
  EXPECT_EQ(slice.first_sequence, 4u);
  ASSERT_EQ(slice.events.size(), 3u);
  EXPECT_EQ(slice.events[0].tick, 4u);
  EXPECT_EQ(std::get<RoomPaused>(slice.events[2].event).user, "6");
}

TEST(EventLog, FullLogForgetsTheOldestAndSaysSo) {
  EventLog log(4);
  for (int i = 1; i <= 10; ++i) log.append(1, i, RoomPaused{});
  const EventSlice slice = log.since(2, 100);
  EXPECT_EQ(slice.oldest_sequence, 7u);
  EXPECT_EQ(slice.first_sequence, 7u);
  EXPECT_EQ(slice.events.size(), 4u);
}

TEST(EventLog, FutureAndEmptyLogsGiveNothing) {
  EventLog log(4);
  EXPECT_EQ(log.last_sequence(), 0u);
  EXPECT_TRUE(log.since(0, 10).events.empty());
  log.append(1, 1, RoomPaused{});
  const EventSlice slice = log.since(50, 10);
  EXPECT_TRUE(slice.events.empty());
  EXPECT_EQ(slice.first_sequence, 2u);
}

TEST(EventLog, EpochIsThatOfTheFirstEvent) {
  EventLog log(10);
  log.append(1, 5, RoomPaused{});
  log.append(2, 0, RoomReset{"ann", 2});
  EXPECT_EQ(log.since(1, 10).epoch, 1u);
  EXPECT_EQ(log.since(2, 10).epoch, 2u);
}

}  // namespace
}  // namespace urto

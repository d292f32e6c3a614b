#include "room/command_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace urto {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Submission from(const std::string& user, std::uint64_t sequence, std::size_t bytes = 1) {
  return {user, kNoAnswer, {sequence, {Pause{}}}, bytes};
}

std::vector<std::string> labels(const std::vector<Submission>& batches) {
  std::vector<std::string> found;
  for (const Submission& batch : batches) found.push_back(batch.user + std::to_string(batch.batch.sequence));
  return found;
}

TEST(CommandQueue, TakesOneBatchOfEachUserInTurn) {
  CommandQueue queue({});
  for (int i = 1; i <= 3; ++i) queue.push(from("ann", i));
  queue.push(from("bob", 1));
  queue.push(from("cat", 1));
  queue.push(from("cat", 2));
  EXPECT_THAT(labels(queue.drain(0)), ElementsAre("ann1", "bob1", "cat1", "ann2", "cat2", "ann3"));
  EXPECT_TRUE(queue.empty());
}

TEST(CommandQueue, StartsWithAnotherUserEachTurn) {
  std::vector<std::string> first;
  for (std::uint64_t turn = 0; turn < 4; ++turn) {
    CommandQueue queue({});
    for (const char* user : {"ann", "bob", "cat"}) queue.push(from(user, 1));
    first.push_back(queue.drain(turn).front().user);
  }
  EXPECT_THAT(first, ElementsAre("ann", "bob", "cat", "ann"));
}

TEST(CommandQueue, OneWhoFloodsDelaysNobody) {
  Limits limits;
  limits.batches_per_tick_max = 4;
  CommandQueue queue(limits);
  for (int i = 0; i < 200; ++i) queue.push(from("ann", i));
  queue.push(from("bob", 1));
  const auto drained = labels(queue.drain(0));
  EXPECT_THAT(drained, ElementsAre("ann0", "bob1", "ann1", "ann2", "ann3"));
  EXPECT_THAT(queue.drain(0), SizeIs(4));  // the rest waits for its ticks
}

TEST(CommandQueue, RefusesBeyondEachBound) {
  Limits limits;
  limits.queue_batches_max = 2;
  limits.queue_bytes_max = 100;
  limits.queues_bytes_max = 150;
  limits.members_max = 3;
  CommandQueue queue(limits);
  EXPECT_FALSE(queue.push(from("ann", 1, 60)));
  EXPECT_EQ(queue.push(from("ann", 2, 60))->code, RejectionCode::kQueueFull);  // bytes of the user
  EXPECT_FALSE(queue.push(from("ann", 2, 10)));
  EXPECT_EQ(queue.push(from("ann", 3, 10))->code, RejectionCode::kQueueFull);  // batches of the user
  EXPECT_EQ(queue.push(from("bob", 1, 90))->code, RejectionCode::kQueueFull);  // bytes of all
  EXPECT_FALSE(queue.push(from("bob", 1, 10)));
  EXPECT_FALSE(queue.push(from("cat", 1, 10)));
  EXPECT_EQ(queue.push(from("dan", 1, 10))->code, RejectionCode::kQueueFull);  // users
  EXPECT_THAT(labels(queue.drain(0)), ElementsAre("ann1", "bob1", "cat1", "ann2"));
}

TEST(CommandQueue, ForgetsUsersOfWhomNothingWaits) {
  Limits limits;
  limits.members_max = 1;
  CommandQueue queue(limits);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(queue.push(from("user" + std::to_string(i), 1)));
    ASSERT_THAT(queue.drain(i), SizeIs(1));
  }
}

TEST(CommandQueue, KeepsTheOrderOfEachUserUnderConcurrency) {
  CommandQueue queue({});
  constexpr int kCount = 200;
  std::vector<std::thread> senders;
  for (const char* user : {"ann", "bob", "cat"}) {
    senders.emplace_back([&queue, user] {
      for (int i = 0; i < kCount; ++i) queue.push(from(user, i));
    });
  }
  std::map<std::string, std::uint64_t> next;
  int taken = 0;
  std::uint64_t turn = 0;
  while (taken < 3 * kCount) {
    for (const Submission& batch : queue.drain(turn++)) {
      EXPECT_EQ(batch.batch.sequence, next[batch.user]++);
      ++taken;
    }
  }
  for (std::thread& sender : senders) sender.join();
}

}  // namespace
}  // namespace urto

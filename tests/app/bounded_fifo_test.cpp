#include "app/bounded_fifo.h"

#include <gtest/gtest.h>

#include <thread>

namespace urto::app {
namespace {

TEST(BoundedFifo, GivesInOrderAndRefusesBeyondItsSize) {
  BoundedFifo<int> fifo(2);
  EXPECT_TRUE(fifo.push(1));
  EXPECT_TRUE(fifo.push(2));
  EXPECT_FALSE(fifo.push(3));
  EXPECT_EQ(fifo.pop(), 1);
  EXPECT_TRUE(fifo.push(4));
  EXPECT_EQ(fifo.pop(), 2);
  EXPECT_EQ(fifo.try_pop(), 4);
  EXPECT_EQ(fifo.try_pop(), std::nullopt);
}

TEST(BoundedFifo, ClosedGivesWhatIsLeftThenNothing) {
  BoundedFifo<int> fifo(5);
  fifo.push(1);
  fifo.close();
  EXPECT_FALSE(fifo.push(2));
  EXPECT_EQ(fifo.pop(), 1);
  EXPECT_EQ(fifo.pop(), std::nullopt);
}

TEST(BoundedFifo, PopWaitsForAPush) {
  BoundedFifo<int> fifo(5);
  std::thread reader([&] {
    for (int i = 0; i < 100; ++i) EXPECT_EQ(fifo.pop(), i);
    EXPECT_EQ(fifo.pop(), std::nullopt);
  });
  for (int i = 0; i < 100;) i += fifo.push(i) ? 1 : 0;
  fifo.close();
  reader.join();
}

TEST(LatestSlot, KeepsTheNewest) {
  LatestSlot<int> slot;
  EXPECT_EQ(slot.try_pop(), std::nullopt);
  slot.push(1);
  slot.push(2);
  EXPECT_EQ(slot.pop(), 2);
  EXPECT_EQ(slot.try_pop(), std::nullopt);
  slot.push(3);
  slot.close();
  slot.push(4);
  EXPECT_EQ(slot.pop(), 3);
  EXPECT_EQ(slot.pop(), std::nullopt);
}

}  // namespace
}  // namespace urto::app

#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace urto {

// Far more than anything here takes, even on a loaded machine: reaching it is a failure, not a result.
inline constexpr std::chrono::seconds kTestPatience{60};

// Collects what callbacks deliver; the test waits until enough has come.
template <class Item>
class Inbox {
 public:
  void add(Item item) {
    const std::lock_guard lock(mutex_);
    items_.push_back(std::move(item));
    changed_.notify_all();
  }

  // All that came, once that is at least `count` items.
  std::vector<Item> wait(std::size_t count) {
    std::unique_lock lock(mutex_);
    const bool came = changed_.wait_for(lock, kTestPatience, [&] { return items_.size() >= count; });
    EXPECT_TRUE(came) << "waited for " << count << " items, got " << items_.size();
    return items_;
  }

  // As wait(), for items that cannot be copied; takes them out.
  std::vector<Item> take(std::size_t count) {
    std::unique_lock lock(mutex_);
    const bool came = changed_.wait_for(lock, kTestPatience, [&] { return items_.size() >= count; });
    EXPECT_TRUE(came) << "waited for " << count << " items, got " << items_.size();
    return std::exchange(items_, {});
  }

  std::vector<Item> now() {
    const std::lock_guard lock(mutex_);
    return items_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Item> items_;
};

}  // namespace urto

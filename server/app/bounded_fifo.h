#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace urto::app {

// First in, first out, between threads. Who pushes never waits.
template <class T>
class BoundedFifo {
 public:
  explicit BoundedFifo(std::size_t size_max) : size_max_(size_max) {}

  // False if it is full or closed: the item is not kept.
  bool push(T item) {
    {
      const std::lock_guard lock(mutex_);
      if (closed_ || items_.size() >= size_max_) return false;
      items_.push_back(std::move(item));
    }
    changed_.notify_one();
    return true;
  }

  // Waits for an item; none once it is closed and empty.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    return take();
  }

  std::optional<T> try_pop() {
    const std::lock_guard lock(mutex_);
    return take();
  }

  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::optional<T> take() {
    if (items_.empty()) return std::nullopt;
    T item = std::move(items_.front());
    items_.pop_front();
    return item;
  }

  const std::size_t size_max_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> items_;
  bool closed_ = false;
};

// Of what is pushed, only the newest is kept.
template <class T>
class LatestSlot {
 public:
  void push(T item) {
    {
      const std::lock_guard lock(mutex_);
      if (closed_) return;
      item_ = std::move(item);
    }
    changed_.notify_one();
  }

  // Waits for an item; none once it is closed and empty.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || item_.has_value(); });
    return std::exchange(item_, std::nullopt);
  }

  std::optional<T> try_pop() {
    const std::lock_guard lock(mutex_);
    return std::exchange(item_, std::nullopt);
  }

  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<T> item_;
  bool closed_ = false;
};

}  // namespace urto::app

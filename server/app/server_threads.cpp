#include "app/server_threads.h"

#include <chrono>

namespace urto::app {

using SteadyTime = std::chrono::time_point<std::chrono::steady_clock, std::chrono::nanoseconds>;

std::uint64_t monotonic_ns() {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
          .count());
}

void Waker::wake() {
  {
    const std::lock_guard lock(mutex_);
    woken_ = true;
  }
  changed_.notify_one();
}

void Waker::wait_until(std::optional<std::uint64_t> time_ns) {
  std::unique_lock lock(mutex_);
  const auto woken = [this] { return woken_; };
  if (time_ns) {
    changed_.wait_until(lock, SteadyTime(std::chrono::nanoseconds(*time_ns)), woken);
  } else {
    changed_.wait(lock, woken);
  }
  woken_ = false;
}

ServerThreads::ServerThreads(Server& server, Waker& waker)
    : server_(server),
      waker_(waker),
      ticks_([this] { tick_until_stopped(); }),
      frames_([this] { send_frames_until_stopped(); }),
      events_([this] {
        while (server_.send_events()) {
        }
      }),
      replies_([this] {
        while (server_.send_reply()) {
        }
      }) {}

ServerThreads::~ServerThreads() { stop(); }

void ServerThreads::tick_until_stopped() {
  while (true) {
    const auto next = server_.run_once(monotonic_ns());
    waker_.wait_until(next);
    const std::lock_guard lock(mutex_);
    if (stopping_) break;
  }
  server_.close_room();
}

void ServerThreads::send_frames_until_stopped() {
  const auto pause = std::chrono::duration<double>(1 / (kSnapshotBurst * server_.room().settings().snapshot_rate_hz));
  while (server_.send_frame()) {
    std::unique_lock lock(mutex_);
    stopped_.wait_for(lock, pause, [this] { return stopping_; });
  }
}

void ServerThreads::stop() {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return;
    stopping_ = true;
  }
  stopped_.notify_all();
  server_.stop_listening();
  waker_.wake();
  for (std::thread* thread : {&ticks_, &frames_, &events_, &replies_}) thread->join();
}

}  // namespace urto::app

#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include "app/server.h"

namespace urto::app {

// Monotonic nanoseconds.
std::uint64_t monotonic_ns();

// Wakes a thread that waits for a time.
class Waker {
 public:
  void wake();
  // Returns at that time, or earlier if woken since the last call; without a time, when woken.
  void wait_until(std::optional<std::uint64_t> time_ns);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool woken_ = false;
};

// Snapshots are sent at no more than this many times the rate that was asked for. A room that steps as fast as it can,
// or at a high time scale, makes far more of them than anybody can look at; the newest wins. Twice, because at once the
// rate the rhythm of the sender would beat with that of the ticks.
inline constexpr double kSnapshotBurst = 2;

// The threads of a server: one ticks, one sends snapshots, one events, one answers.
class ServerThreads {
 public:
  ServerThreads(Server& server, Waker& waker);
  ~ServerThreads();  // stops

  // Ends the ticks, answers what waits, sends what is left. The server listens no more.
  void stop();

 private:
  void tick_until_stopped();
  void send_frames_until_stopped();

  Server& server_;
  Waker& waker_;
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stopping_ = false;
  std::thread ticks_, frames_, events_, replies_;
};

}  // namespace urto::app

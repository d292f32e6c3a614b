#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "room/command.h"
#include "room/limits.h"
#include "room/reply.h"

namespace urto {

// The batches that wait for their tick: one bounded first-in-first-out queue per user. A queue exists while something
// waits in it, so users that come and go leave nothing behind.
class CommandQueue {
 public:
  explicit CommandQueue(const Limits& limits) : limits_(limits) {}

  // Any thread. The rejection says which bound was reached; the batch is then not kept.
  std::optional<Rejection> push(Submission submission);

  // The next batches in the order in which they are to be applied: round-robin over the users that wait, one batch each
  // a round, at most batches_per_tick_max of each. The first user is number `turn` modulo their count (by name), so
  // that no name is favoured.
  std::vector<Submission> drain(std::uint64_t turn);

  bool empty() const;

 private:
  struct UserQueue {
    std::deque<Submission> batches;
    std::size_t bytes = 0;
  };

  std::optional<Rejection> check(const Submission& submission) const;

  const Limits limits_;
  mutable std::mutex mutex_;
  std::map<std::string, UserQueue> queues_;
  std::size_t bytes_ = 0;
};

}  // namespace urto

#include "room/command_queue.h"

#include <utility>

namespace urto {
namespace {

Rejection full(std::size_t value, const std::string& message) {
  return Rejection{RejectionCode::kQueueFull, 0, "", std::to_string(value), message};
}

}  // namespace

std::optional<Rejection> CommandQueue::push(Submission submission) {
  const std::lock_guard lock(mutex_);
  if (auto rejection = check(submission)) return rejection;
  UserQueue& queue = queues_[submission.user];
  queue.bytes += submission.bytes;
  bytes_ += submission.bytes;
  queue.batches.push_back(std::move(submission));
  return std::nullopt;
}

std::optional<Rejection> CommandQueue::check(const Submission& submission) const {
  const auto it = queues_.find(submission.user);
  if (it == queues_.end()) {
    if (queues_.size() >= limits_.members_max) {
      return full(queues_.size(), "Batches of too many users are waiting in this room.");
    }
  } else {
    if (it->second.batches.size() >= limits_.queue_batches_max) {
      return full(it->second.batches.size(), "Too many batches of this user are waiting.");
    }
    if (it->second.bytes + submission.bytes > limits_.queue_bytes_max) {
      return full(it->second.bytes, "Too many bytes of this user are waiting.");
    }
  }
  if (bytes_ + submission.bytes > limits_.queues_bytes_max) {
    return full(bytes_, "Too many bytes are waiting in this room.");
  }
  return std::nullopt;
}

std::vector<Submission> CommandQueue::drain(std::uint64_t turn) {
  const std::lock_guard lock(mutex_);
  std::vector<Submission> drained;
  if (queues_.empty()) return drained;

  std::vector<UserQueue*> order;
  for (auto& [user, queue] : queues_) order.push_back(&queue);
  const std::size_t first = turn % order.size();

  bool found = true;
  for (std::uint32_t round = 0; found && round < limits_.batches_per_tick_max; ++round) {
    found = false;
    for (std::size_t i = 0; i < order.size(); ++i) {
      UserQueue& queue = *order[(first + i) % order.size()];
      if (queue.batches.empty()) continue;
      found = true;
      queue.bytes -= queue.batches.front().bytes;
      bytes_ -= queue.batches.front().bytes;
      drained.push_back(std::move(queue.batches.front()));
      queue.batches.pop_front();
    }
  }
  std::erase_if(queues_, [](const auto& entry) { return entry.second.batches.empty(); });
  return drained;
}

bool CommandQueue::empty() const {
  const std::lock_guard lock(mutex_);
  return queues_.empty();
}

}  // namespace urto

#pragma once

#include <map>
#include <mutex>
#include <optional>

#include "room/command.h"
#include "transport/query.h"

namespace urto::app {

// The transport's questions that wait for an answer of the room, each under its ticket. Any thread.
class PendingQueries {
 public:
  Ticket add(Query query);
  // The question, which is then no longer here. None if there is none (any more).
  std::optional<Query> take(Ticket ticket);
  // Ends all of them without an answer.
  void clear();

 private:
  std::mutex mutex_;
  std::map<Ticket, Query> queries_;
  Ticket last_ = kNoAnswer;
};

}  // namespace urto::app

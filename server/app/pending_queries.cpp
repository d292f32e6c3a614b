#include "app/pending_queries.h"

#include <utility>

namespace urto::app {

Ticket PendingQueries::add(Query query) {
  const std::lock_guard lock(mutex_);
  queries_.emplace(++last_, std::move(query));
  return last_;
}

std::optional<Query> PendingQueries::take(Ticket ticket) {
  const std::lock_guard lock(mutex_);
  auto node = queries_.extract(ticket);
  if (node.empty()) return std::nullopt;
  return std::move(node.mapped());
}

void PendingQueries::clear() {
  std::map<Ticket, Query> ended;  // outlives the lock: ending a query calls into the transport
  const std::lock_guard lock(mutex_);
  ended.swap(queries_);
}

}  // namespace urto::app

#pragma once

#include <memory>

#include "transport/transport.h"

namespace urto {

// A network in memory, for tests and simulations. Whatever one thread sends is delivered on that thread, in the order
// in which the receivers were declared, before the call returns: the same calls give the same order. There is no clock:
// a get() ends when every queryable has answered or dropped the query, and its timeout is not looked at. Nothing is
// lost and nothing is queued. The network lives as long as one of its clients.
class LoopbackNetwork {
 public:
  LoopbackNetwork();
  ~LoopbackNetwork();

  std::unique_ptr<Transport> connect();  // a new client

  class Hub;

 private:
  std::shared_ptr<Hub> hub_;
};

}  // namespace urto

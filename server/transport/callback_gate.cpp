#include "transport/callback_gate.h"

#include <algorithm>
#include <exception>
#include <iostream>

namespace urto {

void CallbackGate::close() {
  std::unique_lock lock(mutex_);
  is_closed_ = true;
  emptied_.wait(lock, [this] { return inside_ == 0; });
}

bool CallbackGate::enter() {
  const std::lock_guard lock(mutex_);
  if (is_closed_) return false;
  ++inside_;
  return true;
}

void CallbackGate::leave() {
  // Notified under the lock: the gate may be gone as soon as a waiting close() has returned.
  const std::lock_guard lock(mutex_);
  if (--inside_ == 0) emptied_.notify_all();
}

void CallbackGate::report_exception() {
  try {
    throw;
  } catch (const std::exception& error) {
    std::cerr << "urto: a transport callback threw: " << error.what() << std::endl;
  } catch (...) {
    std::cerr << "urto: a transport callback threw something that is no std::exception" << std::endl;
  }
}

std::shared_ptr<CallbackGate> CallbackGates::add() {
  auto gate = std::make_shared<CallbackGate>();
  const std::lock_guard lock(mutex_);
  if (is_closed_) gate->close();
  gates_.erase(std::remove_if(gates_.begin(), gates_.end(), [](const auto& known) { return known.expired(); }),
               gates_.end());
  gates_.push_back(gate);
  return gate;
}

void CallbackGates::close() {
  std::vector<std::weak_ptr<CallbackGate>> gates;
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
    gates.swap(gates_);
  }
  for (const auto& known : gates) {
    if (const auto gate = known.lock()) gate->close();
  }
}

}  // namespace urto

#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace urto {

// The door in front of one callback: it lets any number of calls in, also a call from inside another; close() waits for
// those inside, and none gets in after. It also stops what a callback throws.
class CallbackGate {
 public:
  template <class Function, class... Arguments>
  void call(const Function& function, Arguments&&... arguments) {
    if (!enter()) return;
    try {
      function(std::forward<Arguments>(arguments)...);
    } catch (...) {
      report_exception();
    }
    leave();
  }

  void close();

 private:
  bool enter();
  void leave();
  static void report_exception();  // the one being handled, on stderr

  std::mutex mutex_;
  std::condition_variable emptied_;
  std::size_t inside_ = 0;
  bool is_closed_ = false;
};

// All the gates of one transport, to close them together.
class CallbackGates {
 public:
  std::shared_ptr<CallbackGate> add();  // a closed one after close()
  void close();

 private:
  std::mutex mutex_;
  std::vector<std::weak_ptr<CallbackGate>> gates_;
  bool is_closed_ = false;
};

}  // namespace urto

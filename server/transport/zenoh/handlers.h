#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>

#include "rust/cxx.h"

namespace urto::zenoh {

struct IncomingQuery;  // the Rust half, declared by the bridge

inline std::string_view view(rust::Slice<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
inline std::string_view view(rust::Str text) { return {text.data(), text.size()}; }

// What Rust calls, on Zenoh's threads. The functions are inline because the bridge's object file, inside the Rust
// library, calls them. (on_query cannot be: it needs the bridge's own header. It sits in zenoh_transport.cpp, the only
// file that calls the Rust library, so the linker has it by then.) An exception arrives in Rust as an Err, which
// reports it.

class SampleHandler {
 public:
  using Function = std::function<void(std::string_view key, std::string_view payload)>;
  explicit SampleHandler(Function function) : function_(std::move(function)) {}
  void on_sample(rust::Str key, rust::Slice<const std::uint8_t> payload) const { function_(view(key), view(payload)); }

 private:
  Function function_;
};

class LivelinessHandler {
 public:
  using Function = std::function<void(std::string_view key, bool alive)>;
  explicit LivelinessHandler(Function function) : function_(std::move(function)) {}
  void on_change(rust::Str key, bool alive) const { function_(view(key), alive); }

 private:
  Function function_;
};

class QueryHandler {
 public:
  using Function = std::function<void(rust::Box<IncomingQuery> query)>;
  explicit QueryHandler(Function function) : function_(std::move(function)) {}
  void on_query(rust::Box<IncomingQuery> query) const;

 private:
  Function function_;
};

class ReplyHandler {
 public:
  using OnReply = std::function<void(bool is_error, std::string_view key, std::string_view payload)>;
  using OnDone = std::function<void()>;
  ReplyHandler(OnReply on_reply, OnDone on_done) : on_reply_(std::move(on_reply)), on_done_(std::move(on_done)) {}
  void on_reply(bool is_error, rust::Str key, rust::Slice<const std::uint8_t> payload) const {
    on_reply_(is_error, view(key), view(payload));
  }
  void on_done() const { on_done_(); }

 private:
  OnReply on_reply_;
  OnDone on_done_;
};

}  // namespace urto::zenoh

#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "transport/query.h"
#include "transport/transport_error.h"

namespace urto {

// The three kinds of callback of a declaration. The rules for all of them:
// - They may run on any thread, several at a time, and on the thread that called put(), get() or reply(). So they only
//   enqueue: a callback that takes long delays the messages of every other client.
// - Views are valid only while the callback runs.
// - What a callback throws is caught, reported on stderr and dropped.
using SampleCallback = std::function<void(std::string_view key, std::string_view payload)>;
using QueryCallback = std::function<void(Query query)>;
using LivelinessCallback = std::function<void(std::string_view key, bool alive)>;

enum class Reliability { kReliable, kBestEffort };
// A queue of its own each; no order between the two. Answers to queries use kNormal, so what is published with kHigh
// does not wait behind a large answer that its asker does not read (docs/decisions/0001).
enum class Priority { kNormal, kHigh };

struct PublisherOptions {
  std::string encoding;  // e.g. "application/protobuf;schema=urto.v1.Snapshot"; empty: raw bytes
  Reliability reliability = Reliability::kReliable;
  Priority priority = Priority::kHigh;
};

// The right to publish on one key. Destroying it ends it.
class Publisher {
 public:
  virtual ~Publisher() = default;
  // Sends to everyone who subscribed, this client too, and never waits for a slow one: that one misses the message.
  virtual TransportStatus put(std::string_view payload) = 0;
};

// A queryable, a subscriber, a liveliness token or a liveliness subscriber. Destroying it ends it: that waits for a
// callback which is running and afterwards none runs any more. Hence never destroy one inside its own callback.
class Declaration {
 public:
  virtual ~Declaration() = default;
};
using DeclarationPtr = std::unique_ptr<Declaration>;

struct GetRequest {
  std::string key;         // may have wildcards
  std::string parameters;  // "saved_state=true;from=12", or empty
  std::string payload;
  std::string encoding;
  std::chrono::milliseconds timeout{5000};  // > 0
};

TransportStatus check_get(const GetRequest& request);  // key and timeout

// An answer to a get(); the views are valid only while the callback runs.
struct Reply {
  bool is_error = false;  // the queryable answered with an error, whose text is the payload; the key is empty
  std::string_view key;
  std::string_view payload;
};

struct GetCallbacks {
  std::function<void(const Reply&)> on_reply;
  // Once, after the last reply: every queryable has answered or dropped the query, or the time is up. Not when the
  // transport is closed before.
  std::function<void()> on_done;
};

// A client of a network of keys and bytes (docs/protocol.md names the keys; this layer knows none of them).
// All functions may be called from any thread. After close() they answer kClosed.
class Transport {
 public:
  virtual ~Transport() = default;  // closes

  virtual TransportExpected<std::unique_ptr<Publisher>> declare_publisher(std::string_view key,
                                                                          const PublisherOptions& options) = 0;
  // The same as declaring a publisher for one message.
  virtual TransportStatus put(std::string_view key, std::string_view payload, const PublisherOptions& options) = 0;

  virtual TransportExpected<DeclarationPtr> declare_queryable(std::string_view key_expression,
                                                              QueryCallback callback) = 0;
  virtual TransportExpected<DeclarationPtr> declare_subscriber(std::string_view key_expression,
                                                               SampleCallback callback) = 0;
  // While the declaration (and the process) lives, others see this key as alive.
  virtual TransportExpected<DeclarationPtr> declare_liveliness_token(std::string_view key) = 0;
  // First the keys that are alive already, then every change.
  virtual TransportExpected<DeclarationPtr> declare_liveliness_subscriber(std::string_view key_expression,
                                                                          LivelinessCallback callback) = 0;

  // Asks every queryable that matches.
  virtual TransportStatus get(const GetRequest& request, GetCallbacks callbacks) = 0;

  // Ends everything that was declared. No callback runs after it returned. Never call it inside a callback. Twice is
  // harmless; declarations and queries that live longer are harmless too.
  virtual void close() = 0;
};

}  // namespace urto

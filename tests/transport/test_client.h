#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "transport/inbox.h"
#include "transport/transport.h"

namespace urto {

struct Message {
  std::string key;
  std::string payload;
  bool operator==(const Message& other) const { return key == other.key && payload == other.payload; }
  friend std::ostream& operator<<(std::ostream& out, const Message& message) {
    return out << message.key << ": " << message.payload.substr(0, 64);
  }
};

struct Change {
  std::string key;
  bool alive = false;
  bool operator==(const Change& other) const { return key == other.key && alive == other.alive; }
  friend std::ostream& operator<<(std::ostream& out, const Change& change) {
    return out << change.key << (change.alive ? " alive" : " gone");
  }
};

struct Answer {
  bool is_error = false;
  std::string key;
  std::string payload;
};

// Everything a get() brought, once it is done.
inline std::vector<Answer> ask(Transport& transport, GetRequest request) {
  auto answers = std::make_shared<Inbox<Answer>>();
  auto done = std::make_shared<Inbox<bool>>();
  const TransportStatus status =
      transport.get(request, {[answers](const Reply& reply) {
                                answers->add({reply.is_error, std::string(reply.key), std::string(reply.payload)});
                              },
                              [done] { done->add(true); }});
  EXPECT_TRUE(status) << status.error().message;
  if (status) done->wait(1);
  return answers->now();
}

inline GetRequest request(std::string key, std::string payload = {}, std::string parameters = {}) {
  GetRequest made;
  made.key = std::move(key);
  made.payload = std::move(payload);
  made.parameters = std::move(parameters);
  made.timeout = kTestPatience;
  return made;
}

// Unwraps what must have worked.
template <class T>
T expect_ok(TransportExpected<T> result) {
  if (!result) {
    ADD_FAILURE() << name_of(result.error().code) << ": " << result.error().message;
    throw std::runtime_error(result.error().message);
  }
  return std::move(*result);
}

inline DeclarationPtr subscribe(Transport& transport, std::string_view key_expression, Inbox<Message>& inbox) {
  return expect_ok(
      transport.declare_subscriber(key_expression, [&inbox](std::string_view key, std::string_view payload) {
        inbox.add({std::string(key), std::string(payload)});
      }));
}

inline DeclarationPtr watch(Transport& transport, std::string_view key_expression, Inbox<Change>& inbox) {
  return expect_ok(transport.declare_liveliness_subscriber(key_expression, [&inbox](std::string_view key, bool alive) {
    inbox.add({std::string(key), alive});
  }));
}

inline DeclarationPtr serve(Transport& transport, std::string_view key_expression, Inbox<Query>& inbox) {
  return expect_ok(transport.declare_queryable(key_expression, [&inbox](Query query) { inbox.add(std::move(query)); }));
}

}  // namespace urto

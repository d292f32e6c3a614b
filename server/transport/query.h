#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "transport/transport_error.h"

namespace urto {

// How a transport sends the answer of one query; destroying it tells the asker that no answer will come.
class QueryResponder {
 public:
  virtual ~QueryResponder() = default;
  virtual TransportStatus reply(std::string_view payload, std::string_view encoding) = 0;
  virtual TransportStatus reply_error(std::string_view payload) = 0;
};

// A question of another client. It may be kept and answered later, on another thread (one thread at a time), even
// after its transport was closed; dropped without an answer, the asker is told so at once.
class Query {
 public:
  Query(std::string key, std::string parameters, std::string payload, std::unique_ptr<QueryResponder> responder);

  // As asked: it matches the queryable's key expression, and may have wildcards of its own.
  const std::string& key() const { return key_; }
  const std::string& parameters() const { return parameters_; }  // "saved_state=true", or empty
  const std::string& payload() const { return payload_; }
  bool is_answered() const { return responder_ == nullptr; }

  // Exactly one answer, so that the query ends with it. The answer's key is that of the queryable, or where that has
  // wildcards, of the query. An asker who does not read can make it wait: the bound is in the options of the transport.
  TransportStatus reply(std::string_view payload, std::string_view encoding = {});
  TransportStatus reply_error(std::string_view payload);

 private:
  std::string key_;
  std::string parameters_;
  std::string payload_;
  std::unique_ptr<QueryResponder> responder_;
};

}  // namespace urto

#include "transport/query.h"

#include <utility>

namespace urto {
namespace {

TransportStatus already_answered(const std::string& key) {
  return transport_failure(TransportErrorCode::kAlreadyAnswered, key, "the query on " + key + " was answered before");
}

}  // namespace

Query::Query(std::string key, std::string parameters, std::string payload, std::unique_ptr<QueryResponder> responder)
    : key_(std::move(key)),
      parameters_(std::move(parameters)),
      payload_(std::move(payload)),
      responder_(std::move(responder)) {}

TransportStatus Query::reply(std::string_view payload, std::string_view encoding) {
  const std::unique_ptr<QueryResponder> responder = std::move(responder_);
  if (responder == nullptr) return already_answered(key_);
  return responder->reply(payload, encoding);
}

TransportStatus Query::reply_error(std::string_view payload) {
  const std::unique_ptr<QueryResponder> responder = std::move(responder_);
  if (responder == nullptr) return already_answered(key_);
  return responder->reply_error(payload);
}

}  // namespace urto

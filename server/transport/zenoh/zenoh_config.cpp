#include "transport/zenoh/zenoh_config.h"

#include <charconv>
#include <vector>

#include "transport/zenoh/access_control.h"
#include "transport/zenoh/json.h"

namespace urto {
namespace {

constexpr std::size_t kMessageBytesLowest = 1024;
constexpr std::size_t kMessageBytesHighest = std::size_t{1} << 30;
constexpr std::size_t kSessionsHighest = 100'000;
constexpr unsigned kPortMax = 65'535;
// How long a dropped message first waits for room in a client's queue. At 0 a healthy client loses messages to mere
// scheduling, see docs/decisions/0001.
constexpr int kWaitBeforeDropUs = 1000;

bool is_port(std::string_view text) {
  unsigned port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc() && end == text.data() + text.size() && port <= kPortMax;
}

// PROTOCOL/HOST:PORT with an optional "?metadata" and "#configuration".
TransportStatus check_endpoint(const std::string& endpoint) {
  const std::string_view address = std::string_view(endpoint).substr(0, endpoint.find_first_of("?#"));
  const std::size_t slash = address.find('/');
  const std::size_t colon = address.rfind(':');
  const bool has_parts = slash != std::string_view::npos && colon != std::string_view::npos && slash + 1 < colon;
  const std::string_view protocol = address.substr(0, slash);
  if (!has_parts || (protocol != "tcp" && protocol != "tls") || !is_port(address.substr(colon + 1)) ||
      address.find_first_of(" \t\r\n") != std::string_view::npos) {
    return transport_failure(TransportErrorCode::kBadEndpoint, endpoint,
                             "\"" + endpoint + "\" is no endpoint: it takes tcp/HOST:PORT or tls/HOST:PORT");
  }
  return {};
}

tl::unexpected<TransportError> bad_option(std::string name, std::string why) {
  return transport_failure(TransportErrorCode::kBadOption, name, name + " " + why);
}

TransportStatus check_options(const ZenohOptions& options) {
  for (const auto* endpoints : {&options.listen, &options.connect}) {
    for (const std::string& endpoint : *endpoints) {
      if (auto status = check_endpoint(endpoint); !status) return status;
    }
  }
  const bool is_client = options.mode == ZenohMode::kClient;
  if (is_client && !options.listen.empty()) return bad_option("listen", "is for peers; a client listens nowhere");
  if (is_client && options.connect.empty()) return bad_option("connect", "is empty; a client needs an endpoint");
  if (!is_client && options.listen.empty() && options.connect.empty()) {
    return bad_option("listen", "and connect are empty: nobody could be reached");
  }
  if (options.message_bytes_max < kMessageBytesLowest || options.message_bytes_max > kMessageBytesHighest) {
    return bad_option("message_bytes_max",
                      "is " + std::to_string(options.message_bytes_max) + "; it takes 1024 to 1073741824");
  }
  if (options.sessions_max < 1 || options.sessions_max > kSessionsHighest) {
    return bad_option("sessions_max", "is " + std::to_string(options.sessions_max) + "; it takes 1 to 100000");
  }
  if (options.connect_timeout.count() <= 0) return bad_option("connect_timeout", "takes more than 0 ms");
  if (!options.user_dictionary.empty() && !options.connect.empty()) {
    return bad_option("user_dictionary", "and connect exclude each other: a router keeps the users of its clients");
  }
  return {};
}

std::string auth_json(const ZenohOptions& options) {
  std::string usrpwd;
  if (options.credentials) {
    usrpwd = "\"user\": " + json_string(options.credentials->user) +
             ", \"password\": " + json_string(options.credentials->password);
  }
  if (!options.user_dictionary.empty()) {
    usrpwd += (usrpwd.empty() ? "" : ", ");
    usrpwd += "\"dictionary_file\": " + json_string(options.user_dictionary);
  }
  return "{\"usrpwd\": {" + usrpwd + "}}";
}

std::string transport_json(const ZenohOptions& options) {
  const std::string send_buffer = "{\"so_sndbuf\": " + std::to_string(kSendBufferBytes) + "}";
  const auto block_us = std::chrono::microseconds(kReplyBlockMax).count();
  return "{\n    \"unicast\": {\"max_sessions\": " + std::to_string(options.sessions_max) +
         "},\n    \"link\": {\n      \"tx\": {\"queue\": {\"congestion_control\": {\"drop\": {\"wait_before_drop\": " +
         std::to_string(kWaitBeforeDropUs) + "}, \"block\": {\"wait_before_close\": " + std::to_string(block_us) +
         "}}}},\n      \"rx\": {\"max_message_size\": " + std::to_string(options.message_bytes_max) +
         "},\n      \"tcp\": " + send_buffer + ",\n      \"tls\": " + send_buffer +
         "},\n    \"auth\": " + auth_json(options) + "}";
}

// Zenoh's own limit looks at messages in fragments (above 64 KB) only, the filter at the payload of each.
std::string size_filter_json(const ZenohOptions& options) {
  return "[{\"id\": \"size\", \"flows\": [\"ingress\"], \"messages\": [\"put\", \"delete\", \"query\", \"reply\"], "
         "\"key_exprs\": [\"**\"], \"size_limit\": " +
         std::to_string(options.message_bytes_max) + "}]";
}

// An answer goes with the priority of its query. It may not be the askers who choose the queue of our publications.
constexpr std::string_view kQueryPriority =
    "{\"network\": [{\"id\": \"answers\", \"flows\": [\"ingress\"], \"messages\": [\"query\"], "
    "\"overwrite\": {\"priority\": \"data\"}}]}";

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// The endpoint that the message is about, or all of them.
std::string endpoint_in(std::string_view message, const std::vector<std::string>& endpoints) {
  std::string all;
  for (const std::string& endpoint : endpoints) {
    if (has(message, endpoint.substr(0, endpoint.find_first_of("?#")))) return endpoint;
    all += (all.empty() ? "" : ", ") + endpoint;
  }
  return all;
}

}  // namespace

TransportExpected<std::string> zenoh_config_json(const ZenohOptions& options) {
  if (auto status = check_options(options); !status) return tl::make_unexpected(status.error());
  std::string access_control = "{\"enabled\": false, \"default_permission\": \"allow\"}";
  if (!options.user_dictionary.empty()) {
    const auto users = read_users(options.user_dictionary);
    if (!users) return tl::make_unexpected(users.error());
    access_control = access_control_json(*users);
  }
  const bool is_client = options.mode == ZenohMode::kClient;
  // -1: a peer goes on trying in the background.
  const std::string connect_timeout_ms = is_client ? std::to_string(options.connect_timeout.count()) : "-1";
  return "{\n  \"mode\": " + json_string(is_client ? "client" : "peer") +
         ",\n  \"listen\": {\"endpoints\": " + json_strings(options.listen) +
         ", \"timeout_ms\": 0, \"exit_on_failure\": true},\n  \"connect\": {\"endpoints\": " +
         json_strings(options.connect) + ", \"timeout_ms\": " + connect_timeout_ms +
         ", \"exit_on_failure\": " + (is_client ? "true" : "false") +
         "},\n  \"scouting\": {\"multicast\": {\"enabled\": false}, \"gossip\": {\"enabled\": false}},\n"
         "  \"adminspace\": {\"enabled\": false},\n  \"transport\": " +
         transport_json(options) + ",\n  \"low_pass_filter\": " + size_filter_json(options) +
         ",\n  \"qos\": " + std::string(kQueryPriority) + ",\n  \"access_control\": " + access_control + "}";
}

TransportError open_error(const ZenohOptions& options, std::string_view zenoh_message) {
  const std::string words = " (Zenoh: " + std::string(zenoh_message) + ")";
  const auto error = [&](TransportErrorCode code, const std::string& subject, const std::string& message) {
    return TransportError{code, subject, message + words};
  };
  const std::string listen = endpoint_in(zenoh_message, options.listen);
  if (has(zenoh_message, "Address already in use")) {
    return error(TransportErrorCode::kAddressInUse, listen, "something else listens on " + listen + " already");
  }
  if (has(zenoh_message, "Permission denied")) {
    return error(TransportErrorCode::kPermissionDenied, listen, "the system forbids to listen on " + listen);
  }
  if (options.mode == ZenohMode::kClient) {
    const std::string connect = endpoint_in(zenoh_message, options.connect);
    return error(TransportErrorCode::kCannotConnect, connect,
                 "no connection to " + connect + ": nobody listens there, or user and password were refused");
  }
  for (const std::string_view sign :
       {"Cannot assign requested address", "failed to lookup address", "Could not parse", "Can not create"}) {
    if (has(zenoh_message, sign)) {
      return error(TransportErrorCode::kBadEndpoint, listen, "cannot listen on " + listen);
    }
  }
  return error(TransportErrorCode::kInternal, listen, "Zenoh did not open a session on " + listen);
}

}  // namespace urto

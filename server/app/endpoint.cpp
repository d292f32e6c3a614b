#include "app/endpoint.h"

#include <charconv>
#include <cstdint>

namespace urto::app {
namespace {

// The parts of "PROTOCOL/HOST:PORT#OPTIONS".
struct Parts {
  std::string protocol, host, port;
};

Parts split(const std::string& text) {
  std::string address = text.substr(0, text.find('#'));
  Parts parts;
  if (const auto slash = address.find('/'); slash != std::string::npos) {
    parts.protocol = address.substr(0, slash);
    address.erase(0, slash + 1);
  }
  const auto colon = address.rfind(':');
  parts.host = address.substr(0, colon);
  if (colon != std::string::npos) parts.port = address.substr(colon + 1);
  return parts;
}

bool is_port(const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

tl::expected<std::string, std::string> to_endpoint(const std::string& text) {
  const Parts parts = split(text);
  // An IPv6 address has colons of its own, so it stands in brackets.
  const bool bare_ipv6 = parts.host.find(':') != std::string::npos && parts.host.front() != '[';
  if (parts.host.empty() || bare_ipv6 || !is_port(parts.port)) {
    return tl::unexpected<std::string>("\"" + text +
                                       "\" is no endpoint: HOST:PORT, tcp/HOST:PORT or tls/HOST:PORT is "
                                       "needed, with an IPv6 host in brackets and a port from 0 to 65535.");
  }
  return parts.protocol.empty() ? "tcp/" + text : text;
}

bool is_loopback(const std::string& endpoint) {
  const std::string host = split(endpoint).host;
  return host == "localhost" || host == "[::1]" || host.rfind("127.", 0) == 0;
}

}  // namespace urto::app

// A ZenohTransport for python_interop_test.py to talk to: echo_server ROUTER|"" [USER_DICTIONARY]. It prints where it
// listens and ends with its standard input.
#include <iostream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "transport/zenoh/zenoh_transport.h"

namespace urto {
namespace {

const PublisherOptions kText{"text/plain;schema=echo", Reliability::kReliable, Priority::kNormal};

int serve(const ZenohOptions& options) {
  auto opened = ZenohTransport::open(options);
  if (!opened) {
    std::cerr << name_of(opened.error().code) << ": " << opened.error().message << std::endl;
    return 1;
  }
  ZenohTransport& transport = **opened;
  const auto echo = transport.declare_queryable("urto/v1/*/cmd/*", [](Query query) {
    // Answered on another thread, as urtod does.
    std::thread([query = std::move(query)]() mutable {
      query.reply(query.parameters() + "|" + query.payload(), "text/plain;schema=echo");
    }).detach();
  });
  const auto refuse =
      transport.declare_queryable("urto/v1/lab/info", [](Query query) { query.reply_error("refused"); });
  const auto ignore = transport.declare_queryable("urto/v1/lab/state", [](Query) {});
  const auto repeat = transport.declare_subscriber("urto/v1/*/cmd/*", [&](std::string_view, std::string_view payload) {
    transport.put("urto/v1/lab/snapshot", payload, kText);
  });
  const auto members =
      transport.declare_liveliness_subscriber("urto/v1/*/member/**", [&](std::string_view key, bool alive) {
        transport.put("urto/v1/lab/event", std::string(key) + (alive ? " came" : " went"), kText);
      });
  const auto alive = transport.declare_liveliness_token("urto/v1/lab/alive");
  std::cout << transport.endpoints().at(0) << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
  }
  return 0;
}

}  // namespace
}  // namespace urto

int main(int argc, char** argv) {
  urto::ZenohOptions options;
  options.listen = {"tcp/127.0.0.1:0"};
  if (argc > 1 && *argv[1] != '\0') options.connect = {argv[1]};
  if (argc > 2) options.user_dictionary = argv[2];
  return urto::serve(options);
}

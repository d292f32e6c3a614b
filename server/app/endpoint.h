#pragma once

#include <string>
#include <tl/expected.hpp>

namespace urto::app {

// "tcp/HOST:PORT" of "HOST:PORT"; what has a protocol already stays as it is. The error is a sentence for people.
tl::expected<std::string, std::string> to_endpoint(const std::string& text);

// Whether only this machine can reach what listens there.
bool is_loopback(const std::string& endpoint);

}  // namespace urto::app

#include "app/keys.h"

#include <algorithm>

#include "app/options.h"

namespace urto::app {
namespace {

// The last chunk of a key, which is cut off it.
std::string take_last_chunk(std::string_view& key) {
  const auto slash = key.rfind('/');
  if (slash == std::string_view::npos) return "";
  std::string chunk(key.substr(slash + 1));
  key.remove_suffix(key.size() - slash);
  return chunk;
}

}  // namespace

Keys::Keys(const std::string& room) {
  const std::string prefix = "urto/v1/" + room + "/";
  alive = prefix + "alive";
  info = prefix + "info";
  state = prefix + "state";
  snapshot = prefix + "snapshot";
  event = prefix + "event";
  all_commands = prefix + "cmd/*";
  all_members = prefix + "member/*/*";
}

std::optional<std::string> user_of_command_key(std::string_view key) {
  std::string user = take_last_chunk(key);
  if (!is_key_name(user)) return std::nullopt;
  return user;
}

std::optional<Member> member_of_key(std::string_view key) {
  Member member;
  member.session = take_last_chunk(key);
  member.user = take_last_chunk(key);
  if (!is_key_name(member.user) || !is_key_name(member.session)) return std::nullopt;
  return member;
}

std::optional<std::string> parameter(std::string_view parameters, std::string_view name) {
  while (!parameters.empty()) {
    const auto end = std::min(parameters.find(';'), parameters.size());
    const std::string_view pair = parameters.substr(0, end);
    const auto equals = std::min(pair.find('='), pair.size());
    if (pair.substr(0, equals) == name) return std::string(pair.substr(std::min(equals + 1, pair.size())));
    parameters.remove_prefix(std::min(end + 1, parameters.size()));
  }
  return std::nullopt;
}

}  // namespace urto::app

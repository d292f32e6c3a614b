#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "room/roster.h"

namespace urto::app {

// The Zenoh keys of a room: urto/v1/ROOM/… (docs/protocol.md).
struct Keys {
  explicit Keys(const std::string& room);

  std::string alive, info, state, snapshot, event;
  std::string all_commands;  // …/cmd/*
  std::string all_members;   // …/member/*/*
};

// The USER of …/cmd/USER; none if it is no name, a wildcard say.
std::optional<std::string> user_of_command_key(std::string_view key);
// The user and session of …/member/USER/SESSION.
std::optional<Member> member_of_key(std::string_view key);

// The value of `name` in parameters like "saved_state=true;from=12". None if it is not there.
std::optional<std::string> parameter(std::string_view parameters, std::string_view name);

}  // namespace urto::app

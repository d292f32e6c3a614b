#pragma once

#include <string>
#include <vector>

#include "transport/transport_error.h"

namespace urto {

// The users of a dictionary file: lines "USER:PASSWORD", blank ones ignored, at least one, a USER at most once and made
// of 1 to 64 of [A-Za-z0-9_-], a PASSWORD not empty. Errors name file and line, never a password.
TransportExpected<std::vector<std::string>> read_users(const std::string& dictionary_file);

// Zenoh's "access_control" setting, as JSON, that gives each user what docs/protocol.md promises and nothing else:
//
//   client to server   put, query                        urto/v1/*/cmd/USER
//                      liveliness token                  urto/v1/*/member/USER/**
//                      query                             urto/v1/*/info, …/state, …/event
//                      subscribe, also to liveliness     urto/v1/**
//   server to client   put                               urto/v1/*/snapshot, …/event
//                      reply, liveliness token           urto/v1/**
//                      (what is subscribed and asked)    urto/v1/**
//
// So nobody but the server publishes or answers, nobody sees another's commands, and the USER in a key can be trusted.
std::string access_control_json(const std::vector<std::string>& users);

}  // namespace urto

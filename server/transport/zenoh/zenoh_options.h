#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace urto {

enum class ZenohMode {
  kPeer,    // listens; what urtod is
  kClient,  // connects to one of the endpoints, and listens nowhere
};

struct ZenohCredentials {
  std::string user;
  std::string password;
};

// The limits below are Zenoh settings whose defaults (1 GiB, 1000 sessions, the system's buffer, 5 s) let one client
// hurt the others.
inline constexpr std::size_t kMessageBytesMax = std::size_t{4} << 20;
inline constexpr std::size_t kSessionsMax = 256;
// A client that does not read keeps what it was sent in the socket, oldest first, and reads it late. A small buffer
// bounds how late: about six snapshots of 10 KB.
inline constexpr std::size_t kSendBufferBytes = 64 * 1024;
// How long an answer to a client that does not read may hold up its sender, before Zenoh closes that client's session.
inline constexpr std::chrono::milliseconds kReplyBlockMax{1000};

// How to open a ZenohTransport. Never on: multicast scouting and gossip (nobody finds or meets anyone that the
// endpoints do not name), the admin space, plugins.
struct ZenohOptions {
  ZenohMode mode = ZenohMode::kPeer;
  // "tcp/HOST:PORT" or "tls/HOST:PORT", optionally with Zenoh's "#key=value;…" behind. Port 0: the system chooses.
  std::vector<std::string> listen{"tcp/127.0.0.1:7447"};  // none in a client
  std::vector<std::string> connect;                       // routers; a client needs at least one
  std::optional<ZenohCredentials> credentials;            // shown to those we connect to
  // File of lines USER:PASSWORD, readable by us. With it, only these users get in, and each may do only what
  // access_control.h says; without, everybody who reaches the endpoint may do everything. Not together with connect:
  // whoever comes through a router is known to the router alone, so that is where users are set up then.
  std::string user_dictionary;                       // empty: none
  std::size_t message_bytes_max = kMessageBytesMax;  // of an incoming payload, 1 KiB to 1 GiB; larger ones are dropped
  std::size_t sessions_max = kSessionsMax;           // clients at a time, 1 to 100 000; further ones are refused
  std::chrono::milliseconds connect_timeout{5000};   // of a client
};

}  // namespace urto

#pragma once

#include <string>

#include "room/room.h"
#include "urto/v1/command.pb.h"

namespace urto::codec {

inline constexpr std::uint32_t kProtocolVersion = 1;

// What the host of a room knows about it, and the room does not.
struct HostInfo {
  std::string room;
  std::string server_version;
  double snapshot_rate_hz = 0;  // at time scale 1
  bool authenticated = false;   // users are checked by password
  double uptime = 0;            // s
};

// `scene` and `settings` are the room's; they do not change while it lives.
std::string encode_info(const RoomView& view, const SceneDef& scene, const RoomSettings& settings,
                        const HostInfo& host);
// Of a view with state.
std::string encode_state(const RoomView& view, const SceneDef& scene, const RoomSettings& settings,
                         const HostInfo& host, bool with_saved_state);

void write_query_result(const QueryResult& result, v1::QueryResult* out);

}  // namespace urto::codec

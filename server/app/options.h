#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "room/admission.h"

namespace urto::app {

inline constexpr const char* kDefaultEndpoint = "tcp/127.0.0.1:7447";
inline constexpr double kSnapshotRateDefault = 60;  // Hz
inline constexpr double kSnapshotRateMax = 1000;    // Hz

// What the command line asks for.
struct Options {
  std::string scene_file;
  std::string room;                  // empty: the scene's name
  std::vector<std::string> listen;   // as endpoints; empty: kDefaultEndpoint, or none if connect is set
  std::vector<std::string> connect;  // routers
  std::string users_file;            // empty: everybody may come
  Control control = Control::kEveryone;
  std::vector<std::string> owners;
  double snapshot_rate_hz = kSnapshotRateDefault;  // at time scale 1, at most one per tick
  bool paused = false;
  bool publish_hash = false;
  double time_scale = 1;
  unsigned threads = 1;  // that step the world
  bool check_only = false;
  bool explain_only = false;
  std::string log_level = "info";
};

// What to do instead: print `text` (to stderr if the code is not 0) and exit with the code.
struct Exit {
  int code = 0;
  std::string text;
};
inline constexpr int kExitFailure = 1;  // of what was tried: a port that is in use, say
inline constexpr int kExitUsage = 2;    // of what was asked for: an option or a scene that is wrong

tl::expected<Options, Exit> parse_options(int argc, const char* const* argv);

// 1 to 64 of [A-Za-z0-9_-]: what a room, a user or a session may be called, being part of a key.
bool is_key_name(const std::string& name);

}  // namespace urto::app

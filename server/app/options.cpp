#include "app/options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <sstream>

#include "app/endpoint.h"
#include "room/limits.h"

namespace urto::app {
namespace {

constexpr std::size_t kKeyNameBytesMax = 64;

const std::map<std::string, Control> kControls = {
    {"everyone", Control::kEveryone}, {"owners", Control::kOwners}, {"nobody", Control::kNobody}};

std::string check_name(const std::string& text) {
  return is_key_name(text) ? "" : "\"" + text + "\" is not 1 to 64 letters, digits, _ or -";
}

void declare(CLI::App& app, Options& options) {
  app.set_version_flag("--version", std::string("urtod ") + URTO_VERSION);
  app.add_option("--scene", options.scene_file, "The scene to host: urto.v1.Scene in protobuf text format")
      ->required()
      ->type_name("FILE");
  app.add_option("--room", options.room, "Name of the room (default: the scene's name)")
      ->type_name("NAME")
      ->check(check_name);
  app.add_option("--listen", options.listen,
                 "Where clients come in, as HOST:PORT, tcp/HOST:PORT or tls/HOST:PORT; may be given more than once "
                 "(default: " +
                     std::string(kDefaultEndpoint) + ", this machine alone)")
      ->type_name("ENDPOINT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--connect", options.connect, "A Zenoh router to join; may be given more than once")
      ->type_name("ENDPOINT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--users", options.users_file,
                 "File of lines USER:PASSWORD; only they get in, each as that user (default: everybody who reaches the "
                 "endpoint)")
      ->type_name("FILE");
  app.add_option("--control", options.control, "Who may pause, resume, step, reset and scale time")
      ->type_name("everyone|owners|nobody")
      ->transform(CLI::CheckedTransformer(kControls, CLI::ignore_case).description(""))
      ->default_str("everyone");
  app.add_option("--owner", options.owners, "A user who may do so under --control owners; may be given more than once")
      ->type_name("USER")
      ->check(check_name)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--snapshot-rate", options.snapshot_rate_hz, "Live snapshots per simulated second, at most one a tick")
      ->type_name("HZ")
      ->capture_default_str()
      ->check(CLI::Range(1e-3, kSnapshotRateMax));
  app.add_flag("--paused", options.paused, "Start paused");
  app.add_flag("--publish-hash", options.publish_hash, "Put the hash of the state into every snapshot");
  app.add_option("--time-scale", options.time_scale, "Simulated seconds per second")
      ->type_name("SCALE")
      ->capture_default_str()
      ->check(CLI::Range(kTimeScaleMin, kTimeScaleMax));
  app.add_option(
         "--threads", options.threads,
         "Threads that step the room; worth more than 1 from some thousand bodies on, and the results are the same")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1u, kThreadsMax));
  app.add_flag("--check", options.check_only, "Check the scene and exit");
  app.add_flag("--explain", options.explain_only,
               "Print what of the engine the scene needs and why, and what each part of a step costs on this machine, "
               "and exit");
  app.add_option("--log-level", options.log_level, "How much is said on stderr")
      ->type_name("trace|debug|info|warn|error|off")
      ->capture_default_str()
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}).description(""));
}

// What no single option can tell. Empty: nothing is wrong.
std::string check_together(const Options& options) {
  if (!options.users_file.empty() && !options.connect.empty()) {
    return "--users and --connect exclude each other: who comes through a router is known to the router alone, so "
           "that is where users are set up then.";
  }
  if (options.control == Control::kOwners && options.owners.empty()) {
    return "--control owners needs at least one --owner.";
  }
  if (options.control != Control::kOwners && !options.owners.empty()) {
    return "--owner has a meaning only with --control owners.";
  }
  return "";
}

tl::unexpected<Exit> leave(int code, const std::string& text) { return tl::unexpected<Exit>(Exit{code, text}); }

}  // namespace

bool is_key_name(const std::string& name) {
  return !name.empty() && name.size() <= kKeyNameBytesMax &&
         name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-") ==
             std::string::npos;
}

tl::expected<Options, Exit> parse_options(int argc, const char* const* argv) {
  Options options;
  CLI::App app{"Hosts one room of 2D physics over Zenoh: steps a scene and lets clients see it and act in it.",
               "urtod"};
  declare(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, problem;
    const bool asked = app.exit(error, out, problem) == 0;  // --help and --version
    return leave(asked ? 0 : kExitUsage, asked ? out.str() : problem.str());
  }
  if (const std::string wrong = check_together(options); !wrong.empty()) return leave(kExitUsage, wrong + "\n");
  for (auto* endpoints : {&options.listen, &options.connect}) {
    for (std::string& endpoint : *endpoints) {
      auto full = to_endpoint(endpoint);
      if (!full) return leave(kExitUsage, full.error() + "\n");
      endpoint = *full;
    }
  }
  if (options.listen.empty() && options.connect.empty()) options.listen.push_back(kDefaultEndpoint);
  return options;
}

}  // namespace urto::app

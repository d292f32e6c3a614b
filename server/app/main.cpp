// urtod: one room of physics on the network.

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <cstdio>
#include <memory>

#include "app/endpoint.h"
#include "app/load_scene.h"
#include "app/options.h"
#include "app/scene_cost.h"
#include "app/server.h"
#include "app/server_threads.h"
#include "transport/zenoh/zenoh_transport.h"

namespace urto::app {
namespace {

WorldFactory world_factory(unsigned threads) {
  return [threads](const WorldSettings& settings) { return World::create(settings, &monotonic_ns, threads); };
}

RoomSettings room_settings(const Options& options) {
  RoomSettings settings;
  settings.roles = {options.control, {options.owners.begin(), options.owners.end()}};
  settings.paused = options.paused && !options.explain_only;  // what is explained is stepped
  settings.time_scale = options.time_scale;
  settings.publish_hash = options.publish_hash;
  settings.snapshot_rate_hz = options.snapshot_rate_hz;
  return settings;
}

ZenohOptions zenoh_options(const Options& options) {
  ZenohOptions zenoh;
  zenoh.listen = options.listen;
  zenoh.connect = options.connect;
  zenoh.user_dictionary = options.users_file;
  return zenoh;
}

codec::HostInfo host_info(const Options& options, const Room& room) {
  codec::HostInfo host;
  host.room = options.room.empty() ? room.scene().name : options.room;
  host.server_version = URTO_VERSION;
  host.snapshot_rate_hz = 1 / (room.scene().world.time_step * room.ticks_per_snapshot());
  host.authenticated = !options.users_file.empty();
  return host;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

void announce(const Options& options, const std::string& room, const std::vector<std::string>& endpoints) {
  std::string where = endpoints.empty() ? "through the router " + joined(options.connect) : "on " + joined(endpoints);
  bool open = false;
  for (const std::string& endpoint : endpoints) open |= !is_loopback(endpoint);
  std::string who = "everybody on this machine";
  if (!options.users_file.empty()) {
    who = "the users of " + options.users_file;
  } else if (open || !options.connect.empty()) {
    who = "everybody who reaches it";
  }
  spdlog::info("Room {} {}, open to {}.", room, where, who);
  if (open && options.users_file.empty()) {
    spdlog::warn(
        "Without --users, whoever reaches this endpoint over the network may watch, spawn, push and remove, under any "
        "name{}, and nothing is encrypted. Use --users FILE, or listen on 127.0.0.1.",
        options.control == Control::kEveryone ? ", and pause or reset the room" : "");
  }
}

void set_up_log(const Options& options) {
  auto logger = spdlog::stderr_color_mt("urtod");
  logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
  logger->set_level(spdlog::level::from_str(options.log_level));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

// Of threads that are started from here on; wait_for_signal() takes them.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

int serve(const Options& options, std::unique_ptr<Room> room, const sigset_t& signals) {
  auto transport = ZenohTransport::open(zenoh_options(options));
  if (!transport) {
    spdlog::error("{}", transport.error().message);
    return kExitFailure;
  }
  const codec::HostInfo host = host_info(options, *room);
  Waker waker;
  Server server(std::move(room), host, **transport, [&waker] { waker.wake(); });
  if (const auto status = server.start(); !status) {
    spdlog::error("{}", status.error().message);
    return kExitFailure;
  }
  ServerThreads threads(server, waker);
  announce(options, host.room, (*transport)->endpoints());

  int signal = 0;
  sigwait(&signals, &signal);
  spdlog::info("Closing the room {}.", host.room);
  threads.stop();
  (*transport)->close();
  return 0;
}

int run(int argc, char** argv) {
  const auto options = parse_options(argc, argv);
  if (!options) {
    std::fputs(options.error().text.c_str(), options.error().code == 0 ? stdout : stderr);
    return options.error().code;
  }
  set_up_log(*options);
  // Before the room, which may bring threads of its own.
  const bool serves = !options->explain_only && !options->check_only;
  const sigset_t signals = serves ? block_signals() : sigset_t{};
  auto room = load_room(options->scene_file, room_settings(*options), world_factory(options->threads));
  if (!room) {
    std::fprintf(stderr, "%s\n", room.error().c_str());
    return kExitUsage;
  }
  if (options->explain_only) {
    std::fputs(explain(**room).c_str(), stdout);
    std::fputs(cost_text(measure_cost(**room), options->threads).c_str(), stdout);
    return 0;
  }
  if (options->check_only) {
    std::printf("%s: a valid scene, %s, of %zu bodies\n", options->scene_file.c_str(), (*room)->scene().name.c_str(),
                (*room)->scene().bodies.size());
    return 0;
  }
  return serve(*options, std::move(*room), signals);
}

}  // namespace
}  // namespace urto::app

int main(int argc, char** argv) { return urto::app::run(argc, argv); }

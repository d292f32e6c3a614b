#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/keys.h"
#include "app/pending_queries.h"
#include "app/room_host.h"
#include "codec/room_codec.h"
#include "codec/snapshot_codec.h"
#include "transport/transport.h"

namespace urto::app {

// A room on the network: what comes in by keys is decoded and queued, what the room gives is encoded and sent.
// It has no threads and no clock of its own; ServerThreads brings them, and tests call the same functions by hand.
class Server {
 public:
  // host.uptime is filled in with each answer. The transport outlives the server.
  Server(std::unique_ptr<Room> room, codec::HostInfo host, Transport& transport, std::function<void()> wake);
  ~Server();

  // Declares the room's keys; the room is alive for others from here on.
  TransportStatus start();
  // Takes no more questions; the room is gone for others.
  void stop_listening();

  // Tick thread.
  std::optional<std::uint64_t> run_once(std::uint64_t now_ns) { return host_.run_once(now_ns); }
  void close_room() { host_.close(); }

  // One thread each. Wait for the next thing and send it; false once the room was closed and everything is sent.
  bool send_frame();
  bool send_events();
  bool send_reply();
  // The same without waiting: sends all there is.
  void send_all();

  const Room& room() const { return host_.room(); }

 private:
  void on_command_query(Query query);
  void on_command_put(std::string_view key, std::string_view payload);
  void submit(const std::string& user, Ticket ticket, std::string_view payload);
  void on_view_query(Query query, bool state);
  void on_event_query(Query query);

  void publish(const Frame& frame);
  void publish(const EventSlice& slice);
  void answer(const OutgoingReply& reply);
  std::string encode(const Answer& reply) const;
  std::string encode(const ViewReply& reply) const;
  std::string encode(const EventsReply& reply) const;

  const codec::HostInfo host_info_;
  const Keys keys_;
  Transport& transport_;
  PendingQueries pending_;
  RoomHost host_;
  codec::SnapshotEncoder snapshot_encoder_;
  std::unique_ptr<Publisher> snapshots_;
  std::unique_ptr<Publisher> event_publisher_;
  std::vector<DeclarationPtr> declarations_;
};

}  // namespace urto::app

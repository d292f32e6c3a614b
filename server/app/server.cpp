#include "app/server.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <utility>
#include <variant>

#include "codec/command_codec.h"
#include "codec/event_codec.h"

namespace urto::app {
namespace {

std::string encoding_of(const char* message) { return std::string("application/protobuf;schema=urto.v1.") + message; }

Rejection bad_user(const std::string& key) {
  return Rejection{RejectionCode::kMalformed, 0, "", key,
                   "The last part of the key has to be a user: 1 to 64 of A-Z, a-z, 0-9, _ and -."};
}

}  // namespace

Server::Server(std::unique_ptr<Room> room, codec::HostInfo host, Transport& transport, std::function<void()> wake)
    : host_info_(std::move(host)),
      keys_(host_info_.room),
      transport_(transport),
      host_(std::move(room), {std::move(wake), [this](Ticket ticket) { (void)pending_.take(ticket); }}) {}

Server::~Server() { stop_listening(); }

TransportStatus Server::start() {
  TransportStatus status;
  const auto keep = [&](auto declared, auto& place) {
    if (!declared) {
      if (status) status = tl::unexpected<TransportError>(declared.error());
      return;
    }
    place = std::move(*declared);
  };
  const auto declare = [&](TransportExpected<DeclarationPtr> declared) {
    DeclarationPtr declaration;
    keep(std::move(declared), declaration);
    if (declaration) declarations_.push_back(std::move(declaration));
  };
  keep(transport_.declare_publisher(keys_.snapshot, {encoding_of("Snapshot")}), snapshots_);
  keep(transport_.declare_publisher(keys_.event, {encoding_of("EventBatch")}), event_publisher_);
  declare(transport_.declare_queryable(keys_.info, [this](Query query) { on_view_query(std::move(query), false); }));
  declare(transport_.declare_queryable(keys_.state, [this](Query query) { on_view_query(std::move(query), true); }));
  declare(transport_.declare_queryable(keys_.event, [this](Query query) { on_event_query(std::move(query)); }));
  declare(
      transport_.declare_queryable(keys_.all_commands, [this](Query query) { on_command_query(std::move(query)); }));
  declare(transport_.declare_subscriber(
      keys_.all_commands, [this](std::string_view key, std::string_view payload) { on_command_put(key, payload); }));
  declare(transport_.declare_liveliness_subscriber(keys_.all_members, [this](std::string_view key, bool alive) {
    if (const auto member = member_of_key(key)) host_.set_member(*member, alive);
  }));
  // Last: who sees the room alive can talk to it.
  declare(transport_.declare_liveliness_token(keys_.alive));
  return status;
}

void Server::stop_listening() {
  while (!declarations_.empty()) declarations_.pop_back();  // the token first
}

void Server::on_command_query(Query query) {
  const std::string key = query.key();
  const std::string payload = query.payload();
  const Ticket ticket = pending_.add(std::move(query));
  if (const auto user = user_of_command_key(key)) {
    submit(*user, ticket, payload);
  } else {
    host_.refuse("", ticket, 0, bad_user(key));
  }
}

void Server::on_command_put(std::string_view key, std::string_view payload) {
  if (const auto user = user_of_command_key(key)) {
    submit(*user, kNoAnswer, payload);
  } else {
    host_.refuse("", kNoAnswer, 0, bad_user(std::string(key)));
  }
}

void Server::submit(const std::string& user, Ticket ticket, std::string_view payload) {
  auto batch = codec::decode_batch(payload, room().settings().limits);
  if (!batch) {
    host_.refuse(user, ticket, batch.error().sequence, std::move(batch.error().rejection));
    return;
  }
  host_.submit({user, ticket, std::move(*batch), payload.size()});
}

void Server::on_view_query(Query query, bool state) {
  const bool saved_state = state && parameter(query.parameters(), "saved_state") == "true";
  host_.request_view(pending_.add(std::move(query)), state, saved_state);
}

void Server::on_event_query(Query query) {
  std::uint64_t from = 0;
  const std::string text = parameter(query.parameters(), "from").value_or("0");
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), from);
  if (error != std::errc() || end != text.data() + text.size()) {
    (void)query.reply_error("The parameter `from` has to be a sequence number, not \"" + text + "\".");
    return;
  }
  host_.request_events(pending_.add(std::move(query)), from);
}

bool Server::send_frame() {
  const auto frame = host_.frames.pop();
  if (frame) publish(**frame);
  return frame.has_value();
}

bool Server::send_events() {
  const auto slice = host_.events.pop();
  if (slice) publish(*slice);
  return slice.has_value();
}

bool Server::send_reply() {
  const auto reply = host_.replies.pop();
  if (reply) answer(*reply);
  return reply.has_value();
}

void Server::send_all() {
  while (const auto slice = host_.events.try_pop()) publish(*slice);
  while (const auto frame = host_.frames.try_pop()) publish(**frame);
  while (const auto reply = host_.replies.try_pop()) answer(*reply);
}

void Server::publish(const Frame& frame) {
  if (const auto status = snapshots_->put(snapshot_encoder_.encode(frame)); !status) {
    spdlog::debug("A snapshot was not sent: {}", status.error().message);
  }
}

void Server::publish(const EventSlice& slice) {
  for (std::size_t begin = 0; begin < slice.events.size(); begin += kEventsPerMessageMax) {
    const std::size_t end = std::min(begin + kEventsPerMessageMax, slice.events.size());
    EventSlice part;
    part.epoch = slice.events[begin].epoch;
    part.first_sequence = slice.first_sequence + begin;
    part.oldest_sequence = slice.oldest_sequence;
    part.events.assign(slice.events.begin() + static_cast<std::ptrdiff_t>(begin),
                       slice.events.begin() + static_cast<std::ptrdiff_t>(end));
    if (const auto status = event_publisher_->put(codec::encode_events(part)); !status) {
      spdlog::debug("Events were not sent: {}", status.error().message);
    }
  }
}

void Server::answer(const OutgoingReply& reply) {
  const Ticket ticket = std::visit([](const auto& each) { return each.ticket; }, reply);
  auto query = pending_.take(ticket);
  if (!query) return;
  TransportStatus status;
  if (const auto* error = std::get_if<ErrorReply>(&reply)) {
    status = query->reply_error(error->message);
  } else if (const auto* batch = std::get_if<Answer>(&reply)) {
    status = query->reply(encode(*batch), encoding_of("CommandReply"));
  } else if (const auto* view = std::get_if<ViewReply>(&reply)) {
    status = query->reply(encode(*view), encoding_of(view->state ? "RoomState" : "RoomInfo"));
  } else {
    status = query->reply(encode(std::get<EventsReply>(reply)), encoding_of("EventBatch"));
  }
  if (!status) spdlog::debug("An answer was not sent: {}", status.error().message);
}

std::string Server::encode(const Answer& reply) const { return codec::encode_reply(reply.reply); }

std::string Server::encode(const ViewReply& reply) const {
  codec::HostInfo host = host_info_;
  host.uptime = reply.uptime;
  const Room& room = host_.room();
  if (!reply.state) return codec::encode_info(*reply.view, room.scene(), room.settings(), host);
  return codec::encode_state(*reply.view, room.scene(), room.settings(), host, reply.saved_state);
}

std::string Server::encode(const EventsReply& reply) const { return codec::encode_events(reply.events); }

}  // namespace urto::app

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "room/room.h"
#include "support/scenes.h"

namespace urto::testing {

inline Expected<std::unique_ptr<World>> real_world(const WorldSettings& settings) { return World::create(settings); }

// A room that a test ticks by hand, and the answers that came out of it so far.
class RoomDriver {
 public:
  explicit RoomDriver(RoomSettings settings = {}, SceneDef scene = floating_scene(), WorldFactory factory = real_world)
      : room(std::move(Room::create(std::move(settings), std::move(scene), std::move(factory)).value())) {}

  // Queues a batch. The ticket under which its answer will come.
  Ticket send(std::vector<Command> commands, const std::string& user = "ann", std::uint64_t sequence = 1) {
    if (auto refused = room->submit({user, ++last_ticket_, {sequence, std::move(commands)}, 100})) {
      answers.push_back({last_ticket_, std::move(*refused)});
    }
    return last_ticket_;
  }

  TickResult tick() {
    TickResult result = room->tick();
    for (const Answer& answer : result.answers) answers.push_back(answer);
    for (const EventRecord& event : result.events.events) events.push_back(event);
    return result;
  }

  // The answer to a ticket, if it has come.
  std::optional<BatchReply> answer(Ticket ticket) const {
    for (const Answer& each : answers) {
      if (each.ticket == ticket) return each.reply;
    }
    return std::nullopt;
  }

  // Sends a batch, ticks once, and gives its answer.
  BatchReply ask(std::vector<Command> commands, const std::string& user = "ann") {
    const Ticket ticket = send(std::move(commands), user);
    tick();
    return answer(ticket).value();
  }

  template <class E>
  std::vector<E> events_of() const {
    std::vector<E> found;
    for (const EventRecord& record : events) {
      if (const auto* event = std::get_if<E>(&record.event)) found.push_back(*event);
    }
    return found;
  }

  BodyState state_of(const std::string& name) {
    const BatchReply reply = ask({RoomQuery(BodyQuery{name})});
    return reply.results.at(0).query->body->state;
  }

  std::unique_ptr<Room> room;
  std::vector<Answer> answers;
  std::vector<EventRecord> events;

 private:
  Ticket last_ticket_ = 0;
};

inline RoomSettings paused_settings() {
  RoomSettings settings;
  settings.paused = true;
  return settings;
}

}  // namespace urto::testing

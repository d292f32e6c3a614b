#pragma once

#include <string>
#include <tl/expected.hpp>

#include "codec/scene_text.h"
#include "room/room.h"

namespace urto::app {

// A room of a scene file. The error is text for people: a line for each problem, with file, line and column.
tl::expected<std::unique_ptr<Room>, std::string> load_room(const std::string& scene_file, RoomSettings settings,
                                                           const WorldFactory& make_world);

// What the room's model is, as text for people.
std::string explain(const Room& room);

}  // namespace urto::app

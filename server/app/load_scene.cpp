#include "app/load_scene.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

namespace urto::app {
namespace {

constexpr std::uintmax_t kSceneBytesMax = 64u << 20;

tl::expected<std::string, std::string> read_file(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  if (!file) return tl::unexpected<std::string>(name + ": cannot be opened: " + std::strerror(errno) + ".");
  std::string text;
  char buffer[65536];
  while (file.read(buffer, sizeof(buffer)) || file.gcount() > 0) {
    text.append(buffer, static_cast<std::size_t>(file.gcount()));
    if (text.size() > kSceneBytesMax) return tl::unexpected<std::string>(name + ": is larger than 64 MiB.");
  }
  if (file.bad()) return tl::unexpected<std::string>(name + ": cannot be read: " + std::strerror(errno) + ".");
  return text;
}

}  // namespace

tl::expected<std::unique_ptr<Room>, std::string> load_room(const std::string& scene_file, RoomSettings settings,
                                                           const WorldFactory& make_world) {
  const auto text = read_file(scene_file);
  if (!text) return tl::unexpected<std::string>(text.error());
  const auto scene = codec::SceneText::parse(*text, scene_file);
  if (!scene) {
    std::string problems;
    for (const codec::SceneProblem& problem : scene.error()) {
      if (!problems.empty()) problems += '\n';
      problems += problem.text();
    }
    return tl::unexpected<std::string>(problems);
  }
  auto room = Room::create(std::move(settings), scene->scene(), make_world);
  if (!room) {
    const Error& error = room.error();
    return tl::unexpected<std::string>(scene->problem_at(error.field, error.value, error.message).text());
  }
  return std::move(*room);
}

std::string explain(const Room& room) {
  std::ostringstream out;
  const SceneDef& scene = room.scene();
  out << "The scene " << scene.name << ": " << scene.bodies.size() << " bodies.\n";
  for (const Feature& feature : room.world().model()) {
    out << (feature.on ? "  on   " : "  off  ") << feature.name;
    if (!feature.choice.empty()) out << ": " << feature.choice;
    out << " (" << feature.reason << ")\n";
  }
  return out.str();
}

}  // namespace urto::app

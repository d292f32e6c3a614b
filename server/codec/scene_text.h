#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "room/scene.h"

namespace urto::codec {

// What is wrong with a scene file and where.
struct SceneProblem {
  std::string file;
  int line = 0;       // from 1; 0: of the whole file
  int column = 0;     // from 1
  std::string field;  // path in the scene, e.g. "bodies[3].shapes[0].box.width"; empty if the text itself is wrong
  std::string value;
  std::string message;

  // "pyramid.scene:12:5: bodies[3].shapes[0].box.width = -1: A width above zero is needed."
  std::string text() const;
};

// A scene that was read from protobuf text format, and where each of its fields stands.
class SceneText {
 public:
  // `file` is only a name for messages. All problems of the text are reported, else the first of the fields.
  static tl::expected<SceneText, std::vector<SceneProblem>> parse(std::string_view text, const std::string& file);

  SceneText(SceneText&&) noexcept;
  SceneText& operator=(SceneText&&) noexcept;
  ~SceneText();

  const SceneDef& scene() const { return scene_; }

  // A problem of one of the fields, with the line where it stands, or where the message around it begins.
  SceneProblem problem_at(const std::string& field, const std::string& value, const std::string& message) const;

 private:
  struct Locations;
  SceneText(std::string file, std::unique_ptr<Locations> locations);

  std::string file_;
  std::unique_ptr<Locations> locations_;
  SceneDef scene_;
};

// The scene in protobuf text format.
std::string scene_to_text(const SceneDef& scene);

}  // namespace urto::codec

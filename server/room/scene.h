#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "physics/joint_definitions.h"

namespace urto {

// A body as a scene or a spawn command describes it: what the engine needs, and what people call it.
struct BodySpec {
  std::string name;               // empty or unique in the room, at most kNameBytesMax bytes
  std::vector<std::string> tags;  // at most kTagsMax, each at most kTagBytesMax bytes
  BodyDef def;
  std::optional<std::uint32_t> color;  // 0xRRGGBB
};

// A body of the room: by id, or by the name it was spawned with (also earlier in the same batch).
using BodyRef = std::variant<BodyId, std::string>;

// A joint as a scene or a command describes it. The bodies of `def` are found by these references.
struct JointSpec {
  std::string name;               // empty or unique among the room's joints, at most kNameBytesMax bytes
  std::optional<BodyRef> body_a;  // none of a mouse joint
  BodyRef body_b;
  JointDef def;
};

// What a body counts against a room's shapes_max: each segment of a chain is a shape.
inline std::size_t shape_count_of(const BodyDef& def) {
  std::size_t count = 0;
  for (const ShapeDef& shape : def.shapes) {
    const auto* chain = std::get_if<Chain>(&shape.geometry);
    count += chain ? chain->vertices.size() : 1;
  }
  return count;
}

// What a viewer should frame at first: a rectangle, m, world frame.
struct View {
  Vec2 lower{0, 0};
  Vec2 upper{0, 0};
};

// Everything a world starts with.
struct SceneDef {
  std::string name;
  std::string description;
  WorldSettings world;
  std::vector<BodySpec> bodies;
  std::vector<JointSpec> joints;
  std::optional<View> view;
};

}  // namespace urto

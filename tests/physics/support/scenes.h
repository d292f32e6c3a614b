#pragma once

// Small worlds that many tests want.

#include <gtest/gtest.h>

#include <vector>

#include "physics/world.h"

namespace urto::testing {

inline ShapeDef box_shape(double width, double height, Material material = {}) {
  return ShapeDef{Box{width, height, {0, 0}, 0}, material, {}, false};
}

inline ShapeDef circle_shape(double radius, Material material = {}) {
  return ShapeDef{Circle{radius, {0, 0}}, material, {}, false};
}

inline BodyDef body_with(ShapeDef shape, Vec2 position, BodyType type = BodyType::kDynamic) {
  BodyDef def;
  def.type = type;
  def.position = position;
  def.shapes.push_back(std::move(shape));
  return def;
}

inline BodyDef box_body(double x, double y, double width = 1, double height = 1, BodyType type = BodyType::kDynamic) {
  return body_with(box_shape(width, height), {x, y}, type);
}

inline BodyDef ball_body(double x, double y, double radius = 0.5) { return body_with(circle_shape(radius), {x, y}); }

// A floor whose top is y = 0.
inline BodyDef floor_body(double width = 200) { return box_body(0, -1, width, 2, BodyType::kStatic); }

inline std::unique_ptr<World> make_world(const WorldSettings& settings = {}) {
  auto world = World::create(settings);
  EXPECT_TRUE(world.has_value());
  return std::move(*world);
}

inline BodyId add(World& world, const BodyDef& def) {
  const Expected<BodyId> id = world.add_body(def);
  EXPECT_TRUE(id.has_value()) << (id ? "" : id.error().field + ": " + id.error().message);
  return id.value_or(0);
}

inline std::vector<BodyId> add_stack(World& world, int count) {
  std::vector<BodyId> ids;
  for (int i = 0; i < count; ++i) ids.push_back(add(world, box_body(0, i + 0.5)));
  return ids;
}

// Rows of unit boxes: as many at the bottom as there are rows.
inline std::vector<BodyId> add_pyramid(World& world, int rows, double x = 0) {
  std::vector<BodyId> ids;
  for (int i = 0; i < rows; ++i)
    for (int j = i; j < rows; ++j)
      ids.push_back(add(world, box_body(x + 0.5 * (i + 1) + (j - i) - 0.5 * rows, i + 0.5)));
  return ids;
}

inline void step_for(World& world, double seconds) {
  const int steps = static_cast<int>(seconds / world.settings().time_step + 0.5);
  for (int i = 0; i < steps; ++i) world.step();
}

inline WorldSettings settings_for(Precision precision) {
  WorldSettings settings;
  settings.precision = precision;
  return settings;
}

}  // namespace urto::testing

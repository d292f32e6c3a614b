#pragma once

// Small scenes and bodies for tests.

#include <string>
#include <utility>

#include "room/scene.h"

namespace urto::testing {

inline BodySpec box_body(const std::string& name, const Vec2& position, BodyType type = BodyType::kDynamic,
                         double width = 1, double height = 1) {
  BodySpec spec;
  spec.name = name;
  spec.def.type = type;
  spec.def.position = position;
  ShapeDef shape;
  shape.geometry = Box{width, height};
  spec.def.shapes.push_back(shape);
  return spec;
}

// A floor 100 m wide with its top at y = 0, and one box of 1 m in the air at (0, 5), without gravity.
inline SceneDef floating_scene() {
  SceneDef scene;
  scene.name = "floating";
  scene.description = "A box that floats above a floor.";
  scene.world.precision = Precision::kDouble;
  scene.world.gravity = Vec2(0, 0);
  scene.bodies.push_back(box_body("floor", {0, -0.5}, BodyType::kStatic, 100, 1));
  scene.bodies.push_back(box_body("box", {0, 5}));
  return scene;
}

}  // namespace urto::testing

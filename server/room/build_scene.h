#pragma once

#include <functional>
#include <memory>

#include "physics/world.h"
#include "room/body_registry.h"
#include "room/joint_registry.h"
#include "room/limits.h"
#include "room/scene.h"

namespace urto {

using WorldFactory = std::function<Expected<std::unique_ptr<World>>(const WorldSettings&)>;

struct BuiltScene {
  std::unique_ptr<World> world;
  BodyRegistry bodies;
  JointRegistry joints;
};

// The world of a scene at tick 0. Equal scenes give equal worlds with equal ids.
// Errors name the field of the scene: "world.time_step", "bodies[3].shapes[0].box.width".
Expected<BuiltScene> build_scene(const SceneDef& scene, const Limits& limits, const WorldFactory& make_world);

}  // namespace urto

#pragma once

#include <cstdint>
#include <vector>

#include "physics/world.h"

namespace urto {

// How many of the world's parts need a feature. Kept up to date as bodies come and go; the model is a function of
// these counts and the settings, and of nothing else, so a replay makes the same choices.
struct Needs {
  std::uint32_t bodies = 0, dynamic_bodies = 0, rotating_bodies = 0, damped_bodies = 0;
  std::uint32_t shapes = 0, circles = 0, boxes = 0, polygons = 0, capsules = 0, chain_segments = 0, sensors = 0;
  std::uint32_t rough_shapes = 0;     // with friction
  std::uint32_t bouncing_shapes = 0;  // with restitution
  std::uint32_t joints = 0;
};

// What runs in a step: the one place where features are switched on or left out.
struct Model {
  BroadPhaseKind broad_phase = BroadPhaseKind::kBruteForce;  // never kAuto
  bool friction = false;
  bool restitution = false;
  bool damping = false;
  bool fields = false;
  bool second_integrator = false;  // a flight that is not semi-implicit Euler
  bool sleeping = false;
  bool continuous = false;
  bool joints = false;
};

Model choose_model(const WorldSettings& settings, const Needs& needs);
std::vector<Feature> explain_model(const WorldSettings& settings, const Needs& needs);

}  // namespace urto

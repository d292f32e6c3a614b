// A heavy box on a light one, and a beam on two supports.

#include <algorithm>
#include <cmath>
#include <string>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

// The heavy box has the light one's mass times `ratio`. `light` is the light one's edge, the heavy one's is 1 m.
double heavy_sinks(Lab& lab, double ratio, double light) {
  Scene scene;
  scene.add(floor_of(100));
  scene.add(box_at({0, light / 2}, light, light));
  const std::size_t heavy = scene.add(box_at({0, light + 0.5}, 1, 1));
  scene.bodies[heavy].shapes[0].material.density = ratio * light * light;
  Run run(lab, scene);
  run.seconds(10);
  const double deepest = run.overlap_max();
  const double sunk = (run.body(heavy).position - scene.bodies[heavy].position).norm();
  return std::max(deepest, sunk) / light;
}

// A beam of 10 m, a hundredth as thick, on two discs L = 8 m apart; a box at a. With its own weight B in the middle,
// R₁ = W (L − a)/L + B/2.
double support_force(Lab& lab, double load_at) {
  constexpr double kSpan = 8, kLength = 10, kThickness = 0.1, kLoad = 0.5, kRadius = 0.1;
  Scene scene;
  for (const double x : {0.0, kSpan}) scene.add(ball_at({x, -kRadius}, kRadius, BodyType::kStatic));
  scene.add(box_at({kSpan / 2, kThickness / 2}, kLength, kThickness));
  scene.add(box_at({load_at, kThickness + kLoad / 2}, kLoad, kLoad));
  scene.bodies[3].shapes[0].material.density = 20;
  Run run(lab, scene);
  run.seconds(10);
  double force = 0;
  for (const Touch& touch : run.touches())
    if (touch.a == 0 || touch.b == 0) force += touch.normal_impulse / run.time_step();
  const double load = mass_of(scene.bodies[3]) * kGravity, beam = mass_of(scene.bodies[2]) * kGravity;
  return std::abs(force / (load * (kSpan - load_at) / kSpan + beam / 2) - 1);
}

}  // namespace

void add_ratio_cases(std::vector<Case>& cases) {
  for (const int exponent : {2, 3, 4, 6}) {
    for (const double light : {1.0, 0.4}) {
      std::vector<Level> levels{{Profile::kPrecise, 1e-4}};
      if (exponent <= 3) levels.push_back({Profile::kDefault, 0.01});
      const double ratio = std::pow(10, exponent);
      cases.push_back({25, std::string("mass_ratio_1e") + std::to_string(exponent) + (light < 1 ? "_small" : ""),
                       std::string("a box 10^") + std::to_string(exponent) + " times as heavy on a " +
                           (light < 1 ? "smaller" : "light") + " one, 10 s",
                       "sinks or moves, over the light one's size", "relative", levels,
                       [ratio, light](Lab& lab) { return heavy_sinks(lab, ratio, light); }});
    }
  }
  for (const int at : {1, 2, 4})
    cases.push_back({26,
                     std::string("bridge_") + std::to_string(at),
                     std::string("a beam 100:1 on two supports 8 m apart, a load at ") + std::to_string(at) + " m",
                     "error of a support's force",
                     "relative",
                     {{Profile::kPrecise, 1e-6}, {Profile::kDefault, 0.01}},
                     [at](Lab& lab) { return support_force(lab, at); }});
}

}  // namespace urto::accuracy

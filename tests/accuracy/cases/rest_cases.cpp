// What rests, rests; and Painlevé's rod, for which rigid bodies with Coulomb's friction have no answer.

#include <algorithm>
#include <cmath>
#include <string>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

Scene stack_of(int count) {
  Scene scene;
  scene.add(floor_of(100));
  for (int i = 0; i < count; ++i) scene.add(box_at({0, i + 0.5}, 1, 1));
  return scene;
}

constexpr double kMinute = 60, kLastSeconds = 10;

double rest_speed(Lab& lab, int count) {
  Run run(lab, stack_of(count));
  run.seconds(kMinute - kLastSeconds);
  double worst = 0;
  for (long step = std::lround(kLastSeconds / run.time_step()); step > 0; --step) {
    run.steps(1);
    worst = std::max(worst, run.speed_max());
  }
  return worst;
}

// By how much the energy ever passed that of the start, as a share of it.
double rest_energy(Lab& lab, int count) {
  Run run(lab, stack_of(count));
  const double start = run.energy(kGravity);
  double worst = 0;
  for (long step = std::lround(kMinute / run.time_step()); step > 0; --step) {
    run.steps(1);
    worst = std::max(worst, run.energy(kGravity) / start - 1);
  }
  return worst;
}

// A slender rod whose end slides over the floor. With t = tan θ and μ > (4 + t²)/3t the equations of a sliding rod have
// no solution, or more than one (Painlevé 1895): the least such μ is 4/3 at t = 2. Energy may never grow; the figure is
// the greatest rise above the least so far, as a share of what there was.
double rod_energy(Lab& lab, double friction) {
  constexpr double kLength = 2, kThickness = 0.02, kSpeed = 5;
  const double angle = std::atan(2.0);
  double worst = 0;
  for (const double direction : {-1.0, 1.0}) {
    Scene scene;
    scene.add(with_friction(floor_of(200), friction));
    BodyDef rod = with_friction(box_at({0, 0}, kLength, kThickness), friction);
    rod.angle = angle;
    // Its lower right corner is its lowest point.
    rod.position.y() = -turned({-kLength / 2, -kThickness / 2}, angle).y();
    rod.position.y() = std::max(rod.position.y(), -turned({-kLength / 2, kThickness / 2}, angle).y());
    rod.velocity = {direction * kSpeed, 0};
    scene.add(rod);
    Run run(lab, scene);
    const double start = run.energy(kGravity);
    double least = start;
    for (long step = std::lround(5 / run.time_step()); step > 0; --step) {
      run.steps(1);
      const double now = run.energy(kGravity);
      if (!std::isfinite(now)) return now;
      worst = std::max(worst, (now - least) / start);
      least = std::min(least, now);
    }
  }
  return worst;
}

}  // namespace

void add_rest_cases(std::vector<Case>& cases) {
  for (const int count : {1, 5}) {
    const std::string suffix = numbered(count), what = std::to_string(count) + " resting boxes, a minute";
    cases.push_back({21,
                     "rest_speed" + suffix,
                     what,
                     "speed in the last 10 s",
                     "m/s",
                     {{Profile::kDefault, 1e-4}},
                     [count](Lab& lab) { return rest_speed(lab, count); }});
    cases.push_back({21,
                     "rest_energy" + suffix,
                     what,
                     "energy beyond that of the start",
                     "relative",
                     {{Profile::kPrecise, 1e-12}},
                     [count](Lab& lab) { return rest_energy(lab, count); }});
  }
  for (const double friction : {1.2, 1.5})
    cases.push_back({22,
                     std::string("painleve_") + std::to_string(std::lround(friction * 10)),
                     "Painlevé's rod at tan θ = 2 slides at 5 m/s, either way: energy never grows",
                     "greatest rise of the energy",
                     "relative",
                     // Of rounding alone: 300 steps of either scalar.
                     {{Profile::kPrecise, 1e-12}, {Profile::kDefault, 1e-5}},
                     [friction](Lab& lab) { return rod_energy(lab, friction); }});
}

}  // namespace urto::accuracy

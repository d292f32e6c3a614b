// Bodies so fast and walls so thin that a step leads far past them.

#include <algorithm>
#include <cmath>
#include <string>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

enum class Target { kStatic, kKinematic, kDynamic, kEachOther };

constexpr double kStep = 1.0 / 60;
constexpr double kWallHeight = 3;                   // m
constexpr double kRatioMin = 10, kRatioMax = 1000;  // way of a step over thickness

// A shot: the projectile, and what it must not pass.
struct Shot {
  BodyDef projectile, target;
};

Shot random_shot(Random& random, Target target, bool turning) {
  const double thickness = random.between(0.02, 0.2);
  const double speed = thickness / kStep * kRatioMin * std::pow(kRatioMax / kRatioMin, random.between(0, 1));
  Shot shot;
  shot.projectile = box_at({-random.between(0.2, 1.2) * speed * kStep - 1, 0}, thickness, 0.2);
  shot.projectile.velocity = {speed, 0};
  if (turning) {
    shot.projectile.angle = random.between(-3, 3);
    shot.projectile.angular_velocity = random.between(-100, 100);
  }
  if (target == Target::kEachOther) {
    shot.target = shot.projectile;
    shot.target.position.x() = -shot.projectile.position.x() + random.between(0, speed * kStep);
    shot.target.velocity = {-speed, 0};
    shot.target.angular_velocity *= -0.7;
    return shot;
  }
  const BodyType types[] = {BodyType::kStatic, BodyType::kKinematic, BodyType::kDynamic};
  shot.target = box_at({0, 0}, thickness, kWallHeight, types[static_cast<int>(target)]);
  if (target == Target::kKinematic) shot.target.velocity = {-1, 0};
  if (target == Target::kDynamic) shot.target.shapes[0].material.density = 10;
  return shot;
}

constexpr double kUnchanged = 1e-6;  // of a speed: rounding in float

// Shots that end behind what they were fired at. Twelve steps: the longest way to the target takes four. Each in a
// world of its own, or what glances off one target flies on and strikes others before their own shots do.
double missed(Lab& lab, Target target, bool turning, int shots) {
  Random random(12);
  long count = 0;
  for (int i = 0; i < shots; ++i) {
    const Shot shot = random_shot(random, target, turning);
    Scene scene = weightless();
    scene.add(with_friction(shot.projectile, 0));
    scene.add(with_friction(shot.target, 0));
    Run run(lab, scene);
    run.seconds(12 * kStep);
    const BodyState projectile = run.body(0), wall = run.body(1);
    bool passed = !(projectile.position.x() < wall.position.x());
    // Two that turn may glance off each other and fly on. They have met if one of them knows of it.
    if (target == Target::kEachOther && turning)
      passed &= projectile.velocity.isApprox(shot.projectile.velocity, kUnchanged);
    count += passed;
  }
  return static_cast<double>(count);
}

// An elastic shot at a static wall: where it is afterwards tells when it struck. x = x_w − v(T − t*).
double time_of_impact(Lab& lab) {
  Random random(13);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Shot shot = random_shot(random, Target::kStatic, false);
    Scene scene = weightless();
    scene.add(with_friction(with_restitution(shot.projectile, 1), 0));
    scene.add(with_friction(with_restitution(shot.target, 1), 0));
    Run run(lab, scene);
    run.seconds(12 * kStep);
    const double speed = shot.projectile.velocity.x();
    const double thickness = std::get<Box>(shot.target.shapes[0].geometry).width;  // both halves: of box and wall
    const double way = -thickness - shot.projectile.position.x();
    const double expected = -thickness - speed * (run.time() - way / speed);
    worst = std::max(worst, std::abs(run.body(0).position.x() - expected) / speed);
  }
  return worst;
}

}  // namespace

void add_fast_body_cases(std::vector<Case>& cases) {
  const struct {
    const char* name;
    Target target;
  } targets[] = {{"static", Target::kStatic},
                 {"kinematic", Target::kKinematic},
                 {"dynamic", Target::kDynamic},
                 {"each_other", Target::kEachOther}};
  for (const auto& [name, target] : targets) {
    for (const bool turning : {false, true}) {
      const std::string full = std::string("missed_") + name + (turning ? "_turning" : "");
      const std::string what = target == Target::kEachOther ? "each other" : std::string("a thin ") + name + " wall";
      cases.push_back({12,
                       full,
                       "10⁴ fast thin boxes at " + what + (turning ? ", turning" : ""),
                       "passed through",
                       "",
                       {{Profile::kDefault, 0}, {Profile::kPrecise, 0}},
                       [target = target, turning](Lab& lab) { return missed(lab, target, turning, 10000); }});
    }
  }
  cases.push_back({12,
                   "time_of_impact",
                   "100 elastic shots at a thin static wall: when they struck",
                   "error of the time",
                   "s",
                   {{Profile::kPrecise, 1e-6}},
                   time_of_impact});
}

}  // namespace urto::accuracy

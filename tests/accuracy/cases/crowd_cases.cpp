// 225 discs in a box: a heap, and a gas.

#include <algorithm>
#include <cmath>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

constexpr double kRadius = 0.2, kWidth = 7, kMass = 10;  // m, m, kg
constexpr double kSpacing = 0.45;                        // m
constexpr double kSeconds = 10;
constexpr std::size_t kWalls = 4;

// The best of the peers in these two cases (Chipmunk 7.0.3), which the default profile is to be below.
constexpr double kBestPeerHeapOverlap = 2.93e-3, kBestPeerGasEnergy = 4.3e-4;

Scene boxed(const Vec2& gravity, double friction, double restitution) {
  Scene scene;
  scene.settings.gravity = gravity;
  const double half = kWidth / 2;
  for (const BodyDef& wall :
       {box_at({0, -0.5}, kWidth + 2, 1, BodyType::kStatic), box_at({0, 10.5}, kWidth + 2, 1, BodyType::kStatic),
        box_at({-half - 0.5, 5}, 1, 10, BodyType::kStatic), box_at({half + 0.5, 5}, 1, 10, BodyType::kStatic)})
    scene.add(with_restitution(with_friction(wall, friction), restitution));
  Random random(13);
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 15; ++column) {
      const Vec2 offset(random.between(-1e-3, 1e-3), random.between(-1e-3, 1e-3));
      BodyDef def = ball_at(Vec2((column - 7) * kSpacing, 1 + kRadius + row * kSpacing) + offset, kRadius);
      def.mass = kMass;
      scene.add(with_restitution(with_friction(def, friction), restitution));
    }
  }
  return scene;
}

// Σ depth², of discs in each other and in the walls.
double overlap_squares(const Run& run) {
  const std::vector<BodyState> states = run.states();
  double sum = 0;
  for (std::size_t i = kWalls; i < states.size(); ++i) {
    const Vec2& p = states[i].position;
    for (const double depth : {kRadius - p.y(), kRadius - (kWidth / 2 - std::abs(p.x()))})
      sum += std::pow(std::max(0.0, depth), 2);
    for (std::size_t j = i + 1; j < states.size(); ++j)
      sum += std::pow(std::max(0.0, 2 * kRadius - (p - states[j].position).norm()), 2);
  }
  return sum;
}

// The mean over the steps, as SimBenchmark's test of hard contacts has it (Hwangbo, Kang and Hutter).
double heap_overlap(Lab& lab) {
  Run run(lab, boxed({0, -kGravity}, 0.5, 0));
  const long steps = std::lround(kSeconds / run.time_step());
  double sum = 0;
  for (long step = 0; step < steps; ++step) {
    run.steps(1);
    sum += overlap_squares(run);
  }
  return sum / static_cast<double>(steps);
}

double gas_energy(Lab& lab) {
  Scene scene = boxed({0, 0}, 0, 1);
  Random random(14);
  for (std::size_t i = kWalls; i < scene.bodies.size(); ++i)
    scene.bodies[i].velocity = turned({5, 0}, random.between(-kPi, kPi));
  Run run(lab, scene);
  const double start = run.kinetic_energy();
  double worst = 0;
  for (long step = std::lround(kSeconds / run.time_step()); step > 0; --step) {
    run.steps(1);
    worst = std::max(worst, std::abs(run.kinetic_energy() / start - 1));
  }
  return worst;
}

}  // namespace

void add_crowd_cases(std::vector<Case>& cases) {
  cases.push_back({13,
                   "heap_overlap",
                   "225 discs fall into a box",
                   "mean of Σ depth² over 10 s",
                   "m²",
                   {{Profile::kDefault, kBestPeerHeapOverlap}},
                   heap_overlap});
  cases.push_back({14,
                   "gas_energy",
                   "the same as an elastic gas at 5 m/s",
                   "worst error of the energy in 10 s",
                   "relative",
                   {{Profile::kDefault, kBestPeerGasEnergy}, {Profile::kPrecise, 1e-6}},
                   gas_energy});
}

}  // namespace urto::accuracy

// Bounces on a floor, elastic and not, and the cradle.

#include <algorithm>
#include <cmath>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

constexpr double kHeight = 5, kRadius = 0.5;  // m

enum class Kind { kBall, kBox };

Scene bouncer(Kind kind, double restitution, double time_step) {
  Scene scene;
  scene.settings.time_step = time_step;
  scene.add(with_restitution(floor_of(100), restitution));
  const Vec2 start(0, kHeight + kRadius);
  scene.add(with_restitution(kind == Kind::kBall ? ball_at(start, kRadius) : box_at(start, 1, 1), restitution));
  return scene;
}

double height_of(const Run& run) { return run.body(1).position.y() - kRadius; }

// Kinetic and potential, over that at the start.
double energy_share(const Run& run) {
  const BodyDef& def = run.bodies()[1];
  return (kinetic_energy(def, run.body(1)) / mass_of(def) + kGravity * height_of(run)) / (kGravity * kHeight);
}

constexpr double kMillisecond = 1e-3;

double elastic_rmse(Lab& lab) {
  Run run(lab, bouncer(Kind::kBall, 1, kMillisecond));
  double sum = 0;
  const long steps = std::lround(20 / run.time_step());
  for (long step = 0; step < steps; ++step) {
    run.steps(1);
    sum += std::pow(energy_share(run) - 1, 2);
  }
  return std::sqrt(sum / static_cast<double>(steps));
}

// By how much the fitted order of that error falls short of 2. Errors at the level of rounding have no order to fall
// short in.
double elastic_order(Lab& lab) {
  constexpr double kRounding = 1e-10;
  const double coarse = lab.with_step_scale(4, elastic_rmse), fine = lab.with_step_scale(1, elastic_rmse);
  if (coarse < kRounding && fine < kRounding) return 0;
  return std::max(0.0, 2 - std::log2(coarse / fine) / 2);
}

// The height of the first apex after a moment, from the highest sample and the speed there.
double apex_after(Run& run, double moment) {
  run.seconds(moment);
  double before = run.body(1).velocity.y();
  for (long step = std::lround(5 / run.time_step()); step > 0; --step) {
    run.steps(1);
    const double now = run.body(1).velocity.y();
    if (before > 0 && now <= 0) return height_of(run) + now * now / (2 * kGravity);
    before = now;
  }
  return height_of(run);
}

double elastic_apex(Lab& lab, Kind kind) {
  Run run(lab, bouncer(kind, 1, 1.0 / 60));
  return std::abs(apex_after(run, 10) / kHeight - 1);
}

// ---- e = 0.8 ----

constexpr double kRestitution = 0.8;
constexpr int kApexes = 5;

// The n-th apex is e²ⁿ H.
double damped_apexes(Lab& lab) {
  Run run(lab, bouncer(Kind::kBall, kRestitution, 1.0 / 60));
  double worst = 0;
  for (int n = 1; n <= kApexes; ++n) {
    const double exact = std::pow(kRestitution, 2 * n) * kHeight;
    worst = std::max(worst, std::abs(apex_after(run, 0) / exact - 1));
  }
  return worst;
}

// It rests at t₀(1 + e)/(1 − e), t₀ = √(2H/g). Below this speed it counts as resting: what is left then is 2 parts in a
// thousand of that time.
constexpr double kRestSpeed = 0.02;  // m/s

double damped_rest_time(Lab& lab) {
  Run run(lab, bouncer(Kind::kBall, kRestitution, 1.0 / 60));
  const double exact = std::sqrt(2 * kHeight / kGravity) * (1 + kRestitution) / (1 - kRestitution);
  double last = 0;
  while (run.time() < 2 * exact) {
    run.steps(1);
    if (run.body(1).velocity.norm() > kRestSpeed) last = run.time();
  }
  return std::abs(last / exact - 1);
}

double damped_rests(Lab& lab) {
  Run run(lab, bouncer(Kind::kBall, kRestitution, 1.0 / 60));
  run.seconds(20);
  return run.body(1).velocity.norm();
}

// ---- The cradle ----

// Five balls in a row, the first comes at 1 m/s; between them this much room.
Run cradle(Lab& lab, double gap) {
  Scene scene = weightless();
  for (int i = 0; i < 5; ++i)
    scene.add(with_friction(with_restitution(ball_at({i * (2 * kRadius + gap), 0}, kRadius), 1), 0));
  scene.bodies[0].position.x() = -1;
  scene.bodies[0].velocity.x() = 1;
  Run run(lab, scene);
  run.seconds(3);
  return run;
}

double cradle_error(Lab& lab, double gap) {
  const Run run = cradle(lab, gap);
  double momentum = 0, energy = 0;
  for (int i = 0; i < 5; ++i) {
    momentum += run.body(i).velocity.x();
    energy += run.body(i).velocity.squaredNorm();
  }
  return std::max({std::abs(momentum - 1), std::abs(energy - 1), std::abs(run.body(4).velocity.x() - 1)});
}

}  // namespace

void add_bounce_cases(std::vector<Case>& cases) {
  cases.push_back({7,
                   "elastic_rmse",
                   "a ball of restitution 1 falls 5 m and bounces for 20 s, h = 1 ms",
                   "root mean square of the energy's error",
                   "relative",
                   {{Profile::kPrecise, 5.7e-6}},
                   elastic_rmse});
  cases.push_back({7,
                   "elastic_order",
                   "the same: order of that error in h, h = 4 and 1 ms",
                   "short of 2 by",
                   "",
                   {{Profile::kPrecise, 0.05}},
                   elastic_order});
  cases.push_back({7,
                   "elastic_apex_ball",
                   "the same at 1/60 s: first apex after 10 s",
                   "error of the apex",
                   "relative",
                   {{Profile::kDefault, 0.02}},
                   [](Lab& lab) { return elastic_apex(lab, Kind::kBall); }});
  cases.push_back({7,
                   "elastic_apex_box",
                   "the same of a box",
                   "error of the apex",
                   "relative",
                   {{Profile::kDefault, 0.02}},
                   [](Lab& lab) { return elastic_apex(lab, Kind::kBox); }});
  cases.push_back({8,
                   "damped_apexes",
                   "a ball of restitution 0.8: its first five apexes are e²ⁿH",
                   "error of the worst apex",
                   "relative",
                   {{Profile::kPrecise, 1e-3}, {Profile::kDefault, 0.03}},
                   damped_apexes});
  cases.push_back({8,
                   "damped_rest_time",
                   "the same: it rests at t₀(1+e)/(1−e)",
                   "error of the time",
                   "relative",
                   {{Profile::kPrecise, 0.01}},
                   damped_rest_time});
  cases.push_back({8,
                   "damped_rests",
                   "the same: after 20 s it rests",
                   "speed",
                   "m/s",
                   {{Profile::kPrecise, 1e-4}, {Profile::kDefault, 1e-4}},
                   damped_rests});
  cases.push_back({9,
                   "cradle",
                   "five elastic balls with gaps of 1 mm: the last leaves with all",
                   "momentum, energy or speed of the last off by",
                   "relative",
                   {{Profile::kPrecise, 1e-12}},
                   [](Lab& lab) { return cradle_error(lab, 1e-3); }});
  cases.push_back({9,
                   "cradle_touching",
                   "the same without gaps: how far from a real cradle",
                   "momentum, energy or speed of the last off by",
                   "relative",
                   {},
                   [](Lab& lab) { return cradle_error(lab, 0); }});
}

}  // namespace urto::accuracy

// An oscillator, whose energy each integrator keeps in its own way, and a way back in time; momentum of a crowd.

#include <algorithm>
#include <cmath>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

constexpr double kStep = 1.0 / 60;
constexpr double kOmegaStep = 0.1;             // ω h
constexpr double kOmega = kOmegaStep / kStep;  // rad/s
constexpr double kAmplitude = 1;               // m

Scene oscillator() {
  Scene scene = weightless();
  scene.settings.sub_steps = 1;
  scene.add(ball_at({kAmplitude, 0}, 0.1));
  scene.bodies[0].mass = 1;
  scene.settings.fields.push_back(Spring{{0, 0}, kOmega * kOmega, 0});
  return scene;
}

double energy_of(const Run& run) {
  const BodyState state = run.body(0);
  return 0.5 * state.velocity.squaredNorm() + 0.5 * kOmega * kOmega * state.position.squaredNorm();
}

struct EnergyRange {
  double low = 1, high = 1, last = 1;  // shares of what there was at the start
};

EnergyRange oscillate(Lab& lab, double duration) {
  Run run(lab, oscillator());
  const double start = energy_of(run);
  EnergyRange range;
  for (long step = std::lround(duration / run.time_step()); step > 0; --step) {
    run.steps(1);
    range.last = energy_of(run) / start;
    range.low = std::min(range.low, range.last);
    range.high = std::max(range.high, range.last);
  }
  return range;
}

double oscillator_energy(Lab& lab) {
  const EnergyRange range = oscillate(lab, 60);
  return std::max(range.high - 1, 1 - range.low);
}

constexpr double kHour = 3600;
constexpr double kGrowthSeconds = 10;  // of explicit Euler: in an hour it would pass every number

// From backward error analysis of x'' = −ω²x (Hairer, Lubich and Wanner, Geometric Numerical Integration, ch. IX), from
// rest at the amplitude:
//   semi-implicit Euler  keeps ½v² + ½ω²x² − ½hω²xv, whose last term swings by ±ωh/2 of the energy
//   Verlet               keeps ½v² + ½ω²x²(1 − (ωh)²/4): the energy swings by (ωh)²/4
//   Runge-Kutta 4        |R(iωh)|² = 1 − (ωh)⁶/72 + …, a step
//   explicit Euler       |1 + iωh|² = 1 + (ωh)², a step
double oscillator_law(Lab& lab) {
  const Integrator integrator = lab.method().integrator.value_or(Integrator::kSemiImplicitEuler);
  const EnergyRange range = oscillate(lab, integrator == Integrator::kExplicitEuler ? kGrowthSeconds : kHour);
  const double swing = std::max(range.high - 1, 1 - range.low);
  switch (integrator) {
    case Integrator::kSemiImplicitEuler:
      return std::abs(swing / (kOmegaStep / 2) - 1);
    case Integrator::kVerlet:
      return std::abs(swing / (kOmegaStep * kOmegaStep / 4) - 1);
    case Integrator::kRungeKutta4: {
      const double steps = kHour / kStep;
      return std::abs(std::log(range.last) / (-std::pow(kOmegaStep, 6) / 72 * steps) - 1);
    }
    case Integrator::kExplicitEuler:
      break;
  }
  const double steps = kGrowthSeconds / kStep;
  return std::abs(std::log(range.last) / (std::log1p(kOmegaStep * kOmegaStep) * steps) - 1);
}

double time_reversal(Lab& lab) {
  Run run(lab, oscillator());
  run.steps(10000);
  run.set_velocity(0, -run.body(0).velocity, 0);
  run.steps(10000);
  return (run.body(0).position - Vec2(kAmplitude, 0)).norm();
}

// ---- Momentum ----

struct Momentum {
  Vec2 linear{0, 0};
  double angular = 0;
  double linear_scale = 0, angular_scale = 0;  // sums of the parts' magnitudes
};

Momentum momentum_of(const Run& run) {
  Momentum sum;
  for (std::size_t i = 0; i < run.bodies().size(); ++i) {
    const BodyState state = run.body(i);
    const Vec2 linear = state.velocity * mass_of(run.bodies()[i]);
    const double orbital = state.position.x() * linear.y() - state.position.y() * linear.x();
    const double own = inertia_of(run.bodies()[i]) * state.angular_velocity;
    sum.linear += linear;
    sum.angular += orbital + own;
    sum.linear_scale += linear.norm();
    sum.angular_scale += std::abs(orbital) + std::abs(own);
  }
  return sum;
}

// 200 boxes of many sizes fly towards each other and past, turning. Nothing acts from outside.
Scene crowd_in_free_space() {
  Scene scene = weightless();
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const Vec2 place(1.6 * (i % 20 - 9.5), 1.6 * (i / 20 - 4.5));
    BodyDef def = box_at(place, random.between(0.4, 1), random.between(0.4, 1));
    def.angle = random.between(-3, 3);
    def.velocity = -0.3 * place + Vec2(random.between(-1, 1.5), random.between(-1, 1));
    def.angular_velocity = random.between(-3, 4);
    scene.add(with_restitution(def, 0.3));
  }
  return scene;
}

double crowd_momentum(Lab& lab) {
  Run run(lab, crowd_in_free_space());
  const Momentum start = momentum_of(run);
  run.steps(std::lround(10000 / lab.method().step_scale));
  const Momentum end = momentum_of(run);
  return std::max((end.linear - start.linear).norm() / start.linear_scale,
                  std::abs(end.angular - start.angular) / start.angular_scale);
}

}  // namespace

void add_oscillation_cases(std::vector<Case>& cases) {
  cases.push_back({4,
                   "oscillator_energy",
                   "an oscillator of ωh = 0.1, a minute",
                   "energy error",
                   "relative",
                   {},
                   oscillator_energy,
                   Curves::kIntegrators});
  cases.push_back({4,
                   "oscillator_law",
                   "the same for an hour against each integrator's own law",
                   "deviation from the law",
                   "relative",
                   {{Profile::kExplicitEuler, 0.1},
                    {Profile::kSemiImplicitEuler, 0.1},
                    {Profile::kVerlet, 0.1},
                    {Profile::kRungeKutta4, 0.1}},
                   oscillator_law,
                   Curves::kIntegrators});
  cases.push_back({5,
                   "time_reversal",
                   "an oscillator, 10⁴ steps there and 10⁴ back",
                   "distance from the start",
                   "m",
                   {{Profile::kVerlet, 1e-12}},
                   time_reversal,
                   Curves::kIntegrators});
  cases.push_back({6,
                   "crowd_momentum",
                   "200 boxes collide in free space, 10⁴ steps",
                   "change of momentum",
                   "relative",
                   {{Profile::kPrecise, 1e-12}, {Profile::kDefault, 1e-5}},
                   crowd_momentum});
}

}  // namespace urto::accuracy

// Motion without contact: parabolas, free spins, and the order of the integrators on forces that are not linear.

#include <algorithm>
#include <cmath>

#include "accuracy/case.h"
#include "accuracy/cases/order.h"

namespace urto::accuracy {
namespace {

constexpr double kSeconds = 10;
const Vec2 kStart(1, 2), kThrow(3, 50);

Vec2 thrown(Lab& lab, double& sub_step, Integrator& integrator) {
  Scene scene;
  scene.add(box_at(kStart, 1, 1));
  scene.bodies[0].velocity = kThrow;
  Run run(lab, scene);
  run.seconds(kSeconds);
  sub_step = run.sub_step();
  integrator = run.integrator();
  return run.body(0).position;
}

Vec2 parabola() { return kStart + kThrow * kSeconds + Vec2(0, -kGravity) * (kSeconds * kSeconds / 2); }

double ballistic(Lab& lab) {
  double sub_step = 0;
  Integrator integrator{};
  return (thrown(lab, sub_step, integrator) - parabola()).norm();
}

// n steps of h with v first: x_n = x₀ + v₀nh − g h² n(n+1)/2, so the error at t = nh is −½ g h t; with x first the sum
// runs to n−1 and the error is +½ g h t. Verlet and Runge-Kutta 4 are exact on a parabola.
double ballistic_law(Lab& lab) {
  double sub_step = 0;
  Integrator integrator{};
  const Vec2 at = thrown(lab, sub_step, integrator);
  double law = 0;
  if (integrator == Integrator::kSemiImplicitEuler) law = -0.5 * kGravity * sub_step * kSeconds;
  if (integrator == Integrator::kExplicitEuler) law = 0.5 * kGravity * sub_step * kSeconds;
  const Vec2 expected = parabola() + Vec2(0, law);
  return (at - expected).norm() / expected.norm();
}

constexpr long kSpinSteps = 10000;

BodyState spun(Lab& lab, double speed, double& time) {
  Scene scene = weightless();
  scene.add(box_at({0, 0}, 10, 0.1));
  scene.bodies[0].angular_velocity = speed;
  Run run(lab, scene);
  run.steps(std::lround(kSpinSteps / lab.method().step_scale));
  time = run.time();
  return run.body(0);
}

double spin_angle(Lab& lab, double speed) {
  double time = 0;
  const BodyState state = spun(lab, speed, time);
  // In long double, or the rounding of 2π alone would be as large as what is allowed.
  constexpr long double kTurn = 6.283185307179586476925286766559L;
  const long double expected = static_cast<long double>(speed) * time;
  return static_cast<double>(std::abs(std::remainder(static_cast<long double>(state.angle) - expected, kTurn)));
}

// Without contact neither may change at all: the speed of the turn is what both follow from.
double spin_energy(Lab& lab, double speed) {
  double time = 0;
  const BodyState state = spun(lab, speed, time);
  const double ratio = state.angular_velocity / speed;
  return std::max({std::abs(ratio - 1), std::abs(ratio * ratio - 1), state.velocity.norm()});
}

// ---- Kepler's orbit ----

constexpr double kEccentricity = 0.3, kSemiMajorAxis = 10.0, kPeriod = 10.0;  // m, s
constexpr double kOrbitShare = 0.37;  // of the period: at a whole one semi-implicit Euler looks second-order

double attraction() {  // Kepler's third law: a³ (2π / T)²
  return std::pow(kSemiMajorAxis, 3) * std::pow(2 * kPi / kPeriod, 2);
}

// From the periapsis on the x axis, by Kepler's equation M = E − e sin E (Newton's method).
Vec2 on_orbit(double time) {
  const double mean = 2 * kPi * time / kPeriod;
  double eccentric = mean;
  for (int i = 0; i < 50; ++i)
    eccentric -= (eccentric - kEccentricity * std::sin(eccentric) - mean) / (1 - kEccentricity * std::cos(eccentric));
  return {kSemiMajorAxis * (std::cos(eccentric) - kEccentricity),
          kSemiMajorAxis * std::sqrt(1 - kEccentricity * kEccentricity) * std::sin(eccentric)};
}

double orbit_error(Lab& lab, double time_step, long steps) {
  Scene scene = weightless();
  scene.settings.time_step = time_step;
  scene.settings.sub_steps = 1;
  scene.settings.fields.push_back(PointAttractor{{0, 0}, attraction(), 0});
  scene.add(ball_at(on_orbit(0), 0.1));
  const double r = kSemiMajorAxis * (1 - kEccentricity);
  scene.bodies[0].velocity = {0, std::sqrt(attraction() * (2 / r - 1 / kSemiMajorAxis))};
  Run run(lab, scene);
  run.steps(steps);
  return (run.body(0).position - on_orbit(run.time())).norm();
}

double orbit(Lab& lab) {
  const long steps = std::lround(kOrbitShare * kPeriod * 60 / lab.method().step_scale);
  return orbit_error(lab, kOrbitShare * kPeriod / static_cast<double>(steps) / lab.method().step_scale, steps);
}

// ---- The fitted order ----

double orbit_order(Lab& lab) { return order_error(lab, kOrbitShare * kPeriod, 3200, 200, orbit_error); }

// ---- A fall through air with quadratic drag ----

// v = v∞ tanh(g t / v∞), y = −v∞²/g · ln cosh(g t / v∞), v∞ = √(m g / k).
double drag_error(Lab& lab, double time_step, long steps) {
  Scene scene;
  scene.settings.time_step = time_step;
  scene.settings.sub_steps = 1;
  scene.settings.fields.push_back(Drag{0, 0.05});
  scene.add(box_at({0, 0}, 1, 1));
  Run run(lab, scene);
  run.steps(steps);
  const double terminal = std::sqrt(kGravity / 0.05);
  const double exact = -terminal * terminal / kGravity * std::log(std::cosh(kGravity * run.time() / terminal));
  return std::abs(run.body(0).position.y() - exact);
}

double drag_order(Lab& lab) { return order_error(lab, 2, 200, 40, drag_error); }

}  // namespace

void add_flight_cases(std::vector<Case>& cases) {
  cases.push_back({1,
                   "ballistic",
                   "a box thrown up at 50 m/s, 10 s against the parabola",
                   "position error",
                   "m",
                   {{Profile::kPrecise, 1e-12}},
                   ballistic,
                   Curves::kIntegrators});
  cases.push_back({1, "ballistic_law", "the same against each integrator's own law of error", "deviation from the law",
                   "relative", for_integrators(1e-12), ballistic_law, Curves::kIntegrators});
  for (const double speed : {1.0, 20.0, 100.0, 500.0}) {
    const std::string suffix = numbered(std::lround(speed));
    const double turn = speed * kSpinSteps / 60;
    cases.push_back({2,
                     "spin_angle" + suffix,
                     "a plate 100:1 turns freely for 10⁴ steps, θ = ωt",
                     "angle error",
                     "rad",
                     {{Profile::kPrecise, 1e-12 + 2e-16 * turn}, {Profile::kDefault, 1e-5 * turn}},
                     [speed](Lab& lab) { return spin_angle(lab, speed); },
                     Curves::kIntegrators});
    cases.push_back({2,
                     "spin_energy" + suffix,
                     "the same: energy and angular momentum stay",
                     "change",
                     "relative",
                     {{Profile::kPrecise, 1e-12}, {Profile::kDefault, 1e-6}},
                     [speed](Lab& lab) { return spin_energy(lab, speed); },
                     Curves::kIntegrators});
  }
  cases.push_back({3,
                   "orbit",
                   "Kepler's orbit of eccentricity 0.3 at 0.37 of its period",
                   "position error",
                   "m",
                   {},
                   orbit,
                   Curves::kIntegrators});
  cases.push_back({3, "orbit_order", "the same: the order in h", "deviation of the fitted order", "",
                   for_integrators(0.05), orbit_order, Curves::kIntegrators});
  cases.push_back({3, "drag_order", "a fall with quadratic drag, 2 s against ln cosh: the order in h",
                   "deviation of the fitted order", "", for_integrators(0.05), drag_order, Curves::kIntegrators});
}

}  // namespace urto::accuracy

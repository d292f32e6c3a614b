// Rectangles that strike a floor with one corner: what the impulse must be, and that no energy comes from it.

#include <algorithm>
#include <cmath>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

// Each rectangle has a floor of its own, so that distances stay small and nobody meets anybody.
constexpr double kLane = 20;  // m

struct Strike {
  BodyDef body;
  Vec2 arm{0, 0};  // from the centre to the corner that strikes, at the start
  double restitution = 0;
};

// A corner a little above y = 0, well below the others, comes down.
Strike random_strike(Random& random, double lane_x, double friction, double spin) {
  Strike strike;
  const double w = random.between(0.2, 2), h = random.between(0.2, 2), angle = random.between(0.15, kPi / 2 - 0.15);
  strike.restitution = random.between(0, 1);
  strike.body = box_at({0, 0}, w, h);
  strike.body.angle = angle;
  strike.arm = turned({-w / 2, -h / 2}, angle);
  for (const Vec2& corner : {Vec2(w / 2, -h / 2), Vec2(-w / 2, h / 2)})
    if (turned(corner, angle).y() < strike.arm.y()) strike.arm = turned(corner, angle);
  strike.body.position = Vec2(lane_x, random.between(0.02, 0.1)) - Vec2(0, strike.arm.y());
  strike.body.velocity = {random.between(-3, 3), random.between(-4, -1)};
  strike.body.angular_velocity = spin * random.between(-1, 1);
  strike.body = with_friction(with_restitution(strike.body, strike.restitution), friction);
  return strike;
}

Scene lanes() {
  Scene scene = weightless();
  scene.settings.friction_mixing = Mixing::kMaximum;
  scene.settings.restitution_mixing = Mixing::kMaximum;
  return scene;
}

void add_lane(Scene& scene, const Strike& strike, double lane_x) {
  BodyDef ground = box_at({lane_x, -0.5}, 10, 1, BodyType::kStatic);
  scene.add(with_restitution(with_friction(ground, 0), 0));
  scene.add(strike.body);
}

// Without friction and spin the arm at the impact is that at the start, and j = −(1 + e) vₙ / kₙ with
// kₙ = 1/m + (r × n)²/I. The error is that of the speeds after it, the turn's times the arm's length.
double frictionless(Lab& lab) {
  Random random(10);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Strike strike = random_strike(random, 0, 0, 0);
    Scene scene = lanes();
    add_lane(scene, strike, 0);
    Run run(lab, scene);
    const Vec2 before = run.body(1).velocity;  // as the engine's scalars hold it
    for (int step = 0; step < 30 && run.body(1).velocity == before; ++step) run.steps(1);
    const double m = mass_of(strike.body), inertia = inertia_of(strike.body), lever = strike.arm.x();
    const double k = 1 / m + lever * lever / inertia;
    const double impulse = -(1 + strike.restitution) * strike.body.velocity.y() / k;
    const Vec2 velocity = strike.body.velocity + Vec2(0, impulse / m);
    const auto off_now = [&] {
      const BodyState after = run.body(1);
      return (after.velocity - velocity).norm() +
             std::abs(after.angular_velocity - lever * impulse / inertia) * strike.arm.norm();
    };
    double off = off_now();
    run.steps(1);  // an impact may be spread over two steps
    off = std::min(off, off_now());
    worst = std::max(worst, off / std::abs(strike.body.velocity.y()));
  }
  return worst;
}

// ---- With friction ----

constexpr int kImpacts = 100000;
constexpr int kLanesPerWorld = 250;

struct Gains {
  long count = 0;       // bodies whose energy was ever greater than before
  double greatest = 0;  // share gained
};

Gains gains_of(Lab& lab, int impacts, double tolerance) {
  Random random(11);
  Gains gains;
  for (int done = 0; done < impacts; done += kLanesPerWorld) {
    Scene scene = lanes();
    for (int lane = 0; lane < kLanesPerWorld; ++lane)
      add_lane(scene, random_strike(random, lane * kLane, random.between(0, 1), 5), lane * kLane);
    Run run(lab, scene);
    run.steps(30);
    for (int lane = 0; lane < kLanesPerWorld; ++lane) {
      const BodyDef& def = scene.bodies[2 * lane + 1];
      const BodyState start{BodyType::kDynamic, def.position, def.angle, def.velocity, def.angular_velocity, true};
      const double gain = kinetic_energy(def, run.body(2 * lane + 1)) / kinetic_energy(def, start) - 1;
      gains.count += !(gain <= tolerance);
      gains.greatest = std::max(gains.greatest, gain);
    }
  }
  return gains;
}

constexpr double kGainTolerance = 1e-12;

}  // namespace

void add_impact_cases(std::vector<Case>& cases) {
  cases.push_back({10,
                   "oblique_impulse",
                   "100 rectangles strike a floor with a corner, no friction: j = −(1+e) vₙ/kₙ",
                   "worst error of the speeds after it",
                   "relative",
                   {{Profile::kPrecise, 1e-12}},
                   frictionless});
  cases.push_back({11,
                   "friction_gains",
                   "10⁵ rectangles strike with friction and spin: energy never grows",
                   "impacts that gain more than 1e-12",
                   "",
                   {{Profile::kPrecise, 0}},
                   [](Lab& lab) { return static_cast<double>(gains_of(lab, kImpacts, kGainTolerance).count); }});
  cases.push_back({11, "friction_gain_max", "the same", "greatest gain of energy", "relative", {}, [](Lab& lab) {
                     return gains_of(lab, kImpacts, kGainTolerance).greatest;
                   }});
}

}  // namespace urto::accuracy

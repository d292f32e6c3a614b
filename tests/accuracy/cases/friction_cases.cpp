// Friction: slopes, stops, rolling, toppling, seams.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

// A long static slope that falls to the right, its surface through the origin, and a body that touches it at `along`.
struct Slope {
  double angle;  // rad
  Vec2 down() const { return turned({1, 0}, -angle); }
  Vec2 out() const { return turned({0, 1}, -angle); }

  Scene with(BodyDef body, double friction, double height_of_center) const {
    Scene scene;
    BodyDef ground = box_at(-out(), 1000, 2, BodyType::kStatic);
    ground.angle = -angle;
    scene.add(with_friction(ground, friction));
    body.position = out() * height_of_center;
    body.angle = -angle;
    scene.add(with_friction(body, friction));
    return scene;
  }
};

constexpr double kSlopeFriction = 0.5;

Run on_slope(Lab& lab, double degrees_beyond) {
  const Slope slope{std::atan(kSlopeFriction) + degrees(degrees_beyond)};
  return Run(lab, slope.with(box_at({0, 0}, 1, 1), kSlopeFriction, 0.5));
}

// Below the angle of friction: how fast it creeps in the second half of 10 s.
double creep(Lab& lab, double degrees_beyond) {
  Run run = on_slope(lab, degrees_beyond);
  run.seconds(5);
  const Vec2 middle = run.body(1).position;
  run.seconds(5);
  return (run.body(1).position - middle).norm() / 5;
}

double slope_acceleration(double degrees_beyond) {
  const double angle = std::atan(kSlopeFriction) + degrees(degrees_beyond);
  return kGravity * (std::sin(angle) - kSlopeFriction * std::cos(angle));
}

double slide_acceleration(Lab& lab, double degrees_beyond) {
  Run run = on_slope(lab, degrees_beyond);
  run.seconds(0.1);
  const double early = run.body(1).velocity.norm(), since = run.time();
  run.seconds(9.9);
  return std::abs((run.body(1).velocity.norm() - early) / (run.time() - since) / slope_acceleration(degrees_beyond) -
                  1);
}

double slide_distance(Lab& lab, double degrees_beyond) {
  Run run = on_slope(lab, degrees_beyond);
  const Vec2 start = run.body(1).position;
  run.seconds(10);
  const double exact = 0.5 * slope_acceleration(degrees_beyond) * run.time() * run.time();
  return std::abs((run.body(1).position - start).norm() / exact - 1);
}

// ---- A stop ----

constexpr double kStopSpeed = 5;  // m/s

double stop_distance(Lab& lab, double friction) {
  Scene scene;
  scene.add(with_friction(floor_of(100), friction));
  scene.add(with_friction(box_at({0, 0.5}, 1, 1), friction));
  scene.bodies[1].velocity = {kStopSpeed, 0};
  Run run(lab, scene);
  run.seconds(10);
  return std::abs(run.body(1).position.x() - kStopSpeed * kStopSpeed / (2 * friction * kGravity));
}

// ---- Rolling ----

constexpr double kRollSpeed = 3, kRollFriction = 0.2, kDiscRadius = 0.5;

Run slipping_disc(Lab& lab) {
  Scene scene;
  scene.add(with_friction(floor_of(200), kRollFriction));
  scene.add(with_friction(ball_at({0, kDiscRadius}, kDiscRadius), kRollFriction));
  scene.bodies[1].velocity = {kRollSpeed, 0};
  return Run(lab, scene);
}

// It slips until v/3μg, has then come 5v²/18μg, and rolls on at 2v/3.
double slip_to_roll(Lab& lab) {
  Run run = slipping_disc(lab);
  run.seconds(5);
  const double slips = kRollSpeed / (3 * kRollFriction * kGravity), final_speed = 2 * kRollSpeed / 3;
  const double distance = 5 * kRollSpeed * kRollSpeed / (18 * kRollFriction * kGravity);
  const double exact = distance + final_speed * (run.time() - slips);
  return std::max(std::abs(run.body(1).velocity.x() / final_speed - 1), std::abs(run.body(1).position.x() / exact - 1));
}

double roll_drift(Lab& lab) {
  Run run = slipping_disc(lab);
  run.seconds(5);
  const BodyState early = run.body(1);
  run.seconds(25);
  const BodyState late = run.body(1);
  return std::max(std::abs(late.velocity.x() / early.velocity.x() - 1),
                  std::abs(late.angular_velocity / early.angular_velocity - 1));
}

// It rolls with a = ⅔ g sin θ if μ ≥ tan θ / 3, else it slips with a = g (sin θ − μ cos θ).
double disc_on_slope(Lab& lab, double angle, double friction) {
  Run run(lab, Slope{angle}.with(ball_at({0, 0}, kDiscRadius), friction, kDiscRadius));
  run.seconds(0.1);
  const double early = run.body(1).velocity.norm(), since = run.time();
  run.seconds(4.9);
  const bool rolls = friction >= std::tan(angle) / 3;
  const double exact =
      rolls ? 2.0 / 3 * kGravity * std::sin(angle) : kGravity * (std::sin(angle) - friction * std::cos(angle));
  return std::abs((run.body(1).velocity.norm() - early) / (run.time() - since) / exact - 1);
}

// ---- Toppling ----

// A box of 1 m by `height` on a slope, μ = 1: it topples iff tan θ > 1 / height.
bool topples(Lab& lab, double height, double angle) {
  Run run(lab, Slope{angle}.with(box_at({0, 0}, 1, height), 1, height / 2));
  run.seconds(10);
  return std::abs(run.body(1).angle + angle) > 0.3;
}

// Where it begins to topple, by bisection within 4° of where it should.
double topple_angle(Lab& lab, double height) {
  const double exact = std::atan(1 / height);
  double low = exact - degrees(4), high = exact + degrees(4);
  for (int i = 0; i < 10; ++i) {
    const double middle = 0.5 * (low + high);
    (topples(lab, height, middle) ? high : low) = middle;
  }
  return std::abs(0.5 * (low + high) - exact) * 180 / kPi;
}

// ---- Seams ----

struct Slid {
  double slowed = 0, turned = 0;
};

Slid over_seams(Lab& lab, double tile_width) {
  Scene scene;
  for (double x = -2; x < 14; x += tile_width)
    scene.add(with_friction(box_at({x + tile_width / 2, -0.5}, tile_width, 1, BodyType::kStatic), 0));
  const std::size_t body = scene.add(with_friction(box_at({0, 0.5}, 1, 1), 0));
  scene.bodies[body].velocity = {5, 0};
  Run run(lab, scene);
  Slid worst;
  for (long step = std::lround(2 / run.time_step()); step > 0; --step) {
    run.steps(1);
    worst.slowed = std::max(worst.slowed, std::abs(run.body(body).velocity.x() / 5 - 1));
    worst.turned = std::max(worst.turned, std::abs(run.body(body).angle));
  }
  return worst;
}

// For names and for sentences: 5 and 0.5.
std::string decimal(double value) {
  char text[16];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}
std::string tenths(double value) { return std::to_string(std::lround(value * 10)); }

}  // namespace

void add_friction_cases(std::vector<Case>& cases) {
  for (const double below : {0.1, 0.5}) {
    cases.push_back({15,
                     std::string("slope_creep_") + tenths(below),
                     std::string("a box on a slope, ") + decimal(below) + "° below its angle of friction, atan 0.5",
                     "creep",
                     "m/s",
                     {{Profile::kPrecise, 1e-9}, {Profile::kDefault, 1e-5}},
                     [below](Lab& lab) { return creep(lab, -below); }});
  }
  for (const double beyond : {0.5, 5.0, 20.0}) {
    const std::string what = std::string("the same ") + decimal(beyond) + "° beyond it: a = g (sin θ − μ cos θ)";
    cases.push_back({15,
                     std::string("slide_acceleration_") + tenths(beyond),
                     what,
                     "error of the acceleration",
                     "relative",
                     {{Profile::kPrecise, 1e-6}},
                     [beyond](Lab& lab) { return slide_acceleration(lab, beyond); }});
    cases.push_back({15,
                     std::string("slide_distance_") + tenths(beyond),
                     what,
                     "error of the distance in 10 s",
                     "relative",
                     {{Profile::kDefault, 0.01}},
                     [beyond](Lab& lab) { return slide_distance(lab, beyond); }});
  }
  for (const double friction : {0.2, 0.5, 0.8})
    cases.push_back({16,
                     std::string("stop_distance_") + tenths(friction),
                     "a box stops from 5 m/s: v²/2μg",
                     "error of the distance",
                     "m",
                     {{Profile::kPrecise, 1e-4}, {Profile::kDefault, kStopSpeed / 60 / 2}},
                     [friction](Lab& lab) { return stop_distance(lab, friction); }});
  cases.push_back({17,
                   "slip_to_roll",
                   "a disc slips until it rolls: 2v/3, and 5v²/18μg on the way",
                   "error of speed or place",
                   "relative",
                   {{Profile::kPrecise, 1e-4}, {Profile::kDefault, 0.01}},
                   slip_to_roll});
  cases.push_back({17,
                   "roll_drift",
                   "the same rolls on for 25 s",
                   "change of its speeds",
                   "relative",
                   {{Profile::kPrecise, 1e-12}},
                   roll_drift});
  cases.push_back({18,
                   "disc_rolls",
                   "a disc rolls down 20°: ⅔ g sin θ",
                   "error of the acceleration",
                   "relative",
                   {{Profile::kPrecise, 1e-6}, {Profile::kDefault, 1e-3}},
                   [](Lab& lab) { return disc_on_slope(lab, degrees(20), 0.5); }});
  cases.push_back({18,
                   "disc_slips",
                   "a disc slips down 45° at μ = 0.25 < tan θ / 3",
                   "error of the acceleration",
                   "relative",
                   {{Profile::kPrecise, 1e-6}, {Profile::kDefault, 1e-3}},
                   [](Lab& lab) { return disc_on_slope(lab, degrees(45), 0.25); }});
  for (const double height : {2.0, 4.0})
    cases.push_back({19,
                     std::string("topple_") + tenths(height),
                     std::string("a box of 1 m by ") + decimal(height) + " m on a slope topples iff tan θ > w/h",
                     "error of the angle",
                     "°",
                     {{Profile::kPrecise, 0.05}, {Profile::kDefault, 0.5}},
                     [height](Lab& lab) { return topple_angle(lab, height); }});
  for (const double width : {1.0, 8.0}) {
    const std::string what =
        std::string("a box slides at 5 m/s over seams of static boxes, one every ") + decimal(width) + " m";
    cases.push_back({20,
                     std::string("seam_speed_") + tenths(width),
                     what,
                     "change of speed",
                     "relative",
                     {{Profile::kDefault, 1e-6}},
                     [width](Lab& lab) { return over_seams(lab, width).slowed; }});
    cases.push_back({20,
                     std::string("seam_angle_") + tenths(width),
                     what,
                     "angle",
                     "rad",
                     {{Profile::kDefault, 1e-6}},
                     [width](Lab& lab) { return over_seams(lab, width).turned; }});
  }
}

}  // namespace urto::accuracy

// The world in a mirror, and far from the origin.

#include <algorithm>
#include <cmath>
#include <string>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

constexpr double kSeconds = 10;

Scene pyramid_of(int rows, const Vec2& origin) {
  Scene scene;
  scene.add(floor_of(200));
  for (int row = 0; row < rows; ++row)
    for (int column = row; column < rows; ++column)
      scene.add(box_at({column - row + 0.5 * row - 0.5 * (rows - 1), row + 0.5}, 1, 1));
  for (BodyDef& def : scene.bodies) def.position += origin;
  return scene;
}

// A tilted box falls on the floor, turning.
Scene one_contact() {
  Scene scene;
  scene.add(floor_of(200));
  BodyDef def = box_at({0.3, 2}, 1, 0.6);
  def.angle = 0.4;
  def.velocity = {1, 0};
  def.angular_velocity = 2;
  scene.add(def);
  return scene;
}

Scene mirrored(Scene scene) {
  for (BodyDef& def : scene.bodies) {
    def.position.x() = -def.position.x();
    def.velocity.x() = -def.velocity.x();
    def.angle = -def.angle;
    def.angular_velocity = -def.angular_velocity;
  }
  return scene;
}

// Body i of the one against body i of the other: the farthest that they are from each other's image.
double mirror_error(Lab& lab, const Scene& scene) {
  Run here(lab, scene), there(lab, mirrored(scene));
  here.seconds(kSeconds);
  there.seconds(kSeconds);
  double worst = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyState a = here.body(i), b = there.body(i);
    worst = std::max({worst, std::abs(a.position.x() + b.position.x()), std::abs(a.position.y() - b.position.y()),
                      std::abs(std::remainder(a.angle + b.angle, 2 * kPi))});
  }
  return worst;
}

constexpr int kRows = 20;

// Against the run at the origin, in units of the last place of the distance in double precision.
double far_difference(Lab& lab, double distance) {
  const Vec2 far(distance, distance);
  Run here(lab, pyramid_of(kRows, {0, 0})), there(lab, pyramid_of(kRows, far));
  here.seconds(kSeconds);
  there.seconds(kSeconds);
  double worst = 0;
  for (std::size_t i = 1; i < here.bodies().size(); ++i)
    worst = std::max(worst, (there.body(i).position - far - here.body(i).position).cwiseAbs().maxCoeff());
  return worst / (std::nextafter(distance, 2 * distance) - distance);
}

double far_moves(Lab& lab, double distance) {
  Run run(lab, pyramid_of(kRows, {distance, distance}));
  run.seconds(kSeconds);
  double worst = 0;
  for (std::size_t i = 1; i < run.bodies().size(); ++i)
    worst = std::max(worst, (run.body(i).position - run.bodies()[i].position).norm());
  return worst;
}

}  // namespace

void add_symmetry_cases(std::vector<Case>& cases) {
  cases.push_back({31,
                   "mirror_one",
                   "a falling box and its mirror image, 10 s",
                   "farthest from the image",
                   "m or rad",
                   {{Profile::kPrecise, 0}, {Profile::kDefault, 0}},
                   [](Lab& lab) { return mirror_error(lab, one_contact()); }});
  cases.push_back({31,
                   "mirror_pyramid",
                   "a pyramid of 10 rows and its mirror image, 10 s",
                   "farthest from the image",
                   "m or rad",
                   {{Profile::kPrecise, 1e-12}, {Profile::kDefault, 1e-4}},
                   [](Lab& lab) {
                     return mirror_error(lab, pyramid_of(10, {0, 0}));
                   }});
  for (const int exponent : {4, 5, 6}) {
    const double distance = std::pow(10, exponent);
    cases.push_back(
        {32,
         std::string("far_1e") + std::to_string(exponent),
         std::string("a pyramid of 20 rows 10^") + std::to_string(exponent) + " m away and at the origin, 10 s",
         "farthest between the two",
         "ulp",
         {{Profile::kPrecise, 4}},
         [distance](Lab& lab) { return far_difference(lab, distance); }});
  }
  // Half a box: it stands. A unit in the last place of the place is a millimetre there.
  cases.push_back({32,
                   "far_stands_1e4",
                   "a pyramid of 20 rows 10⁴ m away, 10 s",
                   "farthest that a box moves",
                   "m",
                   {{Profile::kDefault, 0.5}},
                   [](Lab& lab) { return far_moves(lab, 1e4); }});
}

}  // namespace urto::accuracy

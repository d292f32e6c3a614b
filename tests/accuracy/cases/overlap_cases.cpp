// What starts deep inside each other, and scenes that press hard.

#include <algorithm>
#include <cmath>
#include <string>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

// ---- Deep overlap ----

// A grid of unit boxes, each inside its neighbours by this share of its size.
Scene overlapping(int columns, int rows, double share) {
  Scene scene = weightless();
  const double pitch = 1 - share;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) scene.add(box_at({column * pitch, row * pitch * 1.01}, 1, 1));
  return scene;
}

double exit_speed(Lab& lab, int columns, int rows, double share) {
  Run run(lab, overlapping(columns, rows, share));
  double worst = 0;
  for (long step = std::lround(5 / run.time_step()); step > 0; --step) {
    run.steps(1);
    worst = std::max(worst, run.speed_max());
  }
  return worst;
}

// By how much the kinetic energy later passes that after 1 s, over what a speed of 1 m/s would be.
double late_energy(Lab& lab, int columns, int rows, double share) {
  Run run(lab, overlapping(columns, rows, share));
  run.seconds(1);
  const double then = run.kinetic_energy();
  double worst = 0;
  for (long step = std::lround(4 / run.time_step()); step > 0; --step) {
    run.steps(1);
    worst = std::max(worst, run.kinetic_energy() - then);
  }
  return worst / (0.5 * columns * rows);
}

// ---- Scenes of Catto's solver2d, which published them as films ----

struct Settled {
  double overlap = 0;  // over the least size
  double speed = 0;    // m/s
};

Settled settle(Lab& lab, const Scene& scene, double size) {
  Run run(lab, scene);
  run.seconds(20);
  return {run.overlap_max() / size, run.speed_max()};
}

// 25 × 25 discs between four walls that leave them no room to spare.
Scene confined() {
  constexpr double kRadius = 0.5;
  constexpr int kSide = 25;
  Scene scene;
  const double width = kSide * 2 * kRadius;
  scene.add(box_at({0, -0.5}, width + 2, 1, BodyType::kStatic));
  scene.add(box_at({0, width + 0.5}, width + 2, 1, BodyType::kStatic));
  for (const double side : {-1.0, 1.0})
    scene.add(box_at({side * (width / 2 + 0.5), width / 2}, 1, width, BodyType::kStatic));
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column)
      scene.add(ball_at({(column + 0.5) * 2 * kRadius - width / 2, (row + 0.5) * 2 * kRadius}, kRadius));
  return scene;
}

// Ten rows of unit boxes, and instead of the topmost a box of 3 m that weighs `ratio` times one of them.
Scene heavy_topped(double ratio) {
  constexpr int kRows = 10;
  Scene scene;
  scene.add(floor_of(100));
  for (int row = 0; row < kRows - 2; ++row)
    for (int column = row; column < kRows; ++column)
      scene.add(box_at({column - row + 0.5 * row - 0.5 * (kRows - 1), row + 0.5}, 1, 1));
  const std::size_t top = scene.add(box_at({0, kRows - 2 + 1.5}, 3, 3));
  scene.bodies[top].mass = ratio;
  return scene;
}

// A beam of 20 m, 400 times as long as thick, falls 15 m with the two boxes of 1 m under its ends.
Scene dropped_beam() {
  Scene scene;
  scene.add(floor_of(100));
  for (const double x : {-9.0, 9.0}) scene.add(box_at({x, 15 + 0.5}, 1, 1));
  scene.add(box_at({0, 15 + 1 + 0.025}, 20, 0.05));
  return scene;
}

void add_settling(std::vector<Case>& cases, const std::string& name, const std::string& title, Scene (*make)(),
                  double size) {
  cases.push_back({30,
                   name + "_overlap",
                   title + ", after 20 s",
                   "deepest overlap, over the size",
                   "relative",
                   {{Profile::kDefault, 0.01}},
                   [make, size](Lab& lab) { return settle(lab, make(), size).overlap; }});
  cases.push_back({30,
                   name + "_speed",
                   title + ", after 20 s",
                   "greatest speed",
                   "m/s",
                   {{Profile::kDefault, 0.01}},
                   [make, size](Lab& lab) { return settle(lab, make(), size).speed; }});
}

}  // namespace

void add_overlap_cases(std::vector<Case>& cases) {
  for (const int percent : {25, 50, 90}) {
    const struct {
      const char* name;
      const char* what;
      int columns, rows;
    } kinds[] = {{"pair", "two boxes", 2, 1}, {"heap", "a heap of 50 boxes", 10, 5}};
    for (const auto& [name, what, columns, rows] : kinds) {
      const std::string title = std::string(what) + " start " + std::to_string(percent) + " % inside each other";
      const std::string suffix = std::string("_") + name + "_" + std::to_string(percent);
      const double share = percent / 100.0;
      cases.push_back(
          {29,
           "exit_speed" + suffix,
           title,
           "greatest speed",
           "m/s",
           {{Profile::kDefault, 3}},
           [=, columns = columns, rows = rows](Lab& lab) { return exit_speed(lab, columns, rows, share); }});
      cases.push_back(
          {29,
           "late_energy" + suffix,
           title,
           "energy gained after 1 s, over that at 1 m/s",
           "relative",
           // 240 steps of rounding in float.
           {{Profile::kDefault, 1e-4}},
           [=, columns = columns, rows = rows](Lab& lab) { return late_energy(lab, columns, rows, share); }});
    }
  }
  add_settling(cases, "confined", "625 discs that fill a box", confined, 1);
  add_settling(
      cases, "heavy_top_100", "a pyramid under a box 100 times as heavy", [] { return heavy_topped(100); }, 1);
  add_settling(
      cases, "heavy_top_300", "a pyramid under a box 300 times as heavy", [] { return heavy_topped(300); }, 1);
  add_settling(cases, "dropped_beam", "a beam 400:1 falls 15 m with two boxes under it", dropped_beam, 1);
}

}  // namespace urto::accuracy

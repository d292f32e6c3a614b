// Stacks and pyramids: whether they stand, and what their contacts carry.

#include <algorithm>
#include <cmath>
#include <string>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

Scene stack_of(int count) {
  Scene scene;
  scene.add(floor_of(200));
  for (int i = 0; i < count; ++i) scene.add(box_at({0, i + 0.5}, 1, 1));
  return scene;
}

Scene pyramid_of(int rows) {
  Scene scene;
  scene.add(floor_of(400));
  for (int row = 0; row < rows; ++row)
    for (int column = row; column < rows; ++column)
      scene.add(box_at({column - row + 0.5 * row - 0.5 * (rows - 1), row + 0.5}, 1, 1));
  return scene;
}

// How far the top box has sunk at the end, or what it has fallen.
double top_sinks(Lab& lab, int count, double duration) {
  Run run(lab, stack_of(count));
  run.seconds(duration);
  return std::abs(run.body(count).position.y() - (count - 0.5));
}

double drift(Lab& lab, int count, double duration) {
  Run run(lab, stack_of(count));
  run.seconds(duration);
  double worst = 0;
  for (int i = 1; i <= count; ++i) worst = std::max(worst, std::abs(run.body(i).position.x()));
  return worst;
}

// The force between box k and the one below, k from 0, against the weight (N − k) m g above: the worst, over N m g.
double force_residual(const Run& run, int count) {
  std::vector<double> forces(count, 0);
  for (const Touch& touch : run.touches())
    forces[std::max(touch.a, touch.b) - 1] += touch.normal_impulse / run.time_step();
  double worst = 0;
  for (int k = 0; k < count; ++k)
    worst = std::max(worst, std::abs(forces[k] - (count - k) * kGravity) / ((count - k) * kGravity));
  return worst;
}

double stack_forces(Lab& lab, int count) {
  Run run(lab, stack_of(count));
  run.seconds(10);
  return force_residual(run, count);
}

// ---- Pyramids ----

double moved_max(const Run& run) {
  double worst = 0;
  for (std::size_t i = 1; i < run.bodies().size(); ++i)
    worst = std::max(worst, (run.body(i).position - run.bodies()[i].position).norm());
  return worst;
}

double pyramid_moves(Lab& lab, int rows) {
  Run run(lab, pyramid_of(rows));
  run.seconds(60);
  return moved_max(run);
}

double ground_force(Lab& lab, int rows, double duration) {
  Run run(lab, pyramid_of(rows));
  run.seconds(duration);
  double force = 0;
  for (const Touch& touch : run.touches())
    if (touch.a == 0 || touch.b == 0) force += touch.normal_impulse / run.time_step();
  return std::abs(force / (rows * (rows + 1) / 2 * kGravity) - 1);
}

// ---- Convergence ----

constexpr int kConvergenceCount = 15;

// From cold: what a single step's forces are off by. Gauss-Seidel's spectral radius is cos²(π/2N), 210 iterations a
// decade: 2100 for ten.
double cold_residual(Lab& lab) {
  Run run(lab, stack_of(kConvergenceCount));
  run.steps(1);
  return force_residual(run, kConvergenceCount);
}

Case long_one(Case each) {
  each.is_long = true;
  return each;
}

}  // namespace

void add_stack_cases(std::vector<Case>& cases) {
  for (const int count : {10, 50, 100}) {
    const std::string suffix = numbered(count), what = std::string("a stack of ") + std::to_string(count) + " boxes";
    cases.push_back({23,
                     "stack_sinks" + suffix,
                     what + ", 60 s",
                     "top sinks by",
                     "m",
                     {{Profile::kDefault, 0.05}},
                     [count](Lab& lab) { return top_sinks(lab, count, 60); }});
    cases.push_back({23,
                     "stack_drift" + suffix,
                     what + ", 60 s",
                     "goes sideways by",
                     "m",
                     {{Profile::kDefault, 0.01}},
                     [count](Lab& lab) { return drift(lab, count, 60); }});
    cases.push_back({23,
                     "stack_forces" + suffix,
                     what + ", after 10 s",
                     "worst error of a contact's force",
                     "relative",
                     {{Profile::kPrecise, 1e-6}},
                     [count](Lab& lab) { return stack_forces(lab, count); }});
    cases.push_back(long_one({23,
                              "stack_hour" + suffix,
                              what + ", an hour",
                              "top sinks by",
                              "m",
                              {{Profile::kPrecise, 0.05}},
                              [count](Lab& lab) { return top_sinks(lab, count, 3600); }}));
  }
  cases.push_back({24,
                   "pyramid_moves_20",
                   "a pyramid of 20 rows, 60 s",
                   "farthest that a box moves",
                   "m",
                   {{Profile::kDefault, 0.02}},
                   [](Lab& lab) { return pyramid_moves(lab, 20); }});
  cases.push_back(long_one({24,
                            "pyramid_moves_100",
                            "a pyramid of 100 rows, 60 s",
                            "farthest that a box moves",
                            "m",
                            {{Profile::kDefault, 0.02}},
                            [](Lab& lab) { return pyramid_moves(lab, 100); }}));
  cases.push_back({24,
                   "pyramid_force_20",
                   "a pyramid of 20 rows, after 2 s: the ground carries its weight",
                   "error of the force",
                   "relative",
                   {{Profile::kPrecise, 1e-6}},
                   [](Lab& lab) { return ground_force(lab, 20, 2); }});
  cases.push_back(long_one({24,
                            "pyramid_force_20_minute",
                            "the same after 60 s",
                            "error of the force",
                            "relative",
                            {{Profile::kPrecise, 1e-6}},
                            [](Lab& lab) { return ground_force(lab, 20, 60); }}));
  cases.push_back(long_one({24,
                            "pyramid_force_100",
                            "a pyramid of 100 rows, after 60 s",
                            "error of the force",
                            "relative",
                            {{Profile::kPrecise, 1e-6}},
                            [](Lab& lab) { return ground_force(lab, 100, 60); }}));
  cases.push_back({33,
                   "cold_residual",
                   "a stack of 15, its first step from cold",
                   "worst error of a contact's force",
                   "relative",
                   {{Profile::kPrecise, 1e-10}},
                   cold_residual});
}

}  // namespace urto::accuracy

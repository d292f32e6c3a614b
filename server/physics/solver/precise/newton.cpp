#include "physics/solver/precise/newton.h"

#include <limits>

#include "physics/geometry/vector.h"
#include "physics/solver/precise/interior_point.h"
#include "physics/solver/precise/sweeps.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
namespace {

struct Impulses {
  std::vector<double> values;

  void take(const ContactProblem& problem) {
    values.clear();
    for (const ProblemPoint& p : problem.points) {
      values.push_back(p.normal_impulse);
      values.push_back(p.tangent_impulse);
    }
  }
  void give(ContactProblem& problem) const {
    for (std::size_t k = 0; k < problem.points.size(); ++k) {
      problem.points[k].normal_impulse = values[2 * k];
      problem.points[k].tangent_impulse = values[2 * k + 1];
    }
  }
};

PointState state_of(const ContactProblem& problem, const ProblemPoint& p) {
  const double normal = p.inverse_mass_normal * p.normal_impulse - normal_velocity(problem, p);
  if (!(normal > 0.0)) return PointState::kOpen;
  if (p.friction == 0.0) return PointState::kSlipPlus;
  const double tangent = p.tangent_impulse - tangent_velocity(problem, p) / p.inverse_mass_tangent;
  // The bound of the impulse at hand, or of the one that closes the point.
  const double bound = p.friction * max_of(p.normal_impulse, normal / p.inverse_mass_normal);
  if (tangent > bound) return PointState::kSlipPlus;
  if (tangent < -bound) return PointState::kSlipMinus;
  return PointState::kStick;
}

bool update_states(ContactProblem& problem) {
  bool changed = false;
  for (ProblemPoint& p : problem.points) {
    const PointState state = state_of(problem, p);
    changed |= state != p.state;
    p.state = state;
  }
  return changed;
}

double slip_of(const ProblemPoint& p) {
  if (p.state == PointState::kSlipPlus) return p.friction;
  return p.state == PointState::kSlipMinus ? -p.friction : 0.0;
}

// The impulses as the states will have them.
void conform_impulses(ContactProblem& problem) {
  for (ProblemPoint& p : problem.points) {
    if (p.state == PointState::kOpen) {
      p.normal_impulse = p.tangent_impulse = 0;
    } else if (p.state != PointState::kStick) {
      p.tangent_impulse = slip_of(p) * p.normal_impulse;
    }
  }
}

// What each point adds is summed by itself and the masses come last, so that it does not matter which of a body's two
// points is the first: a mirror image gets the same forces to the last bit.
void assemble(const ContactProblem& problem, ProblemWorkspace& work) {
  work.system.clear_values();
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const ProblemPoint& p = problem.points[k];
    if (p.state == PointState::kOpen) continue;
    if (p.state == PointState::kStick) {
      add_outers(problem, work, k, p.normal, p.normal, p.tangent, p.tangent, p.stiffness);
      continue;
    }
    double left[6];
    for (int i = 0; i < 6; ++i) left[i] = p.normal[i] + slip_of(p) * p.tangent[i];
    add_outer(problem, work, k, left, p.normal, p.stiffness);
  }
  add_masses(problem, work);
}

// One repetition: the defect of momentum is zero because velocities follow from the impulses, so that only the points'
// own defects are on the right side.
void correct(ContactProblem& problem, ProblemWorkspace& work) {
  work.right.assign(3 * problem.bodies.size(), 0.0);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const ProblemPoint& p = problem.points[k];
    if (p.state == PointState::kOpen) continue;
    const double normal = -p.stiffness * normal_velocity(problem, p);
    const double tangent =
        p.state == PointState::kStick ? -p.stiffness * tangent_velocity(problem, p) : slip_of(p) * normal;
    double row[6];
    for (int i = 0; i < 6; ++i) row[i] = normal * p.normal[i] + tangent * p.tangent[i];
    add_row(problem, work, k, row, 1.0);
  }
  work.system.solve(work.right);
  for (ProblemPoint& p : problem.points) {
    if (p.state == PointState::kOpen) continue;
    p.normal_impulse -= p.stiffness * (normal_velocity(problem, p) + dot_row(problem, work.right, p, p.normal));
    if (p.state == PointState::kStick) {
      p.tangent_impulse -= p.stiffness * (tangent_velocity(problem, p) + dot_row(problem, work.right, p, p.tangent));
    } else {
      p.tangent_impulse = slip_of(p) * p.normal_impulse;
    }
  }
  apply_impulses(problem);
}

// m/s: how far the equations of the states are from holding.
double defect(const ContactProblem& problem) {
  double worst = 0;
  for (const ProblemPoint& p : problem.points) {
    if (p.state == PointState::kOpen) continue;
    const double normal = absolute(normal_velocity(problem, p));
    if (!(normal <= worst)) worst = normal;
    if (p.state != PointState::kStick) continue;
    const double tangent = absolute(tangent_velocity(problem, p));
    if (!(tangent <= worst)) worst = tangent;
  }
  return worst;
}

// Solves the equations of the states; false if they have no finite solution.
bool solve_equations(ContactProblem& problem, ProblemWorkspace& work, bool thoroughly) {
  conform_impulses(problem);
  apply_impulses(problem);
  assemble(problem, work);
  if (!work.system.factorise()) return false;
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < (thoroughly ? kCorrectionsMax : kCorrectionsFirst); ++i) {
    correct(problem, work);
    const double now = defect(problem);
    if (!(now < std::numeric_limits<double>::max())) return false;
    if (now <= 0.125 * tolerance_of(problem)) return true;
    if (i >= kCorrectionsFirst && now > 0.5 * last) return true;  // rounding: it gets no better
    last = now;
  }
  return true;
}

}  // namespace

void set_up_system(const ContactProblem& problem, ProblemWorkspace& work) {
  if (work.ready) return;
  work.edges.clear();
  for (const ProblemPoint& p : problem.points)
    if (p.a != kNone && p.b != kNone) work.edges.push_back({p.a, p.b});
  work.system.set_pattern(static_cast<std::uint32_t>(problem.bodies.size()), work.edges);
  work.places.clear();
  for (const ProblemPoint& p : problem.points) {
    ProblemWorkspace::Place place{0, 0, 0, 0};
    if (p.a != kNone) place.aa = work.system.block_at(p.a, p.a);
    if (p.b != kNone) place.bb = work.system.block_at(p.b, p.b);
    if (p.a != kNone && p.b != kNone) {
      place.ab = work.system.block_at(p.a, p.b);
      place.ba = work.system.block_at(p.b, p.a);
    }
    work.places.push_back(place);
  }
  work.ready = true;
}

void add_masses(const ContactProblem& problem, ProblemWorkspace& work) {
  for (std::uint32_t i = 0; i < problem.bodies.size(); ++i) {
    double* block = &work.system.values()[work.system.block_at(i, i)];
    for (int j = 0; j < 3; ++j) block[4 * j] += problem.bodies[i].mass[j];
  }
}

void add_outers(const ContactProblem& problem, ProblemWorkspace& work, std::size_t k, const double* left,
                const double* right, const double* other_left, const double* other_right, double weight) {
  const ProblemPoint& p = problem.points[k];
  const ProblemWorkspace::Place& place = work.places[k];
  const auto add = [&](std::size_t at, int row, int column) {
    double* block = &work.system.values()[at];
    for (int i = 0; i < 3; ++i) {
      const double first = weight * left[row + i], second = weight * other_left[row + i];
      for (int j = 0; j < 3; ++j) block[3 * i + j] += first * right[column + j] + second * other_right[column + j];
    }
  };
  if (p.a != kNone) add(place.aa, 0, 0);
  if (p.b != kNone) add(place.bb, 3, 3);
  if (p.a != kNone && p.b != kNone) {
    add(place.ab, 0, 3);
    add(place.ba, 3, 0);
  }
}

void add_outer(const ContactProblem& problem, ProblemWorkspace& work, std::size_t k, const double* left,
               const double* right, double weight) {
  constexpr double kNothing[6] = {};
  add_outers(problem, work, k, left, right, kNothing, kNothing, weight);
}

void add_row(const ContactProblem& problem, ProblemWorkspace& work, std::size_t k, const double* row, double weight) {
  const ProblemPoint& p = problem.points[k];
  for (int i = 0; i < 3; ++i) {
    if (p.a != kNone) work.right[3 * p.a + static_cast<std::size_t>(i)] += weight * row[i];
    if (p.b != kNone) work.right[3 * p.b + static_cast<std::size_t>(i)] += weight * row[3 + i];
  }
}

double dot_row(const ContactProblem&, const std::vector<double>& x, const ProblemPoint& p, const double* row) {
  double sum = 0;
  if (p.a != kNone) {
    const double* v = &x[3 * static_cast<std::size_t>(p.a)];
    sum += row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
  }
  if (p.b != kNone) {
    const double* v = &x[3 * static_cast<std::size_t>(p.b)];
    sum += row[3] * v[0] + row[4] * v[1] + row[5] * v[2];
  }
  return sum;
}

ProblemAnswer solve_by_newton(ContactProblem& problem, ProblemWorkspace& work, int rounds_max) {
  set_up_system(problem, work);
  ProblemAnswer best;
  best.residual = std::numeric_limits<double>::infinity();
  Impulses best_impulses;
  for (ProblemPoint& p : problem.points) p.state = state_of(problem, p);
  std::uint32_t factorisations = 0;
  for (int round = 0; round < rounds_max; ++round) {
    ++factorisations;
    if (!solve_equations(problem, work, true)) break;
    const double residual = largest_violation(problem);
    if (residual < best.residual) {
      best.residual = residual;
      best.tolerance = tolerance_of(problem);
      best_impulses.take(problem);
    }
    if (best.solved() || !update_states(problem)) break;
  }
  best.factorisations = factorisations;
  if (!best_impulses.values.empty()) {
    best_impulses.give(problem);
    apply_impulses(problem);
  }
  return best;
}

namespace {

// The best answer so far and its impulses.
struct Best {
  ProblemAnswer answer;
  Impulses impulses;

  Best(const ContactProblem& problem, const ProblemAnswer& first) : answer(first) { impulses.take(problem); }
  void compare(const ContactProblem& problem, const ProblemAnswer& other) {
    const std::uint32_t factorisations = answer.factorisations + other.factorisations;
    if (other.residual <= answer.residual) {
      answer = other;
      impulses.take(problem);
    }
    answer.factorisations = factorisations;
  }
  bool good_enough() const { return answer.residual <= kGoodEnough * answer.tolerance; }
};

}  // namespace

ProblemAnswer solve(ContactProblem& problem, ProblemWorkspace& work) {
  work.ready = false;
  prepare(problem);
  apply_impulses(problem);
  ProblemAnswer answer;
  answer.residual = largest_violation(problem);
  answer.tolerance = tolerance_of(problem);
  if (answer.solved()) return answer;
  Impulses guess;
  guess.take(problem);
  Best best(problem, solve_by_newton(problem, work, kNewtonRounds));
  if (best.good_enough()) return best.answer;
  solve_by_interior_point(problem, work);
  best.compare(problem, solve_by_newton(problem, work, kPolishRounds));
  best.answer.factorisations += kInteriorRounds;
  if (!best.good_enough() && !(best.answer.residual <= kRestSpeed)) {
    guess.give(problem);
    best.compare(problem, solve_by_sweeps(problem, kSweepsMax));
    best.compare(problem, solve_by_newton(problem, work, kPolishRounds));
  }
  best.impulses.give(problem);
  apply_impulses(problem);
  return best.answer;
}

}  // namespace urto

#include "physics/solver/precise/contact_problem.h"

#include <limits>

#include "physics/geometry/vector.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
namespace {

double along(const ContactProblem& problem, const ProblemPoint& point, const double* row) {
  double sum = 0;
  if (point.a != kNone) {
    const double* v = problem.bodies[point.a].velocity;
    sum += row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
  }
  if (point.b != kNone) {
    const double* v = problem.bodies[point.b].velocity;
    sum += row[3] * v[0] + row[4] * v[1] + row[5] * v[2];
  }
  return sum;
}

double inverse_mass_along(const ContactProblem& problem, const ProblemPoint& point, const double* row) {
  double sum = 0;
  for (int side = 0; side < 2; ++side) {
    const std::uint32_t body = side == 0 ? point.a : point.b;
    if (body == kNone) continue;
    for (int i = 0; i < 3; ++i) sum += row[3 * side + i] * row[3 * side + i] * problem.bodies[body].inverse_mass[i];
  }
  return sum;
}

}  // namespace

void prepare(ContactProblem& problem) {
  for (ProblemPoint& p : problem.points) {
    p.inverse_mass_normal = inverse_mass_along(problem, p, p.normal);
    p.inverse_mass_tangent = inverse_mass_along(problem, p, p.tangent);
    double mass = 0;
    if (p.a != kNone) mass = max_of(mass, problem.bodies[p.a].mass[0]);
    if (p.b != kNone) mass = max_of(mass, problem.bodies[p.b].mass[0]);
    p.stiffness = kStiffness * mass;
  }
}

double normal_velocity(const ContactProblem& problem, const ProblemPoint& point) {
  return along(problem, point, point.normal) + point.drive_normal - point.target;
}

double tangent_velocity(const ContactProblem& problem, const ProblemPoint& point) {
  return along(problem, point, point.tangent) + point.drive_tangent;
}

void apply_impulses(ContactProblem& problem) {
  for (ProblemBody& body : problem.bodies)
    for (int i = 0; i < 3; ++i) body.velocity[i] = 0;
  for (const ProblemPoint& p : problem.points) {
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t body = side == 0 ? p.a : p.b;
      if (body == kNone) continue;
      for (int i = 0; i < 3; ++i)
        problem.bodies[body].velocity[i] +=
            p.normal[3 * side + i] * p.normal_impulse + p.tangent[3 * side + i] * p.tangent_impulse;
    }
  }
  // The impulses are summed first: they nearly cancel where bodies rest.
  for (ProblemBody& body : problem.bodies)
    for (int i = 0; i < 3; ++i) body.velocity[i] = body.free[i] + body.inverse_mass[i] * body.velocity[i];
}

double violation(const ContactProblem& problem, const ProblemPoint& p) {
  const double wn = p.inverse_mass_normal, wt = p.inverse_mass_tangent;
  const double normal = wn * p.normal_impulse;
  const double worst = absolute(normal - max_of(0.0, normal - normal_velocity(problem, p)));
  if (p.friction == 0.0) return worst;
  const double bound = wt * p.friction * max_of(0.0, p.normal_impulse), tangent = wt * p.tangent_impulse;
  return max_of(worst, absolute(tangent - clamp_to(tangent - tangent_velocity(problem, p), -bound, bound)));
}

double largest_violation(const ContactProblem& problem) {
  double worst = 0;
  for (const ProblemPoint& p : problem.points) {
    const double v = violation(problem, p);
    if (!(v <= worst)) worst = v;  // also what is no number
  }
  return worst;
}

double tolerance_of(const ContactProblem& problem) {
  double speed = 0, impulse = 0;
  for (const ProblemBody& body : problem.bodies) {
    speed = max_of(speed, absolute(body.free[0]));
    speed = max_of(speed, absolute(body.free[1]));
  }
  for (const ProblemPoint& p : problem.points) {
    const double weight = max_of(p.inverse_mass_normal, p.inverse_mass_tangent);
    impulse = max_of(impulse, weight * max_of(absolute(p.normal_impulse), absolute(p.tangent_impulse)));
  }
  return kResidual * speed + kRoundings * std::numeric_limits<double>::epsilon() * impulse;
}

}  // namespace urto

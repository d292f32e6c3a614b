#include "physics/solver/precise/sweeps.h"

#include "physics/geometry/vector.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
namespace {

struct PointImpulses {
  double normal, tangent;
};

// One point by itself: its velocities are u + K λ, where K couples the tangent to the normal.
struct PointProblem {
  double normal_speed, tangent_speed;  // m/s: u, without the point's own impulse
  double k_normal, k_tangent, k_both;  // 1/kg
  double friction;

  PointProblem(const ContactProblem& problem, const ProblemPoint& p)
      : k_normal(p.inverse_mass_normal), k_tangent(p.inverse_mass_tangent), k_both(0), friction(p.friction) {
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t body = side == 0 ? p.a : p.b;
      if (body == kNone) continue;
      for (int i = 0; i < 3; ++i)
        k_both += p.normal[3 * side + i] * p.tangent[3 * side + i] * problem.bodies[body].inverse_mass[i];
    }
    normal_speed = normal_velocity(problem, p) - k_normal * p.normal_impulse - k_both * p.tangent_impulse;
    tangent_speed = tangent_velocity(problem, p) - k_both * p.normal_impulse - k_tangent * p.tangent_impulse;
  }

  // It parts, sticks, or slips to one side; of several answers the one that sticks.
  PointImpulses solve() const {
    if (normal_speed >= 0.0) return {0, 0};
    const double determinant = k_normal * k_tangent - k_both * k_both;
    if (friction > 0.0 && determinant > 0.0) {
      const double normal = (k_both * tangent_speed - k_tangent * normal_speed) / determinant;
      const double tangent = (k_both * normal_speed - k_normal * tangent_speed) / determinant;
      if (normal >= 0.0 && absolute(tangent) <= friction * normal) return {normal, tangent};
    }
    for (const double slip : {friction, -friction}) {
      const double k = k_normal + slip * k_both;
      if (!(k > 0.0)) continue;
      const double normal = -normal_speed / k;
      if (slip * (tangent_speed + (k_both + slip * k_tangent) * normal) <= 0.0) return {normal, slip * normal};
    }
    // Unreached but for rounding: there is always an answer that sticks or slips.
    return {-normal_speed / k_normal, 0};
  }
};

void change_to(ContactProblem& problem, ProblemPoint& p, const PointImpulses& next) {
  const double normal = next.normal - p.normal_impulse, tangent = next.tangent - p.tangent_impulse;
  for (int side = 0; side < 2; ++side) {
    const std::uint32_t slot = side == 0 ? p.a : p.b;
    if (slot == kNone) continue;
    ProblemBody& body = problem.bodies[slot];
    for (int i = 0; i < 3; ++i)
      body.velocity[i] += body.inverse_mass[i] * (p.normal[3 * side + i] * normal + p.tangent[3 * side + i] * tangent);
  }
  p.normal_impulse = next.normal;
  p.tangent_impulse = next.tangent;
}

}  // namespace

ProblemAnswer solve_by_sweeps(ContactProblem& problem, int sweeps_max) {
  ProblemAnswer answer;
  apply_impulses(problem);
  const std::size_t count = problem.points.size();
  for (int sweep = 0; sweep < sweeps_max; ++sweep) {
    for (std::size_t i = 0; i < count; ++i) {
      ProblemPoint& p = problem.points[sweep % 2 == 0 ? i : count - 1 - i];
      change_to(problem, p, PointProblem(problem, p).solve());
    }
    if ((sweep + 1) % kSweepsBetweenLooks != 0 && sweep + 1 < sweeps_max) continue;
    // From the impulses anew, or rounding would add up.
    apply_impulses(problem);
    answer.residual = largest_violation(problem);
    answer.tolerance = tolerance_of(problem);
    if (answer.solved()) break;
  }
  return answer;
}

}  // namespace urto

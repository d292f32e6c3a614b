#pragma once

#include <cstdint>
#include <vector>

#include "physics/body.h"

namespace urto {

// What touching bodies owe each other, as a problem of its own: which impulses λ at the contact points give velocities
// v with
//
//   M (v − v_free) = Σ λn·n + λt·t                            Newton's law over the interval
//   λn ≥ 0,  n·v ≥ target,  λn·(n·v − target) = 0             no tension, no penetration (Signorini)
//   |λt| ≤ μ·λn,  t·v = 0 if less, else opposed to λt         friction (Coulomb)
//
// n and t are rows of six numbers: what a unit impulse does to the two bodies. In the plane the friction cone is a
// wedge, so this is a linear complementarity problem, and exact.
enum class PointState : std::uint8_t { kOpen, kStick, kSlipPlus, kSlipMinus };  // slip: λt = ±μ·λn

struct ProblemBody {
  double mass[3] = {1, 1, 1};          // kg, kg, kg·m²; 1 where the inverse is 0
  double inverse_mass[3] = {0, 0, 0};  // 0: does not turn
  double free[3] = {0, 0, 0};          // velocity without contacts
  double velocity[3] = {0, 0, 0};      // the answer
};

struct ProblemPoint {
  std::uint32_t a = kNone, b = kNone;  // kNone: cannot be moved
  double normal[6] = {}, tangent[6] = {};
  double drive_normal = 0, drive_tangent = 0;  // m/s, relative velocity that an unmovable body adds
  double target = 0;                           // m/s
  double friction = 0;
  double normal_impulse = 0, tangent_impulse = 0;  // N·s: a guess on entry, the answer on return
  // Derived by prepare().
  double inverse_mass_normal = 0, inverse_mass_tangent = 0;  // 1/kg
  double stiffness = 0;                                      // kg: weight of the constraint in the factorised matrix
  PointState state = PointState::kOpen;
};

struct ContactProblem {
  std::vector<ProblemBody> bodies;
  std::vector<ProblemPoint> points;

  void clear() {
    bodies.clear();
    points.clear();
  }
};

// How well it was solved, and how.
struct ProblemAnswer {
  double residual = 0;   // m/s, the largest violation
  double tolerance = 0;  // m/s, what rounding and kResidual allow
  std::uint32_t factorisations = 0;
  bool solved() const { return residual <= tolerance; }
};

void prepare(ContactProblem& problem);
double normal_velocity(const ContactProblem& problem, const ProblemPoint& point);   // less the target
double tangent_velocity(const ContactProblem& problem, const ProblemPoint& point);  // m/s
// v = v_free + M⁻¹ Σ λ
void apply_impulses(ContactProblem& problem);
// m/s: by how much a point is away from its laws, as the natural map λ − projection(λ − v/w) times w.
double violation(const ContactProblem& problem, const ProblemPoint& point);
double largest_violation(const ContactProblem& problem);
// The residual that counts as zero.
double tolerance_of(const ContactProblem& problem);

}  // namespace urto

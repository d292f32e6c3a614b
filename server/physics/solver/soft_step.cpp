#include "physics/solver/soft_step.h"

#include "physics/constants.h"
#include "physics/motion.h"

namespace urto {
namespace {

// The lever arms of a point now. Both bodies have moved by different amounts since the point was found; were the arms
// frozen, the two halves of an impulse would act at different world points and angular momentum would be made from
// nothing. So the drift of the centres is shared out between the arms, more of it to the heavier body's.
template <class S>
struct Arms {
  S ax, ay, bx, by;
  Arms(const ConstraintPoint<S>& p, S share_a, S driftx, S drifty)
      : ax(p.ax + share_a * driftx),
        ay(p.ay + share_a * drifty),
        bx(p.bx - (S(1) - share_a) * driftx),
        by(p.by - (S(1) - share_a) * drifty) {}
};

template <class S>
void apply(Motion<S>& a, Motion<S>& b, const ContactConstraint<S>& k, const Arms<S>& r, S px, S py) {
  a.vx -= k.inv_mass_a * px;
  a.vy -= k.inv_mass_a * py;
  a.w -= k.inv_inertia_a * (r.ax * py - r.ay * px);
  b.vx += k.inv_mass_b * px;
  b.vy += k.inv_mass_b * py;
  b.w += k.inv_inertia_b * (r.bx * py - r.by * px);
}

template <class S>
S relative_velocity(const Motion<S>& a, const Motion<S>& b, const Arms<S>& r, S ux, S uy) {
  const S dvx = (b.vx - b.w * r.by) - (a.vx - a.w * r.ay);
  const S dvy = (b.vy + b.w * r.bx) - (a.vy + a.w * r.ax);
  return dvx * ux + dvy * uy;
}

template <class S>
void warm_start(WorldData<S>& world, const ConstraintSet<S>& set) {
  for (const ContactConstraint<S>& k : set.contacts) {
    Motion<S>&a = world.motions[k.a], &b = world.motions[k.b];
    const S driftx = b.dx - a.dx, drifty = b.dy - a.dy;
    for (int i = 0; i < k.count; ++i) {
      const ConstraintPoint<S>& p = k.points[i];
      const Arms<S> r(p, k.share_a, driftx, drifty);
      apply(a, b, k, r, p.normal_impulse * k.nx + p.tangent_impulse * k.ny,
            p.normal_impulse * k.ny - p.tangent_impulse * k.nx);
    }
  }
}

template <class S>
struct SubStep {
  S inv_h;
  bool use_bias;
  bool friction;
};

template <class S>
void solve_friction(ContactConstraint<S>& k, Motion<S>& a, Motion<S>& b, S driftx, S drifty) {
  for (int i = 0; i < k.count; ++i) {
    ConstraintPoint<S>& p = k.points[i];
    const Arms<S> r(p, k.share_a, driftx, drifty);
    const S vt = relative_velocity(a, b, r, k.ny, -k.nx);
    const S bound = k.friction * p.normal_impulse;
    const S next = clamp_to(p.tangent_impulse - p.tangent_mass * vt, -bound, bound);
    const S impulse = next - p.tangent_impulse;
    p.tangent_impulse = next;
    apply(a, b, k, r, impulse * k.ny, -impulse * k.nx);
  }
}

// What a point asks of its relative normal velocity: v + bias = −γ λ, where γ is the constraint's compliance.
template <class S>
struct Demand {
  S bias, compliance;
};

template <class S>
Demand<S> demand_of(const ContactConstraint<S>& k, const ConstraintPoint<S>& p, const Motion<S>& a, const Motion<S>& b,
                    S driftx, S drifty, const SubStep<S>& step) {
  // Where the anchors are now: material points, turned with their bodies.
  const S rx = (b.c * p.bx - b.s * p.by - p.bx) - (a.c * p.ax - a.s * p.ay - p.ax);
  const S ry = (b.s * p.bx + b.c * p.by - p.by) - (a.s * p.ax + a.c * p.ay - p.ay);
  const S s = p.separation + (driftx + rx) * k.nx + (drifty + ry) * k.ny;
  if (s > S(0)) return {s * step.inv_h, S(0)};  // may close the gap in this sub-step, not more
  if (!step.use_bias) return {S(0), S(0)};
  return {max_of(k.bias_rate * s, S(-kPushSpeedMax)), k.compliance * p.inverse_mass};
}

// One point: λ = max(0, (k λ₀ − v − bias) / (k + γ)).
template <class S>
void solve_normal(ContactConstraint<S>& k, Motion<S>& a, Motion<S>& b, S driftx, S drifty, const SubStep<S>& step) {
  ConstraintPoint<S>& p = k.points[0];
  const Demand<S> d = demand_of(k, p, a, b, driftx, drifty, step);
  const Arms<S> r(p, k.share_a, driftx, drifty);
  const S vn = relative_velocity(a, b, r, k.nx, k.ny);
  const S next = max_of((p.inverse_mass * p.normal_impulse - vn - d.bias + d.compliance * p.preload) / (p.inverse_mass + d.compliance), S(0));
  const S impulse = next - p.normal_impulse;
  p.normal_impulse = next;
  apply(a, b, k, r, impulse * k.nx, impulse * k.ny);
}

// Both points of a manifold at once, so that neither side is favoured: the linear complementarity problem
//   w = (K + γ) λ − q ≥ 0,  λ ≥ 0,  w·λ = 0,   q = K λ₀ − v − bias
// by trying which points push (Catto, "Block solver", Box2D 2; here with compliance).
template <class S>
void solve_normals(ContactConstraint<S>& k, Motion<S>& a, Motion<S>& b, S driftx, S drifty, const SubStep<S>& step) {
  ConstraintPoint<S>&p1 = k.points[0], &p2 = k.points[1];
  const Demand<S> d1 = demand_of(k, p1, a, b, driftx, drifty, step), d2 = demand_of(k, p2, a, b, driftx, drifty, step);
  const Arms<S> r1(p1, k.share_a, driftx, drifty), r2(p2, k.share_a, driftx, drifty);
  const S v1 = relative_velocity(a, b, r1, k.nx, k.ny), v2 = relative_velocity(a, b, r2, k.nx, k.ny);
  const S q1 = p1.inverse_mass * p1.normal_impulse + k.coupling * p2.normal_impulse - v1 - d1.bias + d1.compliance * p1.preload;
  const S q2 = k.coupling * p1.normal_impulse + p2.inverse_mass * p2.normal_impulse - v2 - d2.bias + d2.compliance * p2.preload;
  const S k11 = p1.inverse_mass + d1.compliance, k22 = p2.inverse_mass + d2.compliance, k12 = k.coupling;
  const S determinant = k11 * k22 - k12 * k12;
  S next1 = k22 * q1 - k12 * q2, next2 = k11 * q2 - k12 * q1;
  if (determinant > S(kDeterminantMin) * k11 * k22 && next1 >= S(0) && next2 >= S(0)) {
    next1 /= determinant;
    next2 /= determinant;
  } else if (q1 >= S(0) && k12 * q1 >= k11 * q2) {
    next1 = q1 / k11;
    next2 = S(0);
  } else if (q2 >= S(0) && k12 * q2 >= k22 * q1) {
    next1 = S(0);
    next2 = q2 / k22;
  } else {
    next1 = next2 = S(0);
  }
  const S i1 = next1 - p1.normal_impulse, i2 = next2 - p2.normal_impulse;
  p1.normal_impulse = next1;
  p2.normal_impulse = next2;
  apply(a, b, k, r1, i1 * k.nx, i1 * k.ny);
  apply(a, b, k, r2, i2 * k.nx, i2 * k.ny);
}

// One Gauss-Seidel pass over a contact: friction first, so that the last word is that bodies do not penetrate.
template <class S>
void solve_contact(WorldData<S>& world, ContactConstraint<S>& k, const SubStep<S>& step) {
  Motion<S>&a = world.motions[k.a], &b = world.motions[k.b];
  const S driftx = b.dx - a.dx, drifty = b.dy - a.dy;
  if (step.friction && k.friction > S(0)) solve_friction(k, a, b, driftx, drifty);
  if (k.count == 2) {
    solve_normals(k, a, b, driftx, drifty, step);
  } else {
    solve_normal(k, a, b, driftx, drifty, step);
  }
}

template <class S>
void solve_contacts(WorldData<S>& world, ConstraintSet<S>& set, const SubStep<S>& step) {
  for (ContactConstraint<S>& k : set.contacts) solve_contact(world, k, step);
}

template <class S>
void add_to_totals(ConstraintSet<S>& set, S preload_rate) {
  for (ContactConstraint<S>& k : set.contacts) {
    for (int i = 0; i < k.count; ++i) {
      k.points[i].preload += preload_rate * (k.points[i].normal_impulse - k.points[i].preload);
      k.points[i].total_normal_impulse += k.points[i].normal_impulse;
      k.points[i].total_tangent_impulse += k.points[i].tangent_impulse;
    }
  }
}

// Newton's restitution for points that were hit in this step, faster than the threshold.
template <class S>
void apply_restitution(WorldData<S>& world, ConstraintSet<S>& set) {
  const S threshold = S(world.settings.restitution_threshold);
  for (ContactConstraint<S>& k : set.contacts) {
    if (k.restitution == S(0)) continue;
    Motion<S>&a = world.motions[k.a], &b = world.motions[k.b];
    for (int i = 0; i < k.count; ++i) {
      ConstraintPoint<S>& p = k.points[i];
      if (p.approach > -threshold || p.total_normal_impulse == S(0)) continue;
      const Arms<S> r(p, k.share_a, b.dx - a.dx, b.dy - a.dy);
      const S vn = relative_velocity(a, b, r, k.nx, k.ny);
      const S next = max_of(p.normal_impulse - (vn + k.restitution * p.approach) / p.inverse_mass, S(0));
      const S impulse = next - p.normal_impulse;
      p.normal_impulse = next;
      p.total_normal_impulse += impulse;
      apply(a, b, k, r, impulse * k.nx, impulse * k.ny);
    }
  }
}

template <class S>
void integrate_velocities(WorldData<S>& world, const Mover<S>& mover) {
  for (std::uint32_t slot : world.awake) {
    if (world.model.second_integrator && world.scratch.colors[slot] == 0) continue;  // it flies, see below
    mover.integrate_velocity(world.bodies[slot], world.motions[slot]);
  }
}

template <class S>
void integrate_positions(WorldData<S>& world, const Mover<S>& mover) {
  for (std::uint32_t slot : world.awake) {
    // A body without contacts advances by the scene's integrator; one with contacts needs velocities that the
    // contacts have seen, which is what semi-implicit Euler gives.
    if (world.model.second_integrator && world.scratch.colors[slot] == 0) {
      mover.fly(world.bodies[slot], world.motions[slot]);
    } else {
      mover.integrate_position(world.bodies[slot], world.motions[slot]);
    }
  }
}

}  // namespace

template <class S>
void solve_soft_step(WorldData<S>& world, ConstraintSet<S>& set) {
  const std::uint32_t n = world.settings.sub_steps;
  const S h = S(world.settings.time_step / n);
  const Mover<S> mover(world, h);
  prepare_contacts(world, set, h);
  const SubStep<S> biased{S(1) / h, true, world.model.friction}, relaxed{S(1) / h, false, world.model.friction};
  for (std::uint32_t i = 0; i < n; ++i) {
    integrate_velocities(world, mover);
    warm_start(world, set);
    solve_contacts(world, set, biased);
    integrate_positions(world, mover);
    solve_contacts(world, set, relaxed);
    add_to_totals(set, h / S(kPreloadTime));
  }
  if (world.model.restitution) apply_restitution(world, set);
  store_impulses(world, set);
}

template void solve_soft_step(WorldData<float>&, ConstraintSet<float>&);
template void solve_soft_step(WorldData<double>&, ConstraintSet<double>&);

}  // namespace urto

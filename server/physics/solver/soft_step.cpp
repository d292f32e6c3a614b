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

// What a point asks of its relative normal velocity: v + bias = −γ (λ − P), where γ is its compliance, P its preload.
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

// Changes the normal impulse of a point to `next`.
template <class S>
void push(const ContactConstraint<S>& k, ConstraintPoint<S>& p, Motion<S>& a, Motion<S>& b, const Arms<S>& r, S next) {
  const S impulse = next - p.normal_impulse;
  p.normal_impulse = next;
  apply(a, b, k, r, impulse * k.nx, impulse * k.ny);
}

// One point: λ = max(0, (k λ₀ − v − bias + γ P) / (k + γ)).
template <class S>
void solve_normal(ContactConstraint<S>& k, Motion<S>& a, Motion<S>& b, S driftx, S drifty, const SubStep<S>& step) {
  ConstraintPoint<S>& p = k.points[0];
  const Demand<S> d = demand_of(k, p, a, b, driftx, drifty, step);
  const Arms<S> r(p, k.share_a, driftx, drifty);
  const S vn = relative_velocity(a, b, r, k.nx, k.ny);
  const S q = p.inverse_mass * p.normal_impulse - vn - d.bias + d.compliance * p.preload;
  push(k, p, a, b, r, max_of(q / (p.inverse_mass + d.compliance), S(0)));
}

template <class S>
struct TwoImpulses {
  S first, second;
};

// Both points of a manifold at once, so that neither side is favoured: the linear complementarity problem
//   w = K λ − q ≥ 0,  λ ≥ 0,  w·λ = 0
// by trying which points push (Catto, "Block solver", Box2D 2).
template <class S>
TwoImpulses<S> solve_two(S k11, S k12, S k22, S q1, S q2) {
  const S determinant = k11 * k22 - k12 * k12;
  const S d1 = k22 * q1 - k12 * q2, d2 = k11 * q2 - k12 * q1;
  if (determinant > S(kDeterminantMin) * k11 * k22 && d1 >= S(0) && d2 >= S(0))
    return {d1 / determinant, d2 / determinant};
  if (q1 >= S(0) && k12 * q1 >= k11 * q2) return {q1 / k11, S(0)};
  if (q2 >= S(0) && k12 * q2 >= k22 * q1) return {S(0), q2 / k22};
  return {S(0), S(0)};
}

// λ of both points: (K + γ) λ = K λ₀ − v − bias + γ P where they push.
template <class S>
void solve_normals(ContactConstraint<S>& k, Motion<S>& a, Motion<S>& b, S driftx, S drifty, const SubStep<S>& step) {
  ConstraintPoint<S>&p1 = k.points[0], &p2 = k.points[1];
  const Demand<S> d1 = demand_of(k, p1, a, b, driftx, drifty, step), d2 = demand_of(k, p2, a, b, driftx, drifty, step);
  const Arms<S> r1(p1, k.share_a, driftx, drifty), r2(p2, k.share_a, driftx, drifty);
  const S v1 = relative_velocity(a, b, r1, k.nx, k.ny), v2 = relative_velocity(a, b, r2, k.nx, k.ny);
  const S q1 =
      p1.inverse_mass * p1.normal_impulse + k.coupling * p2.normal_impulse - v1 - d1.bias + d1.compliance * p1.preload;
  const S q2 =
      k.coupling * p1.normal_impulse + p2.inverse_mass * p2.normal_impulse - v2 - d2.bias + d2.compliance * p2.preload;
  const TwoImpulses<S> next =
      solve_two(p1.inverse_mass + d1.compliance, k.coupling, p2.inverse_mass + d2.compliance, q1, q2);
  push(k, p1, a, b, r1, next.first);
  push(k, p2, a, b, r2, next.second);
}

// One Gauss-Seidel pass over a contact. With bias friction comes first, so that the last word before bodies move is
// that they do not penetrate. In the relaxation it comes last, bounded by the impulse without the spring's share:
// a bound from the spring would make a slope a little too slippery.
template <class S>
void solve_contact(WorldData<S>& world, ContactConstraint<S>& k, const SubStep<S>& step) {
  Motion<S>&a = world.motions[k.a], &b = world.motions[k.b];
  const S driftx = b.dx - a.dx, drifty = b.dy - a.dy;
  const bool rough = step.friction && k.friction > S(0);
  if (rough && step.use_bias) solve_friction(k, a, b, driftx, drifty);
  if (k.count == 2) {
    solve_normals(k, a, b, driftx, drifty, step);
  } else {
    solve_normal(k, a, b, driftx, drifty, step);
  }
  if (rough && !step.use_bias) solve_friction(k, a, b, driftx, drifty);
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

// Newton's restitution for a contact that was hit in this step: each point that closed in faster than the threshold
// and pushed leaves at e times that speed; the others must only not close in. Both points at once.
template <class S>
void restitute(WorldData<S>& world, ContactConstraint<S>& k, S threshold) {
  Motion<S>&a = world.motions[k.a], &b = world.motions[k.b];
  const S driftx = b.dx - a.dx, drifty = b.dy - a.dy;
  const auto leaving = [&](const ConstraintPoint<S>& p) {
    return p.approach <= -threshold && p.total_normal_impulse > S(0) ? -k.restitution * p.approach : S(0);
  };
  ConstraintPoint<S>&p1 = k.points[0], &p2 = k.points[1];
  const S u1 = leaving(p1), u2 = k.count == 2 ? leaving(p2) : S(0);
  if (u1 == S(0) && u2 == S(0)) return;
  const S before1 = p1.normal_impulse;
  const Arms<S> r1(p1, k.share_a, driftx, drifty);
  const S v1 = relative_velocity(a, b, r1, k.nx, k.ny);
  if (k.count == 1) {
    push(k, p1, a, b, r1, max_of(p1.normal_impulse + (u1 - v1) / p1.inverse_mass, S(0)));
  } else {
    const S before2 = p2.normal_impulse;
    const Arms<S> r2(p2, k.share_a, driftx, drifty);
    const S v2 = relative_velocity(a, b, r2, k.nx, k.ny);
    const TwoImpulses<S> next =
        solve_two(p1.inverse_mass, k.coupling, p2.inverse_mass,
                  p1.inverse_mass * p1.normal_impulse + k.coupling * p2.normal_impulse + u1 - v1,
                  k.coupling * p1.normal_impulse + p2.inverse_mass * p2.normal_impulse + u2 - v2);
    push(k, p1, a, b, r1, next.first);
    push(k, p2, a, b, r2, next.second);
    p2.total_normal_impulse += p2.normal_impulse - before2;
  }
  p1.total_normal_impulse += p1.normal_impulse - before1;
}

template <class S>
void apply_restitution(WorldData<S>& world, ConstraintSet<S>& set) {
  const S threshold = S(world.settings.restitution_threshold);
  for (ContactConstraint<S>& k : set.contacts)
    if (k.restitution > S(0)) restitute(world, k, threshold);
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

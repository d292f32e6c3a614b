#include "physics/solver/precise/step.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {

// Impacts with restitution are taken one after the other, the hardest first: so a blow runs through a row of touching
// balls as through one with gaps. What then still approaches does so without restitution, and stops at once together.
void PreciseStep::take_impacts() {
  if (world_->model.restitution) {
    for (int round = 0; round < kImpactRoundsMax; ++round) {
      const Touching* hardest = hardest_impact();
      if (!hardest) break;
      collide(*hardest);
    }
  }
  stop_approach();
}

double PreciseStep::parting(const Touching& touching, int point) const {
  const Contact<double>& c = world_->contacts[touching.contact];
  const TouchPoint& p = touching.touch.points[point];
  return parting_speed(touching.touch.normal, p.arm_a, paths_[c.body_a], p.arm_b, paths_[c.body_b]);
}

const PreciseStep::Touching* PreciseStep::hardest_impact() const {
  const Touching* hardest = nullptr;
  double most = max_of(kRestSpeed, world_->settings.restitution_threshold);
  for (const Touching& t : touching_) {
    if (world_->contacts[t.contact].restitution == 0.0 || pairs_[t.contact].bounces >= kBouncesMax) continue;
    for (int i = 0; i < t.touch.count; ++i) {
      const double approach = -parting(t, i);
      if (!(approach > most)) continue;
      most = approach;
      hardest = &t;
    }
  }
  return hardest;
}

Collision PreciseStep::collision_of(const Contact<double>& c) {
  return {world_->bodies[c.body_a],
          world_->bodies[c.body_b],
          paths_[c.body_a],
          paths_[c.body_b],
          world_->model.friction ? c.friction : 0.0,
          c.restitution};
}

void PreciseStep::add_impulse(std::uint32_t contact, std::uint32_t point, const PointImpulse& impulse) {
  ManifoldPoint<double>& p = world_->contacts[contact].points[point];
  p.total_normal_impulse += impulse.normal;
  p.total_tangent_impulse += impulse.tangent;
}

void PreciseStep::collide(const Touching& t) {
  ++pairs_[t.contact].bounces;
  ++pairs_[t.contact].strikes;
  const Collision collision = collision_of(world_->contacts[t.contact]);
  const bool first = parting(t, 0) < -kRestSpeed;
  if (t.touch.count == 2 && first && parting(t, 1) < -kRestSpeed) {
    PointImpulse impulses[2];
    collide_at_points(collision, t.touch, impulses);
    add_impulse(t.contact, 0, impulses[0]);
    add_impulse(t.contact, 1, impulses[1]);
    return;
  }
  const std::uint32_t point = first ? 0 : 1;
  add_impulse(t.contact, point, collide_at_point(collision, t.touch.normal, t.touch.points[point]));
}

void PreciseStep::stop_approach() {
  bool approaching = false;
  for (const Touching& t : touching_)
    for (int i = 0; i < t.touch.count; ++i) approaching |= parting(t, i) < -kRestSpeed;
  if (!approaching) return;
  build_problem(Purpose::kImpact, 0.0);
  solve(problem_, workspace_);
  for (std::size_t i = 0; i < cluster_.size(); ++i) {
    Path& path = paths_[cluster_[i]];
    path.vx = problem_.bodies[i].velocity[0];
    path.vy = problem_.bodies[i].velocity[1];
    path.w = problem_.bodies[i].velocity[2];
  }
  for (std::size_t k = 0; k < origins_.size(); ++k) {
    const ProblemPoint& p = problem_.points[k];
    if (p.normal_impulse > 0.0) ++pairs_[touching_[origins_[k].touching].contact].strikes;
    add_impulse(touching_[origins_[k].touching].contact, origins_[k].point, {p.normal_impulse, p.tangent_impulse});
  }
}

}  // namespace urto

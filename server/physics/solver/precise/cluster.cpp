#include "physics/contact_graph.h"
#include "physics/solver/precise/step.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {

// Bodies that touch, found from one of them, are given the velocities and forces that they have from now on.
void PreciseStep::settle(std::uint32_t seed, double now) {
  gather(seed, now);
  work_done_ += cluster_.size();
  changed_.insert(changed_.end(), cluster_.begin(), cluster_.end());
  for (std::uint32_t slot : cluster_) ++versions_[slot];
  if (work_done_ > work_most_ && now > 0.0) return stop_cluster();
  if (touching_.empty()) {
    for (std::uint32_t slot : cluster_) thrust_->accelerate(world_->bodies[slot], paths_[slot], h_);
    return;
  }
  take_impacts();
  if (now == 0.0) part_overlaps();
  find_forces(now);
}

void PreciseStep::gather(std::uint32_t seed, double now) {
  ++serial_;
  cluster_.clear();
  touching_.clear();
  join(seed, now);
  for (std::size_t i = 0; i < cluster_.size(); ++i) look_around(cluster_[i], now);
}

void PreciseStep::join(std::uint32_t slot, double now) {
  if (serials_[slot] == serial_) return;
  serials_[slot] = serial_;
  locals_[slot] = static_cast<std::uint32_t>(cluster_.size());
  paths_[slot] = paths_[slot].from(now);
  cluster_.push_back(slot);
}

bool PreciseStep::far_apart(const Contact<double>& c, const Path& a, const Path& b) const {
  const Body<double>&body_a = world_->bodies[c.body_a], &body_b = world_->bodies[c.body_b];
  const double x = (body_b.x - body_a.x) + (b.dx - a.dx), y = (body_b.y - body_a.y) + (b.dy - a.dy);
  const double reach = body_a.extent_max + body_b.extent_max + 2 * kTouchDistance;
  return x * x + y * y > reach * reach;
}

// The contacts of a body of the cluster: what they did until now is accounted for, and who touches there joins.
void PreciseStep::look_around(std::uint32_t slot, double now) {
  for_each_contact_of(*world_, slot, [&](std::uint32_t contact) {
    const Contact<double>& c = world_->contacts[contact];
    Pair& pair = pairs_[contact];
    if (c.sensor() || pair.cluster == serial_) return;
    pair.cluster = serial_;
    const std::uint32_t other = c.body_a == slot ? c.body_b : c.body_a;
    // Who is still pushed by this body must not go on alone.
    const bool pushed = pair.normal_force[0] > 0.0 || pair.normal_force[1] > 0.0;
    if (pushed && world_->bodies[other].dynamic()) join(other, now);
    account(contact, now);
    pair.held = 0;
    const Path other_path = paths_[other].from(now);
    const Path &path_a = c.body_a == slot ? paths_[slot] : other_path,
               &path_b = c.body_a == slot ? other_path : paths_[slot];
    if (far_apart(c, path_a, path_b)) return;
    const Touch touch = find_touch(*world_, c, path_a, path_b, kTouchDistance);
    if (touch.count == 0) return;
    touching_.push_back({contact, touch});
    adopt(touching_.back());
    if (world_->bodies[other].dynamic() && world_->bodies[other].awake()) join(other, now);
  });
}

// Forces act from `since` to now. Both bodies' paths tell of now if they push each other.
void PreciseStep::account(std::uint32_t contact, double now) {
  Pair& pair = pairs_[contact];
  balance(contact, now);
  Contact<double>& c = world_->contacts[contact];
  for (int i = 0; i < 2; ++i) {
    c.points[i].total_normal_impulse += pair.normal_force[i] * (now - pair.since);
    c.points[i].total_tangent_impulse += pair.tangent_force[i] * (now - pair.since);
    pair.normal_force[i] = pair.tangent_force[i] = 0;
  }
  pair.force_x = pair.force_y = pair.torque = 0;
  pair.since = now;
}

// A force and its reaction act along one line at one moment of the interval alone: as the bodies drift past each other
// the two lines part, and the pair of forces turns what should not be turned. What it has made of angular momentum is
// given back, to both alike. With x_b − x_a the centres' distance the gain is ∫ (x_b − x_a) × F + torque.
void PreciseStep::balance(std::uint32_t contact, double now) {
  const Pair& pair = pairs_[contact];
  const Contact<double>& c = world_->contacts[contact];
  const double s = now - pair.since;
  if (!(s > 0.0) || (pair.force_x == 0.0 && pair.force_y == 0.0)) return;
  const Body<double>&a = world_->bodies[c.body_a], &b = world_->bodies[c.body_b];
  const auto integral = [s](double x, double v, double gain, double acceleration) {
    return s * (x - s * (0.5 * (v - s * gain) + s * acceleration / 3.0));
  };
  const Path &pa = paths_[c.body_a], &pb = paths_[c.body_b];
  const Vec2 apart(integral((b.x - a.x) + (pb.dx - pa.dx), pb.vx - pa.vx, pb.gain_x - pa.gain_x, pb.ax - pa.ax),
                   integral((b.y - a.y) + (pb.dy - pa.dy), pb.vy - pa.vy, pb.gain_y - pa.gain_y, pb.ay - pa.ay));
  turn_both(c, -(cross<double>(apart, Vec2(pair.force_x, pair.force_y)) + s * pair.torque));
}

void PreciseStep::turn_both(const Contact<double>& c, double angular_impulse) {
  const Body<double>&a = world_->bodies[c.body_a], &b = world_->bodies[c.body_b];
  if (!(a.inv_inertia > 0.0) || !(b.inv_inertia > 0.0)) return;  // something else holds one of them
  const double gain = angular_impulse / (a.inertia + b.inertia);
  paths_[c.body_a].w += gain;
  paths_[c.body_b].w += gain;
}

// The world's contact becomes what was found, with the impulses that its points had.
void PreciseStep::adopt(const Touching& touching) {
  Contact<double>& c = world_->contacts[touching.contact];
  const ManifoldPoint<double> old[2] = {c.points[0], c.points[1]};
  const std::uint32_t old_count = c.count;
  c.nx = touching.touch.normal.x();
  c.ny = touching.touch.normal.y();
  c.count = static_cast<std::uint32_t>(touching.touch.count);
  bool taken[2] = {false, false};
  for (int i = 0; i < 2; ++i) {
    ManifoldPoint<double>& p = c.points[i];
    p = ManifoldPoint<double>{};
    if (i >= touching.touch.count) continue;
    const TouchPoint& t = touching.touch.points[i];
    p.ax = t.arm_a.x();
    p.ay = t.arm_a.y();
    p.bx = t.arm_b.x();
    p.by = t.arm_b.y();
    p.separation = t.gap;
    p.id = t.id;
    for (std::uint32_t j = 0; j < old_count; ++j) {
      if (old[j].id != t.id || taken[j]) continue;
      p.normal_impulse = old[j].normal_impulse;
      p.tangent_impulse = old[j].tangent_impulse;
      p.total_normal_impulse = old[j].total_normal_impulse;
      p.total_tangent_impulse = old[j].total_tangent_impulse;
      taken[j] = true;
      break;
    }
  }
  // What a point did that is gone stays with the contact.
  for (std::uint32_t j = 0; j < old_count; ++j) {
    if (taken[j]) continue;
    c.points[0].total_normal_impulse += old[j].total_normal_impulse;
    c.points[0].total_tangent_impulse += old[j].total_tangent_impulse;
  }
  pairs_[touching.contact].touch_id = touching.touch.points[0].id;
}

// Out of work: the bodies stand until the step ends and keep their velocities.
void PreciseStep::stop_cluster() {
  for (std::uint32_t slot : cluster_) {
    Path& path = paths_[slot];
    path.ax = path.ay = path.aw = path.gain_x = path.gain_y = path.gain_w = 0;
    path.since = h_;
  }
}

}  // namespace urto

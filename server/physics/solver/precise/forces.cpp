#include <algorithm>

#include "physics/constants.h"
#include "physics/solver/precise/step.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
namespace {

void set_row(double* row, const Vec2& u, const MiddleOfTouch& p, const Body<double>& a, const Body<double>& b) {
  row[0] = -u.x();
  row[1] = -u.y();
  row[2] = a.inv_inertia > 0.0 ? -cross<double>(p.arm_a, u) : 0.0;
  row[3] = u.x();
  row[4] = u.y();
  row[5] = b.inv_inertia > 0.0 ? cross<double>(p.arm_b, u) : 0.0;
}

ProblemBody problem_body(const Body<double>& body) {
  ProblemBody out;
  out.inverse_mass[0] = out.inverse_mass[1] = body.inv_mass;
  out.inverse_mass[2] = body.inv_inertia;
  out.mass[0] = out.mass[1] = body.mass;
  out.mass[2] = body.inv_inertia > 0.0 ? body.inertia : 1.0;
  return out;
}

}  // namespace

// kImpact: velocities at once. kForces: velocities after `duration`. kPlaces: shifts that part what overlaps.
void PreciseStep::build_problem(Purpose purpose, double duration) {
  problem_.clear();
  origins_.clear();
  for (std::uint32_t slot : cluster_) {
    ProblemBody body = problem_body(world_->bodies[slot]);
    const Path& path = paths_[slot];
    if (purpose != Purpose::kPlaces) {
      body.free[0] = path.vx + duration * path.gain_x;
      body.free[1] = path.vy + duration * path.gain_y;
      body.free[2] = path.w + duration * path.gain_w;
    }
    problem_.bodies.push_back(body);
  }
  for (std::uint32_t i = 0; i < touching_.size(); ++i) {
    if (purpose == Purpose::kForces) pairs_[touching_[i].contact].held = 0;
    for (int k = 0; k < touching_[i].touch.count; ++k) {
      if (purpose == Purpose::kForces) {
        if (parting(touching_[i], k) > kRestSpeed) continue;
        ++pairs_[touching_[i].contact].held;
      }
      add_point(purpose, i, static_cast<std::uint32_t>(k), duration);
    }
  }
}

void PreciseStep::add_point(Purpose purpose, std::uint32_t index, std::uint32_t k, double duration) {
  const Touching& t = touching_[index];
  const Contact<double>& c = world_->contacts[t.contact];
  const Body<double>&a = world_->bodies[c.body_a], &b = world_->bodies[c.body_b];
  const TouchPoint& touch = t.touch.points[k];
  // Impacts and shifts happen at once: there the middle is the moment itself.
  const MiddleOfTouch middle = middle_of(*world_, c, t.touch.normal, touch, paths_[c.body_a], paths_[c.body_b],
                                         purpose == Purpose::kForces ? duration : 0.0);
  const Vec2 normal = middle.normal, tangent = cross<double>(normal, 1.0);
  ProblemPoint p;
  set_row(p.normal, normal, middle, a, b);
  set_row(p.tangent, tangent, middle, a, b);
  if (a.dynamic()) p.a = locals_[c.body_a];
  if (b.dynamic()) p.b = locals_[c.body_b];
  if (purpose == Purpose::kPlaces) {
    p.target = touch.gap < -kPenetrationMin ? min_of(-kPenetrationShare * touch.gap, kPushSpeedMax * h_) : 0.0;
  } else {
    // What cannot be moved may move by itself.
    const Path still, &path_a = a.dynamic() ? still : paths_[c.body_a],
                      &path_b = b.dynamic() ? still : paths_[c.body_b];
    p.drive_normal = parting_speed(normal, middle.arm_a, path_a, middle.arm_b, path_b) + middle.gain_normal;
    p.drive_tangent = parting_speed(tangent, middle.arm_a, path_a, middle.arm_b, path_b) + middle.gain_tangent;
    p.friction = world_->model.friction ? c.friction : 0.0;
  }
  if (purpose == Purpose::kForces) {
    p.normal_impulse = c.points[k].normal_impulse * (duration / h_);
    p.tangent_impulse = c.points[k].tangent_impulse * (duration / h_);
  }
  problem_.points.push_back(p);
  origins_.push_back({index, k});
}

// Overlap is taken back by a shift alone, the least in terms of mass: it gives nobody a velocity, but for the turn that
// keeps angular momentum.
void PreciseStep::part_overlaps() {
  bool overlaps = false;
  for (const Touching& t : touching_)
    for (int i = 0; i < t.touch.count; ++i) overlaps |= t.touch.points[i].gap < -kPenetrationMin;
  if (!overlaps) return;
  build_problem(Purpose::kPlaces, 0.0);
  solve(problem_, workspace_);
  for (std::size_t i = 0; i < cluster_.size(); ++i) {
    Path& path = paths_[cluster_[i]];
    path.dx += problem_.bodies[i].velocity[0];
    path.dy += problem_.bodies[i].velocity[1];
    path.da += problem_.bodies[i].velocity[2];
  }
  for (std::size_t k = 0; k < origins_.size(); ++k) {
    const ProblemPoint& p = problem_.points[k];
    const Contact<double>& c = world_->contacts[touching_[origins_[k].touching].contact];
    const Path &a = paths_[c.body_a], &b = paths_[c.body_b];
    turn_both(c, -p.normal_impulse * (p.normal[3] * (b.vy - a.vy) - p.normal[4] * (b.vx - a.vx)));
  }
}

void PreciseStep::find_forces(double now) {
  double duration = h_ - now;
  for (std::uint32_t slot : cluster_) thrust_->accelerate(world_->bodies[slot], paths_[slot], h_);
  build_problem(Purpose::kForces, duration);
  if (problem_.points.empty()) return;
  solve(problem_, workspace_);
  std::uint32_t contact = kNone;
  const double share = until_stop(contact);
  if (contact != kNone) {
    duration *= share;
    build_problem(Purpose::kForces, duration);
    solve(problem_, workspace_);
    ++pairs_[contact].stops;
    const Contact<double>& c = world_->contacts[contact];
    events_.push_back({now + duration, contact, versions_[c.body_a], versions_[c.body_b]});
    std::push_heap(events_.begin(), events_.end(), later);
  }
  take_forces(duration);
}

// The share of the time after which the first contact that slides now will stick. One that sticks at the end had, for a
// part of the time, all the friction that it could have, and none to spare after that: the mean tells the part. Faces
// and round shapes only: the force at a lone corner changes as the body turns over it, and has no such mean.
double PreciseStep::until_stop(std::uint32_t& contact) const {
  double first = 1;
  if (!world_->model.friction || cluster_.size() > kStopClusterMax) return first;
  for (std::size_t k = 0; k < origins_.size(); ++k) {
    const std::uint32_t index = origins_[k].touching;
    const Touching& t = touching_[index];
    const Contact<double>& c = world_->contacts[t.contact];
    const bool pair = k + 1 < origins_.size() && origins_[k + 1].touching == index;
    const bool round = world_->convexes[c.shape_a].count == 1 || world_->convexes[c.shape_b].count == 1;
    if (!(pair || round) || origins_[k].point > 0 || pairs_[t.contact].stops >= kStopsMax) continue;
    const TouchPoint& touch = t.touch.points[0];
    const double slide =
        parting_speed(cross<double>(t.touch.normal, 1.0), touch.arm_a, paths_[c.body_a], touch.arm_b, paths_[c.body_b]);
    double normal = problem_.points[k].normal_impulse, tangent = problem_.points[k].tangent_impulse;
    if (pair) {
      normal += problem_.points[k + 1].normal_impulse;
      tangent += problem_.points[k + 1].tangent_impulse;
    }
    if (absolute(slide) <= kRestSpeed || !(normal > 0.0) || c.friction == 0.0) continue;
    const double share = absolute(tangent) / (c.friction * normal);
    if (share >= first - kStopLeast || share <= kStopLeast) continue;
    first = share;
    contact = t.contact;
  }
  return first;
}

void PreciseStep::take_forces(double duration) {
  for (std::size_t i = 0; i < cluster_.size(); ++i) {
    Path& path = paths_[cluster_[i]];
    const ProblemBody& body = problem_.bodies[i];
    const double x = (body.velocity[0] - body.free[0]) / duration, y = (body.velocity[1] - body.free[1]) / duration,
                 w = (body.velocity[2] - body.free[2]) / duration;
    path.ax += x;
    path.ay += y;
    path.aw += w;
    path.gain_x += x;
    path.gain_y += y;
    path.gain_w += w;
  }
  for (std::size_t k = 0; k < origins_.size(); ++k) {
    const ProblemPoint& p = problem_.points[k];
    const std::uint32_t contact = touching_[origins_[k].touching].contact, point = origins_[k].point;
    pairs_[contact].normal_force[point] = p.normal_impulse / duration;
    pairs_[contact].tangent_force[point] = p.tangent_impulse / duration;
    const auto sum = [&](int i) {
      return (p.normal_impulse * p.normal[i] + p.tangent_impulse * p.tangent[i]) / duration;
    };
    pairs_[contact].force_x += sum(3);
    pairs_[contact].force_y += sum(4);
    pairs_[contact].torque += sum(2) + sum(5);
    world_->contacts[contact].points[point].normal_impulse = p.normal_impulse * (h_ / duration);
    world_->contacts[contact].points[point].tangent_impulse = p.tangent_impulse * (h_ / duration);
  }
}

}  // namespace urto

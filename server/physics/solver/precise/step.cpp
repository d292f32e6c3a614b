#include "physics/solver/precise/step.h"

#include <algorithm>

#include "physics/bounds.h"
#include "physics/contact_graph.h"
#include "physics/motion.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
PreciseSolver::PreciseSolver() : step_(std::make_unique<PreciseStep>()) {}
PreciseSolver::~PreciseSolver() = default;
void PreciseSolver::solve(WorldData<double>& world) { step_->run(world); }

void PreciseStep::run(WorldData<double>& world) {
  world_ = &world;
  begin();
  widen_bounds(world_->awake);
  settle_all();
  schedule_all();
  take_events();
  finish();
}

void PreciseStep::begin() {
  h_ = world_->settings.time_step;
  thrust_.emplace(*world_);
  const std::size_t bodies = world_->bodies.size();
  paths_.assign(bodies, Path{});
  versions_.assign(bodies, 0);
  serials_.assign(bodies, 0);
  locals_.assign(bodies, kNone);
  pairs_.assign(world_->contacts.size(), Pair{});
  events_.clear();
  serial_ = 0;
  work_done_ = 0;
  work_most_ = kWorkLeast + static_cast<std::uint64_t>(kWorkFactor) * world_->awake.size();
  for (std::uint32_t slot : world_->awake) start_path(slot, 0.0);
  for (const ActiveContact& active : world_->active) {
    for (ManifoldPoint<double>& p : world_->contacts[active.contact].points)
      p.total_normal_impulse = p.total_tangent_impulse = 0;
  }
}

void PreciseStep::start_path(std::uint32_t slot, double now) {
  const Motion<double>& m = world_->motions[slot];
  Path& path = paths_[slot];
  path = Path{};
  path.since = now;
  path.vx = m.vx;
  path.vy = m.vy;
  path.w = m.w;
  if (slot < world_->speed_rests.size()) {
    const SpeedRest& rest = world_->speed_rests[slot];
    path.rest_x = rest.vx == m.vx ? rest.rest_x : 0.0;
    path.rest_y = rest.vy == m.vy ? rest.rest_y : 0.0;
  }
  thrust_->accelerate(world_->bodies[slot], path, h_);
}

// The broad phase has seen ways at even velocities. Where acceleration, turning or a change of course leads a body out
// of its bounds, pairs are sought once more.
void PreciseStep::widen_bounds(const std::vector<std::uint32_t>& slots) {
  bool moved = false;
  for (std::uint32_t slot : slots) {
    const Body<double>& body = world_->bodies[slot];
    const Path& path = paths_[slot];
    const Path end = path.from(h_);
    // A parabola stays within the triangle of its ends and the point where their tangents meet.
    const double half = 0.5 * (h_ - path.since);
    const double mid_x = path.dx + half * path.vx, mid_y = path.dy + half * path.vy;
    const double way = absolute(end.da - path.da) + absolute(path.aw) * h_ * h_;
    for (Proxy p = body.first_shape; p != kNone; p = world_->shapes[p].next) {
      Shape<double>& shape = world_->shapes[p];
      const Aabb<double> box = world_->convexes[p].bounds(body.pose());
      Aabb<double> sweep = box;
      for (const Vec2& d : {Vec2(path.dx, path.dy), Vec2(end.dx, end.dy), Vec2(mid_x, mid_y)})
        sweep = sweep.merged(Aabb<double>{box.lower + d, box.upper + d});
      sweep = sweep.expanded(min_of(way, 2.0) * body.extent_max + kTouchDistance);
      if (shape.fat.contains(sweep)) continue;
      shape.fat = sweep.expanded(shape.margin);
      world_->broad_phase->move(p, shape.fat);
      mark_moved(*world_, p);
      moved = true;
    }
  }
  if (!moved) return;
  update_broad_phase(*world_);
  pairs_.resize(world_->contacts.size());
}

void PreciseStep::settle_all() {
  // By index: settling may wake bodies, which are appended.
  for (std::size_t i = 0; i < world_->awake.size(); ++i) {
    const std::uint32_t slot = world_->awake[i];
    if (world_->bodies[slot].dynamic() && serials_[slot] == 0) settle(slot, 0.0);
  }
}

void PreciseStep::schedule_all() {
  for (std::size_t i = 0; i < world_->active.size(); ++i) schedule(world_->active[i].contact, 0.0);
}

void PreciseStep::take_events() {
  while (!events_.empty()) {
    std::pop_heap(events_.begin(), events_.end(), later);
    const Event event = events_.back();
    events_.pop_back();
    const Contact<double>& c = world_->contacts[event.contact];
    if (versions_[c.body_a] != event.version_a || versions_[c.body_b] != event.version_b) continue;
    take(event);
  }
}

void PreciseStep::take(const Event& event) {
  const Contact<double>& c = world_->contacts[event.contact];
  changed_.clear();
  const std::size_t awake_before = world_->awake.size();
  for (std::uint32_t slot : {c.body_a, c.body_b})
    if (world_->bodies[slot].dynamic()) wake_body(*world_, slot);
  for (std::size_t i = awake_before; i < world_->awake.size(); ++i) start_path(world_->awake[i], event.time);
  const std::uint32_t seeds = serial_, strikes = pairs_[event.contact].strikes;
  const bool was_held = pairs_[event.contact].held > 0;
  settle(world_->bodies[c.body_a].dynamic() ? c.body_a : c.body_b, event.time);
  for (std::size_t i = awake_before; i < world_->awake.size(); ++i) {
    const std::uint32_t slot = world_->awake[i];
    if (world_->bodies[slot].dynamic() && serials_[slot] <= seeds) settle(slot, event.time);
  }
  // Nothing came of it (a search that ran out of rounds, corners that pass each other), or too much: look again later.
  // What touched until now may strike with its other end next: that is looked for at once.
  Pair& met = pairs_[event.contact];
  if (!was_held && met.held == 0 && (met.strikes == strikes || met.strikes > kStrikesMax)) {
    met.silence = met.silence == 0.0 ? kSilence * h_ : kSilenceGrowth * met.silence;
    met.silent_until = event.time + met.silence;
  }
  widen_bounds(changed_);
  for (std::uint32_t slot : changed_) {
    for_each_contact_of(*world_, slot, [&](std::uint32_t contact) {
      if (pairs_[contact].scheduled == serial_) return;
      pairs_[contact].scheduled = serial_;
      schedule(contact, event.time);
    });
  }
}

void PreciseStep::finish() {
  for (std::uint32_t slot : world_->awake) paths_[slot] = paths_[slot].from(h_);
  for (const ActiveContact& active : world_->active) account(active.contact, h_);
  world_->speed_rests.resize(world_->bodies.size());
  for (std::uint32_t slot : world_->awake) {
    const Path& end = paths_[slot];
    world_->speed_rests[slot] = {end.vx, end.vy, end.rest_x, end.rest_y};
    Motion<double>& m = world_->motions[slot];
    m.vx = end.vx;
    m.vy = end.vy;
    m.w = end.w;
    m.dx = end.dx;
    m.dy = end.dy;
    m.da = end.da;
    rotation_by(m.da, m.c, m.s);
  }
}

}  // namespace urto

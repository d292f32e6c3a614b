#include <algorithm>

#include "physics/solver/precise/impact_time.h"
#include "physics/solver/precise/step.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
namespace {

// Faces that look at each other up to this angle lie on each other.
constexpr double kFlushAngle = 1e-9;  // rad

// The first s > 0 with rate·s + gain·s²/2 = angle, or a negative number. An angle of nothing is come back to.
double first_turn_by(double angle, double rate, double gain) {
  if (absolute(angle) < kFlushAngle) return rate * gain < 0.0 ? -2 * rate / gain : -1.0;
  if (gain == 0.0) return rate == 0.0 ? -1.0 : angle / rate;
  const double under = rate * rate + 2 * gain * angle;
  if (under < 0.0) return -1.0;
  const double root = std::sqrt(under);
  // Without cancellation: q = −(rate + sign(rate)·root), roots q/gain and −2·angle/q.
  const double q = -(rate + (rate < 0.0 ? -root : root));
  const double r1 = q / gain, r2 = q != 0.0 ? -2 * angle / q : -1.0;
  const double low = min_of(r1, r2), high = max_of(r1, r2);
  return low > 0.0 ? low : high;
}

}  // namespace

// Two polygons that touch with a corner on a face touch along it when one of the faces beside the corner comes to lie
// flush with that face, which is a matter of their turn alone.
std::optional<double> PreciseStep::closing_time(std::uint32_t contact, double now) const {
  const Contact<double>& c = world_->contacts[contact];
  const Convex<double>&a = world_->convexes[c.shape_a], &b = world_->convexes[c.shape_b];
  if (a.count < 3 || b.count < 3) return {};
  const Path pa = paths_[c.body_a].from(now), pb = paths_[c.body_b].from(now);
  const Stance at_a(world_->bodies[c.body_a], pa), at_b(world_->bodies[c.body_b], pb);
  const bool flip = (pairs_[contact].touch_id & (1u << 16)) != 0;
  const Convex<double>& incident = flip ? a : b;
  const Rotation<double>& turn = flip ? at_a.q : at_b.q;
  const std::uint32_t corner = pairs_[contact].touch_id & 0xffu;
  if (corner >= incident.count) return {};
  const Vec2 outward(flip ? -c.nx : c.nx, flip ? -c.ny : c.ny);  // of the reference face
  const double sign = flip ? -1.0 : 1.0;
  const double rate = sign * (pb.w - pa.w), gain = sign * (pb.aw - pa.aw);
  double first = h_;
  for (std::uint32_t face : {corner, corner == 0 ? incident.count - 1 : corner - 1}) {
    const Vec2 normal = turn.apply(incident.normals[face]);
    const double angle = atan2_of(cross<double>(normal, -outward), dot<double>(normal, -outward));
    const double s = first_turn_by(angle, rate, gain);
    if (s > 0.0) first = min_of(first, now + s);
  }
  if (first < h_) return first;
  return {};
}

void PreciseStep::schedule(std::uint32_t contact, double now) {
  const Contact<double>& c = world_->contacts[contact];
  if (c.sensor()) return;
  const Pair& pair = pairs_[contact];
  double time = h_;
  if (pair.held > 0) {
    if (pair.held > 1) return;
    const std::optional<double> flush = closing_time(contact, now);
    if (!flush) return;
    time = *flush;
  } else {
    const double from = max_of(now, pair.silent_until);
    if (from >= h_) return;
    const Encounter encounter = first_encounter(*world_, c, paths_[c.body_a], paths_[c.body_b], from, h_);
    if (!encounter.meets) return;
    time = encounter.time;
  }
  if (time >= h_) return;
  events_.push_back({time, contact, versions_[c.body_a], versions_[c.body_b]});
  std::push_heap(events_.begin(), events_.end(), later);
}

}  // namespace urto

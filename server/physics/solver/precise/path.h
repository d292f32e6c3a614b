#pragma once

#include "physics/data.h"
#include "physics/force_field.h"

namespace urto {

// sum += term; what rounding takes away is kept and comes with the next term (Kahan 1965, and Neumaier's order of the
// two), or a velocity that gains the same in each step would drift by the same rounding error in each.
inline void add_keeping_rest(double& sum, double& rest, double term) {
  const double gain = term + rest, next = sum + gain;
  rest = absolute(sum) >= absolute(gain) ? (sum - next) + gain : (gain - next) + sum;
  sum = next;
}

// The way of a body within a step from a moment on, until something happens to it: a parabola, and a turn that speeds
// up evenly. Places are relative to where the body was when the step began, so that distance from the origin costs no
// digits. The velocity has an acceleration of its own: through force fields, that of Verlet's velocity form.
struct Path {
  double since = 0;                           // s into the step
  double dx = 0, dy = 0, da = 0;              // m, m, rad since the step began
  double vx = 0, vy = 0, w = 0;               // m/s, rad/s
  double rest_x = 0, rest_y = 0;              // m/s: what rounding left out of the velocity
  double ax = 0, ay = 0, aw = 0;              // m/s², rad/s²: of the place
  double gain_x = 0, gain_y = 0, gain_w = 0;  // m/s², rad/s²: of the velocity

  // The same way, told from a later moment.
  Path from(double time) const {
    if (time <= since) return *this;  // a body that was stopped stays there
    Path p = *this;
    const double s = time - since;
    p.since = time;
    p.dx += s * (vx + 0.5 * s * ax);
    p.dy += s * (vy + 0.5 * s * ay);
    p.da += s * (w + 0.5 * s * aw);
    add_keeping_rest(p.vx, p.rest_x, s * gain_x);
    add_keeping_rest(p.vy, p.rest_y, s * gain_y);
    p.w += s * gain_w;
    return p;
  }
};

// What pushes a body besides contacts: gravity, fields, damping, its own force.
class Thrust {
 public:
  explicit Thrust(const WorldData<double>& world);

  // Sets the accelerations of a free flight from path.since to `end`. Without fields and damping they are constant and
  // the flight is exact; with them it is of second order.
  void accelerate(const Body<double>& body, Path& path, double end) const;

 private:
  struct Acceleration {
    double x, y, w;
  };
  Acceleration at(const Body<double>& body, const Path& path) const;

  const Model& model_;
  Vec2 gravity_;
  Fields<double> fields_;
};

// How a body stands at a moment: its turn, and where its centre of mass is relative to the start of the step.
struct Stance {
  double dx, dy;
  Rotation<double> q;
  Stance(const Body<double>& body, const Path& path);
};

// b's centre of mass as seen from a's.
inline Vec2 between(const Body<double>& a, const Stance& at_a, const Body<double>& b, const Stance& at_b) {
  return Vec2((b.x - a.x) + (at_b.dx - at_a.dx), (b.y - a.y) + (at_b.dy - at_a.dy));
}
// b's frame as seen from a's.
Transform<double> frame_of(const Body<double>& a, const Stance& at_a, const Body<double>& b, const Stance& at_b);

}  // namespace urto

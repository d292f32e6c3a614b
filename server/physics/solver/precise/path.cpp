#include "physics/solver/precise/path.h"

#include "physics/motion.h"

namespace urto {

Thrust::Thrust(const WorldData<double>& world)
    : model_(world.model), gravity_(world.settings.gravity), fields_(world.settings.fields) {}

Thrust::Acceleration Thrust::at(const Body<double>& body, const Path& path) const {
  Vec2 a = gravity_ * body.gravity_scale;
  double w = 0;
  if (body.flags & kBodyHasForce) {
    Vec2 force(body.force_x, body.force_y);
    if (body.flags & kBodyForceInBodyFrame) force = Stance(body, path).q.apply(force);
    a += force * body.inv_mass;
    w = body.torque * body.inv_inertia;
  }
  const Vec2 v(path.vx, path.vy);
  if (model_.fields) a += fields_.acceleration(Vec2(body.x + path.dx, body.y + path.dy), v, body.inv_mass);
  if (model_.damping) {
    a -= v * body.linear_damping;
    w -= path.w * body.angular_damping;
  }
  return {a.x(), a.y(), w};
}

void Thrust::accelerate(const Body<double>& body, Path& path, double end) const {
  if (!body.dynamic()) return;
  const Acceleration start = at(body, path);
  path.ax = path.gain_x = start.x;
  path.ay = path.gain_y = start.y;
  path.aw = path.gain_w = body.can_rotate() ? start.w : 0.0;
  if (!model_.fields && !model_.damping && !(body.flags & kBodyForceInBodyFrame)) return;
  const Acceleration later = at(body, path.from(end));
  path.gain_x = 0.5 * (start.x + later.x);
  path.gain_y = 0.5 * (start.y + later.y);
  if (body.can_rotate()) path.gain_w = 0.5 * (start.w + later.w);
}

Stance::Stance(const Body<double>& body, const Path& path) : dx(path.dx), dy(path.dy), q(body.rotation()) {
  if (path.da == 0.0) return;
  Rotation<double> turn;
  rotation_by(path.da, turn.c, turn.s);
  q = turn.times(body.rotation());
}

Transform<double> frame_of(const Body<double>& a, const Stance& at_a, const Body<double>& b, const Stance& at_b) {
  Transform<double> frame;
  frame.q = at_a.q.inverse_times(at_b.q);
  frame.p = (at_a.q.apply_inverse(between(a, at_a, b, at_b)) + a.local_center()) - frame.q.apply(b.local_center());
  return frame;
}

}  // namespace urto

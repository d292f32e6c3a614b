#include "physics/motion.h"

#include "physics/constants.h"
#include "physics/integrator.h"

namespace urto {

template <class S>
void rotation_by(S angle, S& c, S& s) {
  // Up to here the Taylor terms left out are under 1e-17 (sine to x¹⁵, cosine to x¹⁴; float needs fewer).
  if (absolute(angle) > S(kSmallTurn)) return sin_cos(angle, s, c);
  const S q = angle * angle;
  if constexpr (sizeof(S) == 4) {
    s = angle * (S(1) + q * (S(-1.0 / 6) + q * (S(1.0 / 120) + q * S(-1.0 / 5040))));
    c = S(1) + q * (S(-0.5) + q * (S(1.0 / 24) + q * S(-1.0 / 720)));
  } else {
    s = angle *
        (1 + q * (-1.0 / 6 +
                  q * (1.0 / 120 +
                       q * (-1.0 / 5040 + q * (1.0 / 362880 + q * (-1.0 / 39916800 + q * (1.0 / 6227020800.0)))))));
    c = 1 + q * (-0.5 + q * (1.0 / 24 +
                             q * (-1.0 / 720 + q * (1.0 / 40320 + q * (-1.0 / 3628800 + q * (1.0 / 479001600.0))))));
  }
}

template <class S>
Mover<S>::Mover(const WorldData<S>& world, S h)
    : model_(world.model),
      integrator_(world.settings.integrator),
      gravity_(world.settings.gravity.template cast<S>()),
      fields_(world.settings.fields),
      h_(h) {}

template <class S>
Vec<S> Mover<S>::acceleration(const Body<S>& body, const Motion<S>& motion, const Vec<S>& x, const Vec<S>& v) const {
  Vec<S> a = gravity_ * body.gravity_scale;
  if (body.flags & kBodyHasForce) {
    Vec<S> force(body.force_x, body.force_y);
    if (body.flags & kBodyForceInBodyFrame) force = Rotation<S>{motion.c, motion.s}.times(body.rotation()).apply(force);
    a += force * body.inv_mass;
  }
  if (model_.fields) a += fields_.acceleration(x, v, body.inv_mass);
  return a;
}

template <class S>
void Mover<S>::integrate_velocity(const Body<S>& body, Motion<S>& motion) const {
  if (!body.dynamic()) return;
  const Vec<S> x(body.x + motion.dx, body.y + motion.dy), v(motion.vx, motion.vy);
  const Vec<S> next = v + acceleration(body, motion, x, v) * h_;
  motion.vx = next.x();
  motion.vy = next.y();
  if (body.flags & kBodyHasForce) motion.w += h_ * body.torque * body.inv_inertia;
  if (model_.damping) {
    const S linear = S(1) / (S(1) + h_ * body.linear_damping);
    motion.vx *= linear;
    motion.vy *= linear;
    motion.w *= S(1) / (S(1) + h_ * body.angular_damping);
  }
}

template <class S>
void Mover<S>::integrate_position(Motion<S>& motion) const {
  motion.dx += h_ * motion.vx;
  motion.dy += h_ * motion.vy;
  motion.da += h_ * motion.w;  // a body that cannot turn has no angular velocity
  rotation_by(motion.da, motion.c, motion.s);
}

template <class S>
void Mover<S>::fly(const Body<S>& body, Motion<S>& motion) const {
  if (!body.dynamic()) return integrate_position(motion);
  const auto a = [&](const Vec<S>& x, const Vec<S>& v) {
    return Vec<S>(acceleration(body, motion, x, v) - v * body.linear_damping);
  };
  // The integrators see the way since the start of the step added to where the body was.
  const Vec<S> start(body.x, body.y);
  const Flight<S> now{Vec<S>(start.x() + motion.dx, start.y() + motion.dy), Vec<S>(motion.vx, motion.vy)};
  const Flight<S> next = advance<S>(integrator_, now, h_, a);
  const S w = motion.w;
  if (body.flags & kBodyHasForce) motion.w += h_ * body.torque * body.inv_inertia;
  if (model_.damping) motion.w *= S(1) / (S(1) + h_ * body.angular_damping);
  motion.vx = next.v.x();
  motion.vy = next.v.y();
  motion.dx = next.x.x() - start.x();
  motion.dy = next.x.y() - start.y();
  if (!body.can_rotate()) return;
  motion.da += h_ * (integrator_ == Integrator::kExplicitEuler       ? w
                     : integrator_ == Integrator::kSemiImplicitEuler ? motion.w
                                                                     : S(0.5) * (w + motion.w));
  rotation_by(motion.da, motion.c, motion.s);
}

template <class S>
void saturate(Motion<S>& motion) {
  const S most = S(kSpeedMax), turn_most = S(kAngularSpeedMax);
  motion.vx = clamp_to(motion.vx, -most, most);
  motion.vy = clamp_to(motion.vy, -most, most);
  motion.w = clamp_to(motion.w, -turn_most, turn_most);
}

template class Mover<float>;
template class Mover<double>;
template void saturate(Motion<float>&);
template void saturate(Motion<double>&);
template void rotation_by(float, float&, float&);
template void rotation_by(double, double&, double&);

}  // namespace urto

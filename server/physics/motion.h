#pragma once

#include "physics/data.h"
#include "physics/force_field.h"

namespace urto {

// Moves bodies: velocities from forces, positions from velocities. `h` is a sub-step in seconds.

template <class S>
class Mover {
 public:
  Mover(const WorldData<S>& world, S h);

  // What integrate_velocity adds to a body that only the uniform gravity acts on, m/s.
  Vec<S> pull(const Body<S>& body) const {
    return body.dynamic() ? Vec<S>(gravity_ * body.gravity_scale * h_) : Vec<S>(Vec<S>::Zero());
  }
  // v += h a, then damping (implicit: v / (1 + h d), stable for any d).
  void integrate_velocity(const Body<S>& body, Motion<S>& motion) const;
  // x += h v, angle += h ω.
  void integrate_position(Motion<S>& motion) const;
  // Both at once by the scene's integrator, for a body that nothing touches.
  void fly(const Body<S>& body, Motion<S>& motion) const;

 private:
  Vec<S> acceleration(const Body<S>& body, const Motion<S>& motion, const Vec<S>& x, const Vec<S>& v) const;

  const Model& model_;
  Integrator integrator_;
  Vec<S> gravity_;
  Fields<S> fields_;
  S h_;
};

// Speeds saturate at kSpeedMax and kAngularSpeedMax, far beyond what a scene means: what overflows is lost for good.
template <class S>
void saturate(Motion<S>& motion);

// The rotation by a small or large angle, without the full reduction when it is small.
inline constexpr double kSmallTurn = 0.25;  // rad
template <class S>
void rotation_by(S angle, S& c, S& s);

}  // namespace urto

#pragma once

#include "physics/solver/precise/touch.h"

namespace urto {

// The impact of two bodies, free of time: only velocities change.
struct Collision {
  const Body<double>&a, &b;
  Path &path_a, &path_b;  // of one moment
  double friction, restitution;
};

struct PointImpulse {
  double normal = 0, tangent = 0;  // N·s; the tangent is the normal turned by −90°
};

// One point, by the energetic law (Stronge 1990): the normal impulse grows from nothing, the tangent follows by
// Coulomb's law through slip, stick and reversal (Routh 1905), and the impact ends when the normal force has given back
// e² of the work that it took. Friction only ever takes, so energy never grows; without it this is Newton's law. All of
// it is piecewise linear in the normal impulse and taken exactly, piece by piece.
PointImpulse collide_at_point(const Collision& c, const Vec2& normal, const TouchPoint& point);

// Both points of a touch at once: the impulses that stop the approach (inelastic, with friction), then e times the
// normal ones once more with what friction they allow. If that would make energy, (1 + e) times the former, which never
// does: with T the energy and λ of the inelastic solution, T falls along λ and is a parabola symmetric about λ or
// beyond.
void collide_at_points(const Collision& c, const Touch& touch, PointImpulse (&impulses)[2]);

// Changes both bodies' velocities by an impulse at one world point.
void apply(const Collision& c, const Vec2& impulse, const TouchPoint& point);

}  // namespace urto

#pragma once

#include "physics/constants.h"
#include "physics/data.h"

namespace urto {

// The sum of the scene's force fields, ready in the world's scalar.
template <class S>
struct Fields {
  struct Attractor {
    Vec<S> center;
    S strength, softening_squared;
  };
  struct Dragging {
    S linear, quadratic;
  };
  struct Springing {
    Vec<S> center;
    S stiffness, damping;
  };
  std::vector<Attractor> attractors;
  std::vector<Dragging> drags;
  std::vector<Springing> springs;

  explicit Fields(const std::vector<ForceField>& fields);

  // m/s² at position x and velocity v of a body with this inverse mass.
  Vec<S> acceleration(const Vec<S>& x, const Vec<S>& v, S inv_mass) const {
    Vec<S> a = Vec<S>::Zero();
    for (const Attractor& f : attractors) {
      const Vec<S> r = f.center - x;
      const S d2 = max_of(dot<S>(r, r) + f.softening_squared, S(kAttractionDistanceMin * kAttractionDistanceMin));
      a += r * (f.strength / (d2 * std::sqrt(d2)));
    }
    for (const Dragging& f : drags) a -= v * ((f.linear + f.quadratic * length<S>(v)) * inv_mass);
    for (const Springing& f : springs) a -= ((x - f.center) * f.stiffness + v * f.damping) * inv_mass;
    return a;
  }
};

// J, of the fields that have a potential: attractors and springs.
double field_potential(const std::vector<ForceField>& fields, const Vec2& position, double mass);

}  // namespace urto

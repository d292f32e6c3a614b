#pragma once

// What the peers' adapters share: refusals, mixing, masses.

#include <algorithm>
#include <cmath>

#include "accuracy/engine.h"
#include "accuracy/scene.h"

namespace urto::accuracy {

// What no peer has, or is not asked for. Throws Lacks.
inline void refuse_what_peers_lack(const WorldSettings& settings, unsigned threads) {
  if (threads > 1) throw Lacks("cases on several threads");
  if (!settings.fields.empty()) throw Lacks("force fields");
  if (settings.integrator != Integrator::kSemiImplicitEuler) throw Lacks("other integrators");
  if (settings.solver != SolverKind::kSoftStep) throw Lacks("other solvers");
  if (settings.broad_phase != BroadPhaseKind::kAuto) throw Lacks("other broad phases");
  if (settings.narrow_phase != NarrowPhaseKind::kSat) throw Lacks("other narrow phases");
}

// The joints of the cases: a hinge without limits, motor and spring, and a spring of a given length.
inline bool is_plain_hinge(const JointDef& def) {
  const auto* hinge = std::get_if<RevoluteJoint>(&def.geometry);
  return hinge && !hinge->limits && !hinge->motor && !hinge->spring;
}
inline const DistanceJoint& spring_of(const JointDef& def) {
  const auto* rod = std::get_if<DistanceJoint>(&def.geometry);
  if (!rod || !rod->length || !rod->spring || rod->limits) throw Lacks("joints of other kinds");
  return *rod;
}

inline double mixed(Mixing rule, double a, double b) {
  switch (rule) {
    case Mixing::kGeometricMean:
      return std::sqrt(a * b);
    case Mixing::kMaximum:
      return std::max(a, b);
    case Mixing::kMinimum:
      return std::min(a, b);
    case Mixing::kAverage:
      break;
  }
  return 0.5 * (a + b);
}

// At their best settings: a body that starts so fast that it may pass through another is marked for continuous
// collision with all, where an engine has such a mark.
inline bool is_bullet(const BodyDef& def, const WorldSettings& settings) {
  if (!settings.continuous || def.type != BodyType::kDynamic) return false;
  double thickness = 0;
  if (const auto* box = std::get_if<Box>(&def.shapes[0].geometry)) thickness = std::min(box->width, box->height);
  if (const auto* circle = std::get_if<Circle>(&def.shapes[0].geometry)) thickness = circle->radius;
  return thickness > 0 && def.velocity.norm() * settings.time_step > thickness;
}

// Mass and inertia that a given mass asks for: those of the density scaled.
inline double mass_scale(const BodyDef& def, double mass_by_density) {
  return def.mass ? *def.mass / mass_by_density : 1;
}

}  // namespace urto::accuracy

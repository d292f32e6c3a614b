#pragma once

#include <optional>
#include <string>

#include "physics/definitions.h"

namespace urto::accuracy {

// How a scene is computed: what is set here overrides what the scene says.
struct Method {
  std::string name;
  double step_scale = 1;  // of the scene's time step
  std::optional<std::uint32_t> sub_steps;
  std::optional<Precision> precision;
  std::optional<SolverKind> solver;
  std::optional<Integrator> integrator;
  std::optional<BroadPhaseKind> broad_phase;
  std::optional<NarrowPhaseKind> narrow_phase;
  std::optional<bool> continuous;
  std::optional<double> restitution_threshold;

  WorldSettings applied_to(WorldSettings settings) const;
};

// The profiles in which levels are set. They are the same for every case; none is tuned to one.
enum class Profile {
  kDefault,  // what a room gets: the defaults
  kPrecise,  // double precision, the precise solver, a flight of second order
  // Those below are for laws of integrators: double precision, and nothing else changed.
  kSemiImplicitEuler,
  kExplicitEuler,
  kVerlet,
  kRungeKutta4,
};

Method method_of(Profile profile);
// As reports and tests/accuracy/expected_failures.txt write it: default, precise, verlet …
std::string name_of(Profile profile);

}  // namespace urto::accuracy

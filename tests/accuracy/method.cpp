#include "accuracy/method.h"

namespace urto::accuracy {
namespace {

// Below it a bounce ends. The default of half a metre a second makes piles come to rest; whoever asks for precision
// means each bounce, down to one that rises a fiftieth of a millimetre.
constexpr double kPreciseRestitutionThreshold = 0.02;  // m/s

Method of_integrator(Profile profile, Integrator integrator) {
  Method method;
  method.name = name_of(profile);
  method.precision = Precision::kDouble;
  method.integrator = integrator;
  return method;
}

template <class T>
void override_with(const std::optional<T>& wanted, T& setting) {
  if (wanted) setting = *wanted;
}

}  // namespace

WorldSettings Method::applied_to(WorldSettings settings) const {
  settings.time_step *= step_scale;
  override_with(sub_steps, settings.sub_steps);
  override_with(precision, settings.precision);
  override_with(solver, settings.solver);
  override_with(integrator, settings.integrator);
  override_with(broad_phase, settings.broad_phase);
  override_with(narrow_phase, settings.narrow_phase);
  override_with(continuous, settings.continuous);
  override_with(restitution_threshold, settings.restitution_threshold);
  return settings;
}

std::string name_of(Profile profile) {
  switch (profile) {
    case Profile::kDefault:
      return "default";
    case Profile::kPrecise:
      return "precise";
    case Profile::kSemiImplicitEuler:
      return "semi_implicit_euler";
    case Profile::kExplicitEuler:
      return "explicit_euler";
    case Profile::kVerlet:
      return "verlet";
    case Profile::kRungeKutta4:
      return "runge_kutta_4";
  }
  return "";
}

Method method_of(Profile profile) {
  switch (profile) {
    case Profile::kSemiImplicitEuler:
      return of_integrator(profile, Integrator::kSemiImplicitEuler);
    case Profile::kExplicitEuler:
      return of_integrator(profile, Integrator::kExplicitEuler);
    case Profile::kVerlet:
      return of_integrator(profile, Integrator::kVerlet);
    case Profile::kRungeKutta4:
      return of_integrator(profile, Integrator::kRungeKutta4);
    case Profile::kPrecise: {
      Method method = of_integrator(profile, Integrator::kVerlet);
      method.solver = SolverKind::kPrecise;
      method.restitution_threshold = kPreciseRestitutionThreshold;
      return method;
    }
    case Profile::kDefault:
      break;
  }
  Method method;
  method.name = name_of(profile);
  return method;
}

}  // namespace urto::accuracy

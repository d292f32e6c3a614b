#include "physics/model.h"

#include "physics/constants.h"

namespace urto {
namespace {

BroadPhaseKind choose_broad_phase(const WorldSettings& settings, const Needs& needs) {
  if (settings.broad_phase != BroadPhaseKind::kAuto) return settings.broad_phase;
  return needs.shapes <= kBruteForceShapesMax ? BroadPhaseKind::kBruteForce : BroadPhaseKind::kBvh;
}

// Can the mixed coefficient of some pair be other than zero? The minimum and the geometric mean need two shapes that
// have it, the others one.
bool mixes_to_nonzero(Mixing mixing, std::uint32_t shapes_with_it) {
  const bool both = mixing == Mixing::kGeometricMean || mixing == Mixing::kMinimum;
  return shapes_with_it >= (both ? 2u : 1u);
}

const char* name_of(BroadPhaseKind kind) {
  switch (kind) {
    case BroadPhaseKind::kBruteForce:
      return "brute force";
    case BroadPhaseKind::kQuadtree:
      return "quadtree";
    case BroadPhaseKind::kBvh:
      return "dynamic BVH";
    case BroadPhaseKind::kAuto:
      break;
  }
  return "auto";
}

const char* name_of(SolverKind solver) {
  switch (solver) {
    case SolverKind::kSoftStep:
      return "soft step";
    case SolverKind::kThesis:
      return "thesis";
    case SolverKind::kPrecise:
      return "precise";
  }
  return "";
}

const char* name_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::kSemiImplicitEuler:
      return "semi-implicit Euler";
    case Integrator::kExplicitEuler:
      return "explicit Euler";
    case Integrator::kVerlet:
      return "Verlet";
    case Integrator::kRungeKutta4:
      return "Runge-Kutta 4";
  }
  return "";
}

std::string count_of(std::uint32_t count, const char* what) { return std::to_string(count) + " " + what; }

}  // namespace

Model choose_model(const WorldSettings& settings, const Needs& needs) {
  Model model;
  model.broad_phase = choose_broad_phase(settings, needs);
  model.friction = mixes_to_nonzero(settings.friction_mixing, needs.rough_shapes);
  model.restitution = mixes_to_nonzero(settings.restitution_mixing, needs.bouncing_shapes);
  model.damping = needs.damped_bodies > 0;
  model.fields = !settings.fields.empty();
  model.second_integrator = settings.integrator != Integrator::kSemiImplicitEuler;
  model.sleeping = settings.sleeping && settings.solver != SolverKind::kThesis;
  // The precise solver follows every way itself.
  model.continuous = settings.continuous && needs.dynamic_bodies > 0 && settings.solver != SolverKind::kPrecise;
  model.joints = needs.joints > 0;
  return model;
}

std::vector<Feature> explain_model(const WorldSettings& settings, const Needs& needs) {
  const Model model = choose_model(settings, needs);
  const bool asked_broad = settings.broad_phase != BroadPhaseKind::kAuto;
  const bool thesis = settings.solver == SolverKind::kThesis, precise = settings.solver == SolverKind::kPrecise;
  const bool polygons = needs.boxes + needs.polygons + needs.capsules + needs.chain_segments > 0;
  std::vector<Feature> out;
  out.push_back(
      {"precision", settings.precision == Precision::kFloat ? "float" : "double", true, "the scene names it"});
  out.push_back({"broad phase", name_of(model.broad_phase), true,
                 asked_broad ? "the scene names it" : count_of(needs.shapes, "shapes")});
  out.push_back({"narrow phase",
                 !polygons                                        ? "circles"
                 : settings.narrow_phase == NarrowPhaseKind::kSat ? "SAT"
                                                                  : "GJK and EPA",
                 true,
                 count_of(needs.boxes, "boxes, ") + count_of(needs.polygons, "polygons, ") +
                     count_of(needs.capsules, "capsules, ") + count_of(needs.chain_segments, "chain segments, ") +
                     count_of(needs.circles, "circles")});
  out.push_back({"solver", name_of(settings.solver), true,
                 precise ? "the scene names it; impacts at their own time, forces by a direct solve"
                         : count_of(settings.sub_steps, "sub-steps")});
  out.push_back({"integrator", precise ? "exact flight" : name_of(settings.integrator), true,
                 precise ? "of the precise solver; second order in force fields" : "the scene names it"});
  out.push_back({"rotation", needs.rotating_bodies > 0 ? "on" : "off", needs.rotating_bodies > 0,
                 count_of(needs.rotating_bodies, "bodies can turn")});
  out.push_back({"friction", model.friction ? "on" : "off", model.friction,
                 count_of(needs.rough_shapes, "shapes have friction")});
  out.push_back({"restitution", model.restitution ? "on" : "off", model.restitution,
                 count_of(needs.bouncing_shapes, "shapes have restitution")});
  out.push_back(
      {"damping", model.damping ? "on" : "off", model.damping, count_of(needs.damped_bodies, "bodies are damped")});
  out.push_back({"force fields", model.fields ? "on" : "off", model.fields,
                 count_of(static_cast<std::uint32_t>(settings.fields.size()), "fields besides gravity")});
  out.push_back({"joints", model.joints ? "on" : "off", model.joints, count_of(needs.joints, "joints")});
  out.push_back({"sensors", needs.sensors > 0 ? "on" : "off", needs.sensors > 0, count_of(needs.sensors, "sensors")});
  out.push_back({"hit events", settings.hit_events ? "on" : "off", settings.hit_events.has_value(),
                 settings.hit_events ? "the scene asks for them" : "the scene does not ask for them"});
  out.push_back({"sleeping", model.sleeping ? "on" : "off", model.sleeping,
                 thesis              ? "the thesis's solver has no rest"
                 : settings.sleeping ? "the default"
                                     : "the scene forbids it"});
  out.push_back({"continuous collision", model.continuous ? "on" : "off", model.continuous,
                 precise               ? "the precise solver follows every way itself"
                 : settings.continuous ? "only bodies that move further than their half-thickness pay for it"
                                       : "the scene forbids it"});
  return out;
}

}  // namespace urto

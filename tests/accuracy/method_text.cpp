#include "accuracy/method_text.h"

#include <map>
#include <sstream>
#include <stdexcept>

namespace urto::accuracy {
namespace {

template <class T>
T chosen(const std::map<std::string, T>& choices, const std::string& word) {
  const auto found = choices.find(word);
  if (found == choices.end()) throw std::invalid_argument("unknown word: " + word);
  return found->second;
}

void set(Method& method, const std::string& key, const std::string& value) {
  if (key == "step_scale") {
    method.step_scale = std::stod(value);
  } else if (key == "sub_steps") {
    method.sub_steps = static_cast<std::uint32_t>(std::stoul(value));
  } else if (key == "precision") {
    method.precision = chosen<Precision>({{"float", Precision::kFloat}, {"double", Precision::kDouble}}, value);
  } else if (key == "solver") {
    method.solver = chosen<SolverKind>(
        {{"soft_step", SolverKind::kSoftStep}, {"thesis", SolverKind::kThesis}, {"precise", SolverKind::kPrecise}},
        value);
  } else if (key == "integrator") {
    method.integrator = chosen<Integrator>({{"explicit_euler", Integrator::kExplicitEuler},
                                            {"semi_implicit_euler", Integrator::kSemiImplicitEuler},
                                            {"verlet", Integrator::kVerlet},
                                            {"runge_kutta_4", Integrator::kRungeKutta4}},
                                           value);
  } else if (key == "broad_phase") {
    method.broad_phase = chosen<BroadPhaseKind>({{"brute_force", BroadPhaseKind::kBruteForce},
                                                 {"quadtree", BroadPhaseKind::kQuadtree},
                                                 {"bvh", BroadPhaseKind::kBvh}},
                                                value);
  } else if (key == "narrow_phase") {
    method.narrow_phase =
        chosen<NarrowPhaseKind>({{"sat", NarrowPhaseKind::kSat}, {"gjk", NarrowPhaseKind::kGjk}}, value);
  } else if (key == "continuous") {
    method.continuous = chosen<bool>({{"on", true}, {"off", false}}, value);
  } else {
    throw std::invalid_argument("unknown setting: " + key);
  }
}

Method of_profile(const std::string& name) {
  for (const Profile profile : {Profile::kDefault, Profile::kPrecise, Profile::kSemiImplicitEuler,
                                Profile::kExplicitEuler, Profile::kVerlet, Profile::kRungeKutta4})
    if (name_of(profile) == name) return method_of(profile);
  throw std::invalid_argument("unknown profile: " + name);
}

}  // namespace

Method method_from(const std::string& text) {
  std::istringstream words(text);
  std::string word;
  std::getline(words, word, ',');
  Method method = of_profile(word);
  method.name = text;
  while (std::getline(words, word, ',')) {
    const auto equals = word.find('=');
    if (equals == std::string::npos) throw std::invalid_argument("a setting has no value: " + word);
    set(method, word.substr(0, equals), word.substr(equals + 1));
  }
  return method;
}

}  // namespace urto::accuracy

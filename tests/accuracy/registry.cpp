#include <cmath>
#include <limits>
#include <stdexcept>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

std::vector<Case> collect() {
  std::vector<Case> cases;
  add_flight_cases(cases);
  add_oscillation_cases(cases);
  add_bounce_cases(cases);
  add_impact_cases(cases);
  add_fast_body_cases(cases);
  add_crowd_cases(cases);
  add_friction_cases(cases);
  add_rest_cases(cases);
  add_stack_cases(cases);
  add_ratio_cases(cases);
  add_structure_cases(cases);
  add_overlap_cases(cases);
  add_joint_cases(cases);
  add_symmetry_cases(cases);
  return cases;
}

}  // namespace

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = collect();
  return cases;
}

const Case* find_case(const std::string& name) {
  for (const Case& each : all_cases())
    if (each.name == name) return &each;
  return nullptr;
}

double error_of(const Case& a_case, Lab& lab) {
  const double before = lab.simulated_seconds();
  const double error = a_case.measure(lab);
  if (!(lab.simulated_seconds() > before)) throw std::logic_error(a_case.name + " has simulated nothing");
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

}  // namespace urto::accuracy

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accuracy/lab.h"

namespace urto::accuracy {

// The error that a profile may have. Met if the measured one is at most this.
struct Level {
  Profile profile = Profile::kDefault;
  double error_max = 0;
};

// What varies along the curves of a case's diagram.
enum class Curves {
  kIntegrators,  // free flight: nothing touches
  kSolvers,      // contacts
};

// One hard case: a scene, what is known of it, and how far off a method is. The table of all is docs/accuracy.md.
struct Case {
  int row = 0;        // of that table
  std::string name;   // unique, e.g. "slope_creep"
  std::string title;  // one line for reports, with what is known
  std::string metric, unit;
  std::vector<Level> levels;
  std::function<double(Lab&)> measure;  // the error ≥ 0
  Curves curves = Curves::kSolvers;
  bool is_long = false;  // the report's full run alone measures it
};

const std::vector<Case>& all_cases();
// Null if there is none of this name.
const Case* find_case(const std::string& name);

// The error of a case; infinite if it is no number. Throws std::logic_error if it has simulated nothing.
double error_of(const Case& a_case, Lab& lab);

// The groups, each in a file of its own.
void add_flight_cases(std::vector<Case>& cases);
void add_oscillation_cases(std::vector<Case>& cases);
void add_bounce_cases(std::vector<Case>& cases);
void add_impact_cases(std::vector<Case>& cases);
void add_fast_body_cases(std::vector<Case>& cases);
void add_crowd_cases(std::vector<Case>& cases);
void add_friction_cases(std::vector<Case>& cases);
void add_rest_cases(std::vector<Case>& cases);
void add_stack_cases(std::vector<Case>& cases);
void add_ratio_cases(std::vector<Case>& cases);
void add_structure_cases(std::vector<Case>& cases);
void add_overlap_cases(std::vector<Case>& cases);
void add_joint_cases(std::vector<Case>& cases);
void add_symmetry_cases(std::vector<Case>& cases);

}  // namespace urto::accuracy

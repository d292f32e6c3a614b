#pragma once

#include "physics/solver/precise/block_system.h"
#include "physics/solver/precise/contact_problem.h"

namespace urto {

// Buffers of the contact solvers, kept for their capacity, and where each point's blocks lie in the matrix.
struct ProblemWorkspace {
  struct Place {
    std::size_t aa, ab, ba, bb;
  };
  BlockSystem system;
  std::vector<BlockSystem::Edge> edges;
  std::vector<Place> places;  // by point
  std::vector<double> right;
  bool ready = false;  // pattern is that of the problem at hand
};

// Solves the problem: first by its guess, then by Newton's method on the states of the points, and if that finds no
// end by an interior-point method whose end is polished by Newton's method. Where both fail by more than what counts as
// rest, sweeps over the points take over, polished likewise. The best iterate is kept.
ProblemAnswer solve(ContactProblem& problem, ProblemWorkspace& work);

// Newton's method alone (semi-smooth: Alart and Curnier 1991). Each round names the state of every point and solves the
// linear equations that remain, by an augmented Lagrangian on a directly factorised matrix
//
//   M + Σ stiffness·(n nᵀ [+ t tᵀ if it sticks] [± μ t nᵀ if it slips])
//
// which exists for any number of redundant points, and leaves determinate forces as they are: the multipliers make up
// for what the stiffness lacks, in a few repetitions with the same factors.
ProblemAnswer solve_by_newton(ContactProblem& problem, ProblemWorkspace& work, int rounds_max);

// Shared with the interior-point method.
void set_up_system(const ContactProblem& problem, ProblemWorkspace& work);
void add_masses(const ContactProblem& problem, ProblemWorkspace& work);
// matrix += weight · left rightᵀ of point k.
void add_outer(const ContactProblem& problem, ProblemWorkspace& work, std::size_t k, const double* left,
               const double* right, double weight);
// The same of two products at once.
void add_outers(const ContactProblem& problem, ProblemWorkspace& work, std::size_t k, const double* left,
                const double* right, const double* other_left, const double* other_right, double weight);
// right side += weight · row of point k.
void add_row(const ContactProblem& problem, ProblemWorkspace& work, std::size_t k, const double* row, double weight);
double dot_row(const ContactProblem& problem, const std::vector<double>& x, const ProblemPoint& point,
               const double* row);

}  // namespace urto

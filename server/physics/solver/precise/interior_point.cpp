#include "physics/solver/precise/interior_point.h"

#include "physics/geometry/vector.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
namespace {

// An edge of a friction wedge.
struct Generator {
  std::size_t point;
  double row[6];
  double bend;        // μ with the sign of the edge
  double alpha, w;    // N·s, m/s: both stay positive
  double defect;      // of w = d·v − target + μ |t·v|
  double complement;  // what α w shall become, less α w
  double step_alpha, step_w;
};

class InteriorPoint {
 public:
  InteriorPoint(ContactProblem& problem, ProblemWorkspace& work) : problem_(problem), work_(work) {}

  void run() {
    set_up_system(problem_, work_);
    start();
    if (generators_.empty()) return;
    const double first = gap();
    for (int round = 0; round < kInteriorRounds; ++round) {
      find_defects();
      if (gap() <= kInteriorGap * first && largest_defect() <= kInteriorGap * speed_) break;
      if (!factorise()) break;
      if (!improve()) break;
    }
    write_back();
  }

 private:
  void start() {
    double speed = 0;
    for (ProblemPoint& p : problem_.points) p.normal_impulse = p.tangent_impulse = 0;
    apply_impulses(problem_);
    for (const ProblemPoint& p : problem_.points)
      speed = max_of(speed, max_of(absolute(normal_velocity(problem_, p)), absolute(tangent_velocity(problem_, p))));
    speed_ = speed;
    for (std::size_t k = 0; k < problem_.points.size(); ++k) {
      const ProblemPoint& p = problem_.points[k];
      const int edges = p.friction > 0.0 ? 2 : 1;
      for (int side = 0; side < edges; ++side) {
        Generator g{};
        g.point = k;
        g.bend = edges == 1 ? 0.0 : (side == 0 ? p.friction : -p.friction);
        for (int i = 0; i < 6; ++i) g.row[i] = p.normal[i] + g.bend * p.tangent[i];
        // Heavy bodies have impulses to match.
        g.alpha = speed / (p.inverse_mass_normal + p.friction * p.friction * p.inverse_mass_tangent);
        g.w = speed;
        generators_.push_back(g);
      }
    }
    if (!(speed > 0.0)) generators_.clear();
    velocity_to_match();
  }

  void velocity_to_match() {
    for (ProblemPoint& p : problem_.points) p.normal_impulse = p.tangent_impulse = 0;
    for (const Generator& g : generators_) {
      problem_.points[g.point].normal_impulse += g.alpha;
      problem_.points[g.point].tangent_impulse += g.bend * g.alpha;
    }
    apply_impulses(problem_);
  }

  double gap() const {
    double sum = 0;
    for (const Generator& g : generators_) sum += g.alpha * g.w;
    return sum / static_cast<double>(generators_.size());
  }

  void find_defects() {
    for (Generator& g : generators_) {
      const ProblemPoint& p = problem_.points[g.point];
      const double slide = tangent_velocity(problem_, p);
      g.defect = normal_velocity(problem_, p) + g.bend * slide + p.friction * absolute(slide) - g.w;
    }
  }

  double largest_defect() const {
    double worst = 0;
    for (const Generator& g : generators_) worst = max_of(worst, absolute(g.defect));
    return worst;
  }

  bool factorise() {
    work_.system.clear_values();
    add_masses(problem_, work_);
    for (const Generator& g : generators_) add_outer(problem_, work_, g.point, g.row, g.row, g.alpha / g.w);
    return work_.system.factorise();
  }

  // The Newton step towards the complements; velocities always match the impulses, so there is no defect of momentum.
  void find_step() {
    work_.right.assign(3 * problem_.bodies.size(), 0.0);
    for (const Generator& g : generators_)
      add_row(problem_, work_, g.point, g.row, (g.complement - g.alpha * g.defect) / g.w);
    work_.system.solve(work_.right);
    for (Generator& g : generators_) {
      g.step_w = dot_row(problem_, work_.right, problem_.points[g.point], g.row) + g.defect;
      g.step_alpha = (g.complement - g.alpha * g.step_w) / g.w;
    }
  }

  double longest_step(double Generator::*value, double Generator::*step) const {
    double longest = 1;
    for (const Generator& g : generators_)
      if (g.*step < 0.0) longest = min_of(longest, -(g.*value) / g.*step);
    return longest;
  }

  bool improve() {
    const double now = gap();
    for (Generator& g : generators_) g.complement = -g.alpha * g.w;
    find_step();
    const double la = longest_step(&Generator::alpha, &Generator::step_alpha);
    const double lw = longest_step(&Generator::w, &Generator::step_w);
    double ahead = 0;
    for (const Generator& g : generators_) ahead += (g.alpha + la * g.step_alpha) * (g.w + lw * g.step_w);
    const double ratio = ahead / static_cast<double>(generators_.size()) / now;
    const double aim = ratio * ratio * ratio * now;
    for (Generator& g : generators_) g.complement = aim - g.alpha * g.w - g.step_alpha * g.step_w;
    find_step();
    constexpr double kShort = 0.99;  // of the way to the boundary
    const double length = kShort * min_of(longest_step(&Generator::alpha, &Generator::step_alpha),
                                          longest_step(&Generator::w, &Generator::step_w));
    if (!(length > 1e-8)) return false;
    for (Generator& g : generators_) {
      g.alpha += min_of(1.0, length) * g.step_alpha;
      g.w += min_of(1.0, length) * g.step_w;
    }
    velocity_to_match();
    return true;
  }

  // What is nearly zero is named zero, so that Newton's method starts from clear states.
  void write_back() {
    for (ProblemPoint& p : problem_.points) p.normal_impulse = p.tangent_impulse = 0;
    for (const Generator& g : generators_) {
      const ProblemPoint& p = problem_.points[g.point];
      const double weight = p.inverse_mass_normal;
      if (g.alpha * weight < g.w) continue;
      problem_.points[g.point].normal_impulse += g.alpha;
      problem_.points[g.point].tangent_impulse += g.bend * g.alpha;
    }
    apply_impulses(problem_);
  }

  ContactProblem& problem_;
  ProblemWorkspace& work_;
  std::vector<Generator> generators_;
  double speed_ = 0;
};

}  // namespace

void solve_by_interior_point(ContactProblem& problem, ProblemWorkspace& work) { InteriorPoint(problem, work).run(); }

}  // namespace urto

#pragma once

#include <cmath>
#include <vector>

#include "accuracy/case.h"

namespace urto::accuracy {

inline int order_of(Integrator integrator) {
  if (integrator == Integrator::kRungeKutta4) return 4;
  return integrator == Integrator::kVerlet ? 2 : 1;
}

// How far the order of error(lab, time step, steps), fitted over four time steps, is from that of the lab's integrator.
// By least squares: the slope of log₂ error over log₂ h, each h half the one before.
template <class Error>
double order_error(Lab& lab, double duration, long first_first_order, long first_higher, Error&& error) {
  const int expected = order_of(lab.method().integrator.value_or(Integrator::kSemiImplicitEuler));
  // Fine enough that higher terms do not show, coarse enough that rounding does not.
  long steps = expected == 4 ? first_higher : first_first_order;
  constexpr int kPoints = 4;
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (int i = 0; i < kPoints; ++i, steps *= 2) {
    const double x = -i, y = std::log2(error(lab, duration / static_cast<double>(steps), steps));
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const double slope = (kPoints * sum_xy - sum_x * sum_y) / (kPoints * sum_xx - sum_x * sum_x);
  return std::abs(slope - expected);
}

inline std::vector<Level> for_integrators(double error_max) {
  return {{Profile::kExplicitEuler, error_max},
          {Profile::kSemiImplicitEuler, error_max},
          {Profile::kVerlet, error_max},
          {Profile::kRungeKutta4, error_max}};
}

}  // namespace urto::accuracy

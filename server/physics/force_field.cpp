#include "physics/force_field.h"

namespace urto {

template <class S>
Fields<S>::Fields(const std::vector<ForceField>& fields) {
  for (const ForceField& field : fields) {
    if (const auto* f = std::get_if<PointAttractor>(&field)) {
      attractors.push_back({f->center.cast<S>(), S(f->strength), S(f->softening) * S(f->softening)});
    } else if (const auto* d = std::get_if<Drag>(&field)) {
      drags.push_back({S(d->linear), S(d->quadratic)});
    } else if (const auto* s = std::get_if<Spring>(&field)) {
      springs.push_back({s->center.cast<S>(), S(s->stiffness), S(s->damping)});
    }
  }
}

double field_potential(const std::vector<ForceField>& fields, const Vec2& position, double mass) {
  double sum = 0;
  for (const ForceField& field : fields) {
    if (const auto* f = std::get_if<PointAttractor>(&field)) {
      const Vec2 r = f->center - position;
      const double least = kAttractionDistanceMin * kAttractionDistanceMin;
      sum -= mass * f->strength / std::sqrt(max_of(dot<double>(r, r) + f->softening * f->softening, least));
    } else if (const auto* s = std::get_if<Spring>(&field)) {
      const Vec2 r = position - s->center;
      sum += 0.5 * s->stiffness * dot<double>(r, r);
    }
  }
  return sum;
}

template struct Fields<float>;
template struct Fields<double>;

}  // namespace urto

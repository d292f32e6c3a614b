#pragma once

#include <limits>

#include "physics/geometry/vector.h"

namespace urto {

// An axis-aligned box; touching counts as overlap.
template <class S>
struct Aabb {
  Vec<S> lower = Vec<S>::Zero();
  Vec<S> upper = Vec<S>::Zero();

  bool overlaps(const Aabb& other) const {
    return lower.x() <= other.upper.x() && other.lower.x() <= upper.x() && lower.y() <= other.upper.y() &&
           other.lower.y() <= upper.y();
  }
  bool contains(const Aabb& other) const {
    return lower.x() <= other.lower.x() && other.upper.x() <= upper.x() && lower.y() <= other.lower.y() &&
           other.upper.y() <= upper.y();
  }
  Aabb merged(const Aabb& other) const {
    Aabb out;
    out.lower = Vec<S>(min_of(lower.x(), other.lower.x()), min_of(lower.y(), other.lower.y()));
    out.upper = Vec<S>(max_of(upper.x(), other.upper.x()), max_of(upper.y(), other.upper.y()));
    return out;
  }
  Aabb expanded(S margin) const {
    return {Vec<S>(lower.x() - margin, lower.y() - margin), Vec<S>(upper.x() + margin, upper.y() + margin)};
  }
  S perimeter() const { return S(2) * ((upper.x() - lower.x()) + (upper.y() - lower.y())); }
  Vec<S> center() const { return Vec<S>(S(0.5) * (lower.x() + upper.x()), S(0.5) * (lower.y() + upper.y())); }
};

// A box that overlaps nothing.
template <class S>
Aabb<S> nowhere() {
  constexpr S kInfinity = std::numeric_limits<S>::infinity();
  return {Vec<S>(kInfinity, kInfinity), Vec<S>(-kInfinity, -kInfinity)};
}

}  // namespace urto

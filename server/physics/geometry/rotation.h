#pragma once

#include "physics/geometry/trigonometry.h"
#include "physics/geometry/vector.h"

namespace urto {

// A rotation by an angle, as its cosine and sine.
template <class S>
struct Rotation {
  S c = 1, s = 0;

  static Rotation from_angle(S angle) {
    Rotation q;
    sin_cos(angle, q.s, q.c);
    return q;
  }
  Vec<S> apply(const Vec<S>& v) const { return Vec<S>(c * v.x() - s * v.y(), s * v.x() + c * v.y()); }
  Vec<S> apply_inverse(const Vec<S>& v) const { return Vec<S>(c * v.x() + s * v.y(), -s * v.x() + c * v.y()); }
  // First other, then this.
  Rotation times(const Rotation& other) const { return {c * other.c - s * other.s, s * other.c + c * other.s}; }
  // First other, then the inverse of this.
  Rotation inverse_times(const Rotation& other) const { return {c * other.c + s * other.s, c * other.s - s * other.c}; }
};

// A frame: where its origin is and how it is turned (p_WF, R_WF).
template <class S>
struct Transform {
  Vec<S> p = Vec<S>::Zero();
  Rotation<S> q;

  Vec<S> apply(const Vec<S>& v) const { return q.apply(v) + p; }
  Vec<S> apply_inverse(const Vec<S>& v) const { return q.apply_inverse(v - p); }
  // The frame of other as seen from this one (X_AB from X_WA and X_WB).
  Transform inverse_times(const Transform& other) const {
    return {q.apply_inverse(other.p - p), q.inverse_times(other.q)};
  }
};

}  // namespace urto

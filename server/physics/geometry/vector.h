#pragma once

#include <Eigen/Core>
#include <cmath>

namespace urto {

// The engine's own vector in the world's scalar. The public API speaks Vec2 (double).
template <class S>
using Vec = Eigen::Matrix<S, 2, 1>;

// z of a × b.
template <class S>
inline S cross(const Vec<S>& a, const Vec<S>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// ω × v.
template <class S>
inline Vec<S> cross(S w, const Vec<S>& v) {
  return Vec<S>(-w * v.y(), w * v.x());
}

// v × ω: v turned by −90° and scaled. With ω = 1 an edge becomes the outward normal of a counter-clockwise polygon.
template <class S>
inline Vec<S> cross(const Vec<S>& v, S w) {
  return Vec<S>(w * v.y(), -w * v.x());
}

template <class S>
inline S dot(const Vec<S>& a, const Vec<S>& b) {
  return a.x() * b.x() + a.y() * b.y();
}

template <class S>
inline S length(const Vec<S>& v) {
  return std::sqrt(dot(v, v));
}

// Minimum and maximum with one definition everywhere: the first argument wins ties and NaN loses to neither silently:
// min_of(a, NaN) is a, min_of(NaN, b) is b.
template <class S>
inline S min_of(S a, S b) {
  return b < a ? b : (a == a ? a : b);
}
template <class S>
inline S max_of(S a, S b) {
  return b > a ? b : (a == a ? a : b);
}
template <class S>
inline S clamp_to(S value, S low, S high) {
  return value < low ? low : (value > high ? high : value);
}
template <class S>
inline S absolute(S value) {
  return value < S(0) ? -value : value;
}

}  // namespace urto

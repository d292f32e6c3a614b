#pragma once

#include <cstdint>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "physics/geometry/aabb.h"

namespace urto {

// A vector of 16 bytes over an array of scalars. Nothing but loads and comparisons is done on it: no rounding, so the
// same answers on every processor.
template <class S>
struct Vector16;
template <>
struct Vector16<float> {
  typedef float Type __attribute__((vector_size(16), may_alias));
};
template <>
struct Vector16<double> {
  typedef double Type __attribute__((vector_size(16), may_alias));
};

// Four boxes side by side: one cache line in float. An empty lane overlaps nothing.
template <class S>
struct alignas(16 * sizeof(S)) Box4 {
  static constexpr std::uint32_t kAll = 0xf;

  S lower_x[4], lower_y[4], upper_x[4], upper_y[4];

  Box4() { clear(); }

  void clear() {
    for (int lane = 0; lane < 4; ++lane) clear(lane);
  }
  void clear(int lane) {
    lower_x[lane] = lower_y[lane] = std::numeric_limits<S>::infinity();
    upper_x[lane] = upper_y[lane] = -std::numeric_limits<S>::infinity();
  }
  void set(int lane, const Aabb<S>& box) {
    lower_x[lane] = box.lower.x();
    lower_y[lane] = box.lower.y();
    upper_x[lane] = box.upper.x();
    upper_y[lane] = box.upper.y();
  }
  Aabb<S> get(int lane) const { return {Vec<S>(lower_x[lane], lower_y[lane]), Vec<S>(upper_x[lane], upper_y[lane])}; }
  bool is_empty(int lane) const { return lower_x[lane] > upper_x[lane]; }

  // m; 0 of an empty lane.
  double half_perimeter(int lane) const {
    if (is_empty(lane)) return 0;
    return static_cast<double>(upper_x[lane] - lower_x[lane]) + static_cast<double>(upper_y[lane] - lower_y[lane]);
  }

  // The box around all four lanes.
  Aabb<S> bounds() const {
    return {Vec<S>(least(lower_x), least(lower_y)), Vec<S>(greatest(upper_x), greatest(upper_y))};
  }

  // Bit i: lane i overlaps the box (touching counts).
  std::uint32_t overlap_mask(const Aabb<S>& box) const {
    return overlap_mask(box.lower.x(), box.lower.y(), box.upper.x(), box.upper.y());
  }
  // Bit i: lane i overlaps lane `lane` of `other`.
  std::uint32_t overlap_mask(const Box4& other, int lane) const {
    return overlap_mask(other.lower_x[lane], other.lower_y[lane], other.upper_x[lane], other.upper_y[lane]);
  }

 private:
  using Vector = typename Vector16<S>::Type;
  static constexpr int kVectorLanes = 16 / sizeof(S);

  static const Vector& load(const S* values) { return *reinterpret_cast<const Vector*>(values); }

  std::uint32_t overlap_mask(S low_x, S low_y, S high_x, S high_y) const {
    std::uint32_t out = 0;
    for (int lane = 0; lane < 4; lane += kVectorLanes) {
      out |= bits((load(lower_x + lane) <= high_x) & (load(upper_x + lane) >= low_x) &
                  (load(lower_y + lane) <= high_y) & (load(upper_y + lane) >= low_y))
             << lane;
    }
    return out;
  }

  // One bit a lane of a comparison's result (all ones or all zeros a lane).
  template <class Comparison>
  static std::uint32_t bits(const Comparison& lanes) {
#if defined(__SSE2__)
    if constexpr (sizeof(S) == 4) {
      return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<const __m128&>(lanes)));
    } else {
      return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<const __m128d&>(lanes)));
    }
#else
    std::uint32_t out = 0;
    for (int lane = 0; lane < kVectorLanes; ++lane) out |= static_cast<std::uint32_t>(lanes[lane] & 1) << lane;
    return out;
#endif
  }

  static S least(const S* v) { return lesser(lesser(v[0], v[1]), lesser(v[2], v[3])); }
  static S greatest(const S* v) { return greater(greater(v[0], v[1]), greater(v[2], v[3])); }
  static S lesser(S a, S b) { return a < b ? a : b; }
  static S greater(S a, S b) { return a > b ? a : b; }
};

}  // namespace urto

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "physics/geometry/aabb.h"

namespace urto {

// Vectors of four lanes. Only loads, comparisons, minima and maxima are done on them: no rounding, so the same answers
// on every processor.
template <class S>
struct Lanes4;
template <>
struct Lanes4<float> {
  typedef float Type __attribute__((vector_size(16)));
};
template <>
struct Lanes4<double> {
  typedef double Type __attribute__((vector_size(32)));
};

// Four boxes side by side: one cache line in float. An empty lane overlaps nothing.
template <class S>
struct Box4 {
  using Lanes = typename Lanes4<S>::Type;
  static constexpr std::uint32_t kAll = 0xf;

  Lanes lower_x, lower_y, upper_x, upper_y;

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

  // The box around all four lanes.
  Aabb<S> bounds() const {
    return {Vec<S>(least(lower_x), least(lower_y)), Vec<S>(greatest(upper_x), greatest(upper_y))};
  }

  // Bit i: lane i overlaps the box (touching counts).
  std::uint32_t overlap_mask(const Aabb<S>& box) const {
    return mask((lower_x <= box.upper.x()) & (upper_x >= box.lower.x()) & (lower_y <= box.upper.y()) &
                (upper_y >= box.lower.y()));
  }
  // Bit i: lane i overlaps lane `lane` of `other`.
  std::uint32_t overlap_mask(const Box4& other, int lane) const {
    return mask((lower_x <= other.upper_x[lane]) & (upper_x >= other.lower_x[lane]) & (lower_y <= other.upper_y[lane]) &
                (upper_y >= other.lower_y[lane]));
  }

 private:
  static S least(const Lanes& v) { return lesser(lesser(v[0], v[1]), lesser(v[2], v[3])); }
  static S greatest(const Lanes& v) { return greater(greater(v[0], v[1]), greater(v[2], v[3])); }
  static S lesser(S a, S b) { return a < b ? a : b; }
  static S greater(S a, S b) { return a > b ? a : b; }

  // One bit a lane of a comparison's result (all ones or all zeros a lane).
  template <class Comparison>
  static std::uint32_t mask(const Comparison& lanes) {
#if defined(__SSE2__)
    if constexpr (sizeof(S) == 4) {
      return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<const __m128&>(lanes)));
    } else {
      const auto* halves = reinterpret_cast<const __m128d*>(&lanes);
      return static_cast<std::uint32_t>(_mm_movemask_pd(halves[0]) | (_mm_movemask_pd(halves[1]) << 2));
    }
#else
    const Comparison bits = lanes & Comparison{1, 2, 4, 8};
    return static_cast<std::uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
  }
};

}  // namespace urto

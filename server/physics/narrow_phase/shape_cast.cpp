#include "physics/narrow_phase/shape_cast.h"

#include <limits>

#include "physics/narrow_phase/gjk.h"

namespace urto {
namespace {

// Grazing halves the distance with each advance: 64 bring any distance below the rounding of a double.
constexpr int kAdvancesMax = 64;

// In units of the rounding of the coordinates: nearer than this is touching.
constexpr int kTouchRoundings = 16;

// m, of the largest coordinate that the distance is computed from.
template <class S>
S size_of(const Convex<S>& shape) {
  S size = shape.radius;
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    size = max_of(size, max_of(absolute(shape.vertices[i].x()), absolute(shape.vertices[i].y())) + shape.radius);
  }
  return size;
}

}  // namespace

template <class S>
ShapeCast<S> shape_cast(const Convex<S>& a, const Convex<S>& b, const Transform<S>& b_in_a, const Vec<S>& translation) {
  ShapeCast<S> out;
  const S rounding = S(kTouchRoundings) * std::numeric_limits<S>::epsilon();
  const S reach = size_of(a) + size_of(b);
  Transform<S> pose = b_in_a;
  S t = 0;
  for (int advance = 0; advance < kAdvancesMax; ++advance) {
    pose.p = b_in_a.p + t * translation;
    const Distance<S> d = gjk_distance(a, b, pose);
    out.iterations = advance;
    out.fraction = t;
    out.normal = d.normal;
    out.point = S(0.5) * (d.point_a + d.point_b);
    if (d.separation <= S(0)) {
      out.overlapping = advance == 0;
      if (out.overlapping) out.normal = Vec<S>::Zero();
      break;
    }
    // Moving along the plane, away from it, or not as far as to it: it parts them for the whole way.
    const S closing = -dot<S>(d.normal, translation);
    if (closing <= S(0) || d.separation > closing * (S(1) - t)) return out;
    const S next = min_of(t + d.separation / closing, S(1));
    const bool touching = d.separation <= rounding * (reach + length<S>(pose.p)) || next == t;
    t = next;
    out.fraction = t;
    if (touching) break;
  }
  out.hit = true;
  return out;
}

template ShapeCast<float> shape_cast(const Convex<float>&, const Convex<float>&, const Transform<float>&,
                                     const Vec<float>&);
template ShapeCast<double> shape_cast(const Convex<double>&, const Convex<double>&, const Transform<double>&,
                                      const Vec<double>&);

}  // namespace urto

#pragma once

// The separation of two convex shapes by comparing everything with everything: slow, and by another way than the
// engine.

#include <algorithm>
#include <limits>
#include <vector>

#include "physics/geometry/convex.h"

namespace urto::testing_shapes {

inline std::vector<Vec2> placed(const Convex<double>& shape, const Transform<double>& pose) {
  std::vector<Vec2> out;
  for (std::uint32_t i = 0; i < shape.count; ++i) out.push_back(pose.apply(shape.vertices[i]));
  return out;
}

// Brute force, in double: outside, the least distance of all corners of one from all edges of the other; if the cores
// overlap, the least depth over all edge normals of both.
inline double least_vertex_edge_distance(const std::vector<Vec2>& points, const std::vector<Vec2>& edges) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec2& p : points) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Vec2 a = edges[i], e = edges[(i + 1) % edges.size()] - a;
      const double size = e.squaredNorm();
      const double t = size > 0 ? std::clamp((p - a).dot(e) / size, 0.0, 1.0) : 0.0;
      best = std::min(best, (p - a - t * e).norm());
    }
  }
  return best;
}

inline double separation_along(const Vec2& normal, const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec2& p : a) high = std::max(high, normal.dot(p));
  for (const Vec2& p : b) low = std::min(low, normal.dot(p));
  return low - high;
}

inline double best_face(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double best = -std::numeric_limits<double>::infinity();
  for (const auto* shape : {&a, &b}) {
    for (std::size_t i = 0; i < shape->size(); ++i) {
      const Vec2 e = (*shape)[(i + 1) % shape->size()] - (*shape)[i];
      if (e.norm() == 0) continue;
      const Vec2 n = Vec2(e.y(), -e.x()) / e.norm();
      best = std::max({best, separation_along(n, a, b), separation_along(-n, a, b)});
    }
  }
  return best;
}

inline double brute_force(const Convex<double>& a, const Convex<double>& b, const Transform<double>& b_in_a) {
  const std::vector<Vec2> pa = placed(a, {}), pb = placed(b, b_in_a);
  const double face = best_face(pa, pb);
  const double outside = std::min(least_vertex_edge_distance(pa, pb), least_vertex_edge_distance(pb, pa));
  // Overlaps of less than the rounding of a double are touches, for which both answers are 0, but for segments on one
  // line, which no face parts.
  const bool overlap = face < -4e-15 && face > -std::numeric_limits<double>::infinity();
  return (overlap ? face : outside) - a.radius - b.radius;
}

}  // namespace urto::testing_shapes

#include "physics/narrow_phase/nearest_vertices.h"

namespace urto {
namespace {

// Squared distances that differ by less, relative to the size of the shapes squared, count as equal: two corners of a
// face that lies flat on another differ by rounding and by the little that the bodies are turned against each other.
constexpr double kNearlyEqual = 5e-4;

template <class S>
struct Search {
  NearestVertices<S> found;
  S distance2[2] = {S(0), S(0)};
  S tolerance;

  void offer(const Vec<S>& point, S d2) {
    if (found.count == 0 || d2 + tolerance < distance2[0]) {
      found.points[0] = point;
      distance2[0] = d2;
      found.count = 1;
    } else if (d2 - tolerance <= distance2[0] && elsewhere(point) && (found.count == 1 || d2 < distance2[1])) {
      found.points[1] = point;
      distance2[1] = d2;
      found.count = 2;
    }
  }
  bool elsewhere(const Vec<S>& point) const {
    const Vec<S> d = point - found.points[0];
    return dot<S>(d, d) > tolerance;
  }
};

template <class S>
Vec<S> nearest_on_edge(const Vec<S>& v1, const Vec<S>& v2, const Vec<S>& p) {
  const Vec<S> e = v2 - v1;
  const S t = clamp_to(dot<S>(e, p - v1) / dot<S>(e, e), S(0), S(1));
  return v1 + e * t;
}

template <class S>
void search(const Convex<S>& edges, const Convex<S>& vertices, Search<S>& s) {
  for (std::uint32_t i = 0; i < vertices.count; ++i) {
    for (std::uint32_t j = 0; j < edges.count; ++j) {
      const Vec<S> q =
          nearest_on_edge(edges.vertices[j], edges.vertices[j + 1 < edges.count ? j + 1 : 0], vertices.vertices[i]);
      const Vec<S> d = vertices.vertices[i] - q;
      s.offer(q, dot<S>(d, d));
    }
  }
}

template <class S>
S size2(const Convex<S>& shape) {
  const Vec<S> d = shape.vertices[1] - shape.vertices[0], e = shape.vertices[2] - shape.vertices[1];
  return dot<S>(d, d) + dot<S>(e, e);
}

}  // namespace

template <class S>
NearestVertices<S> nearest_vertices(const Convex<S>& a, const Convex<S>& b_placed) {
  Search<S> s;
  s.tolerance = S(kNearlyEqual) * min_of(size2(a), size2(b_placed));
  search(a, b_placed, s);
  search(b_placed, a, s);
  return s.found;
}

template NearestVertices<float> nearest_vertices(const Convex<float>&, const Convex<float>&);
template NearestVertices<double> nearest_vertices(const Convex<double>&, const Convex<double>&);

}  // namespace urto

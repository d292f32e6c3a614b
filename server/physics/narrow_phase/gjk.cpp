#include "physics/narrow_phase/gjk.h"

#include <cstdint>
#include <limits>
#include <utility>

namespace urto {
namespace {

// The Minkowski difference B − A of two polygons of up to 8 corners has at most 16 edges, and each round takes one step
// towards the nearest feature: 20 rounds are more than exact arithmetic needs, and rounding cannot add more.
constexpr int kRoundsMax = 20;
constexpr int kPolytopeMax = 3 + kRoundsMax;

// In units of the rounding of the shapes' coordinates: how far a support may lie beyond a feature that is called the
// nearest. A support is a difference of rotated coordinates (3 roundings each) times a direction (2 more).
constexpr int kSlackRoundings = 8;

// A point of B − A, and the corners it comes from.
template <class S>
struct Support {
  Vec<S> w;
  std::uint32_t a = 0, b = 0;
};

// Both shapes in a's frame, without their radii.
template <class S>
struct Pair {
  const Convex<S>& a;
  const Convex<S>& b;
  const Rotation<S>& q;
  Vec<S> b_vertices[kPolygonVerticesMax];
  S slack;  // m: see kSlackRoundings

  Pair(const Convex<S>& shape_a, const Convex<S>& shape_b, const Transform<S>& b_in_a)
      : a(shape_a), b(shape_b), q(b_in_a.q) {
    S size = 0;
    for (std::uint32_t i = 0; i < b.count; ++i) {
      b_vertices[i] = b_in_a.apply(b.vertices[i]);
      size = max_of(size, max_of(absolute(b_vertices[i].x()), absolute(b_vertices[i].y())));
    }
    for (std::uint32_t i = 0; i < a.count; ++i) {
      size = max_of(size, max_of(absolute(a.vertices[i].x()), absolute(a.vertices[i].y())));
    }
    slack = S(kSlackRoundings) * std::numeric_limits<S>::epsilon() * size;
  }

  // The point of B − A that is furthest against direction; the first of equals.
  Support<S> support_against(const Vec<S>& direction) const {
    Support<S> s;
    S best = dot(direction, a.vertices[0]);
    for (std::uint32_t i = 1; i < a.count; ++i) {
      const S along = dot(direction, a.vertices[i]);
      if (along > best) {
        best = along;
        s.a = i;
      }
    }
    best = dot(direction, b_vertices[0]);
    for (std::uint32_t i = 1; i < b.count; ++i) {
      const S along = dot(direction, b_vertices[i]);
      if (along < best) {
        best = along;
        s.b = i;
      }
    }
    s.w = b_vertices[s.b] - a.vertices[s.a];
    return s;
  }

  // From one point of B − A to another, by the shapes' own edges: a corner that both share cancels exactly, which keeps
  // the direction of an edge much shorter than the shapes are apart.
  Vec<S> edge(const Support<S>& from, const Support<S>& to) const {
    Vec<S> e = Vec<S>::Zero();
    if (from.b != to.b) e += q.apply(b.vertices[to.b] - b.vertices[from.b]);
    if (from.a != to.a) e -= a.vertices[to.a] - a.vertices[from.a];
    return e;
  }
};

template <class S>
struct Simplex {
  Support<S> points[3];
  int count = 0;

  bool has(const Support<S>& s) const {
    for (int i = 0; i < count; ++i) {
      if (points[i].a == s.a && points[i].b == s.b) return true;
    }
    return false;
  }
};

// Keeps of a segment what is nearest to the origin and returns the vector to it, of any length if onto the segment's
// inside (see nearest_direction); the fraction along it is set then.
template <class S>
Vec<S> reduce_segment(const Pair<S>& pair, Simplex<S>& simplex) {
  const Vec<S>& w0 = simplex.points[0].w;
  const Vec<S>& w1 = simplex.points[1].w;
  const Vec<S> e = pair.edge(simplex.points[0], simplex.points[1]);
  if (dot(e, w0) >= S(0)) {
    simplex.count = 1;
    return w0;
  }
  if (dot(e, w1) <= S(0)) {
    simplex.points[0] = simplex.points[1];
    simplex.count = 1;
    return w1;
  }
  const S moment = cross(e, w0);
  return cross(e, moment / -dot(e, e));
}

// The outcome of the search outside: the vector from the origin to B − A, or zero if the origin may be within.
template <class S>
Vec<S> reduce_triangle(const Pair<S>& pair, Simplex<S>& simplex) {
  const Support<S> p0 = simplex.points[0], p1 = simplex.points[1], p2 = simplex.points[2];
  // p2 is the newest; the origin lies on its side of p0 p1, or the search had ended.
  const Vec<S> e20 = pair.edge(p2, p0), e21 = pair.edge(p2, p1);
  const S area = cross(e20, e21);
  const S side0 = cross(e20, p2.w) * (area < S(0) ? S(-1) : S(1));  // > 0: beyond p2 p0
  const S side1 = cross(e21, p2.w) * (area < S(0) ? S(1) : S(-1));  // > 0: beyond p2 p1
  const bool beyond0 = side0 > S(0), beyond1 = side1 > S(0);
  if (!beyond0 && !beyond1) return Vec<S>::Zero();
  Simplex<S> s0, s1;
  s0.points[0] = p0;
  s1.points[0] = p1;
  s0.points[1] = s1.points[1] = p2;
  s0.count = s1.count = 2;
  const Vec<S> v0 = beyond0 ? reduce_segment(pair, s0) : Vec<S>::Zero();
  const Vec<S> v1 = beyond1 ? reduce_segment(pair, s1) : Vec<S>::Zero();
  const bool first = beyond0 && (!beyond1 || dot(v0, v0) <= dot(v1, v1));
  simplex = first ? s0 : s1;
  return first ? v0 : v1;
}

// A candidate for the answer: unit normal from a to b, the separation along it, and the feature of B − A there.
template <class S>
struct Face {
  Vec<S> normal = Vec<S>(1, 0);
  S separation = -std::numeric_limits<S>::infinity();
  Support<S> from, to;
};

// normal turned so that the separation is that of the origin from the line through w: ≥ 0 if outside.
template <class S>
Face<S> face_of(const Pair<S>& pair, const Support<S>& from, const Support<S>& to) {
  Face<S> face;
  const Vec<S> e = pair.edge(from, to);
  face.normal = cross(e, S(1) / length(e));
  face.from = from;
  face.to = to;
  face.separation = dot(face.normal, from.w);
  return face;
}

template <class S>
Face<S> flipped(Face<S> face) {
  face.normal = -face.normal;
  face.separation = -face.separation;
  return face;
}

template <class S>
Distance<S> finish(const Pair<S>& pair, const Face<S>& face, const Vec<S>& on_a, int rounds) {
  Distance<S> out;
  out.normal = face.normal;
  out.separation = (face.separation - pair.a.radius) - pair.b.radius;
  out.point_a = on_a + pair.a.radius * face.normal;
  out.point_b = out.point_a + out.separation * face.normal;
  out.iterations = rounds;
  return out;
}

// The corners of a shape that lie on its supporting line, as an interval along that line.
template <class S>
struct Interval {
  S low = std::numeric_limits<S>::infinity(), high = -std::numeric_limits<S>::infinity();
  Vec<S> at_low, at_high;

  // outward: away from the shape.
  Interval(const Vec<S>* vertices, std::uint32_t count, const Vec<S>& outward, S slack) {
    S top = dot(outward, vertices[0]);
    for (std::uint32_t i = 1; i < count; ++i) top = max_of(top, dot(outward, vertices[i]));
    for (std::uint32_t i = 0; i < count; ++i) {
      if (dot(outward, vertices[i]) < top - slack) continue;
      const S along = cross(outward, vertices[i]);
      if (along < low) {
        low = along;
        at_low = vertices[i];
      }
      if (along > high) {
        high = along;
        at_high = vertices[i];
      }
    }
  }

  Vec<S> at(S along) const {
    const S size = high - low;
    return size > S(0) ? Vec<S>(at_low + clamp_to((along - low) / size, S(0), S(1)) * (at_high - at_low)) : at_low;
  }
};

// The witness on a's core when the two shapes meet along face.normal: the middle of what their features share, so that
// parallel edges get points that lie on both.
template <class S>
Distance<S> finish_at_features(const Pair<S>& pair, const Face<S>& face, int rounds) {
  const Interval<S> a(pair.a.vertices, pair.a.count, face.normal, pair.slack);
  const Interval<S> b(pair.b_vertices, pair.b.count, -face.normal, pair.slack);
  // b's interval is measured along the opposite direction.
  const S low = max_of(a.low, -b.high), high = min_of(a.high, -b.low);
  Distance<S> out = finish(pair, face, a.at(S(0.5) * (low + high)), rounds);
  out.edge_a = a.high > a.low;
  out.edge_b = b.high > b.low;
  return out;
}

// Outside, the nearest point of the simplex to the origin is unique and put back on a.
template <class S>
Distance<S> finish_at_simplex(const Pair<S>& pair, const Face<S>& face, int rounds) {
  const Vec<S>& a0 = pair.a.vertices[face.from.a];
  Vec<S> on_a = a0;
  const bool edge_a = face.from.a != face.to.a, edge_b = face.from.b != face.to.b;
  if (edge_a) {
    const Vec<S> e = pair.edge(face.from, face.to);
    on_a += clamp_to(-dot(e, face.from.w) / dot(e, e), S(0), S(1)) * (pair.a.vertices[face.to.a] - a0);
  }
  Distance<S> out = finish(pair, face, on_a, rounds);
  out.edge_a = edge_a;
  out.edge_b = edge_b;
  return out;
}

// The largest separation along any edge normal of either shape: the exact answer for overlapping polygons, and what is
// left when rounding hides the way of the polytope (touching corners, shapes without area).
template <class S>
Face<S> search_all_faces(const Pair<S>& pair) {
  Face<S> best;
  const auto consider = [&](const Vec<S>& normal, std::uint32_t count) {
    if (count < 2 || !(dot(normal, normal) > S(0))) return;
    const Support<S> s = pair.support_against(normal);
    const S separation = dot(normal, s.w);
    if (separation > best.separation) {
      best.normal = normal;
      best.separation = separation;
    }
  };
  const auto unit_normal = [](const Vec<S>& e) {
    const S size = length(e);
    return size > S(0) ? Vec<S>(cross(e, S(1) / size)) : Vec<S>(Vec<S>::Zero());
  };
  for (std::uint32_t i = 0; i < pair.a.count; ++i) {
    consider(unit_normal(pair.a.vertices[i + 1 < pair.a.count ? i + 1 : 0] - pair.a.vertices[i]), pair.a.count);
  }
  for (std::uint32_t i = 0; i < pair.b.count; ++i) {
    const Vec<S> e = pair.b.vertices[i + 1 < pair.b.count ? i + 1 : 0] - pair.b.vertices[i];
    consider(-unit_normal(pair.q.apply(e)), pair.b.count);
  }
  // Two points: there is no edge.
  if (best.separation < -std::numeric_limits<S>::max()) {
    best.separation = dot(best.normal, pair.support_against(best.normal).w);
  }
  return best;
}

// A polytope within B − A around the origin, counter-clockwise; faces[i] runs from points[i] to the next.
template <class S>
struct Polytope {
  Face<S> faces[kPolytopeMax];
  int count = 0;

  void insert(int at, const Face<S>& face) {
    for (int i = count; i > at; --i) faces[i] = faces[i - 1];
    faces[at] = face;
    ++count;
  }
};

// Expands the polytope at its face nearest to the origin until the face is one of B − A. False if rounding leaves no
// polytope to begin with or no end.
template <class S>
bool expand(const Pair<S>& pair, const Simplex<S>& simplex, Face<S>& out, int& rounds) {
  Support<S> p0 = simplex.points[0], p1 = simplex.points[1], p2 = simplex.points[2];
  const S area = cross(pair.edge(p0, p1), pair.edge(p0, p2));
  const S longest = max_of(length(pair.edge(p0, p1)), length(pair.edge(p0, p2)));
  if (absolute(area) <= pair.slack * longest) return false;
  if (area < S(0)) std::swap(p1, p2);
  // Outward normals of B − A are normals from b to a: flipped, so that the separation is ≤ 0 within.
  Polytope<S> polytope;
  polytope.insert(0, flipped(face_of(pair, p0, p1)));
  polytope.insert(1, flipped(face_of(pair, p1, p2)));
  polytope.insert(2, flipped(face_of(pair, p2, p0)));
  for (int round = 0; round < kRoundsMax; ++round) {
    ++rounds;
    int nearest = 0;
    for (int i = 1; i < polytope.count; ++i) {
      if (polytope.faces[i].separation > polytope.faces[nearest].separation) nearest = i;
    }
    const Face<S> face = polytope.faces[nearest];
    const Support<S> s = pair.support_against(face.normal);
    if (face.separation - dot(face.normal, s.w) <= pair.slack) {
      out = face;
      return true;
    }
    const Face<S> second = flipped(face_of(pair, s, face.to));
    polytope.faces[nearest] = flipped(face_of(pair, face.from, s));
    polytope.insert(nearest + 1, second);
  }
  return false;
}

template <class S>
Distance<S> penetration(const Pair<S>& pair, const Simplex<S>& simplex, int rounds) {
  Face<S> face;
  if (simplex.count != 3 || !expand(pair, simplex, face, rounds)) face = search_all_faces(pair);
  return finish_at_features(pair, face, rounds);
}

template <class S>
Distance<S> separated(const Pair<S>& pair, const Simplex<S>& simplex, const Vec<S>& nearest, int rounds) {
  Face<S> face;
  if (simplex.count == 2) {
    face = face_of(pair, simplex.points[0], simplex.points[1]);
    if (face.separation < S(0)) face = flipped(face);
  } else {
    face.separation = length(nearest);
    face.normal = nearest * (S(1) / face.separation);
    face.from = face.to = simplex.points[0];
  }
  return finish_at_simplex(pair, face, rounds);
}

// Where rounding stopped the search: the best face, or the nearest point found, whichever parts the shapes further.
template <class S>
Distance<S> stalled(const Pair<S>& pair, const Simplex<S>& simplex, const Vec<S>& nearest, int rounds) {
  Face<S> face = search_all_faces(pair);
  const Vec<S> direction = nearest * (S(1) / length(nearest));
  const S separation = dot(direction, pair.support_against(direction).w);
  return separation > face.separation ? separated(pair, simplex, nearest, rounds)
                                      : finish_at_features(pair, face, rounds);
}

}  // namespace

template <class S>
Distance<S> gjk_distance(const Convex<S>& a, const Convex<S>& b, const Transform<S>& b_in_a) {
  const Pair<S> pair(a, b, b_in_a);
  Vec<S> v = b_in_a.apply(b.centroid) - a.centroid;
  if (dot(v, v) <= pair.slack * pair.slack) v = Vec<S>(1, 0);
  Simplex<S> simplex;
  simplex.points[0] = pair.support_against(v);
  simplex.count = 1;
  v = simplex.points[0].w;
  for (int round = 1; round <= kRoundsMax; ++round) {
    const S size = length(v);
    // Nearer than rounding can tell: the vector to the origin has no direction.
    if (size <= pair.slack) return penetration(pair, simplex, round);
    const Support<S> s = pair.support_against(v);
    // No point of B − A lies nearer along v than the one at hand: it is the nearest.
    if (dot(v, v) - dot(v, s.w) <= size * pair.slack) return separated(pair, simplex, v, round);
    if (simplex.has(s)) return stalled(pair, simplex, v, round);
    simplex.points[simplex.count++] = s;
    v = simplex.count == 2 ? reduce_segment(pair, simplex) : reduce_triangle(pair, simplex);
    if (simplex.count == 3) return penetration(pair, simplex, round);
  }
  return stalled(pair, simplex, v, kRoundsMax);
}

template Distance<float> gjk_distance<float>(const Convex<float>&, const Convex<float>&, const Transform<float>&);
template Distance<double> gjk_distance<double>(const Convex<double>&, const Convex<double>&, const Transform<double>&);

}  // namespace urto

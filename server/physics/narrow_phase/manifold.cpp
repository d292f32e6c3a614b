#include "physics/narrow_phase/manifold.h"

#include "physics/constants.h"
#include "physics/narrow_phase/chain_segment.h"
#include "physics/narrow_phase/gjk.h"

namespace urto {
namespace {

template <class S>
using Manifold = LocalManifold<S>;

template <class S>
std::uint32_t after(const Convex<S>& shape, std::uint32_t i) {
  return i + 1 < shape.count ? i + 1 : 0;
}

// The nearest feature of a polygon to a point outside or inside of it decides the normal: a face, or a corner.
template <class S>
Manifold<S> collide_polygon_circle(const Convex<S>& polygon, const Vec<S>& center, S radius, S reach) {
  Manifold<S> m;
  std::uint32_t face = 0;
  S best = dot<S>(polygon.normals[0], center - polygon.vertices[0]);
  for (std::uint32_t i = 1; i < polygon.count; ++i) {
    const S s = dot<S>(polygon.normals[i], center - polygon.vertices[i]);
    if (s > best) {
      best = s;
      face = i;
    }
  }
  const Vec<S> v1 = polygon.vertices[face], v2 = polygon.vertices[after(polygon, face)];
  const Vec<S> edge = v2 - v1;
  const S along = dot<S>(edge, center - v1);
  const bool corner = best > S(0) && (along < S(0) || along > dot<S>(edge, edge));
  S separation = best;
  m.normal = polygon.normals[face];
  std::uint32_t id = face;
  if (corner) {
    const Vec<S> v = along < S(0) ? v1 : v2;
    const Vec<S> d = center - v;
    separation = length<S>(d);
    if (separation > S(0)) m.normal = d / separation;
    id = 256u + (along < S(0) ? face : after(polygon, face));
  }
  const S gap = separation - radius - polygon.radius;
  if (gap > reach) return m;
  m.add_point(center - m.normal * (separation - polygon.radius - S(0.5) * gap), gap, id);
  return m;
}

// One id wherever a disc touches a segment: it rolls over the ends without losing what it carries.
template <class S>
Manifold<S> collide_segment_circle(const Convex<S>& segment, const Vec<S>& center, S radius, S reach) {
  Manifold<S> m;
  const Vec<S> edge = segment.vertices[1] - segment.vertices[0];
  const S along = clamp_to(dot<S>(edge, center - segment.vertices[0]) / dot<S>(edge, edge), S(0), S(1));
  const Vec<S> nearest = segment.vertices[0] + edge * along, d = center - nearest;
  const S distance = length<S>(d);
  const S gap = distance - segment.radius - radius;
  if (gap > reach) return m;
  m.normal = distance > S(0) ? Vec<S>(d / distance) : segment.normals[0];
  m.add_point(nearest + m.normal * (segment.radius + S(0.5) * gap), gap, 0);
  return m;
}

template <class S>
Manifold<S> collide_with_circle(const Convex<S>& shape, const Vec<S>& center, S radius, S reach) {
  return shape.count == 2 ? collide_segment_circle(shape, center, radius, reach)
                          : collide_polygon_circle(shape, center, radius, reach);
}

template <class S>
Manifold<S> collide_circles(const Convex<S>& a, const Vec<S>& center, S radius, S reach) {
  Manifold<S> m;
  const Vec<S> d = center - a.vertices[0];
  const S distance = length<S>(d);
  const S gap = distance - a.radius - radius;
  if (gap > reach) return m;
  // Concentric circles have no direction: up is as good as any, and the same everywhere.
  m.normal = distance > S(0) ? Vec<S>(d / distance) : Vec<S>(S(0), S(1));
  m.add_point(a.vertices[0] + m.normal * (a.radius + S(0.5) * gap), gap, 0);
  return m;
}

// Clips the incident edge (of `other`) against the side planes of the reference face and keeps what is below it
// (Sutherland and Hodgman 1974). `flip`: the reference is b, so the normal is turned to point from a to b.
template <class S>
Manifold<S> clip(const Convex<S>& reference, std::uint32_t face, const Convex<S>& other, S reach, bool flip) {
  Manifold<S> m;
  const Vec<S> normal = reference.normals[face];
  std::uint32_t incident = 0;
  S least = dot<S>(normal, other.normals[0]);
  for (std::uint32_t i = 1; i < other.count; ++i) {
    const S d = dot<S>(normal, other.normals[i]);
    if (d < least) {
      least = d;
      incident = i;
    }
  }
  const std::uint32_t j1 = incident, j2 = after(other, incident);
  const Vec<S> v1 = reference.vertices[face], v2 = reference.vertices[after(reference, face)];
  const Vec<S> tangent = Vec<S>(-normal.y(), normal.x());  // from v1 to v2 of a counter-clockwise outline
  const S length_of_face = dot<S>(tangent, v2 - v1);
  // The incident edge runs against the reference face: p at its start lies towards v2.
  Vec<S> p = other.vertices[j1], q = other.vertices[j2];
  S tp = dot<S>(tangent, p - v1), tq = dot<S>(tangent, q - v1);
  if (tp < S(0) || tq > length_of_face) return m;
  const Vec<S> d = q - p;
  const S span = tp - tq;
  const Vec<S> p0 = p;
  if (span > S(0)) {
    if (tp > length_of_face) p = p0 + d * ((tp - length_of_face) / span);
    if (tq < S(0)) q = p0 + d * (tp / span);
  }
  const S radii = reference.radius + other.radius;
  const S sp = dot<S>(normal, p - v1), sq = dot<S>(normal, q - v1);
  m.normal = flip ? Vec<S>(-normal) : normal;
  const std::uint32_t side = flip ? ManifoldIds::kFlip : 0u;
  // Midway between the surfaces.
  if (sp - radii <= reach)
    m.add_point(p - normal * (S(0.5) * (sp + other.radius - reference.radius)), sp - radii, side | (face << 8) | j1);
  if (sq - radii <= reach)
    m.add_point(q - normal * (S(0.5) * (sq + other.radius - reference.radius)), sq - radii, side | (face << 8) | j2);
  return m;
}

// Polygons apart by a corner each: SAT's best axis is then a face normal and not the direction of least distance.
template <class S>
Manifold<S> corner_to_corner(const Convex<S>& a, const Convex<S>& b, S reach) {
  Manifold<S> m;
  const Distance<S> d = gjk_distance<S>(a, b, Transform<S>{});
  if (d.separation > reach) return m;
  m.normal = d.normal;
  m.add_point(S(0.5) * (d.point_a + d.point_b), d.separation, ManifoldIds::kCorners);
  return m;
}

// Of shapes with a radius, whose cores are mostly apart while they touch. A face that has a corner of the other
// straight before it, or an edge along it, gives the normal; else two corners do.
template <class S>
Manifold<S> collide_rounded(const Convex<S>& a, const Convex<S>& b, const Manifold<S>& faces, S core_separation,
                            S reach) {
  const S radii = a.radius + b.radius;
  for (int i = 0; i < faces.count; ++i)
    if (core_separation <= S(0) || faces.points[i].separation + radii <= core_separation + S(kFacePreference))
      return faces;
  const Distance<S> d = gjk_distance<S>(a, b, Transform<S>{});
  if (faces.count > 0 && (d.edge_a || d.edge_b)) return faces;
  Manifold<S> m;
  if (d.separation > reach) return m;
  m.normal = d.normal;
  m.add_point(S(0.5) * (d.point_a + d.point_b), d.separation, ManifoldIds::kCorners);
  return m;
}

template <class S>
std::uint32_t face_along(const Convex<S>& shape, const Vec<S>& direction, S& alignment) {
  std::uint32_t face = 0;
  alignment = dot<S>(shape.normals[0], direction);
  for (std::uint32_t i = 1; i < shape.count; ++i) {
    const S d = dot<S>(shape.normals[i], direction);
    if (d > alignment) {
      alignment = d;
      face = i;
    }
  }
  return face;
}

template <class S>
Manifold<S> collide_polygons_gjk(const Convex<S>& a, const Convex<S>& b, S reach) {
  const Distance<S> d = gjk_distance<S>(a, b, Transform<S>{});
  Manifold<S> m;
  if (d.separation > reach) return m;
  const S radii = a.radius + b.radius;
  if (radii > S(0) && d.separation + radii > S(0) && !d.edge_a && !d.edge_b) {
    m.normal = d.normal;
    m.add_point(S(0.5) * (d.point_a + d.point_b), d.separation, ManifoldIds::kCorners);
    return m;
  }
  S along_a, along_b;
  const std::uint32_t face_a = face_along<S>(a, d.normal, along_a);
  const std::uint32_t face_b = face_along<S>(b, -d.normal, along_b);
  m = along_a + S(kFacePreference) >= along_b ? clip(a, face_a, b, reach, false) : clip(b, face_b, a, reach, true);
  if (m.count == 0) {
    m.normal = d.normal;
    m.add_point(S(0.5) * (d.point_a + d.point_b), d.separation, ManifoldIds::kCorners);
  }
  return m;
}

template <class S>
Manifold<S> collide_polygons_sat(const Convex<S>& a, const Convex<S>& b, S reach) {
  const S radii = a.radius + b.radius;
  const FaceSeparation<S> fa = max_face_separation(a, b);
  if (fa.separation - radii > reach) return Manifold<S>{};
  const FaceSeparation<S> fb = max_face_separation(b, a);
  if (fb.separation - radii > reach) return Manifold<S>{};
  const bool flip = fb.separation > fa.separation + S(kFacePreference);
  const Manifold<S> m = flip ? clip(b, fb.face, a, reach, true) : clip(a, fa.face, b, reach, false);
  if (radii > S(0)) return collide_rounded(a, b, m, max_of(fa.separation, fb.separation), reach);
  const bool apart = max_of(fa.separation, fb.separation) > S(0);
  return m.count == 0 && apart ? corner_to_corner(a, b, reach) : m;
}

template <class S>
void turn_around(Manifold<S>& m, const Transform<S>& b_in_a) {
  m.normal = b_in_a.q.apply(-m.normal);
  for (int i = 0; i < m.count; ++i) m.points[i].p = b_in_a.apply(m.points[i].p);
}

// Chains do not touch each other.
template <class S>
Manifold<S> collide_with_chain(const Convex<S>& a, const Convex<S>& b, const Transform<S>& b_in_a, S reach) {
  if (a.chain_segment() && b.chain_segment()) return {};
  const Transform<S> frame = a.chain_segment() ? b_in_a : b_in_a.inverse_times(Transform<S>{});
  const Convex<S>& other = a.chain_segment() ? b : a;
  Convex<S> moved = placed(other, frame);
  moved.centroid = frame.apply(other.centroid);
  if (a.chain_segment()) return collide_chain_segment(a, moved, reach);
  Manifold<S> m = collide_chain_segment(b, moved, reach);
  turn_around(m, b_in_a);
  for (int i = 0; i < m.count; ++i) m.points[i].id ^= ManifoldIds::kFlip;
  return m;
}

}  // namespace

template <class S>
FaceSeparation<S> max_face_separation(const Convex<S>& a, const Convex<S>& b_placed) {
  FaceSeparation<S> best;
  for (std::uint32_t i = 0; i < a.count; ++i) {
    const S nx = a.normals[i].x(), ny = a.normals[i].y();
    S least = nx * b_placed.vertices[0].x() + ny * b_placed.vertices[0].y();
    for (std::uint32_t j = 1; j < b_placed.count; ++j) {
      const S d = nx * b_placed.vertices[j].x() + ny * b_placed.vertices[j].y();
      if (d < least) least = d;
    }
    const S separation = least - (nx * a.vertices[i].x() + ny * a.vertices[i].y());
    if (i == 0 || separation > best.separation) best = {i, separation};
  }
  return best;
}

template <class S>
Convex<S> placed(const Convex<S>& b, const Transform<S>& b_in_a) {
  Convex<S> out{typename Convex<S>::Uninitialized{}};
  out.count = b.count;
  out.radius = b.radius;
  out.flags = b.flags;
  for (std::uint32_t i = 0; i < b.count; ++i) {
    out.vertices[i] = b_in_a.apply(b.vertices[i]);
    out.normals[i] = b_in_a.q.apply(b.normals[i]);
  }
  return out;
}

template <class S>
LocalManifold<S> clip_to_face(const Convex<S>& reference, std::uint32_t face, const Convex<S>& other, S reach,
                              bool flip) {
  return clip(reference, face, other, reach, flip);
}

template <class S>
LocalManifold<S> collide(const Convex<S>& a, const Convex<S>& b, const Transform<S>& b_in_a, S reach,
                         NarrowPhaseKind kind) {
  if (((a.flags | b.flags) & kConvexChainSegment) != 0) return collide_with_chain(a, b, b_in_a, reach);
  if (b.count == 1) {
    const Vec<S> center = b_in_a.apply(b.vertices[0]);
    return a.count == 1 ? collide_circles(a, center, b.radius, reach) : collide_with_circle(a, center, b.radius, reach);
  }
  if (a.count == 1) {
    LocalManifold<S> m = collide_with_circle<S>(b, b_in_a.apply_inverse(a.vertices[0]), a.radius, reach);
    turn_around(m, b_in_a);
    return m;
  }
  const Convex<S> moved = placed(b, b_in_a);
  return kind == NarrowPhaseKind::kGjk ? collide_polygons_gjk(a, moved, reach) : collide_polygons_sat(a, moved, reach);
}

#define URTO_INSTANTIATE(S)                                                                                       \
  template LocalManifold<S> collide(const Convex<S>&, const Convex<S>&, const Transform<S>&, S, NarrowPhaseKind); \
  template FaceSeparation<S> max_face_separation(const Convex<S>&, const Convex<S>&);                             \
  template LocalManifold<S> clip_to_face(const Convex<S>&, std::uint32_t, const Convex<S>&, S, bool);             \
  template Convex<S> placed(const Convex<S>&, const Transform<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

#include "physics/narrow_phase/chain_segment.h"

#include "physics/constants.h"
#include "physics/narrow_phase/gjk.h"

namespace urto {
namespace {

// Sine of the angle by which a polygon's normal may lie outside the region of a joint: what lies flat on the next
// segment differs by rounding only, what stands before it by a right angle.
constexpr double kRegionTolerance = 0.1;

template <class S>
struct Segment {
  const Convex<S>& shape;
  Vec<S> v1, v2, edge, normal, before, after, normal_before, normal_after;
  bool convex1, convex2, owns_end;

  explicit Segment(const Convex<S>& s)
      : shape(s),
        v1(s.vertices[0]),
        v2(s.vertices[1]),
        edge(v2 - v1),
        normal(s.normals[0]),
        before(v1 - s.vertices[Convex<S>::kGhostBefore]),
        after(s.vertices[Convex<S>::kGhostAfter] - v2),
        normal_before(cross<S>(before, S(1) / length<S>(before))),
        normal_after(cross<S>(after, S(1) / length<S>(after))),
        convex1(cross<S>(normal_before, normal) >= -S(kFlatJoint)),
        convex2(cross<S>(normal, normal_after) >= -S(kFlatJoint)),
        owns_end((s.flags & kConvexChainEnd) != 0) {}

  // Whether a direction from v1 or v2 lies in that joint's region.
  bool region_of_v1(const Vec<S>& d) const { return convex1 && dot<S>(edge, d) <= S(0) && dot<S>(before, d) > S(0); }
  bool region_of_v2(const Vec<S>& d) const {
    return owns_end && convex2 && dot<S>(edge, d) >= S(0) && dot<S>(after, d) <= S(0);
  }

  bool has_behind(const Vec<S>& p) const {
    if (dot<S>(normal, p - v1) >= S(0)) return false;
    if (convex1 && dot<S>(normal_before, p - v1) >= S(0)) return false;
    return !(convex2 && dot<S>(normal_after, p - v2) >= S(0));
  }

 private:
  // Sine of the turn up to which a joint counts as straight: the rounding of a float world's vertices.
  static constexpr double kFlatJoint = 1e-5;
};

template <class S>
LocalManifold<S> collide_disc(const Segment<S>& s, const Vec<S>& center, S radius, S reach) {
  LocalManifold<S> m;
  const S along = dot<S>(s.edge, center - s.v1);
  Vec<S> nearest = s.v1;
  S distance;
  if (along < S(0) || along > dot<S>(s.edge, s.edge)) {
    const bool first = along < S(0);
    nearest = first ? s.v1 : s.v2;
    const Vec<S> d = center - nearest;
    if (!(first ? s.region_of_v1(d) : s.region_of_v2(d))) return m;
    distance = length<S>(d);
    m.normal = distance > S(0) ? Vec<S>(d / distance) : s.normal;
  } else {
    distance = dot<S>(s.normal, center - s.v1);
    if (distance < S(0)) return m;
    m.normal = s.normal;
    nearest = center - m.normal * distance;
  }
  const S gap = distance - radius;
  if (gap <= reach) m.add_point(nearest + m.normal * (S(0.5) * gap), gap, 0);
  return m;
}

// What a corner of the shape and an end of the segment make of each other.
template <class S>
LocalManifold<S> collide_corners(const Segment<S>& s, const Convex<S>& other, S reach) {
  LocalManifold<S> m;
  const Distance<S> d = gjk_distance<S>(s.shape, other, Transform<S>{});
  if (d.separation > reach) return m;
  if (!s.region_of_v1(d.normal) && !s.region_of_v2(d.normal)) return m;
  m.normal = d.normal;
  m.add_point(S(0.5) * (d.point_a + d.point_b), d.separation, ManifoldIds::kCorners);
  return m;
}

// Whether a normal that is one of the shape's own is one that the segment can have. Turns to the segment's own: false
// with `snap`.
template <class S>
bool in_region(const Segment<S>& s, const Vec<S>& normal, bool& snap) {
  const bool first = dot<S>(normal, s.edge) <= S(0);
  snap = !(first ? s.convex1 : s.convex2);
  if (snap) return false;
  const S beyond = first ? cross<S>(normal, s.normal_before) : cross<S>(s.normal_after, normal);
  return beyond <= S(kRegionTolerance);
}

template <class S>
bool lies_before(const LocalManifold<S>& m, S core_separation, S radius) {
  for (int i = 0; i < m.count; ++i)
    if (m.points[i].separation + radius <= core_separation + S(kFacePreference)) return true;
  return false;
}

}  // namespace

template <class S>
LocalManifold<S> collide_chain_segment(const Convex<S>& segment, const Convex<S>& other, S reach) {
  const Segment<S> s(segment);
  if (other.count == 1) return collide_disc(s, other.vertices[0], other.radius, reach);
  if (s.has_behind(other.centroid)) return {};
  S lowest = dot<S>(s.normal, other.vertices[0] - s.v1);
  for (std::uint32_t i = 1; i < other.count; ++i) lowest = min_of(lowest, dot<S>(s.normal, other.vertices[i] - s.v1));
  if (lowest - other.radius > reach) return {};
  const FaceSeparation<S> face = max_face_separation(other, segment);
  if (face.separation - other.radius > reach) return {};
  S core_separation = lowest;
  LocalManifold<S> m;
  bool snap = true;
  if (face.separation > lowest + S(kFacePreference)) {
    if (in_region<S>(s, -other.normals[face.face], snap)) {
      core_separation = face.separation;
      m = clip_to_face(other, face.face, segment, reach, true);
    } else if (!snap) {
      return {};
    }
  }
  if (snap) m = clip_to_face(segment, 0, other, reach, false);
  if (core_separation <= S(0) || lies_before(m, core_separation, other.radius)) return m;
  return collide_corners(s, other, reach);
}

template LocalManifold<float> collide_chain_segment(const Convex<float>&, const Convex<float>&, float);
template LocalManifold<double> collide_chain_segment(const Convex<double>&, const Convex<double>&, double);

}  // namespace urto

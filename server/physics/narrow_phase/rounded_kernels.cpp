// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/narrow_phase/rounded_kernels.h"

#include <limits>

#include "physics/constants.h"
#include "physics/narrow_phase/manifold.h"
#include "physics/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/narrow_phase/rounded_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "physics/narrow_phase/outline_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

// m: a circle has no faces, and any face of another shape is better.
constexpr double kNoFace = -1e30;
// As in gjk.cpp: in units of the rounding of coordinates, how far a vertex may lie beyond what is called the nearest.
constexpr int kSlackRoundings = 8;

template <class S>
HWY_INLINE Pair<S> negated_if(Mask<S> condition, Pair<S> v) {
  return {hn::IfThenElse(condition, hn::Neg(v.x), v.x), hn::IfThenElse(condition, hn::Neg(v.y), v.y)};
}
template <class S>
HWY_INLINE Vector<S> largest_part(Pair<S> v) {
  return larger(hn::Abs(v.x), hn::Abs(v.y));
}

// Both outlines in a's axes, from a's centroid, and what a lane is.
template <class S>
struct RoundedPair {
  Outlines<S> a, b;
  Vector<S> radius_a, radius_b, radii;
  Mask<S> two_discs;

  HWY_INLINE RoundedPair(const PlaceLanes<S>& pa, const PlaceLanes<S>& pb, const OutlineRows<S>* outlines,
                         const std::uint32_t* proxies_a, const std::uint32_t* proxies_b, Vector<S> count_a,
                         Vector<S> count_b)
      : a(outlines, proxies_a, count_a, most_of<S>(count_a, 1)),
        b(outlines, proxies_b, count_b, most_of<S>(count_b, 1)) {
    const auto zero = hn::Zero(Tag<S>());
    radius_a = hn::IfThenElseZero(hn::Lt(pa.vertices, zero), pa.half.x);
    radius_b = hn::IfThenElseZero(hn::Lt(pb.vertices, zero), pb.half.x);
    radii = hn::Add(radius_a, radius_b);
    two_discs = hn::And(hn::Lt(count_a, set(S(2))), hn::Lt(count_b, set(S(2))));
    b.place(rotated_back<S>(pa.axis, pb.axis), rotated_back<S>(pa.axis, minus<S>(pb.center, pa.center)));
  }
};

// The incident edge (a circle's is its centre) clipped to the reference face, as in manifold.cpp.
template <class S>
struct Clip {
  Pair<S> p, q;
  Vector<S> sp, sq;      // m, along the face's normal, between the cores
  Mask<S> below, above;  // all of the edge lies beyond the face's start, its end
  Pair<S> end, corner;   // of face and edge: what meet if two corners do
  Vector<S> end_index;

  HWY_INLINE Clip(const BestFace<S>& face, const IncidentEdge<S>& edge, Vector<S> reference_count) {
    const auto zero = hn::Zero(Tag<S>()), one = set(S(1));
    const Pair<S> tangent{hn::Neg(face.normal.y), face.normal.x};
    const auto length = dot<S>(tangent, minus<S>(face.end, face.start));
    const auto tp = dot<S>(tangent, minus<S>(edge.p, face.start)), tq = dot<S>(tangent, minus<S>(edge.q, face.start));
    below = hn::Lt(tp, zero);
    above = hn::Gt(tq, length);
    const Pair<S> d = minus<S>(edge.q, edge.p);
    const auto span = hn::Sub(tp, tq);
    const auto spans = hn::Gt(span, zero);
    const auto share = hn::Div(one, hn::IfThenElse(spans, span, one));
    const auto along = [&](Vector<S> part) HWY_ATTR -> Pair<S> {
      return {hn::Add(edge.p.x, hn::Mul(d.x, part)), hn::Add(edge.p.y, hn::Mul(d.y, part))};
    };
    const auto p_beyond = hn::Gt(tp, length), q_beyond = hn::Lt(tq, zero);
    p = choose<S>(hn::And(spans, p_beyond), along(hn::Mul(hn::Sub(tp, length), share)), edge.p);
    q = choose<S>(hn::And(spans, q_beyond), along(hn::Mul(tp, share)), edge.q);
    sp = dot<S>(face.normal, minus<S>(p, face.start));
    sq = dot<S>(face.normal, minus<S>(q, face.start));
    // As for boxes (box_kernels.cpp): the nearer end of an edge that lies beside the face, else the one that reaches
    // beyond it, the deeper one if both do.
    const auto deeper_p = hn::Lt(dot<S>(face.normal, d), zero);
    const auto q_meets = hn::Or(above, hn::AndNot(below, hn::AndNot(hn::AndNot(deeper_p, p_beyond), q_beyond)));
    const auto at_start = hn::Or(below, hn::AndNot(above, q_meets));
    corner = choose<S>(q_meets, edge.q, edge.p);
    end = choose<S>(at_start, face.start, face.end);
    const auto next = hn::Add(face.index, one);
    end_index = hn::IfThenElse(at_start, face.index, hn::IfThenElse(hn::Lt(next, reference_count), next, zero));
  }
};

// The corner that lies furthest along a direction; of several the first.
template <class S>
HWY_INLINE Pair<S> furthest(const Outlines<S>& outline, Pair<S> direction) {
  Pair<S> best = outline.vertices[0];
  auto top = dot<S>(direction, best);
  for (int k = 1; k < outline.most; ++k) {
    const auto along = dot<S>(direction, outline.vertices[k]);
    const auto further = hn::Gt(along, top);
    top = hn::IfThenElse(further, along, top);
    best = choose<S>(further, outline.vertices[k], best);
  }
  return best;
}

// The way from a corner of a to one of b, and whether no other corner is nearer along it: the test of GJK's last round.
template <class S>
struct Corners {
  Pair<S> from, way;
  Vector<S> distance;
  Mask<S> nearest;

  HWY_INLINE Corners(const Outlines<S>& a, const Outlines<S>& b, Pair<S> on_a, Pair<S> on_b) : from(on_a) {
    measure(a, b, on_a, on_b);
    if (hn::AllTrue(Tag<S>(), nearest)) return;
    // The corners that were nearer, if these are it.
    const Pair<S> better_a = choose<S>(nearest, from, furthest_a), better_b = choose<S>(nearest, on_b, furthest_b);
    from = better_a;
    measure(a, b, better_a, better_b);
  }

 private:
  HWY_INLINE void measure(const Outlines<S>& a, const Outlines<S>& b, Pair<S> on_a, Pair<S> on_b) {
    way = minus<S>(on_b, on_a);
    const auto distance2 = dot<S>(way, way);
    distance = hn::Sqrt(distance2);
    furthest_a = furthest<S>(a, way);
    furthest_b = furthest<S>(b, {hn::Neg(way.x), hn::Neg(way.y)});
    const auto size = larger(largest_part<S>(on_a), largest_part<S>(on_b));
    const auto slack = hn::Mul(set(S(kSlackRoundings) * std::numeric_limits<S>::epsilon()), size);
    const auto nearer_by = hn::Sub(distance2, dot<S>(way, minus<S>(furthest_b, furthest_a)));
    nearest = hn::And(hn::Gt(distance, slack), hn::Le(nearer_by, hn::Mul(distance, slack)));
  }

  Pair<S> furthest_a, furthest_b;
};

// The outcome of each lane: a contact by faces, by corners, or a question for the general routine.
template <class S>
struct Verdict {
  Mask<S> keep_p, keep_q, corner, ask;
};

// reference_count, incident_count: of vertices.
template <class S>
HWY_INLINE Verdict<S> judge(const RoundedPair<S>& pair, const Clip<S>& clip, const Corners<S>& corners, Mask<S> near,
                            Vector<S> core_separation, Vector<S> reach, Mask<S> disc) {
  const auto zero = hn::Zero(Tag<S>());
  const auto apart = hn::Gt(core_separation, zero), round = hn::Gt(pair.radii, zero);
  // A circle inside of a polygon is pushed out by the nearest face, wherever it lies before it.
  const auto beside = hn::AndNot(hn::AndNot(apart, disc), hn::Or(clip.below, clip.above));
  const auto by_faces = hn::AndNot(pair.two_discs, hn::AndNot(beside, near));
  const auto keep_p = hn::And(by_faces, hn::Le(hn::Sub(clip.sp, pair.radii), reach));
  const auto keep_q = hn::AndNot(disc, hn::And(by_faces, hn::Le(hn::Sub(clip.sq, pair.radii), reach)));
  // collide_rounded of manifold.cpp.
  const auto most = hn::Add(core_separation, set(S(kFacePreference)));
  const auto straight = hn::Or(hn::And(keep_p, hn::Le(clip.sp, most)), hn::And(keep_q, hn::Le(clip.sq, most)));
  const auto faces = hn::And(hn::Or(keep_p, keep_q), hn::Or(hn::Or(disc, straight), hn::Not(hn::And(round, apart))));
  const auto open = hn::AndNot(faces, near);
  // A disc's nearest corner is known. Others ask, unless two corners are surely the nearest; sharp shapes without a
  // point and without a gap have no contact.
  const auto known = hn::And(disc, hn::Or(pair.two_discs, apart));
  const auto found = hn::And(open, hn::Or(known, hn::And(hn::And(round, apart), corners.nearest)));
  const auto nothing = hn::AndNot(hn::Or(round, apart), open);
  const auto gap = hn::Sub(hn::Sub(corners.distance, pair.radius_a), pair.radius_b);
  return {hn::And(faces, keep_p), hn::And(faces, keep_q), hn::And(found, hn::Le(gap, reach)),
          hn::AndNot(hn::Or(found, nothing), open)};
}

template <class S>
HWY_INLINE void collide_vector(const Place<S>* places, const OutlineRows<S>* outlines, const std::uint32_t* proxies_a,
                               const std::uint32_t* proxies_b, std::size_t lane, ManifoldLanes<S>& out) {
  const auto zero = hn::Zero(Tag<S>()), one = set(S(1)), half_of = set(S(0.5));
  store(zero, out.count + lane);
  const PlaceLanes<S> a(places, proxies_a + lane), b(places, proxies_b + lane);
  const auto reach = reach_of(a, b);
  const auto count_a = hn::Abs(a.vertices), count_b = hn::Abs(b.vertices);
  const RoundedPair<S> pair(a, b, outlines, proxies_a + lane, proxies_b + lane, count_a, count_b);
  BestFace<S> fa(pair.a, pair.b), fb(pair.b, pair.a);
  fa.separation = hn::IfThenElse(hn::Gt(count_a, one), fa.separation, set(S(kNoFace)));
  fb.separation = hn::IfThenElse(hn::Gt(count_b, one), fb.separation, set(S(kNoFace)));
  const auto near =
      hn::And(hn::Le(hn::Sub(fa.separation, pair.radii), reach), hn::Le(hn::Sub(fb.separation, pair.radii), reach));
  if (hn::AllFalse(Tag<S>(), near)) return;
  const auto flip = hn::Gt(fb.separation, hn::Add(fa.separation, set(S(kFacePreference))));
  fa.normal = choose<S>(flip, fb.normal, fa.normal);
  fa.start = choose<S>(flip, fb.start, fa.start);
  fa.end = choose<S>(flip, fb.end, fa.end);
  fa.index = hn::IfThenElse(flip, fb.index, fa.index);
  const BestFace<S>& face = fa;
  const auto core_separation = larger(fa.separation, fb.separation);
  const auto reference_count = hn::IfThenElse(flip, count_b, count_a);
  const auto disc = hn::Lt(hn::IfThenElse(flip, count_a, count_b), set(S(2)));
  const IncidentEdge<S> edge(pair.a, pair.b, flip, face.normal);
  const Clip<S> clip(face, edge, reference_count);
  const Corners<S> corners(pair.a, pair.b, choose<S>(flip, clip.corner, clip.end),
                           choose<S>(flip, clip.end, clip.corner));
  const Verdict<S> verdict = judge(pair, clip, corners, near, core_separation, reach, disc);

  const auto gap = hn::Sub(hn::Sub(corners.distance, pair.radius_a), pair.radius_b);
  const auto scale = hn::Div(one, hn::IfThenElse(hn::Gt(corners.distance, zero), corners.distance, one));
  Pair<S> way{hn::Mul(corners.way.x, scale), hn::Mul(corners.way.y, scale)};
  const Pair<S> outward = negated_if<S>(flip, face.normal);
  // Corner on corner: the face's normal, and of concentric circles: up.
  const auto none = hn::Eq(corners.distance, zero);
  way = choose<S>(none, choose<S>(pair.two_discs, {zero, one}, outward), way);
  const Pair<S> normal = choose<S>(verdict.corner, way, outward);
  // Midway between the surfaces, in world axes, from a's centre of mass.
  const auto in_world = [&](Pair<S> at) HWY_ATTR -> Pair<S> {
    const Pair<S> world = rotated<S>(a.axis, at);
    return {hn::Add(a.offset.x, world.x), hn::Add(a.offset.y, world.y)};
  };
  const auto skew = hn::IfThenElse(flip, hn::Sub(pair.radius_a, pair.radius_b), hn::Sub(pair.radius_b, pair.radius_a));
  const auto point = [&](Pair<S> at, Vector<S> s) HWY_ATTR -> Pair<S> {
    const auto back = hn::Mul(half_of, hn::Add(s, skew));
    return {hn::Sub(at.x, hn::Mul(face.normal.x, back)), hn::Sub(at.y, hn::Mul(face.normal.y, back))};
  };
  const auto s1 = hn::IfThenElse(verdict.keep_p, clip.sp, clip.sq);
  const auto forward = hn::Add(pair.radius_a, hn::Mul(half_of, gap));
  const Pair<S> at_corner{hn::Add(corners.from.x, hn::Mul(way.x, forward)),
                          hn::Add(corners.from.y, hn::Mul(way.y, forward))};
  const Pair<S> at_face = point(choose<S>(verdict.keep_p, clip.p, clip.q), s1);
  const Pair<S> first = in_world(choose<S>(verdict.corner, at_corner, at_face));
  const Pair<S> second = in_world(point(clip.q, clip.sq));
  const Pair<S> up = rotated<S>(a.axis, normal);

  // Ids as in manifold.cpp: a disc has none on a disc or a segment, a face's or a corner's on a polygon.
  const auto side = hn::Add(hn::IfThenElseZero(flip, set(S(ManifoldIds::kFlip))), hn::Mul(face.index, set(S(256))));
  const auto q_id = hn::Add(side, edge.q_index);
  const auto face_id = hn::IfThenElse(verdict.keep_p, hn::Add(side, edge.p_index), q_id);
  const auto disc_id =
      hn::IfThenElseZero(hn::Gt(reference_count, set(S(2))),
                         hn::IfThenElse(verdict.corner, hn::Add(set(S(256)), clip.end_index), face.index));
  const auto id = hn::IfThenElse(verdict.corner, set(S(ManifoldIds::kCorners)), face_id);

  const auto both = hn::And(verdict.keep_p, verdict.keep_q);
  const auto any = hn::Or(verdict.corner, hn::Or(verdict.keep_p, verdict.keep_q));
  const auto count = hn::Add(hn::IfThenElseZero(any, one), hn::IfThenElseZero(both, one));
  const Pair<S> between = minus<S>(b.center, a.center);
  store(up.x, out.nx + lane);
  store(up.y, out.ny + lane);
  store(hn::Sub(hn::Add(between.x, a.offset.x), b.offset.x), out.between_x + lane);
  store(hn::Sub(hn::Add(between.y, a.offset.y), b.offset.y), out.between_y + lane);
  store(first.x, out.x[0] + lane);
  store(first.y, out.y[0] + lane);
  store(second.x, out.x[1] + lane);
  store(second.y, out.y[1] + lane);
  store(hn::IfThenElse(verdict.corner, gap, hn::Sub(s1, pair.radii)), out.separation[0] + lane);
  store(hn::Sub(clip.sq, pair.radii), out.separation[1] + lane);
  store(hn::IfThenElse(disc, disc_id, id), out.id[0] + lane);
  store(q_id, out.id[1] + lane);
  store(hn::IfThenElse(verdict.ask, set(S(kAskGeneral)), count), out.count + lane);
}

template <class S>
void collide_rounded(const Place<S>* places, const OutlineRows<S>* outlines, const std::uint32_t* a,
                     const std::uint32_t* b, ManifoldLanes<S>& out) {
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(kLanes<S>); lane += width)
    collide_vector(places, outlines, a, b, lane, out);
}

template <class S>
constexpr RoundedKernels<S> kKernels{collide_rounded<S>};

}  // namespace

const RoundedKernels<float>* float_rounded_kernels() { return &kKernels<float>; }
const RoundedKernels<double>* double_rounded_kernels() { return &kKernels<double>; }

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace urto {

HWY_EXPORT(float_rounded_kernels);
HWY_EXPORT(double_rounded_kernels);

template <>
const RoundedKernels<float>& rounded_kernels<float>() {
  return *HWY_DYNAMIC_DISPATCH(float_rounded_kernels)();
}
template <>
const RoundedKernels<double>& rounded_kernels<double>() {
  return *HWY_DYNAMIC_DISPATCH(double_rounded_kernels)();
}

}  // namespace urto
#endif

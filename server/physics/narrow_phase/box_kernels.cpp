// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/narrow_phase/box_kernels.h"

#include "physics/constants.h"
#include "physics/narrow_phase/manifold.h"
#include "physics/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/narrow_phase/box_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "physics/narrow_phase/place_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

template <class S>
HWY_INLINE Pair<S> turned(Pair<S> v) {  // by +90°
  return {hn::Neg(v.y), v.x};
}
template <class S>
HWY_INLINE Pair<S> negated_if(Mask<S> condition, Pair<S> v) {
  return {hn::IfThenElse(condition, hn::Neg(v.x), v.x), hn::IfThenElse(condition, hn::Neg(v.y), v.y)};
}

// The axes of SAT: how far the boxes are apart along each one's x and y axis.
template <class S>
struct Separations {
  Vector<S> ax, ay, bx, by;

  HWY_INLINE Separations(const PlaceLanes<S>& a, const PlaceLanes<S>& b, Pair<S> between) {
    const auto c = hn::Abs(dot<S>(a.axis, b.axis)), s = hn::Abs(dot<S>(a.axis, turned<S>(b.axis)));
    const auto along = [](Pair<S> axis, Pair<S> d) HWY_ATTR { return hn::Abs(dot<S>(axis, d)); };
    ax = hn::Sub(hn::Sub(along(a.axis, between), a.half.x), hn::Add(hn::Mul(c, b.half.x), hn::Mul(s, b.half.y)));
    ay = hn::Sub(hn::Sub(along(turned<S>(a.axis), between), a.half.y),
                 hn::Add(hn::Mul(s, b.half.x), hn::Mul(c, b.half.y)));
    bx = hn::Sub(hn::Sub(along(b.axis, between), b.half.x), hn::Add(hn::Mul(c, a.half.x), hn::Mul(s, a.half.y)));
    by = hn::Sub(hn::Sub(along(turned<S>(b.axis), between), b.half.y),
                 hn::Add(hn::Mul(s, a.half.x), hn::Mul(c, a.half.y)));
  }
};

// A face of one box as the reference: normal and the way along it, and the edge of the other box that looks at it most,
// clipped to the reference's width. Lengths in the frame of the reference's centre.
template <class S>
struct Clipped {
  Pair<S> normal, tangent;   // world axes
  Vector<S> half;            // m, from the centre to the face
  Vector<S> px, py, qx, qy;  // m, the clipped edge: along the normal, along the face; p lies further along
  Vector<S> p_id, q_id;
  Vector<S> corner_x, corner_y;  // m, from the nearer end of the face to the edge's end nearer to it
  Vector<S> end_y;               // m, that end of the face
  Mask<S> beside;                // the edge lies wholly beside the face: the two meet corner to corner at most

  // vertical: the face is that of the reference's y axis.
  HWY_INLINE Clipped(const PlaceLanes<S>& a, const PlaceLanes<S>& b, Pair<S> between, Mask<S> flip, Mask<S> vertical) {
    const auto zero = hn::Zero(Tag<S>()), one = set(S(1)), two = set(S(2)), three = set(S(3));
    const Pair<S> way = negated_if<S>(flip, between);
    const Pair<S> axis = choose<S>(flip, b.axis, a.axis), other = choose<S>(flip, a.axis, b.axis);
    const Pair<S> halves = choose<S>(flip, b.half, a.half), others = choose<S>(flip, a.half, b.half);
    normal = choose<S>(vertical, turned<S>(axis), axis);
    const auto backwards = hn::Lt(dot<S>(normal, way), zero);
    normal = negated_if<S>(backwards, normal);
    tangent = turned<S>(normal);
    half = hn::IfThenElse(vertical, halves.y, halves.x);
    const auto width = hn::IfThenElse(vertical, halves.x, halves.y);
    const auto face =
        hn::IfThenElse(vertical, hn::IfThenElse(backwards, zero, two), hn::IfThenElse(backwards, three, one));
    // The other box as seen from the face.
    const auto ex = dot<S>(normal, way), ey = dot<S>(tangent, way);
    const auto c = dot<S>(normal, other), s = dot<S>(tangent, other);
    const auto by_x = hn::Ge(hn::Abs(c), hn::Abs(s));
    // The outward normal (mx, my) of the incident edge: ± the other's x axis (c, s) or y axis (−s, c).
    const auto positive = hn::Or(hn::And(by_x, hn::Lt(c, zero)), hn::AndNot(by_x, hn::Gt(s, zero)));
    const auto ux = hn::IfThenElse(by_x, c, hn::Neg(s)), uy = hn::IfThenElse(by_x, s, c);
    const auto mx = hn::IfThenElse(positive, ux, hn::Neg(ux)), my = hn::IfThenElse(positive, uy, hn::Neg(uy));
    const auto depth = hn::IfThenElse(by_x, others.x, others.y), length = hn::IfThenElse(by_x, others.y, others.x);
    const auto start = hn::IfThenElse(by_x, hn::IfThenElse(positive, one, three), hn::IfThenElse(positive, two, zero));
    const auto end = hn::IfThenElse(hn::Eq(start, three), zero, hn::Add(start, one));
    const auto mid_x = hn::Add(ex, hn::Mul(mx, depth)), mid_y = hn::Add(ey, hn::Mul(my, depth));
    // The edge runs from p to q, against the tangent: its direction is (−my, mx), and mx < 0.
    const auto reach_x = hn::Mul(my, length), reach_y = hn::Mul(mx, length);
    const auto p0x = hn::Add(mid_x, reach_x), p0y = hn::Sub(mid_y, reach_y);
    const auto q0x = hn::Sub(mid_x, reach_x), q0y = hn::Add(mid_y, reach_y);
    const auto low = hn::Neg(width);
    const auto below = hn::Lt(p0y, low), above = hn::Gt(q0y, width);
    beside = hn::Or(below, above);
    // The end of the edge that may meet an end of the face: the nearer one if all of it lies beside the face, else the
    // one that reaches beyond it, the deeper one if both do.
    const auto q_beyond = hn::Lt(q0y, low), p_beyond = hn::Gt(p0y, width);
    const auto q_meets = hn::Or(above, hn::AndNot(below, hn::AndNot(hn::And(p_beyond, hn::Lt(p0x, q0x)), q_beyond)));
    const auto at_low = hn::Or(below, hn::AndNot(above, q_meets));
    end_y = hn::IfThenElse(at_low, low, width);
    corner_x = hn::Sub(hn::IfThenElse(q_meets, q0x, p0x), half);
    corner_y = hn::Sub(hn::IfThenElse(q_meets, q0y, p0y), end_y);
    const auto dx = hn::Sub(q0x, p0x), dy = hn::Sub(q0y, p0y), span = hn::Neg(dy);
    const auto spans = hn::Gt(span, zero);
    const auto share = hn::Div(one, hn::IfThenElse(spans, span, one));
    const auto cut_p = hn::And(spans, hn::Gt(p0y, width)), cut_q = hn::And(spans, hn::Lt(q0y, low));
    const auto to_p = hn::Mul(hn::Sub(p0y, width), share), to_q = hn::Mul(hn::Add(p0y, width), share);
    px = hn::IfThenElse(cut_p, hn::Add(p0x, hn::Mul(dx, to_p)), p0x);
    py = hn::IfThenElse(cut_p, width, p0y);
    qx = hn::IfThenElse(cut_q, hn::Add(p0x, hn::Mul(dx, to_q)), q0x);
    qy = hn::IfThenElse(cut_q, low, q0y);
    const auto side = hn::Add(hn::IfThenElseZero(flip, set(S(ManifoldIds::kFlip))), hn::Mul(face, set(S(256))));
    p_id = hn::Add(side, start);
    q_id = hn::Add(side, end);
  }
};

template <class S>
struct Points {
  Mask<S> p, q;
  HWY_INLINE Points(const Clipped<S>& f, Vector<S> reach)
      : p(hn::AndNot(f.beside, hn::Le(hn::Sub(f.px, f.half), reach))),
        q(hn::AndNot(f.beside, hn::Le(hn::Sub(f.qx, f.half), reach))) {}
};

template <class S>
HWY_INLINE void collide_vector(const Place<S>* places, const std::uint32_t* proxies_a, const std::uint32_t* proxies_b,
                               std::size_t lane, ManifoldLanes<S>& out) {
  const auto zero = hn::Zero(Tag<S>()), one = set(S(1)), half_of = set(S(0.5));
  const PlaceLanes<S> a(places, proxies_a + lane), b(places, proxies_b + lane);
  const Pair<S> between{hn::Sub(b.center.x, a.center.x), hn::Sub(b.center.y, a.center.y)};
  const auto reach = reach_of(a, b);
  const Separations<S> sat(a, b, between);
  const auto best_a = larger(sat.ax, sat.ay), best_b = larger(sat.bx, sat.by);
  const auto near = hn::And(hn::Le(best_a, reach), hn::Le(best_b, reach));
  store(zero, out.count + lane);
  if (hn::AllFalse(Tag<S>(), near)) return;
  const auto flip = hn::Gt(best_b, hn::Add(best_a, set(S(kFacePreference))));
  const auto vertical = hn::Or(hn::And(flip, hn::Gt(sat.by, sat.bx)), hn::AndNot(flip, hn::Gt(sat.ay, sat.ax)));
  const Clipped<S> face(a, b, between, flip, vertical);
  Points<S> kept(face, reach);
  kept.p = hn::And(kept.p, near);
  kept.q = hn::And(kept.q, near);

  // Corner to corner.
  const auto distance2 = hn::Add(hn::Mul(face.corner_x, face.corner_x), hn::Mul(face.corner_y, face.corner_y));
  const auto distance = hn::Sqrt(distance2);
  const auto apart = hn::Gt(larger(best_a, best_b), zero);
  const auto corner = hn::And(hn::AndNot(hn::Or(kept.p, kept.q), near),
                              hn::And(hn::And(apart, hn::Gt(distance, zero)), hn::Le(distance, reach)));
  const auto scale = hn::Div(one, hn::IfThenElse(corner, distance, one));
  const auto cx = hn::Mul(face.corner_x, scale), cy = hn::Mul(face.corner_y, scale);
  const auto frame = [&](Vector<S> along, Vector<S> across) HWY_ATTR -> Pair<S> {
    return {hn::Add(hn::Mul(face.normal.x, along), hn::Mul(face.tangent.x, across)),
            hn::Add(hn::Mul(face.normal.y, along), hn::Mul(face.tangent.y, across))};
  };
  const Pair<S> normal = negated_if<S>(flip, choose<S>(corner, frame(cx, cy), face.normal));

  // Points midway between the surfaces, from a's centre of mass.
  const auto point = [&](Vector<S> along, Vector<S> across) HWY_ATTR -> Pair<S> {
    const Pair<S> p = frame(along, across);
    return {hn::Add(a.offset.x, hn::Add(p.x, hn::IfThenElseZero(flip, between.x))),
            hn::Add(a.offset.y, hn::Add(p.y, hn::IfThenElseZero(flip, between.y)))};
  };
  const auto first_x = hn::IfThenElse(kept.p, face.px, face.qx), first_y = hn::IfThenElse(kept.p, face.py, face.qy);
  const auto along_1 = hn::IfThenElse(corner, hn::Add(face.half, hn::Mul(half_of, face.corner_x)),
                                      hn::Mul(half_of, hn::Add(first_x, face.half)));
  const auto across_1 = hn::IfThenElse(corner, hn::Add(face.end_y, hn::Mul(half_of, face.corner_y)), first_y);
  const Pair<S> p1 = point(along_1, across_1), p2 = point(hn::Mul(half_of, hn::Add(face.qx, face.half)), face.qy);
  const auto any = hn::Or(hn::Or(kept.p, kept.q), corner), both = hn::And(kept.p, kept.q);
  store(normal.x, out.nx + lane);
  store(normal.y, out.ny + lane);
  store(hn::Sub(hn::Add(between.x, a.offset.x), b.offset.x), out.between_x + lane);
  store(hn::Sub(hn::Add(between.y, a.offset.y), b.offset.y), out.between_y + lane);
  store(p1.x, out.x[0] + lane);
  store(p1.y, out.y[0] + lane);
  store(p2.x, out.x[1] + lane);
  store(p2.y, out.y[1] + lane);
  store(hn::IfThenElse(corner, distance, hn::Sub(first_x, face.half)), out.separation[0] + lane);
  store(hn::Sub(face.qx, face.half), out.separation[1] + lane);
  store(hn::IfThenElse(corner, set(S(0x8000)), hn::IfThenElse(kept.p, face.p_id, face.q_id)), out.id[0] + lane);
  store(face.q_id, out.id[1] + lane);
  store(hn::Add(hn::IfThenElseZero(any, one), hn::IfThenElseZero(both, one)), out.count + lane);
}

template <class S>
void collide_boxes(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b, ManifoldLanes<S>& out) {
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(kLanes<S>); lane += width)
    collide_vector(places, a, b, lane, out);
}

template <class S>
constexpr BoxKernels<S> kKernels{collide_boxes<S>};

}  // namespace

const BoxKernels<float>* float_box_kernels() { return &kKernels<float>; }
const BoxKernels<double>* double_box_kernels() { return &kKernels<double>; }

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace urto {

HWY_EXPORT(float_box_kernels);
HWY_EXPORT(double_box_kernels);

template <>
const BoxKernels<float>& box_kernels<float>() {
  return *HWY_DYNAMIC_DISPATCH(float_box_kernels)();
}
template <>
const BoxKernels<double>& box_kernels<double>() {
  return *HWY_DYNAMIC_DISPATCH(double_box_kernels)();
}

}  // namespace urto
#endif

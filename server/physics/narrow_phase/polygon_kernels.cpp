// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/narrow_phase/polygon_kernels.h"

#include <type_traits>

#include "physics/constants.h"
#include "physics/narrow_phase/manifold.h"
#include "physics/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/narrow_phase/polygon_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "physics/narrow_phase/outline_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

// kVertices: that many or fewer have all outlines here. Known to the compiler, it unrolls what goes around them.
template <class S, int kVertices>
HWY_INLINE void collide_outlines(const PlaceLanes<S>& a, const PlaceLanes<S>& b, const OutlineRows<S>* outlines,
                                 const std::uint32_t* proxies_a, const std::uint32_t* proxies_b, std::size_t lane,
                                 ManifoldLanes<S>& out) {
  const auto zero = hn::Zero(Tag<S>()), one = set(S(1)), half_of = set(S(0.5));
  const auto reach = reach_of(a, b);
  const Pair<S> between = minus<S>(b.center, a.center);
  // Everything in a's axes, from a's centroid.
  const Outlines<S> outline_a(outlines, proxies_a + lane, a.vertices, kVertices);
  Outlines<S> outline_b(outlines, proxies_b + lane, b.vertices, kVertices);
  outline_b.place(rotated_back<S>(a.axis, b.axis), rotated_back<S>(a.axis, between));
  const BestFace<S> fa(outline_a, outline_b), fb(outline_b, outline_a);
  const auto near = hn::And(hn::Le(fa.separation, reach), hn::Le(fb.separation, reach));
  if (hn::AllFalse(Tag<S>(), near)) return;
  const auto flip = hn::Gt(fb.separation, hn::Add(fa.separation, set(S(kFacePreference))));
  const Pair<S> normal = choose<S>(flip, fb.normal, fa.normal);
  const Pair<S> v1 = choose<S>(flip, fb.start, fa.start), v2 = choose<S>(flip, fb.end, fa.end);
  const IncidentEdge<S> edge(outline_a, outline_b, flip, normal);

  // Clipping, as in manifold.cpp.
  const Pair<S> tangent{hn::Neg(normal.y), normal.x};
  const auto length = dot<S>(tangent, minus<S>(v2, v1));
  const auto tp = dot<S>(tangent, minus<S>(edge.p, v1)), tq = dot<S>(tangent, minus<S>(edge.q, v1));
  const auto beside = hn::Or(hn::Lt(tp, zero), hn::Gt(tq, length));
  const Pair<S> d = minus<S>(edge.q, edge.p);
  const auto span = hn::Sub(tp, tq);
  const auto spans = hn::Gt(span, zero);
  const auto share = hn::Div(one, hn::IfThenElse(spans, span, one));
  const auto along = [&](Vector<S> part) HWY_ATTR -> Pair<S> {
    return {hn::Add(edge.p.x, hn::Mul(d.x, part)), hn::Add(edge.p.y, hn::Mul(d.y, part))};
  };
  const Pair<S> p = choose<S>(hn::And(spans, hn::Gt(tp, length)), along(hn::Mul(hn::Sub(tp, length), share)), edge.p);
  const Pair<S> q = choose<S>(hn::And(spans, hn::Lt(tq, zero)), along(hn::Mul(tp, share)), edge.q);
  const auto sp = dot<S>(normal, minus<S>(p, v1)), sq = dot<S>(normal, minus<S>(q, v1));
  const auto clipped = hn::AndNot(beside, near);
  const auto keep_p = hn::And(clipped, hn::Le(sp, reach)), keep_q = hn::And(clipped, hn::Le(sq, reach));
  const auto any = hn::Or(keep_p, keep_q), both = hn::And(keep_p, keep_q);

  const auto apart = hn::Gt(larger(fa.separation, fb.separation), zero);
  const auto ask = hn::AndNot(any, hn::And(near, apart));

  // Midway between the surfaces, in world axes, from a's centre of mass.
  const auto point = [&](Pair<S> at, Vector<S> s) HWY_ATTR -> Pair<S> {
    const auto back = hn::Mul(half_of, s);
    const Pair<S> mid{hn::Sub(at.x, hn::Mul(normal.x, back)), hn::Sub(at.y, hn::Mul(normal.y, back))};
    const Pair<S> world = rotated<S>(a.axis, mid);
    return {hn::Add(a.offset.x, world.x), hn::Add(a.offset.y, world.y)};
  };
  const auto s1 = hn::IfThenElse(keep_p, sp, sq);
  const Pair<S> first = point(choose<S>(keep_p, p, q), s1), second = point(q, sq);
  const Pair<S> up = rotated<S>(a.axis, normal);
  const auto index = hn::IfThenElse(flip, fb.index, fa.index);
  const auto side = hn::Add(hn::IfThenElseZero(flip, set(S(ManifoldIds::kFlip))), hn::Mul(index, set(S(256))));
  const auto p_id = hn::Add(side, edge.p_index), q_id = hn::Add(side, edge.q_index);
  store(hn::IfThenElse(flip, hn::Neg(up.x), up.x), out.nx + lane);
  store(hn::IfThenElse(flip, hn::Neg(up.y), up.y), out.ny + lane);
  store(hn::Sub(hn::Add(between.x, a.offset.x), b.offset.x), out.between_x + lane);
  store(hn::Sub(hn::Add(between.y, a.offset.y), b.offset.y), out.between_y + lane);
  store(first.x, out.x[0] + lane);
  store(first.y, out.y[0] + lane);
  store(second.x, out.x[1] + lane);
  store(second.y, out.y[1] + lane);
  store(s1, out.separation[0] + lane);
  store(sq, out.separation[1] + lane);
  store(hn::IfThenElse(keep_p, p_id, q_id), out.id[0] + lane);
  store(q_id, out.id[1] + lane);
  const auto count = hn::Add(hn::IfThenElseZero(any, one), hn::IfThenElseZero(both, one));
  store(hn::IfThenElse(ask, set(S(kAskGeneral)), count), out.count + lane);
}

template <class S>
HWY_INLINE void collide_vector(const Place<S>* places, const OutlineRows<S>* outlines, const std::uint32_t* proxies_a,
                               const std::uint32_t* proxies_b, std::size_t lane, ManifoldLanes<S>& out) {
  store(hn::Zero(Tag<S>()), out.count + lane);
  const PlaceLanes<S> a(places, proxies_a + lane), b(places, proxies_b + lane);
  const int most = most_of<S>(larger(a.vertices, b.vertices), 3);
  const auto collide = [&](auto vertices) HWY_ATTR {
    collide_outlines<S, decltype(vertices)::value>(a, b, outlines, proxies_a, proxies_b, lane, out);
  };
  if (most == 3) return collide(std::integral_constant<int, 3>());
  if (most == 4) return collide(std::integral_constant<int, 4>());
  if (most == 5) return collide(std::integral_constant<int, 5>());
  if (most == 6) return collide(std::integral_constant<int, 6>());
  collide(std::integral_constant<int, kMost>());
}

template <class S>
void collide_polygons(const Place<S>* places, const OutlineRows<S>* outlines, const std::uint32_t* a,
                      const std::uint32_t* b, ManifoldLanes<S>& out) {
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(kLanes<S>); lane += width)
    collide_vector(places, outlines, a, b, lane, out);
}

template <class S>
constexpr PolygonKernels<S> kKernels{collide_polygons<S>};

}  // namespace

const PolygonKernels<float>* float_polygon_kernels() { return &kKernels<float>; }
const PolygonKernels<double>* double_polygon_kernels() { return &kKernels<double>; }

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace urto {

HWY_EXPORT(float_polygon_kernels);
HWY_EXPORT(double_polygon_kernels);

template <>
const PolygonKernels<float>& polygon_kernels<float>() {
  return *HWY_DYNAMIC_DISPATCH(float_polygon_kernels)();
}
template <>
const PolygonKernels<double>& polygon_kernels<double>() {
  return *HWY_DYNAMIC_DISPATCH(double_polygon_kernels)();
}

}  // namespace urto
#endif

// What the kernels of the narrow phase share: pairs of vectors, and the places of a few lanes' shapes. Included once
// for each instruction set (Highway's pattern for headers), inside a file that Highway compiles for all of them.
#if defined(URTO_PHYSICS_NARROW_PHASE_PLACE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef URTO_PHYSICS_NARROW_PHASE_PLACE_LANES_INL_H_
#undef URTO_PHYSICS_NARROW_PHASE_PLACE_LANES_INL_H_
#else
#define URTO_PHYSICS_NARROW_PHASE_PLACE_LANES_INL_H_
#endif

#include "physics/places.h"
#include "physics/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {

// The x and the y of a vector in each lane.
template <class S>
struct Pair {
  Vector<S> x, y;
};

template <class S>
HWY_INLINE Vector<S> dot(Pair<S> a, Pair<S> b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y));
}
template <class S>
HWY_INLINE Pair<S> minus(Pair<S> a, Pair<S> b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y)};
}
template <class S>
HWY_INLINE Pair<S> choose(Mask<S> condition, Pair<S> yes, Pair<S> no) {
  return {hn::IfThenElse(condition, yes.x, no.x), hn::IfThenElse(condition, yes.y, no.y)};
}

template <class S>
struct PlaceLanes {
  Pair<S> center, axis, half, offset, way;
  Vector<S> reach, bound, turn, vertices;

  HWY_INLINE PlaceLanes(const Place<S>* places, const std::uint32_t* proxies) {
    const auto m0 = load_rows<S>([&](std::size_t i) { return &places[proxies[i]].x; });
    const auto m1 = load_rows<S>([&](std::size_t i) { return &places[proxies[i]].half_width; });
    const auto m2 = load_rows<S>([&](std::size_t i) { return &places[proxies[i]].reach; });
    const auto m3 = load_rows<S>([&](std::size_t i) { return &places[proxies[i]].way_x; });
    center = {m0.c0, m0.c1};
    axis = {m0.c2, m0.c3};
    half = {m1.c0, m1.c1};
    offset = {m1.c2, m1.c3};
    reach = m2.c0;
    bound = m2.c1;
    turn = m2.c2;
    way = {m3.c0, m3.c1};
    vertices = m3.c2;
  }
};

// The way the surfaces may close in by in one step, on top of the shapes' own reach (reach_of in contacts.h).
template <class S>
HWY_INLINE Vector<S> reach_of(const PlaceLanes<S>& a, const PlaceLanes<S>& b) {
  const Pair<S> w = minus<S>(b.way, a.way);
  const auto way = hn::Add(hn::Sqrt(dot<S>(w, w)), hn::Add(a.turn, b.turn));
  return hn::Add(smaller(a.reach, b.reach), smaller(way, smaller(a.bound, b.bound)));
}

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#endif

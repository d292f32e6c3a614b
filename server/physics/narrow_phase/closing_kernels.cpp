// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/narrow_phase/closing_kernels.h"

#include <limits>

#include "physics/constants.h"
#include "physics/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/narrow_phase/closing_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "physics/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

template <class S>
struct Approach {
  Columns<S> a, b;   // rows `reach` of the places
  Vector<S> wx, wy;  // m, b's way as a sees it
  Mask<S> fast;      // one of them is, and they may close in by enough for it to matter

  HWY_INLINE Approach(const Place<S>* places, const std::uint32_t* pa, const std::uint32_t* pb)
      : a(load_rows<S>([&](std::size_t i) { return &places[pa[i]].reach; })),
        b(load_rows<S>([&](std::size_t i) { return &places[pb[i]].reach; })) {
    const auto a3 = load_rows<S>([&](std::size_t i) { return &places[pa[i]].way_x; });
    const auto b3 = load_rows<S>([&](std::size_t i) { return &places[pb[i]].way_x; });
    wx = hn::Sub(b3.c0, a3.c0);
    wy = hn::Sub(b3.c1, a3.c1);
    // m, no point of the one comes nearer to one of the other.
    const auto way = hn::Add(hn::Sqrt(hn::Add(hn::Mul(wx, wx), hn::Mul(wy, wy))), hn::Add(a.c2, b.c2));
    // A bound is half of a least extent.
    const auto fine = hn::Mul(set(S(2 * kFastFraction)), smaller(a.c1, b.c1));
    fast = hn::And(hn::Gt(hn::Add(a3.c3, b3.c3), hn::Zero(Tag<S>())), hn::Gt(way, fine));
  }
};

// m², how far shapes reach from their centroids along (dx, dy), times its length: boxes by their axes (row `x`), what
// else has a disc by that. Infinite if it is not known.
template <class S>
HWY_INLINE Vector<S> reaches(const Columns<S>& place, const Columns<S>& half, Vector<S> dx, Vector<S> dy,
                             Vector<S> length) {
  const auto zero = hn::Zero(Tag<S>());
  const auto along = hn::Abs(hn::Add(hn::Mul(dx, place.c2), hn::Mul(dy, place.c3)));
  const auto across = hn::Abs(hn::Sub(hn::Mul(dy, place.c2), hn::Mul(dx, place.c3)));
  const auto box = hn::Add(hn::Mul(along, half.c0), hn::Mul(across, half.c1));
  const auto known = hn::IfThenElse(hn::Gt(half.c1, zero), box, hn::Neg(hn::Mul(half.c1, length)));
  return hn::IfThenElse(hn::Eq(half.c1, zero), set(std::numeric_limits<S>::infinity()), known);
}

// Along the line between their centroids a gap is left that neither ways nor turns close.
template <class S>
HWY_INLINE std::uint32_t closing_vector(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b) {
  const Approach<S> approach(places, a, b);
  if (hn::AllFalse(Tag<S>(), approach.fast)) return 0;
  const auto a0 = load_rows<S>([&](std::size_t i) { return &places[a[i]].x; });
  const auto b0 = load_rows<S>([&](std::size_t i) { return &places[b[i]].x; });
  const auto a1 = load_rows<S>([&](std::size_t i) { return &places[a[i]].half_width; });
  const auto b1 = load_rows<S>([&](std::size_t i) { return &places[b[i]].half_width; });
  const auto dx = hn::Sub(b0.c0, a0.c0), dy = hn::Sub(b0.c1, a0.c1);
  const auto length2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), length = hn::Sqrt(length2);
  const auto shapes = hn::Add(reaches<S>(a0, a1, dx, dy, length), reaches<S>(b0, b1, dx, dy, length));
  const auto near = hn::Add(hn::Add(approach.a.c2, approach.b.c2), smaller(approach.a.c0, approach.b.c0));
  const auto inwards = hn::Neg(hn::Add(hn::Mul(approach.wx, dx), hn::Mul(approach.wy, dy)));
  const auto closed = hn::Add(hn::Add(shapes, hn::Mul(near, length)), larger(inwards, hn::Zero(Tag<S>())));
  const auto apart = hn::Gt(length2, hn::Mul(set(S(1 + kDiscSlack)), closed));
  return bits_of<S>(hn::AndNot(apart, approach.fast));
}

// Seen from the one the other swings by no more than both turn.
template <class S>
HWY_INLINE std::uint32_t swinging_vector(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b) {
  const Approach<S> approach(places, a, b);
  // What does not fall has no bound of its own, and may be as thin as can be.
  const auto bound = [](Vector<S> v) { return hn::IfThenElseZero(hn::Lt(v, set(S(kCoordinateMax))), v); };
  const auto thin = hn::Mul(set(S(2 * kFastFraction)), hn::Add(bound(approach.a.c1), bound(approach.b.c1)));
  const auto swing = hn::Mul(set(S(1 + kDiscSlack)), hn::Add(approach.a.c2, approach.b.c2));
  return bits_of<S>(hn::And(approach.fast, hn::Gt(swing, thin)));
}

template <class S, std::uint32_t (*OfVector)(const Place<S>*, const std::uint32_t*, const std::uint32_t*)>
std::uint32_t of_block(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b) {
  std::uint32_t found = 0;
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(kLanes<S>); lane += width)
    found |= OfVector(places, a + lane, b + lane) << lane;
  return found;
}

template <class S>
constexpr ClosingKernels<S> kKernels{of_block<S, closing_vector<S>>, of_block<S, swinging_vector<S>>};

}  // namespace

const ClosingKernels<float>* float_closing_kernels() { return &kKernels<float>; }
const ClosingKernels<double>* double_closing_kernels() { return &kKernels<double>; }

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace urto {

HWY_EXPORT(float_closing_kernels);
HWY_EXPORT(double_closing_kernels);

template <>
const ClosingKernels<float>& closing_kernels<float>() {
  return *HWY_DYNAMIC_DISPATCH(float_closing_kernels)();
}
template <>
const ClosingKernels<double>& closing_kernels<double>() {
  return *HWY_DYNAMIC_DISPATCH(double_closing_kernels)();
}

}  // namespace urto
#endif

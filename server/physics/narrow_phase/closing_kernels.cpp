// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/narrow_phase/closing_kernels.h"

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
HWY_INLINE std::uint32_t closing_vector(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b) {
  const auto a2 = load_rows<S>([&](std::size_t i) { return &places[a[i]].reach; });
  const auto b2 = load_rows<S>([&](std::size_t i) { return &places[b[i]].reach; });
  const auto a3 = load_rows<S>([&](std::size_t i) { return &places[a[i]].way_x; });
  const auto b3 = load_rows<S>([&](std::size_t i) { return &places[b[i]].way_x; });
  const auto wx = hn::Sub(b3.c0, a3.c0), wy = hn::Sub(b3.c1, a3.c1);
  const auto way = hn::Add(hn::Sqrt(hn::Add(hn::Mul(wx, wx), hn::Mul(wy, wy))), hn::Add(a2.c2, b2.c2));
  // A bound is half of a least extent.
  const auto fine = hn::Mul(set(S(2 * kFastFraction)), smaller(a2.c1, b2.c1));
  const auto closing = hn::And(hn::Gt(hn::Add(a3.c3, b3.c3), hn::Zero(Tag<S>())), hn::Gt(way, fine));
  return bits_of<S>(closing);
}

template <class S>
std::uint32_t closing(const Place<S>* places, const std::uint32_t* a, const std::uint32_t* b) {
  std::uint32_t found = 0;
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(kLanes<S>); lane += width)
    found |= closing_vector(places, a + lane, b + lane) << lane;
  return found;
}

template <class S>
constexpr ClosingKernels<S> kKernels{closing<S>};

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

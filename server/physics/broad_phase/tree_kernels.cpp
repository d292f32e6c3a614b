// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/broad_phase/tree_kernels.h"

#include "physics/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/broad_phase/tree_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "physics/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

constexpr std::size_t kBoxPairs = 16;  // in a pair of nodes

#if HWY_TARGET != HWY_SCALAR

static_assert(kBoxPairs % kLanes<float> == 0);

alignas(64) constexpr std::int32_t kLaneOfX[kBoxPairs] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

// Of four scalars the one that each pair has of x, from pair `first` on.
HWY_INLINE Vector<float> of_x(const float* four, std::size_t first) {
  const Tag<float> d;
  if constexpr (hn::MaxLanes(Tag<float>()) == 4) {
    return hn::Set(d, four[first / 4]);
  } else {
    return hn::TableLookupLanes(hn::LoadDup128(d, four), hn::SetTableIndices(d, kLaneOfX + first));
  }
}
HWY_INLINE Vector<float> of_y(const float* four) { return hn::LoadDup128(Tag<float>(), four); }

HWY_INLINE Mask<float> overlap(const Box4<float>& x, const Box4<float>& y, std::size_t first) {
  return hn::And(
      hn::And(hn::Le(of_x(x.lower_x, first), of_y(y.upper_x)), hn::Le(of_y(y.lower_x), of_x(x.upper_x, first))),
      hn::And(hn::Le(of_x(x.lower_y, first), of_y(y.upper_y)), hn::Le(of_y(y.lower_y), of_x(x.upper_y, first))));
}

HWY_INLINE std::uint32_t meeting(const Nodes<float>& a, const Nodes<float>& b, bool fresh, const NodePair& pair) {
  std::uint32_t out = 0;
  for (std::size_t first = 0; first < kBoxPairs; first += hn::Lanes(Tag<float>())) {
    Mask<float> met = overlap(a.boxes[pair.x], b.boxes[pair.y], first);
    if (fresh) met = hn::AndNot(overlap(a.before[pair.x], b.before[pair.y], first), met);
    out |= bits_of<float>(met) << first;
  }
  return out;
}

#endif

template <class S>
std::uint32_t overlap(const Box4<S>& x, const Box4<S>& y) {
  std::uint32_t out = 0;
  for (int lane = 0; lane < 4; ++lane) out |= y.overlap_mask(x, lane) << (4 * lane);
  return out;
}

template <class S>
std::uint32_t meeting(const Nodes<S>& a, const Nodes<S>& b, bool fresh, const NodePair& pair) {
  const std::uint32_t met = overlap(a.boxes[pair.x], b.boxes[pair.y]);
  return fresh && met != 0 ? met & ~overlap(a.before[pair.x], b.before[pair.y]) : met;
}

// All lanes of y with those of x that are marked, and all of x with those of y.
constexpr std::uint32_t kOneOfEachRow = 0x1111;
constexpr std::uint32_t rows(std::uint32_t marks) {
  return ((marks & 1u) | (marks & 2u) << 3 | (marks & 4u) << 6 | (marks & 8u) << 9) * 0xfu;
}
static_assert(rows(0b1010) == 0xf0f0);
constexpr std::uint32_t kEachOnce = 0x08ce;  // lanes j of y above lane i of x
constexpr std::uint32_t kEachWithItself = 0x8421;

template <class S>
std::size_t meet(const Nodes<S>& a, const Nodes<S>& b, Sought sought, const NodePair* pairs, std::size_t count,
                 NodeHit* hits) {
  const std::uint32_t of_one = kEachOnce | (sought == Sought::kBranches ? kEachWithItself : 0u);
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const NodePair& pair = pairs[k];
    const std::uint32_t wanted = rows(a.marks[pair.x]) | b.marks[pair.y] * kOneOfEachRow;
    const bool same = a.boxes == b.boxes && pair.x == pair.y;
    const std::uint32_t met = meeting(a, b, sought == Sought::kNewPairs, pair);
    const std::uint32_t lanes = met & wanted & (same ? of_one : 0xffffu);
    hits[found] = {pair, lanes};
    found += lanes != 0 ? 1 : 0;
  }
  return found;
}

template <class S>
double refit_lane(const Box4<S>& child, Box4<S>& parent, int lane) {
  parent.set(lane, child.bounds());
  return parent.half_perimeter(lane);
}

#if HWY_TARGET != HWY_SCALAR

using Four = hn::FixedTag<float, 4>;

// Lane k: the best of the four lanes of row k.
template <class Better>
HWY_INLINE hn::Vec<Four> best_of_rows(const float* r0, const float* r1, const float* r2, const float* r3,
                                      const Better& better) {
  const Four d;
  const auto v0 = hn::Load(d, r0), v1 = hn::Load(d, r1), v2 = hn::Load(d, r2), v3 = hn::Load(d, r3);
  const auto even = better(hn::InterleaveLower(d, v0, v2), hn::InterleaveUpper(d, v0, v2));
  const auto odd = better(hn::InterleaveLower(d, v1, v3), hn::InterleaveUpper(d, v1, v3));
  return better(hn::InterleaveLower(d, even, odd), hn::InterleaveUpper(d, even, odd));
}

HWY_INLINE double refit_node(const Box4<float>* c, Box4<float>& parent) {
  const Four d;
  const auto least = [](auto a, auto b) { return hn::IfThenElse(hn::Lt(a, b), a, b); };
  const auto greatest = [](auto a, auto b) { return hn::IfThenElse(hn::Gt(a, b), a, b); };
  const auto low_x = best_of_rows(c[0].lower_x, c[1].lower_x, c[2].lower_x, c[3].lower_x, least);
  const auto low_y = best_of_rows(c[0].lower_y, c[1].lower_y, c[2].lower_y, c[3].lower_y, least);
  const auto high_x = best_of_rows(c[0].upper_x, c[1].upper_x, c[2].upper_x, c[3].upper_x, greatest);
  const auto high_y = best_of_rows(c[0].upper_y, c[1].upper_y, c[2].upper_y, c[3].upper_y, greatest);
  hn::Store(low_x, d, parent.lower_x);
  hn::Store(low_y, d, parent.lower_y);
  hn::Store(high_x, d, parent.upper_x);
  hn::Store(high_y, d, parent.upper_y);
  const auto sizes = hn::Add(hn::Sub(high_x, low_x), hn::Sub(high_y, low_y));
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(d, hn::IfThenElseZero(hn::Le(low_x, high_x), sizes))));
}

#endif

template <class S>
double refit_node(const Box4<S>* children, Box4<S>& parent) {
  double cost = 0;
  for (int lane = 0; lane < 4; ++lane) cost += refit_lane(children[lane], parent, lane);
  return cost;
}

template <class S>
double refit(const Box4<S>* children, std::size_t count, Box4<S>* parents) {
  double cost = 0;
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) cost += refit_node(children + k, parents[k / 4]);
  for (; k < count; ++k) cost += refit_lane(children[k], parents[k / 4], static_cast<int>(k % 4));
  return cost;
}

template <class S>
constexpr TreeKernels<S> kKernels{meet<S>, refit<S>};

}  // namespace

const TreeKernels<float>* float_tree_kernels() { return &kKernels<float>; }
const TreeKernels<double>* double_tree_kernels() { return &kKernels<double>; }

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace urto {

HWY_EXPORT(float_tree_kernels);
HWY_EXPORT(double_tree_kernels);

template <>
const TreeKernels<float>& tree_kernels<float>() {
  return *HWY_DYNAMIC_DISPATCH(float_tree_kernels)();
}
template <>
const TreeKernels<double>& tree_kernels<double>() {
  return *HWY_DYNAMIC_DISPATCH(double_tree_kernels)();
}

}  // namespace urto
#endif

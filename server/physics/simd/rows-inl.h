// Vectors of a world's scalars, and rows of four scalars turned into them. Included once for each instruction set
// (Highway's pattern for headers), inside a file that Highway compiles for all of them.
#if defined(URTO_PHYSICS_SIMD_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef URTO_PHYSICS_SIMD_ROWS_INL_H_
#undef URTO_PHYSICS_SIMD_ROWS_INL_H_
#else
#define URTO_PHYSICS_SIMD_ROWS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

#include "physics/simd/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Multiplications and additions stay apart everywhere (no MulAdd), and comparisons choose by IfThenElse instead of Min
// and Max: both would differ between machines in rounding, or in the sign of zero.

template <class S>
using Tag = hn::CappedTag<S, static_cast<std::size_t>(kLanes<S>)>;
template <class S>
using Vector = hn::Vec<Tag<S>>;
template <class S>
using Mask = hn::Mask<Tag<S>>;

template <class S>
HWY_INLINE Vector<S> load(const S* lanes) {
  return hn::Load(Tag<S>(), lanes);
}
template <class S>
HWY_INLINE void store(Vector<S> v, S* lanes) {
  hn::Store(v, Tag<S>(), lanes);
}
template <class S>
HWY_INLINE Vector<S> set(S value) {
  return hn::Set(Tag<S>(), value);
}
template <class V>
HWY_INLINE V larger(V a, V b) {
  return hn::IfThenElse(hn::Gt(b, a), b, a);
}
template <class V>
HWY_INLINE V smaller(V a, V b) {
  return hn::IfThenElse(hn::Lt(b, a), b, a);
}

// A bit for each lane.
template <class S>
HWY_INLINE std::uint32_t bits_of(Mask<S> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Tag<S>(), mask, bits);
  return bits[0] | static_cast<std::uint32_t>(bits[1]) << 8;
}

// Four vectors: one for each column of the rows.
template <class S>
struct Columns {
  Vector<S> c0, c1, c2, c3;
};

#if HWY_TARGET != HWY_SCALAR

// Turns 4×4 tiles: each 128-bit block of the four vectors is one tile.
HWY_INLINE Columns<float> turn_tiles(Columns<float> m) {
  const Tag<float> d;
  const auto t0 = hn::InterleaveLower(d, m.c0, m.c2), t1 = hn::InterleaveLower(d, m.c1, m.c3);
  const auto t2 = hn::InterleaveUpper(d, m.c0, m.c2), t3 = hn::InterleaveUpper(d, m.c1, m.c3);
  return {hn::InterleaveLower(d, t0, t1), hn::InterleaveUpper(d, t0, t1), hn::InterleaveLower(d, t2, t3),
          hn::InterleaveUpper(d, t2, t3)};
}

// One row of four in each 128-bit block, a quarter of the vector's width apart. Halves are told by their lanes: what
// type Highway gives the half of a tag differs between its versions.
template <class D>
struct Blocks {
  using Half = hn::Half<D>;
  static constexpr bool kWhole = hn::MaxLanes(D()) == 4;
  static constexpr std::size_t kRows = hn::MaxLanes(D()) / 8;  // of one half
  template <class Row>
  static HWY_INLINE hn::Vec<D> load(const Row& row, std::size_t first) {
    if constexpr (kWhole) {
      return hn::LoadU(D(), row(first));
    } else {
      return hn::Combine(D(), Blocks<Half>::load(row, first + 4 * kRows), Blocks<Half>::load(row, first));
    }
  }
  template <class Row>
  static HWY_INLINE void store(hn::Vec<D> v, const Row& row, std::size_t first) {
    if constexpr (kWhole) {
      hn::StoreU(v, D(), row(first));
    } else {
      Blocks<Half>::store(hn::LowerHalf(Half(), v), row, first);
      Blocks<Half>::store(hn::UpperHalf(Half(), v), row, first + 4 * kRows);
    }
  }
};
using FloatBlocks = Blocks<Tag<float>>;

#endif

// Row i of as many as a vector has lanes is at row(i): its four scalars become the i-th of the four columns.
template <class S, class Row>
HWY_INLINE Columns<S> load_rows(const Row& row) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (sizeof(S) == 4)
    return turn_tiles(
        {FloatBlocks::load(row, 0), FloatBlocks::load(row, 1), FloatBlocks::load(row, 2), FloatBlocks::load(row, 3)});
  else
#endif
  {
    HWY_ALIGN S rows[4 * kLanes<S>];
    const std::size_t n = hn::Lanes(Tag<S>());
    for (std::size_t i = 0; i < n; ++i) std::memcpy(rows + 4 * i, row(i), 4 * sizeof(S));
    // Not into a Columns at once: its implied constructor may be made outside of the instruction set's pragma.
    Vector<S> c0, c1, c2, c3;
    hn::LoadInterleaved4(Tag<S>(), rows, c0, c1, c2, c3);
    return {c0, c1, c2, c3};
  }
}

// The way back. Rows that shall not be written lead to a place that nobody reads.
template <class S, class Row>
HWY_INLINE void store_rows(const Columns<S>& m, const Row& row) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (sizeof(S) == 4) {
    const Columns<float> rows = turn_tiles(m);
    FloatBlocks::store(rows.c0, row, 0);
    FloatBlocks::store(rows.c1, row, 1);
    FloatBlocks::store(rows.c2, row, 2);
    FloatBlocks::store(rows.c3, row, 3);
  } else
#endif
  {
    HWY_ALIGN S rows[4 * kLanes<S>];
    const std::size_t n = hn::Lanes(Tag<S>());
    hn::StoreInterleaved4(m.c0, m.c1, m.c2, m.c3, Tag<S>(), rows);
    for (std::size_t i = 0; i < n; ++i) std::memcpy(row(i), rows + 4 * i, 4 * sizeof(S));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#endif

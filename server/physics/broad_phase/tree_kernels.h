#pragma once

#include <cstddef>
#include <cstdint>

#include "physics/broad_phase/box4.h"

namespace urto {

// The leaves of a tree of boxes: four proxies each, side by side in arrays by leaf.
template <class S>
struct Leaves {
  const Box4<S>* now;
  const Box4<S>* before;      // as of when new pairs were last sought
  const std::uint8_t* marks;  // a bit for each proxy whose pairs are sought
};

struct LeafPair {
  std::uint32_t x, y;  // of the one tree and of the other
};
// Pairs of proxies of two leaves, bit 4i + j that of lane i of x and lane j of y.
struct LeafHit {
  LeafPair leaves;
  std::uint32_t lanes;
};

// What is done at every node of a tree of boxes, side by side. In a moving crowd nearly all pairs of proxies of two
// leaves are apart or have met long ago, and finding that out for all sixteen at once, without a branch for each, is
// most of what a search costs.
template <class S>
struct TreeKernels {
  // The pairs whose boxes overlap, one of them marked; `fresh`: and did not overlap before. Leaves without any are left
  // out; a leaf of one tree paired with itself has each pair once. `hits` has room for `count`. How many there are.
  std::size_t (*meet)(const Leaves<S>& a, const Leaves<S>& b, bool fresh, const LeafPair* pairs, std::size_t count,
                      LeafHit* hits);
  // Sets lane k % 4 of parent k / 4 to what is around node k of the level below. The sum of all half perimeters.
  double (*refit)(const Box4<S>* children, std::size_t count, Box4<S>* parents);
};

template <class S>
const TreeKernels<S>& tree_kernels();

}  // namespace urto

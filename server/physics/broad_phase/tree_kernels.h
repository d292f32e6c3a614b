#pragma once

#include <cstddef>
#include <cstdint>

#include "physics/broad_phase/box4.h"

namespace urto {

// A level of a tree of boxes, by node: four boxes each, those of the nodes below or, in the lowest, of proxies.
template <class S>
struct Nodes {
  const Box4<S>* boxes;
  const Box4<S>* before;      // of the lowest level: as of when new pairs were last sought
  const std::uint8_t* marks;  // a bit for each box of or above a proxy whose pairs are sought
};

struct NodePair {
  std::uint32_t x, y;  // of the one tree and of the other
};
// Pairs of boxes of two nodes, bit 4i + j that of lane i of x and lane j of y.
struct NodeHit {
  NodePair nodes;
  std::uint32_t lanes;
};

enum class Sought {
  kBranches,  // overlapping boxes, each with itself too
  kPairs,     // overlapping boxes of different proxies
  kNewPairs,  // of those the ones that did not overlap before
};

// What is done at every node of a tree of boxes, side by side. In a moving crowd nearly all pairs of proxies are apart
// or have met long ago, and finding that out for all sixteen of two nodes at once, without a branch for each, is most
// of what a search costs.
template <class S>
struct TreeKernels {
  // The pairs of boxes that are sought, of which one is marked. Node pairs without any are left out; a node of one tree
  // paired with itself has each pair once. `hits` has room for `count`. How many there are.
  std::size_t (*meet)(const Nodes<S>& a, const Nodes<S>& b, Sought sought, const NodePair* pairs, std::size_t count,
                      NodeHit* hits);
  // Sets lane k % 4 of parent k / 4 to what is around node k of the level below. The sum of all half perimeters.
  double (*refit)(const Box4<S>* children, std::size_t count, Box4<S>* parents);
};

template <class S>
const TreeKernels<S>& tree_kernels();

}  // namespace urto

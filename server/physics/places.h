#pragma once

#include <cstdint>

#include "physics/definitions.h"

namespace urto {

// A shape as the narrow phase sees it in the coming step: one cache line (two in double), read by rows of four.
template <class S>
struct alignas(16 * sizeof(S)) Place {
  S x = 0, y = 0;  // m, the shape's centroid, world frame
  S c = 1, s = 0;  // of a box's own x axis, of any other shape's body, world frame
  // m, of a sharp box; of any other shape its radius, and below zero how far it reaches from its centroid; 0: unknown.
  S half_width = 0, half_height = 0;
  S offset_x = 0, offset_y = 0;  // m, from the body's centre of mass to the centroid, world axes
  S reach = 0;                   // m, speculative distance
  S bound = 0;                   // m, half of a dynamic body's least extent: no more is added to the reach for its way
  S turn = 0;                    // m, how far the body's farthest point turns in a step
  S box = 0;                     // 1: a sharp box, which box_kernels.h may take; 0: any other shape
  S way_x = 0, way_y = 0;        // m, how far the body comes in a step at its velocity
  // Of an outline whose axes are its body's: how many, below zero if it has a radius or is none of a polygon
  // (rounded_kernels.h); 0 if only the general routine knows it.
  S vertices = 0;
  S fast = 0;  // 1: may pass through something in the step at hand (continuous.h); 0 between steps
};

// Who finds out where a pair touches: a kernel that looks at many side by side, or the general routine.
enum class PairKind { kGeneral, kBoxes, kPolygons, kRounded };
template <class S>
PairKind pair_kind(const Place<S>& a, const Place<S>& b) {
  if (a.box > S(0) && b.box > S(0)) return PairKind::kBoxes;
  if (a.vertices > S(0) && b.vertices > S(0)) return PairKind::kPolygons;
  return a.vertices != S(0) && b.vertices != S(0) ? PairKind::kRounded : PairKind::kGeneral;
}

template <class S>
struct WorldData;

// Sets the places of a body's shapes as the body is and moves now. Whoever changes either between steps asks for it.
template <class S>
void refresh_places(WorldData<S>& world, std::uint32_t slot);

}  // namespace urto

#pragma once

#include <cstdint>

#include "physics/body.h"
#include "physics/places.h"
#include "physics/shape.h"

namespace urto {

// What bodies, and the places of simple ones, are at the end of a step.
template <class S>
struct StepEnd {
  Body<S>* bodies;         // by slot
  Motion<S>* motions;      // by slot
  Place<S>* places;        // by proxy
  const Shape<S>* shapes;  // by proxy
  S time_step;
};

// What was found of the bodies of a block, a bit each.
struct BlockEnd {
  std::uint32_t not_followed;  // whose places and bounds nobody looked at, or whose bounds may be left
  std::uint32_t restful;       // slow for as long as it takes to fall asleep
};

// The movement of as many bodies side by side as a block has lanes.
template <class S>
struct MotionKernels {
  // x += h v, angle += h ω. `count` of any size.
  void (*integrate_positions)(Motion<S>* motions, const std::uint32_t* slots, std::size_t count, S h);
  // Takes over the way that bodies came, counts how long they have been slow, and sets the places of those that have
  // one shape in their middle. `count` of at most kLanes.
  BlockEnd (*end_step)(const StepEnd<S>& world, const std::uint32_t* slots, std::size_t count);
  // A bit each for bodies whose farthest point may have come further than kFastFraction of their least extent, or, if
  // they are kinematic, have moved at all. `count` of at most kLanes.
  std::uint32_t (*fast)(const Body<S>* bodies, const Motion<S>* motions, const std::uint32_t* slots, std::size_t count);
};

template <class S>
const MotionKernels<S>& motion_kernels();

}  // namespace urto

#pragma once

#include <cstdint>

#include "physics/body.h"
#include "physics/narrow_phase/outline.h"
#include "physics/places.h"
#include "physics/shape.h"

namespace urto {

// What bodies, and the places of simple ones, are at the end of a step.
template <class S>
struct StepEnd {
  Body<S>* bodies;     // by slot
  Motion<S>* motions;  // by slot
  // By proxy:
  Place<S>* places;
  Shape<S>* shapes;
  const Convex<S>* convexes;
  const OutlineRows<S>* outlines;
  S time_step;
};

template <class S>
struct WorldData;
template <class S>
StepEnd<S> step_end(WorldData<S>& world) {
  return {world.bodies.data(),   world.motions.data(),  world.places.data(),        world.shapes.data(),
          world.convexes.data(), world.outlines.data(), S(world.settings.time_step)};
}

// What was found of the bodies of a block, a bit each.
struct BlockEnd {
  std::uint32_t followed;  // that have one shape in their middle, whose place and bounds are as they shall be
  std::uint32_t left;      // of those, whose shape has left its bounds and got new ones
  std::uint32_t restful;   // slow for as long as it takes to fall asleep
};

// The movement of as many bodies side by side as a block has lanes.
template <class S>
struct MotionKernels {
  // x += h v, angle += h ω. `count` of any size.
  void (*integrate_positions)(Motion<S>* motions, const std::uint32_t* slots, std::size_t count, S h);
  // Takes over the way that bodies came, counts how long they have been slow, and sets the places of those that have
  // one shape in their middle. `count` of at most kLanes.
  BlockEnd (*end_step)(const StepEnd<S>& world, const std::uint32_t* slots, std::size_t count);
  // The same for shapes of bodies that have ended their step: sets their places, and new bounds where they left theirs,
  // a bit each. Shapes of dynamic bodies with a kernel of the narrow phase alone. `count` of at most kLanes.
  std::uint32_t (*follow)(const StepEnd<S>& world, const std::uint32_t* proxies, std::size_t count);
  // A bit each for shapes that may leave their bounds on their body's way, which is yet to be taken over: all that do,
  // and a few that come near to it, or turn far, or that no kernel knows. `count` of at most kLanes.
  std::uint32_t (*leaving)(const StepEnd<S>& world, const std::uint32_t* proxies, std::size_t count);
  // A bit each for bodies whose farthest point may have come further than kFastFraction of their least extent, or, if
  // they are kinematic, have moved at all. `count` of at most kLanes.
  std::uint32_t (*fast)(const Body<S>* bodies, const Motion<S>* motions, const std::uint32_t* slots, std::size_t count);
};

template <class S>
const MotionKernels<S>& motion_kernels();

}  // namespace urto

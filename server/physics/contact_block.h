#pragma once

#include <cstdint>

#include "physics/simd/lanes.h"

namespace urto {

// Touching contacts as the solver wants them: side by side in lanes, written by the narrow phase each step and worked
// on in place. All that happens along the normal n and the tangent t = (n_y, −n_x), so an anchor r is kept as its
// parts r·n ("along") and r×n ("lever", the arm of the normal impulse; −r·n is that of the tangential one).

template <class S>
struct PointLanes {
  S along[kLanes<S>], lever[kLanes<S>];                                 // m, the anchor from a's centre of mass
  S separation[kLanes<S>];                                              // m, at the start of the step
  S normal_impulse[kLanes<S>], tangent_impulse[kLanes<S>];              // N·s, of this sub-step
  S preload[kLanes<S>];                                                 // N·s, see Softness
  S inverse_mass[kLanes<S>];                                            // 1/kg along the normal
  S tangent_mass[kLanes<S>];                                            // kg along the tangent
  S total_normal_impulse[kLanes<S>], total_tangent_impulse[kLanes<S>];  // N·s, of the step so far
};

// No two lanes of a block share a body that can move.
template <class S>
struct alignas(64) ContactBlock {
  // Scalars first: each array is one cache line, and aligned.
  S nx[kLanes<S>], ny[kLanes<S>];                        // from a to b, world frame
  S between_along[kLanes<S>], between_lever[kLanes<S>];  // m, from a's centre of mass to b's, like an anchor
  S inv_mass_a[kLanes<S>], inv_inertia_a[kLanes<S>], inv_mass_b[kLanes<S>], inv_inertia_b[kLanes<S>];
  S friction[kLanes<S>];
  S round_a[kLanes<S>], round_b[kLanes<S>];  // m, radii of the shapes: what is round looks the same when it has turned
  S share_a[kLanes<S>];                      // how much of the drift of the two centres is a's, see contact_kernels.cpp
  S drift2_max[kLanes<S>];                   // m²: squared drift up to which the arms follow it
  S coupling[kLanes<S>];                     // 1/kg: how an impulse at one point moves the other
  PointLanes<S> points[2];                   // a contact with one point has its second so far away that it never pushes
  std::uint32_t a[kLanes<S>], b[kLanes<S>];  // body slots; 0 in unused lanes
  std::uint32_t movable_a, movable_b;        // bit masks
  std::uint32_t count;                       // of used lanes
};

// What only the narrow phase, restitution and the events need of the same lanes.
template <class S>
struct alignas(64) ContactBlockRest {
  S restitution[kLanes<S>];
  S approach[2][kLanes<S>];  // m/s, normal velocity at the start of the step, negative if closing
  S bounce[2][kLanes<S>];    // m/s, at which a point leaves if it is hit in this sub-step: of the soft step alone
  S id[2][kLanes<S>];        // of the points' features, kNoPoint if there is none
  std::uint32_t shape_a[kLanes<S>], shape_b[kLanes<S>];
  std::uint32_t contact[kLanes<S>];
  std::uint32_t boxes, polygons, rounded;  // bit masks: pairs for the kernels of that name
  std::uint32_t begun;                     // bit mask: touch events have begun and not ended
};

inline constexpr double kNoPoint = -1;  // an id that no feature has
// Ids of the only point of a contact whose points were left out (seams.h); its separation is kFarSeparation.
inline constexpr double kIdlePoint = 1 << 18;         // they are its neighbours' now: it touches
inline constexpr double kGhostPoint = (1 << 18) + 1;  // it does not touch
inline constexpr double kFarSeparation = 1e6;         // m, of a second point that is not there

}  // namespace urto

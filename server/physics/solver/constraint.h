#pragma once

#include <vector>

#include "physics/data.h"
#include "physics/solver/wide.h"

namespace urto {

// One contact point of each lane of a block.
template <class S>
struct PointLanes {
  S ax[kLanes<S>], ay[kLanes<S>], bx[kLanes<S>], by[kLanes<S>];  // m, anchors from the centres of mass, world axes
  S separation[kLanes<S>];                                       // m, at the start of the step
  S inverse_mass[kLanes<S>];  // 1/kg along the normal: 1/m + 1/m + (r×n)²/I + (r×n)²/I
  S tangent_mass[kLanes<S>];  // kg along the tangent
  S normal_impulse[kLanes<S>], tangent_impulse[kLanes<S>];              // N·s, of this sub-step
  S preload[kLanes<S>];                                                 // N·s, see Softness
  S total_normal_impulse[kLanes<S>], total_tangent_impulse[kLanes<S>];  // N·s, of the step so far
  S approach[kLanes<S>];  // m/s, normal velocity at the start of the step, negative if closing
};

// Contacts ready to be solved side by side: no two lanes of a block share a body that can move.
template <class S>
struct alignas(64) ContactBlock {
  // Scalars first: each array is one cache line, and aligned.
  S nx[kLanes<S>], ny[kLanes<S>];
  S friction[kLanes<S>], restitution[kLanes<S>];
  S inv_mass_a[kLanes<S>], inv_inertia_a[kLanes<S>], inv_mass_b[kLanes<S>], inv_inertia_b[kLanes<S>];
  S share_a[kLanes<S>];     // how much of the drift of the two centres is a's, see contact_kernels.cpp
  S drift2_max[kLanes<S>];  // m²: squared drift up to which the arms follow it
  S coupling[kLanes<S>];    // 1/kg: how an impulse at one point moves the other
  S two[kLanes<S>];         // 1 if the contact has two points, 0 if one
  PointLanes<S> points[2];
  std::uint32_t a[kLanes<S>], b[kLanes<S>];  // body slots; 0 in unused lanes
  std::uint32_t contact[kLanes<S>];
  std::uint8_t movable_a[kLanes<S>], movable_b[kLanes<S>];  // 0 or 1
  std::uint32_t count;                                      // of used lanes
};

// Contacts grouped by colour: no two of one colour share a body that can move, so a colour may be solved in any
// order, or side by side, with the same result. Contacts with unmovable bodies come last, which makes them firmest.
template <class S>
struct ConstraintSet {
  std::vector<ContactBlock<S>> blocks;
  std::vector<std::uint8_t> colors;     // scratch: by touching contact
  std::vector<std::uint32_t> touching;  // scratch: contact slots
  std::vector<std::uint32_t> sorted;    // scratch: contact slots by colour
};

inline constexpr std::uint32_t kColorsMax = 64;  // the last one of a kind takes what fits nowhere else, one by one

// A damped spring of frequency f and damping ratio ζ as a soft constraint, integrated implicitly (Catto, "Soft
// Constraints", GDC 2011). Ours differs: the spring answers to what the point carries beyond its preload P, a slow
// average of its impulse,  v + bias_rate · s = −compliance · k · (λ − P).  A plain spring has to be compressed to carry
// what lies on it, and a stack of N boxes sinks by N² of that; with the preload it carries its load uncompressed in the
// end, and still yields to sudden change. (The multiplier of an augmented Lagrangian, updated slowly enough that the
// update does not race the solver's own convergence up the stack: kPreloadTime.)
template <class S>
struct Softness {
  S bias_rate;   // 1/s: ω / (2ζ + hω)
  S compliance;  // of the inverse mass: 1 / (hω (2ζ + hω))
  Softness(S hertz, S damping_ratio, S h);
};

// Collects the active contacts with points, colours them greedily in the order of the active list, and lays them out
// in blocks with their warm-start impulses.
template <class S>
void gather_contacts(WorldData<S>& world, ConstraintSet<S>& set);

// Writes impulses back for warm start and for the reader.
template <class S>
void store_impulses(WorldData<S>& world, const ConstraintSet<S>& set);

}  // namespace urto

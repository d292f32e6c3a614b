#pragma once

#include <vector>

#include "physics/data.h"

namespace urto {

// One contact point as the solver sees it.
template <class S>
struct ConstraintPoint {
  S ax, ay, bx, by;                   // m, anchors from the centres of mass at the start of the step, world axes
  S separation;                       // m, at the start of the step
  S inverse_mass;                     // 1/kg along the normal: k = 1/m + 1/m + (r×n)²/I + (r×n)²/I
  S tangent_mass;                     // kg along the tangent
  S normal_impulse, tangent_impulse;  // N·s, of this sub-step
  S preload;                          // N·s, see Softness
  S total_normal_impulse, total_tangent_impulse;  // N·s, of the step so far
  S approach;                                     // m/s, normal velocity at the start of the step, negative if closing
};

// A touching contact, ready to be solved.
template <class S>
struct ContactConstraint {
  std::uint32_t contact = kNone;
  std::uint32_t a = kNone, b = kNone;  // body slots
  int count = 0;
  S nx, ny;
  S friction, restitution;
  S inv_mass_a, inv_inertia_a, inv_mass_b, inv_inertia_b;
  S share_a;     // how much of the drift of the two centres is a's, see solve_contact
  S coupling;    // 1/kg: how an impulse at one point moves the other
  S bias_rate;   // 1/s
  S compliance;  // of the inverse mass, see Softness
  ConstraintPoint<S> points[2];
};

// Contacts grouped by colour: no two of one colour share a body that can move, so a colour may be solved in any
// order, or side by side, with the same result. Contacts with unmovable bodies come last, which makes them firmest.
template <class S>
struct ConstraintSet {
  std::vector<ContactConstraint<S>> contacts;
  std::vector<std::uint32_t> color_begin;  // one entry past the last colour too
  std::vector<std::uint8_t> colors;        // scratch: by touching contact
  std::vector<std::uint32_t> touching;     // scratch: contact slots
};

inline constexpr std::uint32_t kColorsMax = 64;  // the last one of a kind takes what fits nowhere else, in order

// Collects the active contacts with points, colours them greedily in the order of the active list, and prepares
// masses, softness and warm-start impulses. h: sub-step in seconds.
template <class S>
void prepare_contacts(WorldData<S>& world, ConstraintSet<S>& set, S h);

// Writes impulses back for warm start and for the reader.
template <class S>
void store_impulses(WorldData<S>& world, const ConstraintSet<S>& set);

}  // namespace urto

#pragma once

#include "physics/data.h"

namespace urto {

// The phase: drops contacts whose fat bounds parted, finds the manifolds of the others, carries impulses over by
// feature id, and wakes sleeping bodies that an awake one touches. With the default solver what touches gets a lane in
// the contact set, and what no longer does loses it.
template <class S>
void update_contacts(WorldData<S>& world);

// After the solve: begin and end events. A contact touches while its surfaces meet or an impulse flows.
template <class S>
void report_contact_events(WorldData<S>& world);

// How near two shapes' surfaces must come for a contact point, m: their speculative reach, and the way they may close
// in on each other in one step.
template <class S>
S reach_of(const Place<S>& a, const Place<S>& b);

}  // namespace urto

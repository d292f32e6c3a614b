#pragma once

#include "physics/data.h"

namespace urto {

// Keeps the broad phase's bounds around the bodies, and finds the pairs they make.

// Bounds of a shape at its place.
template <class S>
Aabb<S> tight_bounds(const WorldData<S>& world, Proxy proxy);

// The same, stretched over the way its body will come in one step at its velocity.
template <class S>
Aabb<S> swept_bounds(const WorldData<S>& world, Proxy proxy);

// Bounds of all that the shape passes over when its body moves by the motion that the solver has given it. Places must
// still be those of the start of the step.
template <class S>
Aabb<S> way_bounds(const WorldData<S>& world, Proxy proxy);

// Sets a body's places after it moved, and its proxies' fat bounds where they were left: those it appends to `left`, to
// be announced. Bodies may be followed side by side.
template <class S>
void follow_body(WorldData<S>& world, std::uint32_t slot, std::vector<Proxy>& left);

// Tells the broad phase of a proxy's new fat bounds.
template <class S>
void announce_bounds(WorldData<S>& world, Proxy proxy);

// Sets a proxy's fat bounds anew, in the broad phase too.
template <class S>
void refresh_bounds(WorldData<S>& world, Proxy proxy);

// Sets a body's places and bounds anew as they should be now, whatever they were.
template <class S>
void reset_bounds(WorldData<S>& world, std::uint32_t slot);

// Puts a proxy into the list of those whose pairs are sought at the next step.
template <class S>
void mark_moved(WorldData<S>& world, Proxy proxy);

// The phase: makes contacts of new pairs among moved proxies that filters and body types let touch.
template <class S>
void update_broad_phase(WorldData<S>& world);

}  // namespace urto

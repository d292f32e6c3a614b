#pragma once

#include "physics/data.h"

namespace urto {

// Makes bodies of their descriptions and takes them away again, with all that hangs on them. `def` has been checked.

template <class S>
std::uint32_t create_body(WorldData<S>& world, const BodyDef& def);

// Contacts end with an event, and what rested on the body wakes.
template <class S>
void destroy_body(WorldData<S>& world, std::uint32_t slot);

// Counts a body and its shapes in (+1) or out (−1) of the model's needs.
template <class S>
void count_needs(WorldData<S>& world, std::uint32_t slot, int sign);

// Chooses the model anew and, if it asks for another broad phase, moves all proxies into that.
template <class S>
void update_model(WorldData<S>& world);

}  // namespace urto

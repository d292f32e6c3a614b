#pragma once

#include "physics/data.h"
#include "physics/world.h"

namespace urto {

// Sets what the counters say of contacts. A room asks every tick, so it copies no contact.
template <class S>
void count_contacts(const WorldData<S>& world, Counters& counters);

}  // namespace urto

#pragma once

#include <cstddef>
#include <span>

#include "physics/data.h"

namespace urto {

// The dynamic state as one flat block: a header (what it is, its size, a checksum), the settings, and each array of
// for_each_state_field as its count and its bytes. Little-endian, as every machine that Urto runs on.

template <class S>
std::vector<std::byte> save_state(const WorldData<S>& world);

// Errors: kCorruptState. The world is unchanged then.
template <class S>
Status restore_state(WorldData<S>& world, std::span<const std::byte> block);

// XXH3 of everything after the header.
std::uint64_t hash_of_state(std::span<const std::byte> block);

}  // namespace urto

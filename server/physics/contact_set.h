#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "physics/contact.h"
#include "physics/contact_block.h"

namespace urto {

template <class S>
struct WorldData;

// Contacts by colour: no two of one colour share a body that can move, so a colour may be solved in any order, or side
// by side, with the same result. A contact keeps its colour while it touches. Contacts with unmovable bodies come last,
// which makes them firmest.
inline constexpr std::uint32_t kColorsMax = 64;
inline constexpr std::uint32_t kMovableColors = kColorsMax / 2;  // the other half is for unmovable bodies
// The last colour of a kind takes what fits nowhere else, one lane a block.
constexpr bool takes_what_fits_nowhere(std::uint32_t color) {
  return color == kMovableColors - 1 || color == kColorsMax - 1;
}
template <class S>
constexpr std::uint32_t lanes_used(std::uint32_t color) {
  return takes_what_fits_nowhere(color) ? 1u : static_cast<std::uint32_t>(kLanes<S>);
}

template <class S>
struct ContactSet {
  struct Color {
    std::vector<ContactBlock<S>> blocks;
    std::vector<ContactBlockRest<S>> rest;  // of the same lanes
    std::uint32_t size = 0;                 // of used lanes; all blocks but the last are full
  };
  struct WholeBlock {
    ContactBlock<S>* block;
    ContactBlockRest<S>* rest;
  };
  std::array<Color, kColorsMax> colors;
  std::vector<WholeBlock> blocks;    // scratch: all of them in order
  std::vector<std::uint64_t> taken;  // by body slot: colours of its contacts, a bit each
  bool current = false;              // the lanes hold this step's manifolds (not so after a restore)
};

// Lists all blocks as they are now, colour after colour.
template <class S>
const std::vector<typename ContactSet<S>::WholeBlock>& list_blocks(ContactSet<S>& set) {
  set.blocks.clear();
  for (auto& color : set.colors)
    for (std::size_t i = 0; i < color.blocks.size(); ++i) set.blocks.push_back({&color.blocks[i], &color.rest[i]});
  return set.blocks;
}

// Puts a contact with points into a lane, with the impulses of its record. Its manifold follows in update_contacts.
template <class S>
void insert_lane(WorldData<S>& world, std::uint32_t contact);
// The same in a given colour: what restore does.
template <class S>
void insert_lane(WorldData<S>& world, std::uint32_t contact, std::uint32_t color);

// Takes it out again; its manifold and impulses go back into its record.
template <class S>
void remove_lane(WorldData<S>& world, std::uint32_t contact);

// The contact's record with its manifold, wherever that is now.
template <class S>
Contact<S> settled(const WorldData<S>& world, std::uint32_t contact);

// The colours' contacts in order, for the saved state, and back.
template <class S>
std::vector<std::uint32_t> lane_order(const WorldData<S>& world);
template <class S>
void rebuild_lanes(WorldData<S>& world, const std::vector<std::uint32_t>& order);

}  // namespace urto

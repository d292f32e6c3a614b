#pragma once

#include "physics/data.h"

namespace urto {

// Contacts as edges between bodies, and who is awake. Lists keep their order across save and restore.

template <class S>
std::uint32_t create_contact(WorldData<S>& world, Proxy low, Proxy high);

// Ends the contact (with an event if it touched) and forgets it.
template <class S>
void destroy_contact(WorldData<S>& world, std::uint32_t contact);

// Wakes a body and, through touching contacts, the dynamic bodies it rests on or carries. Static bodies stay still.
template <class S>
void wake_body(WorldData<S>& world, std::uint32_t slot);

// Wakes what touches a body that is about to be moved or taken away.
template <class S>
void wake_neighbours(WorldData<S>& world, std::uint32_t slot);

// Moves an active contact that touches into the contact set, and back.
template <class S>
void give_lane(WorldData<S>& world, std::uint32_t contact);
template <class S>
void release_lane(WorldData<S>& world, std::uint32_t contact);

// Takes one body out of the awake ones; its contacts become inactive unless the other body is awake.
template <class S>
void put_to_sleep(WorldData<S>& world, std::uint32_t slot);

// Its touch begins, or ends if it had begun.
template <class S>
void toggle_touch(WorldData<S>& world, Contact<S>& contact);

template <class S>
ContactEvent end_event(const WorldData<S>& world, const Contact<S>& contact);

// Calls visit(contact slot) for each contact of a body; visit must not change the list.
template <class S, class Visit>
void for_each_contact_of(const WorldData<S>& world, std::uint32_t slot, Visit&& visit) {
  std::uint32_t edge = world.bodies[slot].first_contact;
  while (edge != kNone) {
    visit(edge >> 1);
    edge = world.contacts[edge >> 1].next[edge & 1];
  }
}

}  // namespace urto

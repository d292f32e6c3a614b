#pragma once

// Everything a world is made of, as plain arrays, and nothing that acts on it. The phases of the step are free
// functions on a WorldData; what the future depends on is listed in for_each_state_field.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "physics/body.h"
#include "physics/broad_phase/broad_phase.h"
#include "physics/contact.h"
#include "physics/contact_set.h"
#include "physics/joint.h"
#include "physics/model.h"
#include "physics/narrow_phase/box_kernels.h"
#include "physics/narrow_phase/outline.h"
#include "physics/pair_set.h"
#include "physics/places.h"
#include "physics/shape.h"
#include "physics/team.h"
#include "physics/world.h"

namespace urto {

// A contact with an awake body and no lane, with what is asked of it each step at hand.
struct ActiveContact {
  std::uint32_t contact, shape_a, shape_b;
  std::uint32_t sensor;  // 0 or 1
};

// The lane of a contact of a dynamic shape with one that is not, and its new manifold (seams.h).
template <class S>
struct GroundLane {
  Proxy shape, ground;  // the one that moves, and what it lies on
  std::uint32_t lane;
  bool moves_b;  // the one that moves is the contact's b
  ContactBlock<S>* block;
  ContactBlockRest<S>* rest;
  ManifoldLanes<S>* manifolds;
};
// What a point has to take over when its lane has taken its manifold.
template <class S>
struct AdoptedImpulse {
  ContactBlock<S>* block;
  ContactBlockRest<S>* rest;
  std::uint32_t lane;
  S id, normal_impulse, tangent_impulse, preload;
};

// Buffers that live for one phase; kept for their capacity only.
template <class S>
struct Scratch {
  std::vector<std::pair<Proxy, Proxy>> pairs;
  std::vector<Proxy> proxies;
  std::vector<std::uint32_t> stack;
  std::vector<std::vector<std::uint32_t>> restful;  // body slots, a list for each part of a shared loop
  std::vector<std::uint32_t> parent;                // union-find, by body slot
  std::vector<std::uint8_t> rest, kept_awake;       // by body slot, see sleep.cpp
  std::vector<Vec<S>> pulls;                        // m/s, by awake index
  std::vector<Kick<S>> kicks;                       // by body slot; all zero between steps
  std::vector<std::uint32_t> stretched;             // body slots, see continuous.h
  std::vector<std::uint32_t> course;                // by body slot, see course.h; all kNone between steps
  std::vector<std::uint32_t> parted, met;           // contact slots
  std::vector<std::uint8_t> findings;               // by index of active contact
  std::vector<std::vector<std::uint32_t>> by_part;  // of a shared loop
  std::vector<ManifoldLanes<S>> manifolds;          // of the contacts with unmovable bodies, by block
  std::vector<GroundLane<S>> ground;
  std::vector<std::uint64_t> ground_order;
  std::vector<AdoptedImpulse<S>> adopted;
};

// What rounding left out of a body's velocity when it was last summed, and the velocity that it belongs to: another one
// has nothing left over.
struct SpeedRest {
  double vx = 0, vy = 0;          // m/s
  double rest_x = 0, rest_y = 0;  // m/s
};

template <class S>
struct WorldData {
  WorldSettings settings;
  std::uint64_t step_count = 0;

  std::vector<Body<S>> bodies;     // by slot
  std::vector<Motion<S>> motions;  // by slot
  std::vector<std::uint32_t> free_bodies;
  std::vector<Shape<S>> shapes;     // by slot: the proxies of the broad phase
  std::vector<Convex<S>> convexes;  // by shape slot
  std::vector<std::uint32_t> free_shapes;
  std::vector<Contact<S>> contacts;  // by slot
  std::vector<std::uint32_t> free_contacts;
  std::vector<Joint<S>> joints;  // by slot
  std::vector<std::uint32_t> free_joints;
  std::vector<SpeedRest> speed_rests;  // by body slot: of the precise solver alone

  std::vector<std::uint32_t> awake;          // body slots: awake and not static
  std::vector<ActiveContact> active;         // contacts with an awake body and no lane
  std::vector<std::uint32_t> active_joints;  // joint slots with an awake body
  std::vector<Proxy> moved;                  // left their fat bounds since pairs were last sought

  // Derived: rebuilt by restore.
  Needs needs;
  Model model;
  std::unique_ptr<BroadPhase<S>> broad_phase;
  ContactSet<S> touching;                // the lanes of contacts with an awake body that touch
  std::vector<Place<S>> places;          // by shape slot: as of the start of the step, or of falling asleep
  std::vector<OutlineRows<S>> outlines;  // by shape slot: of the convexes, for the kernels
  PairSet pair_set;
  std::uint32_t touching_count = 0;        // of contacts that have begun and not ended
  mutable std::optional<S> resting_depth;  // m ≤ 0, the least separation of a contact that sleeps; none: not known

  std::shared_ptr<Team> team = std::make_shared<Team>(1);

  // The first `events_reported` are those of the last step; the rest came since (of bodies that were removed) and will
  // be those of the next.
  std::vector<ContactEvent> events;
  std::size_t events_reported = 0;
  std::vector<JointEvent> joint_events;  // of the last step

  Scratch<S> scratch;

  // The arrays that make up the saved state.
  template <class Self, class Visitor>
  static void for_each_state_field(Self& self, Visitor&& visit) {
    visit("step_count", self.step_count);
    visit("bodies", self.bodies);
    visit("motions", self.motions);
    visit("free_bodies", self.free_bodies);
    visit("shapes", self.shapes);
    visit("convexes", self.convexes);
    visit("free_shapes", self.free_shapes);
    visit("contacts", self.contacts);
    visit("free_contacts", self.free_contacts);
    visit("awake", self.awake);
    visit("active", self.active);
    visit("moved", self.moved);
  }

  // Arrays of features that few worlds have. One that is empty leaves no trace in the saved state; a number that is
  // never used again tells them apart; 4 is that of a setting (state.cpp).
  template <class Self, class Visitor>
  static void for_each_optional_field(Self& self, Visitor&& visit) {
    visit(1u, "joints", self.joints);
    visit(2u, "free_joints", self.free_joints);
    visit(3u, "active_joints", self.active_joints);
    visit(5u, "speed_rests", self.speed_rests);
  }
};

// An empty list for each part of a loop that the team shares. One after the other they are in the loop's order.
template <class S>
std::vector<std::vector<std::uint32_t>>& lists_by_part(WorldData<S>& world) {
  world.scratch.by_part.resize(world.team->parts_max());
  for (auto& list : world.scratch.by_part) list.clear();
  return world.scratch.by_part;
}

inline BodyId id_of(std::uint32_t slot, std::uint32_t generation) {
  return (static_cast<BodyId>(generation) << 32) | (slot + 1);
}
template <class S>
inline BodyId id_of(const WorldData<S>& world, std::uint32_t slot) {
  return id_of(slot, world.bodies[slot].generation);
}

}  // namespace urto

#pragma once

#include <cstdint>

#include "physics/body.h"

namespace urto {

enum ContactFlag : std::uint32_t {
  kContactAlive = 1u << 0,
  kContactTouching = 1u << 1,  // has begun and not ended
  kContactSensor = 1u << 2,
  kContactStruck = 1u << 3,  // has been struck; the bits from the 8th on say when (hits.cpp)
};

template <class S>
struct ManifoldPoint {
  S ax = 0, ay = 0;      // m, from a's centre of mass, world axes
  S bx = 0, by = 0;      // m, from b's centre of mass: the same world point
  S separation = 0;      // m, negative if penetrating, at the start of the step
  S normal_impulse = 0;  // N·s of the last sub-step: warm start of the next
  S tangent_impulse = 0;
  S preload = 0;               // N·s, slow average of the normal impulse: the load that rests on the point
  S total_normal_impulse = 0;  // N·s over the whole step
  S total_tangent_impulse = 0;
  std::uint32_t id = 0;      // which features meet here
  std::uint32_t unused = 0;  // no padding
};

// Two shapes whose bounds overlap, and where they touch. While a contact has a lane (contact_set.h), its manifold is
// kept there, and the one here is of an earlier time: settled() tells where they touch.
template <class S>
struct Contact {
  std::uint32_t shape_a = kNone, shape_b = kNone;  // a < b
  std::uint32_t body_a = kNone, body_b = kNone;
  std::uint32_t next[2] = {kNone, kNone};  // edges of the bodies' contact lists
  std::uint32_t prev[2] = {kNone, kNone};
  std::uint32_t color = kNone;  // of its lane in the contact set; kNone: it has none
  std::uint32_t index = kNone;  // of its lane within the colour, or in the list of active contacts
  std::uint32_t flags = 0;
  std::uint32_t count = 0;  // of points; with a lane: any but 0
  S friction = 0, restitution = 0;
  S approach = 0;    // m/s ≥ 0, how fast the surfaces closed in at the start of the step
  S nx = 0, ny = 0;  // unit normal from a to b, world frame
  ManifoldPoint<S> points[2];

  bool alive() const { return (flags & kContactAlive) != 0; }
  bool touching() const { return (flags & kContactTouching) != 0; }
  bool sensor() const { return (flags & kContactSensor) != 0; }
  bool has_lane() const { return color != kNone; }
};

static_assert(sizeof(ManifoldPoint<float>) == 48 && sizeof(ManifoldPoint<double>) == 88);
static_assert(sizeof(Contact<float>) == 12 * 4 + 5 * 4 + 96 && sizeof(Contact<double>) == 12 * 4 + 5 * 8 + 176);

}  // namespace urto

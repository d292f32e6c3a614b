#pragma once

#include <cstdint>
#include <type_traits>

#include "physics/definitions.h"
#include "physics/geometry/rotation.h"

namespace urto {

inline constexpr std::uint32_t kNone = 0xffffffffu;

enum BodyFlag : std::uint32_t {
  kBodyAlive = 1u << 0,
  kBodyAwake = 1u << 1,
  kBodyFixedRotation = 1u << 2,
  kBodyForceInBodyFrame = 1u << 3,
  kBodyHasForce = 1u << 4,
};

// What the solver gathers: velocities, and how far the body has come since the start of the step.
template <class S>
struct Motion {
  S vx = 0, vy = 0, w = 0;   // m/s of the centre of mass, rad/s
  S dx = 0, dy = 0, da = 0;  // m, m, rad; zero between steps
  S c = 1, s = 0;            // rotation by da
};

// What the impulses of the sub-step before will add to a body's velocities when they are applied again.
template <class S>
struct Kick {
  S vx = 0, vy = 0, w = 0;  // m/s, rad/s
  S unused = 0;             // rows are of four
};

// Everything else of a body. Records have no padding: the state is hashed as it lies in memory.
template <class S>
struct Body {
  S x = 0, y = 0;                   // centre of mass, world frame
  S angle = 0;                      // (−π, π]
  S c = 1, s = 0;                   // rotation by angle
  S local_x = 0, local_y = 0;       // centre of mass, body frame
  S inv_mass = 0, inv_inertia = 0;  // 0 unless dynamic
  S mass = 0, inertia = 0;
  S linear_damping = 0, angular_damping = 0, gravity_scale = 1;
  S force_x = 0, force_y = 0, torque = 0;
  S extent_min = 0;  // least distance from the centre of mass to a boundary
  S extent_max = 0;  // greatest
  S sleep_time = 0;  // s below the speed of sleep
  std::uint32_t generation = 0;
  std::uint32_t type = 0;  // BodyType
  std::uint32_t flags = 0;
  std::uint32_t first_shape = kNone, shape_count = 0;
  std::uint32_t first_contact = kNone;  // edge: contact · 2 + side
  std::uint32_t awake_index = kNone;
  std::uint32_t first_joint = 0;  // edge of its joint list (joint.h), 0: none

  BodyType body_type() const { return static_cast<BodyType>(type); }
  bool dynamic() const { return body_type() == BodyType::kDynamic; }
  bool alive() const { return (flags & kBodyAlive) != 0; }
  bool awake() const { return (flags & kBodyAwake) != 0; }
  bool can_rotate() const { return inv_inertia > S(0) || body_type() == BodyType::kKinematic; }

  Rotation<S> rotation() const { return {c, s}; }
  Vec<S> local_center() const { return Vec<S>(local_x, local_y); }
  Vec<S> center() const { return Vec<S>(x, y); }
  Vec<S> origin() const { return center() - rotation().apply(local_center()); }
  Transform<S> pose() const { return {origin(), rotation()}; }
};

static_assert(sizeof(Motion<float>) == 32 && sizeof(Motion<double>) == 64);
static_assert(sizeof(Body<float>) == 20 * 4 + 8 * 4 && sizeof(Body<double>) == 20 * 8 + 8 * 4);
static_assert(std::is_trivially_copyable_v<Body<float>>);

}  // namespace urto

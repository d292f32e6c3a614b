#pragma once

#include "physics/data.h"

namespace urto {

// Questions about a world as it is. Arguments have been checked. Sensors are not seen.

template <class S>
std::vector<BodyId> bodies_at(const WorldData<S>& world, const Vec2& point);
template <class S>
std::vector<BodyId> bodies_in(const WorldData<S>& world, const Vec2& lower, const Vec2& upper);
template <class S>
std::vector<RayHit> bodies_along(const WorldData<S>& world, const Vec2& origin, const Vec2& translation);
template <class S>
std::vector<NearHit> bodies_near(const WorldData<S>& world, const Vec2& point, double distance_max,
                                 std::uint32_t count_max);

// Energy and momentum of the dynamic bodies.
template <class S>
Energy energy_of(const WorldData<S>& world);

template <class S>
std::vector<ContactPoint> contact_points_of(const WorldData<S>& world);

}  // namespace urto

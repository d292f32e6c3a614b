#pragma once

#include "physics/solver/precise/path.h"

namespace urto {

// Where two shapes touch at a moment: like the manifold of the narrow phase, but exact. SAT there prefers one of two
// nearly equal faces, which keeps its choice steady; here the direction that separates best is taken to the last digit.
// Where corners meet, two directions separate equally well, and bodies that do not approach along one of them pass.
struct TouchPoint {
  Vec2 arm_a{0, 0}, arm_b{0, 0};  // m, from the centres of mass, world axes: one world point
  double gap = 0;                 // m, negative if penetrating
  std::uint32_t id = 0;           // which features meet, as in ManifoldPoint
};
struct Touch {
  Vec2 normal{0, 0};  // unit, from a to b, world axes
  TouchPoint points[2];
  int count = 0;
};

// m/s along the normal at a point, negative if the bodies approach.
double parting_speed(const Vec2& normal, const Vec2& arm_a, const Path& a, const Vec2& arm_b, const Path& b);

// A touching point half-way through an interval, if the bodies go on as they move now: a force over the whole interval
// acts there. A corner moves on an arc and not on its tangent: `gain` is what turning and rolling alone add to the
// parting speeds from there to the end, along the normal and along cross(normal, 1).
struct MiddleOfTouch {
  Vec2 normal{0, 0};
  Vec2 arm_a{0, 0}, arm_b{0, 0};
  double gain_normal = 0, gain_tangent = 0;  // m/s
};
MiddleOfTouch middle_of(const WorldData<double>& world, const Contact<double>& contact, const Vec2& normal,
                        const TouchPoint& point, const Path& path_a, const Path& path_b, double duration);

// Points further apart than reach are left out. Both paths tell of the same moment.
Touch find_touch(const WorldData<double>& world, const Contact<double>& contact, const Path& path_a, const Path& path_b,
                 double reach);

}  // namespace urto

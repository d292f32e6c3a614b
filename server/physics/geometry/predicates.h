#pragma once

#include "physics/definitions.h"

namespace urto {

// Which side of the line a → b the point c is on: 1 left, −1 right, 0 on it. Exact for coordinates between 1e-140 and
// 1e140 in size: what a rounded determinant cannot decide is summed without rounding (after Shewchuk 1997, Adaptive
// Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates; ours has two stages instead of four).
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

// Whether the closed segments a0 → a1 and b0 → b1 have a point in common. Exact as orientation() is.
bool segments_meet(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1);

}  // namespace urto
